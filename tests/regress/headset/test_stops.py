"""A stopped training of headset networks ends with 75, keeps its whole epochs, and goes on from them."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from regress.runtime.headset.network.predictor import load_headset_predictor
from tests.regress.headset.drawn import write_drawn_arrays

pytest.importorskip("torch")

SETTINGS = "--epochs 6 --set input_size=16 --set code=8 --set hidden=8 --set batch=4"


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_stopped_headset_training_goes_on_from_its_last_epoch(tmp_path: Path, number: signal.Signals):
    arrays = write_drawn_arrays(tmp_path / "arrays", people=8)
    place = tmp_path / "models"
    place.mkdir()
    command = [sys.executable, "-m", "regress", "headset", "train", arrays, "--out", place / "tiny"]
    command = [*map(str, command), *SETTINGS.split()]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])}
    training = subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)
    checkpoint = place / ".tiny.checkpoint"
    while training.poll() is None and not checkpoint.exists():
        time.sleep(0.02)
    training.send_signal(number)
    _, said = training.communicate(timeout=120)
    assert training.returncode == 75, said
    assert "Traceback" not in said
    assert names(place) == [checkpoint.name]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert names(place) == ["tiny"]
    assert load_headset_predictor(place / "tiny").model.training.resumed_after_epochs >= 1
    assert json.loads((place / "tiny" / "model.json").read_text())["kind"] == "headset"

"""Commands speak to nobody: no address is looked up or connected to, and no file is left that was not asked for."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.regress.headset.takes import pictures, write_take
from tests.regress.headset.tiny import write_tiny_model

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def inputs(quick_model_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("silence")
    write_tiny_model(folder / "headset")
    write_take(
        folder / "take", {name: pictures([0.2, 0.4, 0.6]) for name in ("left_eye", "right_eye", "mouth")}
    )
    np.save(folder / "points.npy", np.random.default_rng(0).normal(size=(3, 68, 2)))
    return {"folder": folder, "landmarks": quick_model_folder}


COMMANDS = {
    "help": "--help",
    "version": "--version",
    "predict": "predict {landmarks} {folder}/points.npy",
    "export": "export {landmarks} --out {out}",
    "bench": "bench {folder}/headset",
    "headset predict": "headset predict {folder}/headset --camera mouth={folder}/take/mouth",
    "headset export": "headset export {folder}/headset --out {out}",
}


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS.keys())
def test_a_command_speaks_to_nobody(command: str, inputs: dict[str, Path], tmp_path: Path):
    home, temporary, out = (tmp_path / name for name in ("home", "temporary", "out"))
    home.mkdir(), temporary.mkdir()
    # nothing of the caller's: onnxruntime is silent wherever CI is set, and wherever it is asked to be
    environment = {
        "PATH": os.environ["PATH"],
        "HOME": str(home),
        "TMPDIR": str(temporary),
        "PYTHONPATH": str(ROOT),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    trace = tmp_path / "trace.txt"
    strace = _strace(trace)
    arguments = command.format(**inputs, out=out).split()
    done = subprocess.run(
        [*strace, sys.executable, "-m", "regress", *arguments],
        env=environment,
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    left = [path for folder in (home, temporary) for path in folder.rglob("*") if path.is_file()]
    assert not left
    if not strace:
        pytest.skip("the command left no file; whether it looks up a host was not seen, for lack of strace")
    calls = trace.read_text().splitlines()
    assert calls[-1].endswith("+++ exited with 0 +++")
    assert not [call for call in calls if "AF_INET" in call]


def _strace(trace: Path) -> list[str]:
    """The words before a command that write its calls to the network; none where there is no working strace."""
    words = ["strace", "-f", "-e", "trace=network", "-o", str(trace)]
    there = shutil.which("strace") and not subprocess.run([*words, "true"], capture_output=True).returncode
    return words if there else []

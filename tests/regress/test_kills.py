"""Kills: whenever a command of regress dies, what it was to replace is the old one or the new one, whole."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from regress.runtime.model import load_model
from tests.regress.conftest import write_dataset
from tests.regress.drawn import drawn_dataset

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not hasattr(os, "fork"), reason="children are forks"),
]

KILLS = 20
"""Of each command at random moments, and as many at steps on the disk, evenly chosen among all."""

Ask = Callable[..., dict[str, Any]]


@pytest.fixture(scope="module")
def ask() -> Iterator[Ask]:
    """Run a command in a child of a process that has loaded everything, and end it."""
    program = Path(__file__).with_name("killed.py")
    environment = {**os.environ, "PYTHONPATH": str(program.parents[2]), "PYTHONWARNINGS": "ignore"}
    process = subprocess.Popen(
        [sys.executable, str(program)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env=environment,
    )

    def call(*words: object, **how: object) -> dict[str, Any]:
        process.stdin.write(json.dumps({"words": list(map(str, words)), **how}) + "\n")
        process.stdin.flush()
        return json.loads(process.stdout.readline())

    yield call
    process.stdin.close()
    assert process.wait(30) == 0
    process.stdout.close()


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data") / "drawn"
    write_dataset(drawn_dataset(np.random.default_rng(5), people=10), folder)
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def hidden(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.name.startswith(".")]


def deaths(ask: Ask, words: tuple[object, ...], *, old: Path, place: Path) -> Iterator[dict[str, object]]:
    """Run a command over a copy of an old folder again and again, killed by steps and then by the clock.

    Yields how it was ended; the test looks at the place after each.
    """

    def put_back() -> None:
        # and what a killed one left, which the next one would sweep in steps of its own; the last one's is swept
        for path in (place, *(place.parent / name for name in hidden(place.parent))):
            shutil.rmtree(path, ignore_errors=True)
        shutil.copytree(old, place)

    put_back()
    whole = ask(*words)
    assert whole["code"] == 0
    chance = random.Random(26)
    # the last one too, which is behind the exchange: by time alone a slow machine never comes so far
    steps = [1 + kill * (whole["steps"] - 1) // (KILLS - 1) for kill in range(KILLS)]
    died = 0
    for how in (
        *({"step": step} for step in steps),
        *({"after_s": whole["seconds"] * chance.random()} for _ in range(KILLS)),
    ):
        put_back()
        died += ask(*words, **how)["code"] == -signal.SIGKILL
        yield how
    assert died >= KILLS


@pytest.fixture(scope="module")
def models(ask: Ask, data: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Two models of other seeds."""
    folder = tmp_path_factory.mktemp("models")
    for seed, name in enumerate(("old", "new")):
        assert ask("train", data, "--out", folder / name, "--seed", seed)["code"] == 0
    assert contents(folder / "old") != contents(folder / "new")
    return folder / "old", folder / "new"


def test_a_killed_training_leaves_the_old_model_or_the_new_one(
    ask: Ask, data: Path, models: tuple[Path, Path], tmp_path: Path
):
    old, new = map(contents, models)
    place = tmp_path / "model"
    words = ("train", data, "--out", place, "--seed", 1)
    outcomes = set()
    for how in deaths(ask, words, old=models[0], place=place):
        found = contents(place)
        assert found in (old, new), how
        load_model(place)
        outcomes.add(found == new)
    assert outcomes == {False, True}
    assert ask(*words)["code"] == 0
    assert contents(place) == new
    assert hidden(tmp_path) == []


def test_a_first_training_that_is_killed_leaves_nothing_or_a_model(
    ask: Ask, data: Path, models: tuple[Path, Path], tmp_path: Path
):
    new, place = contents(models[1]), tmp_path / "model"
    words = ("train", data, "--out", place, "--seed", 1)
    steps = ask(*words)["steps"]
    for step in range(1, steps + 1):
        shutil.rmtree(place, ignore_errors=True)
        assert ask(*words, step=step)["code"] == -signal.SIGKILL
        assert not place.exists() or contents(place) == new
    assert ask(*words)["code"] == 0
    assert hidden(tmp_path) == []


@pytest.mark.parametrize("command", ["export", "report"])
def test_killed_exports_and_reports_leave_whole_files(
    ask: Ask, models: tuple[Path, Path], tmp_path: Path, command: str
):
    def words(model: Path, out: Path) -> tuple[object, ...]:
        if command == "report":
            return ("report", model, "--out", out / "report.html")
        return ("export", model, "--format", "javascript", "--out", out)

    versions = []
    for model in models:
        assert ask(*words(model, tmp_path / model.name))["code"] == 0
        versions.append(contents(tmp_path / model.name))
    place = tmp_path / "place"
    changed = set()
    for how in deaths(ask, words(models[1], place), old=tmp_path / "old", place=place):
        found = {name: content for name, content in contents(place).items() if not name.startswith(".")}
        assert found.keys() == versions[0].keys()
        for name, content in found.items():
            assert content in (versions[0][name], versions[1][name]), (name, how)
            changed.add(content == versions[1][name])
    assert changed == {False, True}
    assert ask(*words(models[1], place))["code"] == 0
    assert contents(place) == versions[1]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_stopped_training_ends_with_75_and_leaves_the_old_model_or_the_new_one(
    ask: Ask, data: Path, models: tuple[Path, Path], tmp_path: Path, number: signal.Signals
):
    old, new = map(contents, models)
    place = tmp_path / "model"
    shutil.copytree(models[0], place)
    words = ("train", data, "--out", place, "--seed", 1)
    seconds, codes = ask(*words)["seconds"], set()
    for part in range(8):
        shutil.rmtree(place)
        shutil.copytree(models[0], place)
        codes.add(ask(*words, after_s=seconds * (part + 0.5) / 8, signal=number)["code"])
        assert contents(place) in (old, new)
        assert hidden(tmp_path) == []
    assert 75 in codes
    assert codes <= {0, 75}

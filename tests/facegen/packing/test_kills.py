"""Kills: whenever `pack` or `merge` dies, the same command run again ends in the same bytes and leaves nothing else."""

import os
import random
import shutil
import signal
from collections.abc import Callable
from pathlib import Path

import pytest

from facegen.packing import PACK_FORMATS
from tests.regress.test_kills import KILLS, Ask, ask, contents

__all__ = ["ask"]

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not hasattr(os, "fork"), reason="children are forks"),
]


PACK_KILLS = 5
"""Of each format, by steps and as many by the clock."""


@pytest.fixture(scope="module")
def halves(recorded, tmp_path_factory) -> tuple[Path, Path]:
    """Two runs of one spec; `merge` reads no pictures, so any files stand for rendered samples."""
    folder = tmp_path_factory.mktemp("halves")
    runs = [shutil.copytree(recorded.folder.path, folder / name) for name in ("a", "b")]
    for number, run in enumerate((runs[0], runs[0], runs[1], runs[1], runs[1])):
        rendered = run / "renders" / "000" / f"{number:06d}"
        rendered.mkdir(parents=True)
        for name in ("sample.json", "mouth.png"):
            (rendered / name).write_text(f"{name} of {number}")
    return runs[0], runs[1]


def killed_and_run_again(
    ask: Ask,
    words: tuple[object, ...],
    place: Path,
    *,
    kills: int = KILLS,
    left: Callable[[dict[str, bytes]], None] = lambda whole: None,
) -> None:
    """Kill a command at steps on the disk and by the clock; the next run must end as one that nobody killed.

    ``left`` looks at what a killed one has left, and takes what there is at the end.
    """
    whole = ask(*words, program="facegen")
    assert whole["code"] == 0
    expected, names = contents(place), sorted(path.name for path in place.iterdir())
    chance = random.Random(26)
    steps = [1 + kill * whole["steps"] // kills for kill in range(kills)]
    died = 0
    for how in (
        *({"step": step} for step in steps),
        *({"after_s": whole["seconds"] * chance.random()} for _ in range(kills)),
    ):
        shutil.rmtree(place)
        died += ask(*words, program="facegen", **how)["code"] == -signal.SIGKILL
        left(expected)
        assert ask(*words, program="facegen")["code"] == 0, how
        assert contents(place) == expected, how
        assert sorted(path.name for path in place.iterdir()) == names, how
        place.mkdir(exist_ok=True)
    assert died >= kills


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.blender] if form.rendered else [])
        for name, form in PACK_FORMATS.items()
    ],
)
def test_a_pack_that_was_killed_goes_on(ask: Ask, request, tmp_path, name):
    """Whole files alone stand under their names, and the index comes with the last of them."""
    out = tmp_path / "pack"
    rendered = PACK_FORMATS[name].rendered
    dataset = request.getfixturevalue("rendered" if rendered else "recorded")
    more = ("--shard-size", 1 if rendered else 100) if "shard_size" in PACK_FORMATS[name].options else ()
    words = ("pack", dataset.folder.path, "--format", name, "--out", out, *more)

    def whole_files_alone(whole: dict[str, bytes]) -> None:
        found = {path: content for path, content in contents(out).items() if not path.startswith("tmp/")}
        assert found.items() <= whole.items()
        assert "index.json" not in found or found == whole

    killed_and_run_again(ask, words, out, kills=PACK_KILLS, left=whole_files_alone)
    assert [path.name for path in tmp_path.iterdir()] == ["pack"]


def test_a_merge_that_was_killed_goes_on(ask: Ask, halves, tmp_path):
    out, sources = tmp_path / "all", [contents(half) for half in halves]
    killed_and_run_again(ask, ("merge", *halves, "--out", out), out)
    assert [contents(half) for half in halves] == sources
    assert [path.name for path in tmp_path.iterdir()] == ["all"]

"""The people of the gallery, at one exposure, have the levels of real headset cameras."""

import dataclasses
import importlib.util
from pathlib import Path

import numpy as np
import pytest

from facegen.spec import load_spec
from facegen.store import resolve
from facegen.work import generate

ROOT = Path(__file__).resolve().parents[3]

SIZE_PX = 128
"""Half of the gallery's; with less still, pixels that pupil and iris share make pupils lighter than real ones."""

pytestmark = [pytest.mark.slow, pytest.mark.blender, pytest.mark.usefixtures("anny")]


@pytest.fixture(scope="module")
def bench_look():
    """`benchmarks/bench_look.py`, which measures and knows what real frames have."""
    found = importlib.util.spec_from_file_location("bench_look", ROOT / "benchmarks" / "bench_look.py")
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def outside(bench_look, tmp_path_factory) -> set[tuple[str, str]]:
    """Kinds of views and figures whose means over people lie outside the ranges of real frames."""
    folder = tmp_path_factory.mktemp("gallery") / "gallery"
    spec = load_spec(ROOT / "datasets" / "gallery.toml")
    spec = dataclasses.replace(spec, render=dataclasses.replace(spec.render, size_px=SIZE_PX))
    generate(resolve(spec, folder), workers=1)
    figures = bench_look.measure(folder)
    assert {kind: len(rows) for kind, rows in figures.items()} == {"eye": 24, "mouth": 12}
    return {
        (kind, name)
        for kind, ranges in (("eye", bench_look.EYE), ("mouth", bench_look.MOUTH))
        for name, (low, high) in ranges.items()
        if not low <= np.nanmean([row[name] for row in figures[kind]]) <= high
    }


def test_means_over_people_lie_in_the_ranges_of_real_frames(outside):
    assert not outside

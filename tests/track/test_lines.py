"""Lines whose times are not known, or whose clock was set: samples' times go on, and a sample's age is its own."""

import io
import time
from collections.abc import Sequence

import numpy as np
import pytest

from regress.runtime.sample import Sample
from track.sources import Capture
from track.sources.capture import EMPTY_AFTER_S
from track.sources.lines import Lines

FPS = 50
PAUSE = "pause"
EPOCH_S = 1.7e9


class Slow(io.StringIO):
    """Lines as a detector gives them, one a frame's time, with pauses in which nothing comes."""

    def readline(self, *size: int) -> str:
        line = super().readline(*size)
        while line.startswith(PAUSE):
            time.sleep(2.5 * EMPTY_AFTER_S)
            line = super().readline(*size)
        time.sleep(1 / FPS)
        return line


def line(time_s: float) -> str:
    return " ".join([f"{time_s:.4f}", *map(str, np.random.default_rng(0).normal(300, 50, 136).round(1))])


def lines(first_s: float, count: int = 12) -> list[str]:
    return [line(first_s + number / FPS) for number in range(count)]


def read(written: Sequence[str]) -> tuple[list[Sample], np.ndarray]:
    """Samples of lines that come slowly, and how old each was."""
    stream = Slow("".join(f"{each}\n" for each in written))
    samples, ages_s = [], []
    with Capture({"camera": lambda: Lines(fps=FPS, stream=stream)}) as capture:
        for sample in capture:
            samples.append(sample)
            ages_s.append(capture.now_s() - sample.time_s)
    return samples, np.array(ages_s)


@pytest.mark.parametrize(
    ("written", "faults"),
    [
        ([*lines(0.0), "", "", *lines(14 / FPS), PAUSE, *lines(1.3)], 0),
        (["", "", *lines(EPOCH_S), PAUSE, *lines(EPOCH_S + 1)], 0),
        (["a detector's greeting", "", *lines(0.0)], 0),
        ([*lines(100.0), *lines(90.0), PAUSE, *lines(91.0)], 1),
        ([*lines(100.0), *lines(EPOCH_S), PAUSE, *lines(EPOCH_S + 1)], 1),
    ],
    ids=["faces that are gone", "no face at first", "a greeting", "a clock set back", "a clock set forward"],
)
def test_times_go_on_and_ages_are_those_of_the_lines(written, faults):
    samples, ages_s = read(written)
    steps_s = np.diff([sample.time_s for sample in samples])
    assert np.isfinite(steps_s).all()
    assert steps_s.min() > 0.1 / FPS
    if PAUSE in written:
        assert any(sample.points is None for sample in samples), "samples without a line come in a pause"
    assert np.isfinite(ages_s).all()
    assert np.abs(np.median(ages_s)) < 1.0
    disorder = [each for each in samples if any(fault.name == "DISORDER" for fault in each.faults.values())]
    assert len(disorder) <= faults

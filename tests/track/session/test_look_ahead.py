"""Filters that look ahead hold frames back: each frame reaches the sinks, and in the order of time."""

import numpy as np
import pytest

from regress.runtime.sample import Sample
from regress.runtime.stages.filters import FILTERS
from tests.track.session.faces import frames, new_session


class Film:
    """Gives some samples, and is over."""

    def __init__(self, samples: list[Sample]) -> None:
        self._left = list(samples)

    def read(self, within_s: float | None = None) -> Sample | None:
        return self._left.pop(0) if self._left else None

    def now_s(self) -> float:
        return 0.0


class Shown:
    """A page that counts."""

    def __init__(self) -> None:
        self.count = 0

    def publish(self, moment) -> None:
        self.count += 1


@pytest.mark.parametrize("name", [*FILTERS, "groups", "none"])
def test_the_last_frames_of_a_film_are_answered_too(name):
    session, page = new_session(filter_name=name), Shown()
    summary = session.run(Film(frames(0, 40)), page)
    labels = [sample.label for sample in session.sinks[0].samples]
    assert labels == [sample.label for sample in frames(0, 40)]
    assert summary.frames == summary.faces == page.count == 40


@pytest.mark.parametrize(("name", "held_s"), [("none", 0), ("kalman-33", 1 / 30), ("kalman-200", 6 / 30)])
def test_latency_is_the_age_of_what_reaches_the_sinks(name, held_s):
    """Of a frame that a filter holds back it is no less by as much as the next ones are newer."""
    session = new_session(filter_name=name)
    for sample in frames(0, 60):
        session.answer(sample, lambda now_s=sample.time_s: now_s + 0.01)
    assert session.summary().latency_ms["p50"] == pytest.approx((held_s + 0.01) * 1000, abs=2)


@pytest.mark.parametrize("name", ["kalman-33", "kalman-50", "mean7"])
def test_a_pause_of_the_camera_does_not_overtake_what_a_filter_holds(name):
    before = frames(0, 30)
    last_s = before[-1].time_s
    pause = [Sample(label="none", time_s=last_s + after_s, pictures={}) for after_s in (0.25, 0.3)]
    session = new_session(filter_name=name)
    session.run(Film([*before, *pause, *frames(30, 40, first_s=last_s + 1)]))
    (kept,) = session.sinks
    assert (np.diff(kept.times_s) > 0).all()
    assert len(kept.samples) == 42

"""How long frames last: as their times say, a usual frame's where these say nothing, and never a whole pause."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.stages.frame_clock import LONGEST_STEP_S, FrameClock

rates = st.floats(10.5, 1000)


@given(fps=rates, count=st.integers(2, 50))
def test_even_frames_last_as_long_as_their_rate_says(fps: float, count: int):
    clock = FrameClock(fps)
    lasted = [clock.step(row / fps) for row in range(count)]
    assert lasted == pytest.approx([1 / fps] * count)


@given(fps=rates, times=st.lists(st.none() | st.floats(-1e6, 1e6) | st.just(np.nan), max_size=20))
def test_whatever_times_come_a_frame_lasts_a_while_and_no_pause(fps: float, times: list[float | None]):
    clock = FrameClock(fps)
    assert all(0 < clock.step(time_s) <= LONGEST_STEP_S for time_s in times)


def test_a_clock_that_was_set_back_is_followed_from_there():
    clock = FrameClock(60)
    steps = [clock.step(time_s) for time_s in (100.0, 100.02, 3.0, 3.01, 9.0, None, 9.01)]
    assert steps == pytest.approx([1 / 60, 0.02, 1 / 60, 0.01, LONGEST_STEP_S, 1 / 60, 0.01])

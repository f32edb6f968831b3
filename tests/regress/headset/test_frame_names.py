"""Times in the usual names of pictures are read: which frames of two cameras go together hangs on them."""

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.recordings.frame_names import FrameNames, frame_names
from regress.runtime.headset.recordings.matching import match
from tests.regress.headset.takes import recording

Call = Callable[[int, datetime], str]
"""What a program calls its picture: by its number, and when it was taken."""

FORMS: dict[str, tuple[Call, float]] = {
    "date, time, ms": (lambda _, at: f"{at:%Y%m%d_%H%M%S}_{at.microsecond // 1000:03d}", 1e-3),
    "a telephone's": (lambda _, at: f"PXL_{at:%Y%m%d_%H%M%S}{at.microsecond // 1000:03d}", 1e-3),
    "digits alone": (lambda _, at: f"{at:%Y%m%d%H%M%S}{at.microsecond // 1000:03d}", 1e-3),
    "ISO": (lambda _, at: f"{at:%Y-%m-%dT%H-%M-%S.%f}", 1e-6),
    "ISO, colons and zone": (lambda _, at: f"eye {at:%Y-%m-%dT%H:%M:%S.%f}Z", 1e-6),
    "counter, ms": (lambda number, at: f"l_{number:04d}_{round(1000 * at.timestamp())}", 1e-3),
    "ms, counter": (lambda number, at: f"{round(1000 * at.timestamp())}-{number}", 1e-3),
    "counter, date": (lambda number, at: f"{number}_{at:%Y%m%dT%H%M%S.%f}", 1e-6),
    "seconds, microseconds": (lambda _, at: f"{int(at.timestamp())}_{at.microsecond:06d}", 1e-6),
    "seconds from the start": (lambda _, at: f"{(at - BEGIN).total_seconds():.3f}", 1e-3),
}
"""By what it is, and how many seconds its last digit has."""

BEGIN = datetime(2024, 5, 1, tzinfo=UTC)


def named(names: list[str]) -> FrameNames:
    return frame_names([Path(f"{name}.jpg") for name in names])


@pytest.mark.parametrize("form", FORMS)
@given(
    start_s=st.integers(4000, 80_000),
    fps=st.sampled_from([10, 24, 30, 60, 90]),
    lost=st.sets(st.integers(0, 199), max_size=60),
    seed=st.integers(0, 99),
)
def test_a_usual_name_says_when_its_picture_was_taken(
    form: str, start_s: int, fps: int, lost: set[int], seed: int
):
    call, digit_s = FORMS[form]
    taken_s = np.delete(start_s + np.arange(200) / fps, list(lost))
    names = [call(number, BEGIN + timedelta(seconds=float(at))) for number, at in enumerate(taken_s)]
    shuffled = list(np.random.default_rng(seed).permutation(names))
    found = named(shuffled)
    assert [file.stem for file in found.files] == names
    assert np.diff(found.time_s) == pytest.approx(np.diff(taken_s), abs=1.01 * digit_s + 1e-6)


@pytest.mark.parametrize("form", FORMS)
def test_a_frame_that_one_camera_lost_shifts_none_of_the_others(form: str):
    """Counters go on by one for each picture that is there; so did pairing one by one."""
    call, _ = FORMS[form]
    taken_s = 4000 + np.arange(120) / 30
    takes = {}
    for name, rows in (("left_eye", np.arange(120)), ("mouth", np.delete(np.arange(120), 7))):
        found = named(
            [call(number, BEGIN + timedelta(seconds=taken_s[row])) for number, row in enumerate(rows)]
        )
        takes[name] = recording(
            name,
            np.full((len(rows), 2, 2), 100, np.uint8),
            numbers=found.numbers,
            numbered=found.numbers is not None,
            time_s=None if found.time_s is None else np.array(found.time_s),
        )
    rows = match(takes).rows
    both = (rows["left_eye"] >= 0) & (rows["mouth"] >= 0)
    assert both.sum() == 119
    assert (np.delete(np.arange(120), 7)[rows["mouth"][both]] == rows["left_eye"][both]).all()


@pytest.mark.parametrize(
    ("names", "numbers"),
    [
        # a counter behind whole seconds, or behind one time for all, is the number
        ([f"20240501_1233{4 + one // 30:02d}_{one:03d}" for one in range(90)], range(90)),
        ([f"1714566{784 + one // 30}_{one:04d}" for one in range(90)], range(90)),
        ([f"20240501_123304_{one:03d}" for one in range(90)], range(90)),
        # a date, and numbers that are no times of a day, or look like the first minute of one
        ([f"20240501_{one:06d}" for one in range(90)], range(90)),
        ([f"20240501_{one:06d}" for one in range(50)], range(50)),
        # pictures of sessions
        ([f"{1 + one // 30}.{one % 30:03d}" for one in range(90)], None),
        (["v1.9", "v1.10", "v1.11"], [9, 10, 11]),
        # two cameras in one folder
        ([f"{'left' if one % 2 else 'right'}_{1_700_000_000_123 + 33 * one}" for one in range(90)], None),
        # a counter that goes back in time is none
        ([f"{one}_{1_700_000_000_123 - 33 * one}" for one in range(90)], None),
    ],
)
def test_what_looks_like_a_time_and_counts_is_no_time(names: list[str], numbers: range | None):
    found = named(names)
    assert found.time_s is None
    assert found.numbers == (None if numbers is None else tuple(numbers))


def test_whole_seconds_since_1970_are_times_and_numbers():
    found = named([str(1_714_566_784 + 2 * one) for one in range(5)])
    assert found.numbers == tuple(range(1_714_566_784, 1_714_566_794, 2))
    assert np.diff(found.time_s) == pytest.approx(2)

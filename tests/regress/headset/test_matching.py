"""Frames of cameras go together by their times or numbers: whatever rates, losses, clocks and beginnings they have."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regress.errors import InputError
from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.recordings.footage import line_up
from regress.runtime.headset.recordings.matching import match
from regress.runtime.headset.recordings.moments import Moments
from regress.runtime.headset.recordings.recording import read_recording
from tests.regress.headset.takes import HEIGHT, WIDTH, pictures, recording, write_pictures

SIZES = {"left_eye": (WIDTH, HEIGHT), "mouth": (WIDTH, HEIGHT)}


def timed(name: str, time_s: np.ndarray, **changes: object):
    """A recording whose pictures do not matter."""
    stack = np.full((len(time_s), 2, 2), 100, dtype=np.uint8)
    return recording(name, stack, **{"numbered": False, "time_s": time_s, **changes})


def seen_s(matched: Moments, name: str, time_s: np.ndarray) -> np.ndarray:
    """When a camera's frames were taken; NaN where it has none."""
    rows = matched.rows[name]
    return np.where(rows >= 0, time_s[rows], np.nan)


@settings(deadline=None)
@given(
    st.sampled_from([(30, 30), (60, 30), (120, 30), (90, 60), (200, 8)]),
    st.floats(0, 1),
    st.floats(0, 0.2),
    st.lists(st.integers(20, 200), max_size=20, unique=True),
    st.integers(0, 99),
)
def test_by_times_nearest_frames_go_together(rates, phase, jitter, lost, seed):
    (eye_fps, mouth_fps), random = rates, np.random.default_rng(seed)
    eye_s = (np.arange(400) + jitter * random.random(400)) / eye_fps
    count = max(3, int(eye_s[-1] * mouth_fps))
    mouth_s = (np.arange(count) + phase + jitter * random.random(count)) / mouth_fps
    eye_s = np.delete(eye_s, lost)
    matched = match({"left_eye": timed("left_eye", eye_s), "mouth": timed("mouth", mouth_s)})
    moments_s, beside_s = (
        seen_s(matched, name, times) for name, times in (("left_eye", eye_s), ("mouth", mouth_s))
    )
    by_eye = np.isfinite(moments_s).all() and np.allclose(np.diff(moments_s), np.diff(matched.time_s))
    quick, other = (moments_s, beside_s) if by_eye else (beside_s, moments_s)
    assert np.diff(matched.time_s) == pytest.approx(np.diff(quick))
    others_s = mouth_s if by_eye else eye_s
    nearest = np.abs(others_s[:, None] - quick).min(axis=0)
    known = np.isfinite(other)
    assert np.abs(other - quick)[known] == pytest.approx(nearest[known])
    step_s = np.median(np.diff(others_s))
    assert known[nearest < 0.5 * step_s].all()
    assert not known[nearest > 0.6 * max(step_s, np.median(np.diff(quick)))].any()


@given(st.integers(1, 8), st.integers(0, 7))
def test_a_slow_camera_whose_numbers_are_in_between_stands_until_its_next_one(times: int, first: int):
    eye = recording("left_eye", np.full((100, 2, 2), 100, np.uint8))
    numbers = np.arange(first, 100, times)
    mouth = recording("mouth", np.full((len(numbers), 2, 2), 100, np.uint8), numbers=numbers)
    rows = match({"left_eye": eye, "mouth": mouth}).rows["mouth"]
    assert (rows[:first] == -1).all()
    assert rows[first:].tolist() == [(row - first) // times for row in range(first, 100)]


def test_what_a_slow_camera_lost_is_missing_from_one_and_a_half_of_its_steps_on():
    numbers = np.delete(np.arange(0, 100, 4), [5])
    mouth = recording("mouth", np.full((len(numbers), 2, 2), 100, np.uint8), numbers=numbers)
    rows = match({"left_eye": recording("left_eye", np.full((100, 2, 2), 9, np.uint8)), "mouth": mouth}).rows
    assert np.flatnonzero(rows["mouth"] == -1).tolist() == [23]


@pytest.mark.parametrize(("eyes", "mouth"), [(120, 90), (120, 50), (30, 10), (200, 60)])
def test_whatever_part_of_the_moments_a_slow_camera_has_its_picture_stands(eyes: int, mouth: int):
    """As `track record` numbers them: a moment for each picture of the quick one."""
    numbers = np.unique(np.arange(0, 400 * mouth // eyes) * eyes // mouth)
    takes = {
        "left_eye": recording("left_eye", np.full((400, 2, 2), 9, np.uint8)),
        "mouth": recording("mouth", np.full((len(numbers), 2, 2), 9, np.uint8), numbers=numbers),
    }
    assert (match(takes).rows["mouth"][: numbers[-1]] >= 0).all()


@given(st.integers(0, 99), st.floats(0.02, 0.2))
def test_what_a_camera_loses_now_and_then_is_missing(seed: int, share: float):
    kept = np.flatnonzero(np.random.default_rng(seed).random(600) > share)
    takes = {
        "left_eye": recording("left_eye", np.full((600, 2, 2), 9, np.uint8)),
        "mouth": recording("mouth", np.full((len(kept), 2, 2), 9, np.uint8), numbers=kept),
    }
    assert np.array_equal(np.flatnonzero(match(takes).rows["mouth"] >= 0), kept)


def test_a_clock_and_a_film_begin_together_by_their_times():
    clock = recording(
        "left_eye",
        np.full((100, 2, 2), 9, np.uint8),
        numbers=1_700_000_000_000 + np.arange(100) * 33,
        time_s=1.7e9 + np.arange(100) * 0.033,
    )
    film = timed("mouth", np.arange(120) / 30, film=True, fps=30.0)
    matched = match({"left_eye": clock, "mouth": film}, from_start=True)
    assert matched.numbers[0] == 1_700_000_000_000  # of the camera with the shorter steps
    rows = matched.rows
    assert np.abs(rows["left_eye"] - rows["mouth"]).max() <= 1
    assert len(rows["mouth"]) >= 98


def test_moments_behind_a_camera_that_ended_go_on_in_time():
    takes = {
        name: recording(
            name,
            np.full((count, 2, 2), 9, np.uint8),
            numbers=1_700_000_000_000 + 33 * np.arange(count),
            time_s=1.7e9 + 0.033 * np.arange(count),
        )
        for name, count in (("left_eye", 60), ("mouth", 20))
    }
    assert np.diff(match(takes).time_s) == pytest.approx(0.033, abs=1e-4)


def test_takes_of_other_numbers_keep_those_of_the_first_camera():
    takes = {
        name: recording(name, np.full((9, 2, 2), 9, np.uint8), numbers=range(first, first + 9))
        for name, first in (("left_eye", 1000), ("mouth", 7))
    }
    assert match(takes, from_start=True).numbers.tolist() == list(range(1000, 1009))


def test_a_camera_that_goes_on_for_longer_shares_the_numbers_of_both():
    eye = recording("left_eye", np.full((120, 2, 2), 9, np.uint8))
    mouth = recording("mouth", np.full((180, 2, 2), 9, np.uint8), numbers=np.arange(180) * 4)
    rows = match({"left_eye": eye, "mouth": mouth}).rows
    assert (rows["left_eye"] >= 0).sum() == 120
    assert rows["mouth"][:120].tolist() == [row // 4 for row in range(120)]


def test_takes_that_begin_elsewhere_keep_their_gaps():
    left = recording("left_eye", np.full((1000, 2, 2), 9, np.uint8))
    numbers = np.delete(np.arange(5000, 6000), np.arange(100, 131))
    mouth = recording("mouth", np.full((len(numbers), 2, 2), 9, np.uint8), numbers=numbers)
    matched = match({"left_eye": left, "mouth": mouth}, from_start=True)
    assert matched.numbers.tolist() == list(range(1000))
    known = matched.rows["mouth"] >= 0
    assert np.flatnonzero(~known).tolist() == list(range(100, 131))
    assert (numbers[matched.rows["mouth"][known]] - 5000 == matched.numbers[known]).all()


def test_clocks_that_share_numbers_by_chance_are_matched_by_their_times(tmp_path):
    """Two cameras of 60 a second, called by milliseconds: six names in a hundred are in both folders."""
    first_ms = 1_700_000_000_000
    left_ms = first_ms + np.round(np.arange(60) * 1000 / 60).astype(int)
    mouth_ms = first_ms + 5 + np.round(np.arange(60) * 1000 / 59.3).astype(int)
    assert 0 < np.isin(left_ms, mouth_ms).sum() < 20
    for name, times_ms in (("left", left_ms), ("mouth", mouth_ms)):
        stack = pictures(np.linspace(80, 160, 60), seed=len(name))
        for time_ms, picture in zip(times_ms, stack, strict=True):
            write_pictures(tmp_path / name, picture[None], first=int(time_ms), name="{}.png")
    takes = {
        camera: read_recording(tmp_path / folder, camera, width=WIDTH, height=HEIGHT)
        for camera, folder in (("left_eye", "left"), ("mouth", "mouth"))
    }
    footage = line_up(takes, SIZES)
    assert footage.present.all()
    assert len(footage.numbers) >= 59
    assert footage.fps == pytest.approx(60, rel=0.03)
    for one in (takes["left_eye"], takes["mouth"]):  # without what their names say of times there is no order
        object.__setattr__(one, "time_s", None)
    with pytest.raises(InputError, match="few frame numbers of one camera are another's"):
        line_up(takes, SIZES)


@pytest.mark.parametrize("digits", [13, 16, 19])
def test_names_of_a_clock_give_times(tmp_path, digits: int):
    ticks = 10 ** (digits - 10)
    first = 1_700_000_000 * ticks
    for number in range(5):
        write_pictures(tmp_path, pictures([90])[:1], first=first + number * ticks // 50, name="left_{}.png")
    found = read_recording(tmp_path, "left_eye", width=WIDTH, height=HEIGHT)
    assert np.diff(found.time_s) == pytest.approx(0.02, abs=1e-6)
    assert line_up({"left_eye": found}, SIZES).fps == pytest.approx(50, rel=1e-3)


def test_cameras_whose_times_have_nothing_in_common_are_refused_or_begin_together():
    takes = {
        "left_eye": timed("left_eye", np.arange(10) / 30),
        "mouth": timed("mouth", 9 + np.arange(10) / 30),
    }
    with pytest.raises(
        InputError, match=r"times have nothing in common \(left_eye 0\.00-0\.30 s, mouth 9\.00-9\.30 s\)"
    ):
        match(takes)
    assert match(takes, from_start=True).rows["mouth"].tolist() == list(range(10))


def test_a_stray_picture_among_numbered_ones_is_told(tmp_path):
    write_pictures(tmp_path, pictures([90] * 20))
    write_pictures(tmp_path, pictures([90]), name="sheet.png")
    footage = line_up({"left_eye": read_recording(tmp_path, "left_eye", width=WIDTH, height=HEIGHT)}, SIZES)
    assert "left_eye: names do not count frames (sheet.png among them); counted from 0" in footage.notes


def test_a_slow_camera_that_is_frozen_is_found_by_its_time():
    eye = recording("left_eye", pictures([100] * 240), numbered=False, time_s=np.arange(240) / 120)
    mouth = recording("mouth", pictures([110] * 60, seed=1), numbered=False, time_s=np.arange(60) / 30)
    mouth.pictures[20:] = mouth.pictures[19]
    footage = line_up({"left_eye": eye, "mouth": mouth}, SIZES)
    frozen = np.array([fault is Fault.FROZEN for fault in footage.faults["mouth"]])
    first_s = footage.time_s[np.argmax(frozen)] - 19 / 30
    assert 0.25 < first_s < 0.4
    assert frozen[np.argmax(frozen) :].all()


def test_a_slow_cameras_picture_that_stands_is_not_frozen():
    """A mouth of two pictures a second, beside eyes of 60."""
    eye = recording("left_eye", pictures([100] * 240), numbered=False, time_s=np.arange(240) / 60)
    mouth = recording("mouth", pictures([110] * 8, seed=1), numbered=False, time_s=np.arange(8) / 2)
    footage = line_up({"left_eye": eye, "mouth": mouth}, SIZES)
    assert footage.present.all()


@given(
    st.integers(0, 1000),
    st.integers(20, 300),
    st.floats(1, 4),
    st.sets(st.integers(1, 18), max_size=5),
)
def test_a_counter_that_ends_long_before_the_others_is_told(
    first: int, count: int, times: float, lost: set[int]
):
    """Of 60 and 30 frames a second, each counted from its own first one, a half went with the wrong ones."""
    quick = np.arange(first, first + round(times * count))
    slow = np.delete(np.arange(first, first + count), list(lost))
    takes = {
        "left_eye": recording("left_eye", np.full((len(quick), 2, 2), 9, np.uint8), numbers=quick),
        "mouth": recording("mouth", np.full((len(slow), 2, 2), 9, np.uint8), numbers=slow),
    }
    told = [note for note in match(takes).notes if note.startswith(f"mouth: its numbers end at {slow[-1]}")]
    assert bool(told) == (len(quick) > 1.1 * count)
    assert all(f"go on to {quick[-1]}; " in note and "fewer frames a second" in note for note in told)
    # takes of different recordings end as they do, and frames that have nothing to do with each other
    assert not any(
        "fewer" in note for note in match(takes, from_start=True).notes + match(takes, still=True).notes
    )


def test_a_slow_camera_that_is_numbered_as_the_quick_one_is_counts_the_same():
    eye = recording("left_eye", np.full((600, 2, 2), 9, np.uint8))
    mouth = recording("mouth", np.full((300, 2, 2), 9, np.uint8), numbers=np.arange(0, 600, 2))
    assert match({"left_eye": eye, "mouth": mouth}).notes == ()

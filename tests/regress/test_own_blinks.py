"""A person's own blinks: what counts as one, when they are trusted, and what is never touched."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES, BLINK_INDICES
from regress.runtime.sample import Sample
from regress.runtime.stages.adjustment import ShapeAdjustment
from regress.runtime.stages.output import Output
from regress.runtime.stages.own_blinks import (
    FEWEST,
    MOST,
    OPEN,
    REMEMBERED,
    UTMOST,
    WHOLE,
    BlinkWatch,
    Ends,
    OwnBlinks,
    TakeBlinks,
)

FPS = 60
SAMPLES = Path(__file__).resolve().parents[2] / "docs" / "samples"


def lid(peaks: list[float], *, fps: float = FPS, half_s: float = 0.1, apart_s: float = 2.0) -> np.ndarray:
    """Readings (n,) of an eye that blinks to these heights, half of a blink's height as long as said."""
    times = np.arange(round((len(peaks) + 1) * apart_s * fps)) / fps
    readings = np.zeros(len(times))
    for number, peak in enumerate(peaks, start=1):
        # at a frame's very time, so that the peak itself is read
        middle_s = round(number * apart_s * fps) / fps
        readings = np.maximum(readings, peak * np.exp2(-(((times - middle_s) / half_s) ** 2)))
    return readings


def take(left: np.ndarray, right: np.ndarray | None = None, *, fps: float = FPS) -> list[Sample]:
    """Samples of a face that does nothing but blink; both eyes alike, if only one is given."""
    weights = np.full((len(left), len(BLENDSHAPES)), 0.3)
    weights[:, BLINK_INDICES[0]] = left
    weights[:, BLINK_INDICES[1]] = left if right is None else right
    return [Sample(label=str(row), time_s=row / fps, weights=each) for row, each in enumerate(weights)]


def blinks_of(samples: list[Sample]) -> np.ndarray:
    return np.array([sample.weights[BLINK_INDICES] for sample in samples])


def watched(readings: np.ndarray, fps: float = FPS) -> BlinkWatch:
    watch = BlinkWatch()
    for row, reading in enumerate(readings):
        watch.step(row / fps, float(reading))
    return watch


@given(
    peaks=st.lists(st.floats(0.45, 1), min_size=FEWEST, max_size=FEWEST + 4),
    fps=st.sampled_from([20, 30, 60, 120]),
    half_s=st.floats(0.06, 0.12),
)
def test_every_blink_counts_by_its_height(peaks: list[float], fps: int, half_s: float):
    watch = watched(lid(peaks, fps=fps, half_s=half_s), fps)
    np.testing.assert_allclose(watch.peaks, peaks)
    assert watch.ends.full == max(watch.peaks)


@given(
    fps=st.sampled_from([30, 60, 120]),
    spikes=st.sets(st.integers(1, 2 * FEWEST), min_size=1),
    to=st.floats(0.6, 1),
)
def test_a_glitch_of_one_frame_is_no_blink(fps: int, spikes: set[int], to: float):
    """One of 1 left forty blinks as they were read."""
    readings = lid([0.5] * (FEWEST + 2), fps=fps)
    for spike in spikes:
        readings[round((spike + 0.5) * fps)] = to
    watch = watched(readings, fps)
    np.testing.assert_allclose(watch.peaks, 0.5)
    assert watch.ends.full == pytest.approx(0.5)


@pytest.mark.parametrize("many", [1, 3])
def test_of_many_blinks_one_in_forty_may_be_none(many: int):
    """An eye that was rubbed."""
    watch = BlinkWatch(remembered=None)
    for row, reading in enumerate(lid([1.0] * many + [0.5] * (REMEMBERED - 1) * many)):
        watch.step(row / FPS, float(reading))
    assert watch.ends.full == pytest.approx(0.5)


@given(reading=st.floats(0, 1), more=st.floats(0, 1), opened=st.floats(OPEN, 0.5), above=st.floats(0.01, 0.5))
def test_stretching_keeps_order_and_range(reading: float, more: float, opened: float, above: float):
    ends = Ends(open=opened, full=opened + above)
    low, high = sorted((reading, more))
    assert reading <= ends.stretched(reading) <= 1
    assert ends.stretched(low) <= ends.stretched(high)
    assert ends.stretched(reading) - reading <= (MOST - 1) * max(0, reading - opened) + 1e-12
    if reading <= opened:
        assert ends.stretched(reading) == reading
    assert WHOLE.stretched(reading) == reading


def test_a_full_blink_reads_one_once_enough_were_seen():
    readings = lid([0.5] * (FEWEST + 2))
    stage = OwnBlinks()
    found = blinks_of([stage.step(sample) for sample in take(readings)])
    ninth = round(2.0 * (FEWEST + 1) * FPS)
    before, after = found[: ninth - FPS], found[ninth - FPS :]
    np.testing.assert_array_equal(before[:, 0], readings[: ninth - FPS])
    assert after.max() == pytest.approx(1.0)
    opened = readings <= watched(readings).ends.open
    np.testing.assert_array_equal(found[opened, 0], readings[opened])


@pytest.mark.parametrize("half_s", [0.45, 1.5])
def test_what_stays_is_no_blink(half_s: float):
    """A squint, a look down, sleepy lids: as slow as this, however deep."""
    assert not watched(lid([0.6] * 12, half_s=half_s, apart_s=6.0)).peaks


def test_a_lid_that_falls_and_stays_or_opens_from_shut_is_no_blink():
    step = np.repeat([0.0, 0.8, 0.0], 2 * FPS)
    assert not watched(step).peaks


def test_noise_and_faint_movements_are_no_blinks():
    noise = np.random.default_rng(0).normal(0.05, 0.02, size=60 * FPS)
    assert not watched(noise).peaks
    assert not watched(lid([0.04] * 12) + noise[: 26 * FPS]).peaks
    assert not watched(lid([0.018] * 12)).peaks


NOISE = np.random.default_rng(1).normal(size=60 * FPS)


def test_a_detector_that_hardly_closes_lids_and_is_sure_of_it_is_seen():
    """OpenFace's blinks reach .047 on a real face, with noise of .0006 a frame: lids close by 70 noises."""
    readings = np.clip(0.003 + lid([0.047] * (FEWEST + 2)) + 0.0006 * NOISE[: 22 * FPS], 0, 1)
    watch = watched(readings)
    assert len(watch.peaks) == FEWEST + 2
    assert watch.ends.factor == UTMOST
    found = blinks_of([*map(OwnBlinks(before=(watch.ends, watch.ends)).step, take(readings))])[:, 0]
    assert found.max() > 0.35
    still = readings < 0.006
    np.testing.assert_array_equal(found[still], readings[still])


@settings(max_examples=20)
@given(noise=st.floats(0, 0.03), full=st.floats(0.3, 0.9))
def test_noise_is_never_stretched_far(noise: float, full: float):
    readings = 0.1 + lid([full] * FEWEST) + noise * NOISE[: 2 * (FEWEST + 1) * FPS]
    ends = watched(np.clip(readings, 0, 1)).ends
    assert 1 <= ends.factor <= UTMOST
    assert ends.factor * noise <= max(0.07, MOST * noise)


def test_an_eye_with_much_noise_is_read_as_before():
    readings = np.clip(0.05 + lid([0.5] * FEWEST) + 0.03 * NOISE[: 2 * (FEWEST + 1) * FPS], 0, 1)
    ends = watched(readings).ends
    assert ends.open >= OPEN
    assert ends.most == MOST


def test_half_shut_lids_blink_from_where_they_are():
    """A flutter of a lid that is half down says nothing of a full blink."""
    assert not watched(np.maximum(0.4, lid([0.6] * 12))).peaks


@pytest.mark.parametrize("full", [0.2, 0.02])
def test_a_reading_is_stretched_threefold_at_most(full: float):
    assert Ends(open=OPEN, full=full).stretched(0.2) == pytest.approx(OPEN + MOST * (0.2 - OPEN))


def test_an_eye_that_reads_much_while_it_is_open_stays_there():
    """Narrow eyes, and no neutral face: between blinks nothing may look sleepier than it was read."""
    stage = OwnBlinks()
    readings = np.maximum(0.22, lid([0.6] * 12))
    found = blinks_of([stage.step(sample) for sample in take(readings)])[-4 * FPS :, 0]
    assert found.max() == pytest.approx(1.0)
    late = readings[-4 * FPS :]
    np.testing.assert_array_equal(found[late == 0.22], 0.22)


def test_each_eye_goes_by_its_own_blinks():
    stage = OwnBlinks()
    samples = take(lid([0.5] * 12), lid([0.8] * 12))
    found = blinks_of([stage.step(sample) for sample in samples])[-4 * FPS :]
    np.testing.assert_allclose(found.max(axis=0), 1.0)


def test_a_known_eye_and_all_other_shapes_stay():
    stage = OwnBlinks()
    stage.known[:] = [True, False]
    samples = take(lid([0.5] * 12))
    found = [stage.step(sample) for sample in samples]
    np.testing.assert_array_equal(blinks_of(found)[:, 0], blinks_of(samples)[:, 0])
    assert blinks_of(found)[-4 * FPS :, 1].max() == pytest.approx(1.0)
    others = np.setdiff1d(np.arange(len(BLENDSHAPES)), BLINK_INDICES)
    assert (np.array([sample.weights for sample in found])[:, others] == 0.3).all()


def test_only_the_last_blinks_count():
    """Who rubs an eye shuts it further than any blink: two minutes later that is forgotten."""
    watch = watched(lid([1.0] * FEWEST + [0.5] * REMEMBERED))
    assert watch.ends.full == pytest.approx(0.5)


def test_all_blinks_of_a_take_count():
    """Who grows tired towards the end of an hour blinks less far then, and shut eyes stay shut before."""
    readings = lid([0.8] * FEWEST + [0.5] * REMEMBERED)
    found = blinks_of(TakeBlinks().run(take(readings)))
    np.testing.assert_allclose(found[: 2 * FEWEST * FPS].max(), 1.0)
    assert found[-4 * FPS :].max() == pytest.approx(0.5 / 0.8, abs=0.01)


def test_a_lost_face_is_no_lid_and_ends_no_blink():
    readings = lid([0.5] * 12)
    gone = readings.copy()
    gone[np.arange(len(gone)) % (2 * FPS) < FPS // 2] = np.nan  # a blink's peak and what follows
    assert not watched(gone).peaks
    stage = OwnBlinks()
    found = blinks_of([stage.step(sample) for sample in take(gone)])
    np.testing.assert_array_equal(found[:, 0], gone)


def test_times_that_begin_again_are_another_take():
    watch = BlinkWatch()
    for _ in range(2):
        for row, reading in enumerate(lid([0.5] * 5)):
            watch.step(row / FPS, float(reading))
    assert len(watch.peaks) == 10


def test_blinks_before_another_seat_are_forgotten():
    stage = OwnBlinks()
    samples = take(lid([0.5] * 12))
    for sample in samples:
        stage.step(sample)
    stage.forget()
    found = blinks_of([stage.step(sample) for sample in samples[: 4 * FPS]])
    np.testing.assert_array_equal(found, blinks_of(samples[: 4 * FPS]))


def test_a_person_is_told_once_where_it_shows():
    said: list[str] = []
    stage = OwnBlinks(said.append)
    for sample in take(lid([0.5] * 20), lid([0.97] * 20)):
        stage.step(sample)
    assert said == [
        "the fullest blinks read 0.50 (left) and 0.97 (right), and are stretched towards 1",
    ]
    said.clear()
    stage = OwnBlinks(said.append)
    for sample in take(lid([0.97] * 20)):
        stage.step(sample)
    assert not said


def test_a_take_is_stretched_from_its_first_blink():
    said: list[str] = []
    readings = lid([0.5] * FEWEST)
    samples = take(readings)
    found = TakeBlinks(said.append).run(samples)
    assert [sample.label for sample in found] == [sample.label for sample in samples]
    expected = [watched(readings).ends.stretched(float(reading)) for reading in readings]
    np.testing.assert_array_equal(blinks_of(found)[:, 1], expected)
    assert said == ["the fullest blinks read 0.50 (left) and 0.50 (right), and are stretched towards 1"]


def test_a_take_with_too_few_blinks_stays():
    said: list[str] = []
    samples = take(lid([0.5] * (FEWEST - 1)))
    np.testing.assert_array_equal(blinks_of(TakeBlinks(said.append).run(samples)), blinks_of(samples))
    assert said == ["fewer than 8 blinks were seen (7), so they stay as they are read"]


def test_samples_without_weights_or_times_pass():
    for stage in (OwnBlinks(), TakeBlinks()):
        samples = [Sample(label="0"), Sample(label="1", weights=np.full(52, 0.3))]
        found = [*stage.feed(samples[0]), *stage.feed(samples[1]), *stage.finish()]
        assert [sample.label for sample in found] == ["0", "1"]
        np.testing.assert_array_equal(found[1].weights, 0.3)


def test_a_recording_of_landmarks_is_stretched_by_its_own_blinks(run):
    """Weights as they leave without them go through the very stage, unasked too, and the person is told."""
    command = ("predict", "landmarks-default", SAMPLES / "talking-face.csv", "--neutral", "1-30")
    code, plain, silent = run(*command, "--no-own-blinks")
    assert code == 0
    code, stretched, told = run(*command, "--own-blinks")
    assert code == 0
    assert run(*command) == (0, stretched, told)
    assert "fullest blinks" not in silent
    code, guessed, _ = run(*command[:-2])
    assert (code, guessed) == run(*command[:-2], "--no-own-blinks")[:2], "no neutral face, so nothing unasked"
    rows, found = ([line.split(",") for line in text.splitlines()] for text in (plain, stretched))
    columns = [rows[0].index(name) for name in ("eyeBlinkLeft", "eyeBlinkRight")]
    read = np.array([[float(row[column]) for column in columns] for row in rows[1:]])
    said: list[str] = []
    expected = blinks_of(TakeBlinks(said.append).run(take(read[:, 0], read[:, 1], fps=30)))
    assert (expected > read + 0.1).any()
    shown = np.array([[float(row[column]) for column in columns] for row in found[1:]])
    np.testing.assert_allclose(shown, expected, atol=1e-3)
    assert said[0] in told


def test_blinks_of_films_are_stretched_unasked_unless_somebody_changes_lids():
    brows = Output(
        adjustments={"browInnerUp": ShapeAdjustment(gain=2.0), "*": ShapeAdjustment(dead_zone=0.1)}
    )
    assert brows.with_own_blinks(film=True) == replace(brows, own_blinks=True, few_told=False)
    assert brows.with_own_blinks(film=False) == brows
    named = dict.fromkeys(("eyeBlinkLeft", "eyeBlinkRight"), ShapeAdjustment())
    spared = Output(adjustments={"*": ShapeAdjustment(gain=2.0), **named})
    assert spared.with_own_blinks(film=True).own_blinks
    for lids in (
        Output(adjustments={"eyeBlinkRight": ShapeAdjustment(gain=2.0)}),
        *(
            Output(adjustments={"*": ShapeAdjustment(**change)})
            for change in ({"gain": 2.0}, {"offset": 0.1}, {"low": 0.1}, {"high": 0.9})
        ),
        Output(amplify_eyes=1.5),
    ):
        assert lids.with_own_blinks(film=True) == lids


@pytest.mark.parametrize("few_told", [False, True])
@pytest.mark.parametrize("full", [1.0, 0.5])
def test_of_blinks_that_stay_a_person_is_told_where_they_asked(full: float, few_told: bool):
    said: list[str] = []
    for blinks in (3, 9):
        TakeBlinks(said.append, few_told=few_told).run(take(lid([full] * blinks)))
    few, enough = ("fewer than 8" in " ".join(said)), ("fullest blinks" in " ".join(said))
    assert few is few_told
    assert enough is (few_told or full < 1)


def test_lines_that_are_answered_as_they_come_have_no_take_to_go_by(run):
    code, _, told = run("predict", "landmarks-default", "-", "--own-blinks")
    assert code == 2
    assert "--own-blinks needs a whole take" in told

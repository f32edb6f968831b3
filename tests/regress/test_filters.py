"""Filters over weights: what they may not change, how late they are, and when `regress predict` takes one unasked."""

import io
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.cli.landmark_take import is_film
from regress.errors import InputError
from regress.runtime.inputs import Frames
from regress.runtime.model import Model, save_model
from regress.runtime.predict import predict_frames, predict_stream
from regress.runtime.sample import Sample
from regress.runtime.stages.filters import DEFAULT_FILTER, FILM_FILTER, FILTERS
from regress.runtime.stages.kalman import LIDS, NOISE_LEAST, SURPRISE, WANDERING, KalmanSmoothing, NoiseMeter
from regress.runtime.stages.output import Output, filter_stage
from regress.runtime.stages.stage import Chain, Stage
from regress.runtime.writers.csv_table import weights_csv
from tests.regress.drawn import drawn_faces

SHAPES = len(BLENDSHAPES)
RATES = (30, 60)
LINEAR = ("mean4", "mean7")


def frames_of(weights: np.ndarray, time_s: np.ndarray) -> list[Sample]:
    """A sample a row, called after its number."""
    return [
        Sample(label=str(row), time_s=float(time), weights=weights[row]) for row, time in enumerate(time_s)
    ]


def left(stage: Stage, weights: np.ndarray, time_s: np.ndarray) -> np.ndarray:
    """Weights (n, 52) that leave a stage."""
    return np.array([sample.weights for sample in stage.run(frames_of(weights, time_s))])


@st.composite
def takes(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    """Weights (n, 52), some rows without, at times (n,) of any rate with gaps."""
    intervals = st.sampled_from((1 / 120, 1 / 60, 0.02, 1 / 30, 0.04, 0.1, 0.6, 3.0))
    time_s = np.cumsum(draw(st.lists(intervals, min_size=1, max_size=40)))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    weights = rng.uniform(size=(len(time_s), SHAPES)) * draw(st.sampled_from((1.0, 0.1, 0.01)))
    weights[draw(st.lists(st.integers(0, len(time_s) - 1), max_size=5))] = np.nan
    return weights, time_s


@pytest.mark.parametrize("name", FILTERS)
@settings(deadline=None, max_examples=40)
@given(take=takes(), gaze=st.booleans())
def test_each_frame_leaves_once_in_its_order(name: str, take: tuple[np.ndarray, np.ndarray], gaze: bool):
    weights, time_s = take
    samples = frames_of(weights, time_s)
    if gaze:
        samples = [replace(sample, gaze=sample.weights[-4:]) for sample in samples]
    live = list(Chain([filter_stage(name)]).stream(samples))
    assert [sample.label for sample in live] == [sample.label for sample in samples]
    assert [sample.time_s for sample in live] == [sample.time_s for sample in samples]
    for given_, sample in zip(samples, live, strict=True):
        assert np.isnan(sample.weights).all() == np.isnan(given_.weights).all()
    present = ~np.isnan(weights[:, 0])
    found = np.array([sample.weights for sample in live])[present]
    assert not len(found) or np.all((found >= weights[present].min(0)) & (found <= weights[present].max(0)))
    if gaze and name != "one-euro":
        for sample in live:
            np.testing.assert_array_equal(sample.gaze, sample.weights[-4:])
    if gaze:  # filtered as a weight; One-Euro knows it for quick, as eyes are
        assert all(sample.gaze.shape == (4,) for sample in live)
    file = filter_stage(name).run(samples)
    for one, other in zip(live, file, strict=True):
        np.testing.assert_array_equal(one.weights, other.weights)


@pytest.mark.parametrize("name", FILTERS)
@settings(deadline=None, max_examples=20)
@given(take=takes(), level=st.floats(0, 1))
def test_filters_leave_constant_weights_as_they_are(
    name: str, take: tuple[np.ndarray, np.ndarray], level: float
):
    weights, time_s = take
    constant = np.where(np.isnan(weights), np.nan, level)
    np.testing.assert_allclose(left(filter_stage(name), constant, time_s), constant, rtol=0, atol=1e-15)


@pytest.mark.parametrize("name", FILTERS)
@settings(deadline=None, max_examples=20)
@given(take=takes())
def test_nothing_is_carried_over_a_gap(name: str, take: tuple[np.ndarray, np.ndarray]):
    weights, time_s = take
    before, after = np.where(np.isnan(weights), np.nan, 0.0), np.where(np.isnan(weights), np.nan, 1.0)
    both = np.concatenate([before, after])
    # for means a gap is three times the step before it: some takes have frames all 3 s
    times = np.concatenate([time_s, time_s[-1] + 9.01 + time_s])
    np.testing.assert_array_equal(left(filter_stage(name), both, times), both)


@pytest.mark.parametrize("name", LINEAR)
@settings(deadline=None, max_examples=20)
@given(take=takes(), factor=st.floats(-2, 2))
def test_filters_of_means_give_sums_of_takes_the_sums_of_their_answers(
    name: str, take: tuple[np.ndarray, np.ndarray], factor: float
):
    weights, time_s = take
    other = np.random.default_rng(0).uniform(size=weights.shape)
    apart = left(filter_stage(name), weights, time_s)
    others = left(filter_stage(name), np.where(np.isnan(weights), np.nan, other), time_s)
    together = left(filter_stage(name), weights + factor * other, time_s)
    np.testing.assert_allclose(together, apart + factor * others, atol=1e-12)


def test_kalman_is_linear_where_nothing_surprises():
    rng = np.random.default_rng(3)
    noise = np.full(SHAPES, 0.1)
    first, second = rng.uniform(0, SURPRISE * 0.1 / 4, size=(2, 50, SHAPES))
    times = np.cumsum(rng.uniform(0.01, 0.05, size=50))

    def kalman(weights: np.ndarray) -> np.ndarray:
        return left(KalmanSmoothing(1 / 30, noise=noise), weights, times)

    np.testing.assert_allclose(kalman(first + second), kalman(first) + kalman(second), atol=1e-12)


def test_kalman_is_the_exact_smoother_where_nothing_surprises():
    """Least squares over the whole take: rows less what is seen, and steps, each by its variance."""
    rng = np.random.default_rng(5)
    noise = np.full(SHAPES, 0.1)
    times = np.cumsum(rng.uniform(0.02, 0.1, size=30))
    seen = 0.5 + rng.uniform(0, SURPRISE * 0.1 / 4, size=(30, SHAPES))
    steps = np.diff(np.eye(30), axis=0) / np.sqrt(WANDERING * np.diff(times))[:, None]
    exact = np.linalg.solve(np.eye(30) + steps.T @ steps, seen)
    # a look ahead that is longer than the take, so that all behind a frame correct it; the first never waits, as nobody
    # knows when the next will come
    smoothed = left(KalmanSmoothing(10.0, noise=noise), seen, times)
    np.testing.assert_array_equal(smoothed[0], seen[0])
    np.testing.assert_allclose(smoothed[1:], exact[1:], atol=1e-12)


@settings(deadline=None, max_examples=40)
@given(take=takes(), rate=st.sampled_from((15, 24, 25, 30, 50, 60, 120)))
def test_a_films_filter_looks_no_further_for_lids(take: tuple[np.ndarray, np.ndarray], rate: int):
    weights, time_s = np.nan_to_num(take[0], nan=0.5), np.arange(len(take[0])) / rate
    lids = [BLENDSHAPE_INDEX[name] for name in LIDS]
    film, quick = (left(filter_stage(name), weights, time_s) for name in (FILM_FILTER, "kalman-33"))
    slow = left(KalmanSmoothing(FILTERS[FILM_FILTER].settings.ahead_s), weights, time_s)
    np.testing.assert_allclose(film[:, lids], quick[:, lids], atol=1e-9)
    others = np.setdiff1d(np.arange(SHAPES), lids)
    np.testing.assert_array_equal(film[:, others], slow[:, others])


def test_a_films_filter_is_calmer_and_keeps_blinks():
    rng = np.random.default_rng(8)
    times = np.arange(900) / 30
    true = np.zeros((900, SHAPES))
    true[:] = 0.4 + 0.2 * np.sin(times)[:, None]
    blink = BLENDSHAPE_INDEX["eyeBlinkLeft"]
    for moment in np.arange(3.0, 29.0, 2.13):  # closing in 80 ms, opening in 160
        lid = np.interp(times - moment, (-0.08, 0, 0.03, 0.19), (0.0, 0.5, 0.5, 0.0))
        true[:, blink] = np.maximum(true[:, blink], 0.4 + lid)
    noisy = true + 0.03 * rng.standard_normal(true.shape)
    film, quick = (left(filter_stage(name), noisy, times) for name in (FILM_FILTER, DEFAULT_FILTER))
    jaw = BLENDSHAPE_INDEX["jawOpen"]
    assert np.abs(film - true)[60:, jaw].mean() < 0.9 * np.abs(quick - true)[60:, jaw].mean()
    assert film[:, blink].max() == pytest.approx(quick[:, blink].max(), abs=1e-9)


def test_kalman_measures_the_noise_of_frames_that_come_twice():
    """As dim webcams give them: two equal rows are no sign of calm."""
    jitter = np.random.default_rng(3).normal(0.5, 0.05, (600, SHAPES))
    once, twice = NoiseMeter(SHAPES), NoiseMeter(SHAPES)
    for row in jitter:
        once.step(row)
        for _ in range(2):
            twice.step(row)
    np.testing.assert_array_equal(twice.noise, once.noise)


def test_kalman_measures_no_noise_across_a_gap():
    """How far the level before a gap lies from the one behind it is no jitter."""
    rng = np.random.default_rng(7)
    jitter = 0.01 * rng.normal(size=(90, SHAPES))
    times = np.arange(90) / 30 + np.where(np.arange(90) < 45, 0.0, 1.0)

    def behind(level: float) -> np.ndarray:
        before = np.where(np.arange(90)[:, None] < 45, level, 0.2)
        return left(filter_stage(DEFAULT_FILTER), before + jitter, times)[45:]

    np.testing.assert_allclose(behind(0.2), behind(0.9), atol=1e-12)


def live_lag_ms(stage: Stage, rate: int, height: float) -> np.ndarray:
    """From half a step's height in what comes to half of it in what has left, of a weight of jaw and lid (2,)."""
    course = np.where(np.arange(4 * rate) < 2 * rate, 0.0, height)
    came, waits, given_ = (
        frames_of(np.repeat(course[:, None], SHAPES, axis=1), np.arange(len(course)) / rate),
        [],
        [],
    )
    for sample in came:
        ready = stage.feed(sample)
        waits += [sample.time_s - other.time_s for other in ready]
        given_ += ready
    weights = np.array([sample.weights for sample in given_ + stage.finish()])
    lags = []
    for name in ("jawOpen", "eyeBlinkLeft"):
        rising = weights[:, BLENDSHAPE_INDEX[name]]
        after = int(np.argmax(rising >= height / 2))
        share = (rising[after] - height / 2) / (rising[after] - rising[after - 1])
        lags.append(1000 * ((after - share - (2 * rate - 0.5)) / rate + np.median(waits)))
    return np.array(lags)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("name", FILTERS)
def test_the_lag_is_as_stated(name: str, rate: int):
    stated = FILTERS[name].lag_ms[RATES.index(rate)]
    assert live_lag_ms(filter_stage(name), rate, 1.0) == pytest.approx(stated, abs=1.5)


def test_the_default_lags_by_a_thirtieth_and_slight_steps_no_more():
    assert max(FILTERS[DEFAULT_FILTER].lag_ms) <= 33
    for rate in (24, 25, 30, 50, 60, 90, 120):
        for height in (0.1, 0.2, 1.0):
            assert live_lag_ms(filter_stage(DEFAULT_FILTER), rate, height).max() < 44
    assert live_lag_ms(filter_stage(DEFAULT_FILTER), 15, 1.0).max() < 1  # none waits for a frame 67 ms away


@pytest.mark.parametrize("rate", [23.976, 24.0, 25.0, 30.0])
def test_every_frame_of_a_film_waits_for_the_next_one(rate: float):
    """But the first, whose next nobody expects yet; also where times say by their last digit that it is late."""
    samples = frames_of(np.zeros((2000, SHAPES)), 1e4 + np.arange(2000) / rate)
    stage = filter_stage("kalman-33")
    assert [len(stage.feed(sample)) for sample in samples] == [0 if row == 1 else 1 for row in range(2000)]
    assert len(stage.finish()) == 1


@pytest.mark.parametrize("rate", RATES)
def test_the_default_calms_a_face_and_keeps_a_blink(rate: int):
    rng = np.random.default_rng(5)
    times = np.arange(10 * rate) / rate
    lid = np.zeros(len(times))
    for moment in (4.0, 6.01, 8.02):  # closing in 80 ms, opening in 160
        lid = np.maximum(lid, np.interp(times - moment, (-0.08, 0, 0.03, 0.19), (0.0, 1.0, 1.0, 0.0)))
    weights = 0.2 + rng.normal(size=(len(times), SHAPES)) * 0.02
    weights[:, BLENDSHAPE_INDEX["eyeBlinkLeft"]] = 0.8 * lid + rng.normal(size=len(times)) * 0.02
    calm = left(filter_stage(DEFAULT_FILTER), weights, times)
    assert calm[2 * rate :, BLENDSHAPE_INDEX["jawOpen"]].std() < 0.55 * 0.02
    for moment in (4.0, 6.01, 8.02):
        about = np.abs(times - moment) < 0.1
        assert calm[about, BLENDSHAPE_INDEX["eyeBlinkLeft"]].max() >= 0.9 * 0.8 * lid[about].max()


def test_kalman_learns_a_quiet_detectors_noise():
    """A slight movement of a quiet detector is no noise."""
    times = np.arange(300) / 30
    slight = np.repeat(0.1 * np.sin(2 * np.pi * times)[:, None], SHAPES, axis=1)
    learned = left(filter_stage(DEFAULT_FILTER), slight, times)
    told = left(KalmanSmoothing(1 / 30, noise=np.full(SHAPES, 0.03)), slight, times)
    errors = [np.abs(found - slight)[150:].max() for found in (learned, told)]
    assert errors[0] < SURPRISE * NOISE_LEAST < errors[1]


def test_a_frame_that_lacks_a_time_is_named():
    timeless = Sample(label="17", weights=np.zeros(SHAPES))
    for name, entry in FILTERS.items():
        if entry.needs_times:
            with pytest.raises(InputError, match="frame 17 has no time"):
                filter_stage(name).run([timeless])
            again = Sample(label="18", time_s=0.5, weights=np.zeros(SHAPES))
            with pytest.raises(InputError, match=r"frame 18: time goes from 0.5 s to 0.5 s"):
                filter_stage(name).run([again, again])
        else:
            assert filter_stage(name).run([timeless])[0].label == "17"


def test_what_looks_ahead_has_no_step():
    with pytest.raises(TypeError, match="use feed and finish"):
        Chain([filter_stage(DEFAULT_FILTER)]).step(Sample(time_s=0.0, weights=np.zeros(SHAPES)))


def test_an_unknown_filter_is_refused():
    with pytest.raises(InputError, match="there is no filter 'median'; mean4, mean7,"):
        Output(filter="median")


FACES = drawn_faces(np.random.default_rng(6), 20)


def test_a_pipe_is_late_by_what_is_stated_and_loses_nothing(quick_model: Model):
    output = Output(filter=DEFAULT_FILTER)
    came = [Sample(label=str(row), time_s=row / 30, points=face) for row, face in enumerate(FACES)]
    taken = 0

    def lines():
        nonlocal taken
        for taken, sample in enumerate(came, start=1):  # noqa: B007
            yield sample

    behind = [
        taken - number for number, _ in enumerate(predict_stream(lines(), quick_model, output), start=1)
    ]
    assert behind[1:-1] == [1] * 18
    assert len(behind) == 20


@pytest.mark.parametrize("name", FILTERS)
@pytest.mark.parametrize(
    "after", [None, np.nan, 0.0], ids=["no time", "not a number", "a clock that began anew"]
)
def test_a_pipe_whose_face_is_lost_is_no_later(name: str, after: float | None):
    stage, taken = filter_stage(name), 0
    seen = frames_of(np.full((10, SHAPES), 0.5), np.arange(10) / 30)
    nothing = np.full(SHAPES, np.nan)
    lost = [
        replace(seen[0], label=str(row), time_s=None if after is None else after + row / 30, weights=nothing)
        for row in range(8)
    ]

    def lines():
        nonlocal taken
        for taken, sample in enumerate([*seen, *lost], start=1):  # noqa: B007
            yield sample

    behind = [taken - number for number, _ in enumerate(Chain([stage]).stream(lines()), start=1)]
    assert len(behind) == 18
    assert max(behind) <= max(4, 1 + round(FILTERS[name].lag_ms[0] * 30 / 1000))


@pytest.mark.parametrize(
    ("time_s", "film"),
    [
        (None, False),
        (np.arange(1.0), False),
        (np.zeros(20), False),
        (np.arange(20) / 1000, False),  # OpenFace on single pictures
        (np.repeat(np.arange(20) / 30, 2), False),  # two faces in each picture
        (np.arange(20) * 1.0, False),  # a photograph a second
        (np.full(20, np.nan), False),
        (np.arange(20) / 25, True),
        (np.delete(np.arange(60) / 30, [5, 6, 30]), True),
        (np.where(np.arange(60) == 7, np.nan, np.arange(60) / 30), True),
    ],
)
def test_what_is_filtered_unasked_is_a_film(time_s: np.ndarray | None, film: bool):
    assert is_film(time_s) is film


def _told(model: Model, *, fps: float | None, name: str | None) -> str:
    time_s = None if fps is None else np.arange(20) / fps
    frames = Frames(points=FACES, labels=tuple(map(str, range(20))), time_s=time_s, source="take.npy")
    return weights_csv(predict_frames(model, frames, output=Output(filter=name)))


def test_a_recording_without_times_and_the_papers_recipe_are_left_alone(
    run, quick_model: Model, quick_model_folder, tmp_path, monkeypatch
):
    np.save(tmp_path / "take.npy", FACES)
    assert run("predict", quick_model_folder, tmp_path / "take.npy")[1] == _told(
        quick_model, fps=None, name=None
    )
    timed = ("--fps", 30)
    default = run("predict", quick_model_folder, tmp_path / "take.npy", *timed)[1]
    assert default == _told(quick_model, fps=30, name=FILM_FILTER)
    paper = replace(quick_model, recipe="paper")
    save_model(paper, tmp_path / "paper")
    found = run("predict", tmp_path / "paper", tmp_path / "take.npy", *timed)[1]
    assert found == _told(paper, fps=30, name=None)
    for option in (("--smooth", 1), ("--smooth", 2), ("--filter", "none")):
        other = run("predict", quick_model_folder, tmp_path / "take.npy", *timed, *option)[1]
        assert (other == default) is (option == ("--smooth", 1))
    lines = "\n".join(" ".join(map(repr, face.ravel().tolist())) for face in FACES)
    monkeypatch.setattr(sys, "stdin", io.StringIO(lines + "\n"))
    code, piped, err = run("predict", quick_model_folder, "-", "--keep-guessed-gaze")
    assert code == 0, err
    np.testing.assert_allclose(
        np.loadtxt(io.StringIO(piped), delimiter=",", skiprows=1, usecols=range(1, 53)),
        quick_model.predict(FACES),
        atol=1e-6,
    )


@pytest.mark.parametrize(
    ("options", "steady", "told"),
    [((), True, True), ((), False, False), (("--fps", 30), True, False), (("--filter", "none"), True, False)],
)
def test_a_film_without_times_is_told_to_lack_them(
    options: tuple, steady: bool, told: bool, run, quick_model_folder, tmp_path
):
    faces = FACES.copy()
    faces[4] = np.nan
    if steady:
        faces += 100 - faces.mean(axis=1, keepdims=True)
    np.save(tmp_path / "take.npy", faces)
    code, _, said = run("predict", quick_model_folder, tmp_path / "take.npy", *options)
    assert code == 0
    assert ("no times are given, so weights are not filtered; if this is a film, --fps" in said) is told


@pytest.mark.parametrize(
    ("step", "steady", "options", "told"),
    [
        (33.3, True, (), True),
        (33.3, True, ("--fps", 30), False),
        (0.0333, True, (), False),
        (10, False, (), False),  # photographs
    ],
)
def test_a_film_whose_times_are_milliseconds_is_told(
    step: float, steady: bool, options: tuple, told: bool, run, quick_model_folder, tmp_path
):
    faces = FACES - FACES.mean(axis=1, keepdims=True) + 100 if steady else FACES
    names = ["time", *(f"{axis}{index}" for index in range(68) for axis in "xy")]
    rows = [",".join(map(repr, [number * step, *face.ravel().tolist()])) for number, face in enumerate(faces)]
    (tmp_path / "take.csv").write_text("\n".join([",".join(names), *rows]) + "\n")
    code, _, said = run("predict", quick_model_folder, tmp_path / "take.csv", *options)
    assert code == 0
    assert ("of 0.03 frames a second, which is no film, so weights are not filtered" in said) is told


def test_help_states_the_lags(run):
    for command in (("predict",), ("headset", "predict")):
        out = run(*command, "--help")[1]
        told = " ".join(out.replace("│", " ").split())
        assert "kalman-33 33/33" in told

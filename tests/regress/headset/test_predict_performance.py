"""From footage to weights: calibration, seats, neutral frames, confidence, and what people ask for."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, MIRRORED_BLENDSHAPES
from regress.errors import InputError
from regress.runtime.headset.answers.confidence import HeadsetConfidence
from regress.runtime.headset.answers.predict import predict_footage
from regress.runtime.headset.network.figures import ShapeFigures
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.person.neutral import Neutral, calmest_frame, neutral_of_frame, read_neutral
from regress.runtime.headset.person.seats import SeatWatch
from regress.runtime.headset.recordings.footage import Footage, line_up
from regress.runtime.prediction import Prediction
from regress.runtime.stages.kalman import LIDS
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import Output
from tests.regress.headset.takes import HEIGHT, WIDTH, pictures, recording, write_pictures
from tests.regress.headset.tiny import NAMES, OWNER, R2, RMSE, write_tiny_model


@pytest.fixture(scope="module")
def predictor(tmp_path_factory: pytest.TempPathFactory) -> HeadsetPredictor:
    return load_headset_predictor(write_tiny_model(tmp_path_factory.mktemp("models") / "tiny"))


def _footage(
    predictor: HeadsetPredictor, means: dict[str, list[float]], *, fps: float | None = 30
) -> Footage:
    stacks = {name: pictures(values, seed=seed) for seed, (name, values) in enumerate(means.items())}
    return line_up({name: recording(name, stack) for name, stack in stacks.items()}, predictor.sizes, fps=fps)


def _predict(
    predictor: HeadsetPredictor, footage: Footage, *inputs: object, **settings: object
) -> Prediction:
    return predict_footage(predictor, footage, *inputs, **settings)[0]


def test_each_camera_drives_its_shapes_and_an_absent_one_lowers_confidence(predictor: HeadsetPredictor):
    footage = _footage(predictor, {"left_eye": [51, 102], "mouth": [153, 204]})
    made = _predict(predictor, footage)
    for name, values in {"left_eye": [0.2, 0.4], "right_eye": [0, 0], "mouth": [0.6, 0.8]}.items():
        columns = [OWNER[shape] == name for shape in BLENDSHAPES]
        assert made.weights[:, columns] == pytest.approx(
            np.array(values)[:, None] * np.ones(sum(columns)), abs=0.01
        )
        # the usual share, which a low deviation does not raise and a high one lowers to nothing
        trust = 0.0 if name == "right_eye" else R2
        assert made.confidence[:, columns] == pytest.approx(trust)
    assert made.gaze[:, 0] == pytest.approx([0.02, 0.04], abs=0.002)


@given(
    factor=st.floats(0.1, 5), there=st.lists(st.booleans(), min_size=3, max_size=3), calibrated=st.booleans()
)
@settings(max_examples=60, deadline=None)
def test_confidence_is_the_share_explained_and_falls_with_deviation_and_cameras(
    predictor: HeadsetPredictor, factor: float, there: list[bool], calibrated: bool
):
    trust = HeadsetConfidence(predictor.model)
    found = trust.of_frame(np.full(52, factor * RMSE), np.array(there), calibrated=calibrated)
    usual = np.clip(1 - (1 - R2) * max(factor**2, 1), 0, 1)
    for column, shape in enumerate(BLENDSHAPES):
        alone = [
            0.8 if OWNER[shape] == name else 0.1 for name, here in zip(NAMES, there, strict=True) if here
        ]
        limit = 1.0 if all(there) else max(alone, default=0.0)
        assert found[column] == pytest.approx(min(usual, limit))


def test_calibrated_frames_have_their_own_scores(predictor: HeadsetPredictor):
    shapes = {
        name: {
            "uncalibrated": ShapeFigures(r2=0.5, mae=0.1, rmse=0.2),
            "same_seat": ShapeFigures(r2=0.8, mae=0.1, rmse=0.1),
        }
        for name in BLENDSHAPES
    }
    shapes["tongueOut"]["uncalibrated"] = ShapeFigures(r2=None, mae=0.0, rmse=0.0)
    scores = dataclasses.replace(predictor.model.scores, cameras={}, shapes=shapes)
    model = dataclasses.replace(predictor.model, scores=scores)
    trust = HeadsetConfidence(model)
    alone, beside_neutral = (
        trust.of_frame(np.full(52, 0.1), np.ones(3, dtype=bool), calibrated=calibrated)
        for calibrated in (False, True)
    )
    assert alone[:-1] == pytest.approx(0.5)
    assert beside_neutral == pytest.approx(0.8)
    assert alone[-1] == 0
    with pytest.raises(InputError, match="has no scores"):
        HeadsetConfidence(dataclasses.replace(model, scores=None))


def test_frames_without_pictures_have_no_weights_and_no_confidence(predictor: HeadsetPredictor):
    both = {name: recording(name, pictures([99] * 4), numbers=[0, 1, 2, 4]) for name in NAMES}
    made = _predict(predictor, line_up(both, predictor.sizes))
    assert np.isnan(made.weights).all(axis=1).tolist() == [False, False, False, True, False]
    assert np.isnan(made.gaze).any(axis=1).tolist() == [False, False, False, True, False]
    assert not made.confidence[3].any()
    assert made.confidence[[0, 1, 2, 4]] == pytest.approx(R2)


def test_calibration_is_the_difference_from_the_neutral_frame(predictor: HeadsetPredictor):
    footage = _footage(predictor, {name: [60, 90, 110] for name in NAMES})
    neutral = Neutral(row=0, pictures=neutral_of_frame(footage, 0))
    made, reseated = predict_footage(predictor, footage, [neutral])
    expected = np.repeat(np.array([[0], [30], [50]]) / 255, 52, axis=1)
    assert made.weights == pytest.approx(expected, abs=0.005)
    assert reseated == ()


def test_pictures_of_unknown_cameras_and_lacking_neutral_ones_are_refused(predictor: HeadsetPredictor):
    seen = {name: pictures([60, 90]) for name in NAMES}
    eyes = {name: seen[name][0] for name in NAMES[:2]}
    for stacks in ({"left": seen["mouth"]}, {**seen, "left": seen["mouth"]}):
        with pytest.raises(InputError, match="given of left; the model has left_eye, right_eye, mouth"):
            predictor.predict(stacks)
    with pytest.raises(InputError, match="given of jaw; the model has"):
        predictor.predict(seen, neutral={name: seen[name][0] for name in NAMES} | {"jaw": seen["mouth"][0]})
    with pytest.raises(InputError, match="no neutral pictures are given of mouth; a calibrated frame needs"):
        predictor.predict(seen, neutral=eyes)
    # a camera that is not there, or not in the calibrated frame, needs none
    alone = predictor.predict({name: seen[name] for name in NAMES[:2]}, neutral=eyes)
    absent = predictor.predict(seen, neutral=eyes, present=np.tile([1, 1, 0], (2, 1)))
    assert np.array_equal(alone.weights, absent.weights)
    half = predictor.predict(seen, neutral=eyes, present=[[1, 1, 1], [1, 1, 0]], calibrated=[0, 1])
    assert np.array_equal(half.weights[1], alone.weights[1])


def test_a_reseated_headset_is_seen_and_goes_on_uncalibrated(predictor: HeadsetPredictor):
    fps, change = 20, 30
    means = [60.0] * change + [160.0] * 40
    footage = _footage(predictor, {name: means for name in NAMES}, fps=fps)
    first, later = (Neutral(row=row, pictures=neutral_of_frame(footage, row)) for row in (0, change + 20))
    made, (label,) = predict_footage(predictor, footage, [first])
    row = int(label)
    assert change <= row <= change + fps / 2
    assert made.weights[: change - 1] == pytest.approx(0, abs=0.005)
    assert made.weights[row:] == pytest.approx(160 / 255, abs=0.005)
    kept, labels = predict_footage(predictor, footage, [first], keep_neutral=True)
    assert labels == (label,)
    assert kept.weights[row:] == pytest.approx(100 / 255, abs=0.005)
    again, labels = predict_footage(predictor, footage, [first, later])
    assert labels == (label,)
    assert np.array_equal(again.weights[: later.row], made.weights[: later.row])
    assert again.weights[later.row :] == pytest.approx(0, abs=0.005)


def test_a_neutral_picture_of_another_seat_counts_for_no_frame(predictor: HeadsetPredictor):
    footage = _footage(predictor, {name: [160.0] * 40 for name in NAMES})
    other = _footage(predictor, {name: [60.0] for name in NAMES})
    made, reseated = predict_footage(
        predictor, footage, [Neutral(row=0, pictures=neutral_of_frame(other, 0))]
    )
    assert reseated == ("0",)
    assert made.weights == pytest.approx(160 / 255, abs=0.005)


def test_a_doubt_that_passes_leaves_its_own_frames_alone_uncalibrated(predictor: HeadsetPredictor):
    footage = _footage(predictor, {name: [60.0] * 30 + [160.0] * 12 + [60.0] * 30 for name in NAMES})
    made, reseated = predict_footage(
        predictor, footage, [Neutral(row=0, pictures=neutral_of_frame(footage, 0))]
    )
    assert reseated == ()
    assert made.weights[[0, 29, 50, 71]] == pytest.approx(0, abs=0.005)
    assert made.weights[41] == pytest.approx(160 / 255, abs=0.005)


@given(low=st.integers(0, 60), length=st.integers(0, 40), fps=st.sampled_from([10, 30, 60]))
@example(low=0, length=8, fps=30)  # a blink as the take begins is most of the frames so far
@settings(max_examples=60, deadline=None)
def test_a_seat_changes_only_where_it_stays_changed(low: int, length: int, fps: int):
    same = np.full(240, 0.95)
    same[low : low + length] = 0.02
    watch = SeatWatch()
    compared = []
    for row, value in enumerate(same):
        compared.append(watch.step(1 / fps, float(value)))
        if row + 1 == low + length and length > 2 * fps * 0.5 + 1:
            assert watch.changed  # before the old seat seems to be back
    assert all(compared[:low])
    if length < fps / 2 - 1:  # of a window with an even count half is no majority
        assert not watch.changed
        assert all(compared[low + length + fps :])
    if length > fps + 1:
        began = compared.index(False)
        assert low <= began <= low + fps / 2
        assert not any(compared[began:])


def test_the_calmest_frame_is_found_and_doubt_is_told():
    rng = np.random.default_rng(3)
    weights = rng.uniform(0.3, 0.8, size=(80, 52))
    calm = rng.choice(80, 30, replace=False)
    weights[calm] = 0.1 + rng.uniform(0, 0.02, size=(30, 52))
    usable = np.ones(80, dtype=bool)
    usable[calm[:3]] = False
    found = calmest_frame(weights, usable)
    assert found.sure
    assert found.row in set(calm[3:])
    assert not calmest_frame(weights[:20], usable[:20]).sure
    weights[:] = 0.9
    weights[:10], weights[70:] = 0.1, 0.4  # as by a new seat in between
    assert "early and late" in calmest_frame(weights, np.ones(80, dtype=bool)).reason
    with pytest.raises(InputError, match="none can be the neutral one"):
        calmest_frame(weights, np.zeros(80, dtype=bool))


def test_a_neutral_frame_needs_every_camera_in_use(predictor: HeadsetPredictor, tmp_path: Path):
    takes = {
        "left_eye": recording("left_eye", pictures([99] * 3)),
        "mouth": recording("mouth", pictures([99] * 2), numbers=[1, 2]),
    }
    footage = line_up(takes, predictor.sizes)
    with pytest.raises(InputError, match="frame 0 cannot be the neutral one: mouth has no picture there"):
        neutral_of_frame(footage, 0)
    assert set(neutral_of_frame(footage, 1)) == {"left_eye", "mouth"}
    write_pictures(tmp_path, pictures([99]), name="left_eye.png")
    assert set(read_neutral(tmp_path, {"left_eye": (WIDTH, HEIGHT)})) == {"left_eye"}
    with pytest.raises(InputError, match=r"has no neutral picture of mouth; mouth\.png is looked for"):
        read_neutral(tmp_path, {"mouth": (WIDTH, HEIGHT)})
    write_pictures(tmp_path, np.zeros((1, HEIGHT, WIDTH), dtype=np.uint8), name="mouth.png")
    with pytest.raises(InputError, match="it is a black picture"):
        read_neutral(tmp_path, {"mouth": (WIDTH, HEIGHT)})


def test_amplified_lids_alone_change_and_stay_weights(predictor: HeadsetPredictor):
    footage = _footage(predictor, {name: [51, 153] for name in NAMES})
    plain, strong = _predict(predictor, footage), _predict(predictor, footage, output=Output(amplify_eyes=2))
    lids = [name in LIDS for name in BLENDSHAPES]
    assert sum(lids) == 6
    assert strong.weights[:, lids] == pytest.approx(np.minimum(2 * plain.weights[:, lids], 1))
    assert np.array_equal(strong.weights[:, np.logical_not(lids)], plain.weights[:, np.logical_not(lids)])


def test_a_mirror_exchanges_weights_gaze_and_confidence(predictor: HeadsetPredictor):
    footage = _footage(predictor, {"left_eye": [51, 102], "mouth": [153, 204]})
    plain, turned = _predict(predictor, footage), _predict(predictor, footage, output=Output(mirror=True))
    order = list(MIRRORED_BLENDSHAPES)
    assert np.array_equal(turned.weights, plain.weights[:, order])
    assert np.array_equal(turned.confidence, plain.confidence[:, order])
    left_yaw, left_pitch, right_yaw, right_pitch = plain.gaze.T
    assert turned.gaze == pytest.approx(np.stack([-right_yaw, right_pitch, -left_yaw, left_pitch], axis=1))


@pytest.mark.parametrize("output", [Output(smooth=4), Output(one_euro=OneEuro(cutoff_hz=1.0, beta=0.5))])
def test_smoothing_calms_weights_and_gaze_alike(predictor: HeadsetPredictor, output: Output):
    rng = np.random.default_rng(0)
    means = (128 + rng.normal(0, 12, 60)).tolist()
    footage = _footage(predictor, {name: means for name in NAMES})
    plain, calm = _predict(predictor, footage), _predict(predictor, footage, output=output)
    blink = BLENDSHAPE_INDEX["eyeBlinkLeft"]
    assert calm.weights[10:, blink].std() < 0.8 * plain.weights[10:, blink].std()
    assert calm.gaze[10:].std() < plain.gaze[10:].std()
    assert calm.gaze[10:, 0].std() < 0.8 * plain.gaze[10:, 0].std()
    assert calm.gaze[10:].mean(axis=0) == pytest.approx(plain.gaze[10:].mean(axis=0), abs=0.005)

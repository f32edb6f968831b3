"""A mouth that lies elsewhere, upside down or on its side is placed; one that fits is left as it is."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.fitness.camera_fitness import CameraFitness
from regress.runtime.headset.fitness.fitness import judge
from regress.runtime.headset.fitness.misfits import Misfit
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.placing.levels import levels_in
from regress.runtime.headset.placing.mouth_points import MouthPoints
from regress.runtime.headset.placing.placement_file import read_placement
from regress.runtime.headset.placing.placement_steps import placement_of_points
from tests.regress.headset.takes import write_take

pytestmark = pytest.mark.slow

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
VIEW = (96, 96)
Change = Callable[[np.ndarray], np.ndarray]


@pytest.fixture(scope="module")
def mouth() -> np.ndarray:
    """Every third frame of a person of whom the networks have learned nothing."""
    files = sorted((TAKE / "mouth").glob("*.png"))[::3]
    return np.stack([cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files])


@pytest.fixture(scope="module")
def predictor() -> HeadsetPredictor:
    return load_headset_predictor("headset-tracking3")


def moved(pictures: np.ndarray, scale: float, *, down: float = 0.0, turn_deg: float = 0.0) -> np.ndarray:
    height, width = pictures.shape[1:]
    matrix = cv2.getRotationMatrix2D((width / 2, height / 2), turn_deg, scale)
    matrix[1, 2] += down * height
    return np.stack(
        [cv2.warpAffine(one, matrix, (width, height), borderMode=cv2.BORDER_REPLICATE) for one in pictures]
    )


def judged(predictor: HeadsetPredictor, pictures: np.ndarray) -> CameraFitness:
    (one,) = judge(predictor, {"mouth": np.ascontiguousarray(pictures)})
    return one


def unplaced(pictures: np.ndarray) -> CameraPlacement:
    """As `predict` sees pictures without a placement."""
    return replace(whole_view((pictures.shape[2], pictures.shape[1]), VIEW), aspect=None)


def mouth_weights(
    predictor: HeadsetPredictor, pictures: np.ndarray, placement: CameraPlacement
) -> np.ndarray:
    views = np.stack([placement.view(one, width=VIEW[0], height=VIEW[1]) for one in pictures])
    levelled = levels_in([views], predictor.model.looks["mouth"]).apply(views)
    columns = [predictor.model.weights.index(name) for name in predictor.model.parts["mouth"]]
    return predictor.graph.run({"mouth": levelled}).weights[:, columns]


@pytest.mark.parametrize("model", ["headset-tracking3", "headset-any"])
@pytest.mark.parametrize(
    ("change", "misfit"),
    [
        (lambda mouth: moved(mouth, 0.6), Misfit.PLACED),
        (lambda mouth: moved(mouth, 0.9, turn_deg=-40), Misfit.PLACED),
        (lambda mouth: mouth[:, ::-1, ::-1], Misfit.UPSIDE_DOWN),
        (lambda mouth: np.rot90(mouth, axes=(1, 2)), Misfit.SIDEWAYS),
        (lambda mouth: mouth[:, 6:78, :][:, ::-1, ::-1], Misfit.UPSIDE_DOWN),
        (lambda mouth: np.rot90(mouth[:, 6:78, :], -1, axes=(1, 2)), Misfit.SIDEWAYS),
    ],
    ids=["small", "turned", "upside down", "on its side", "4:3 upside down", "3:4 on its side"],
)
def test_a_mouth_that_lies_elsewhere_answers_placed_more_as_it_did(
    mouth: np.ndarray, model: str, change: Change, misfit: Misfit
):
    predictor = load_headset_predictor(model)
    plain = mouth_weights(predictor, mouth, CameraPlacement())
    seen = np.ascontiguousarray(change(mouth))
    one = judged(predictor, seen)
    assert misfit in {found.misfit for found in one.findings}
    before, after = (
        np.abs(mouth_weights(predictor, seen, each) - plain).mean()
        for each in (unplaced(seen), replace(one.placement, low=None, high=None))
    )
    assert after < 0.8 * before


@pytest.mark.parametrize("model", ["headset-tracking3", "headset-any"])
@pytest.mark.parametrize(
    "change",
    [
        lambda mouth: mouth,
        lambda mouth: mouth[:, :, ::-1],
        lambda mouth: mouth[:, 6:78],
        lambda mouth: mouth[:, :, 12:84],
        lambda mouth: moved(mouth, 1.3),
        lambda mouth: moved(mouth, 0.9, turn_deg=6),
    ],
    ids=["as it is", "in a mirror", "4:3", "3:4", "a little nearer", "a little turned"],
)
def test_a_mouth_that_fits_is_left_as_it_is(mouth: np.ndarray, model: str, change: Change):
    seen = np.ascontiguousarray(change(mouth))
    one = judged(load_headset_predictor(model), seen)
    assert not {Misfit.PLACED, Misfit.LOST, Misfit.TURNED, Misfit.NOSE} & {
        each.misfit for each in one.findings
    }
    assert replace(one.placement, low=None, high=None) == unplaced(seen)


def test_a_mouth_whose_nose_is_cut_off_is_told_and_not_placed(predictor: HeadsetPredictor, mouth: np.ndarray):
    """A network traces a nose all the same, too far inside, and the mouth would be led away from its place."""
    seen = moved(mouth, 1.0, down=-0.2)
    one = judged(predictor, seen)
    assert [found.misfit for found in one.findings if found.misfit is not Misfit.RIM] == [Misfit.NOSE]
    assert replace(one.placement, low=None, high=None) == CameraPlacement()


def test_an_eye_in_place_of_a_mouth_is_told(predictor: HeadsetPredictor):
    files = sorted((TAKE / "left_eye").glob("*.png"))[:24]
    one = judged(predictor, np.stack([cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files]))
    assert {Misfit.TURNED, Misfit.LOST} & {found.misfit for found in one.findings}, one


def test_what_shows_no_mouth_is_lost_and_left_whole(predictor: HeadsetPredictor):
    noise = np.random.default_rng(0).integers(0, 256, (20, 12, 9), dtype=np.uint8)
    seen = np.stack([cv2.resize(one, (90, 120), interpolation=cv2.INTER_CUBIC) for one in noise])
    one = judged(predictor, seen)
    assert Misfit.LOST in {found.misfit for found in one.findings}
    assert "mouth: the mouth is not found" in " ".join(found.sentence for found in one.findings)
    assert replace(one.placement, low=None, high=None) == unplaced(seen)


@given(
    size=st.floats(0.3, 3),
    turn_deg=st.floats(-170, 170),
    x=st.floats(-50, 150),
    y=st.floats(-50, 150),
    seed=st.integers(0, 99),
)
def test_a_usual_mouth_anywhere_is_led_to_its_usual_place(size, turn_deg, x, y, seed):
    """Whatever the lips' corners do in some of the frames."""
    usual = np.random.default_rng(seed).uniform(10, 80, (9, 2))
    points = MouthPoints(nose=[0, 2, 3, 4, 5], corners=[7, 8], usual=usual)
    angle = np.radians(turn_deg)
    turn = size * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    seen = np.repeat((usual @ turn.T + (x, y))[None], 9, axis=0)
    seen[:3, 7:] += 30
    found = placement_of_points(CameraPlacement(), seen, points, picture=(200, 150), view=VIEW)
    matrix = found.picture_from_view((200, 150), VIEW)
    straight = CameraPlacement().picture_from_view((200, 150), VIEW)
    at = seen[-1] @ straight[:, :2].T + straight[:, 2]
    assert usual @ matrix[:, :2].T + matrix[:, 2] == pytest.approx(at, abs=1e-6)


def test_a_camera_of_few_frames_keeps_none_of_the_others_from_being_judged(
    run, mouth: np.ndarray, tmp_path: Path
):
    """A mouth of five frames refused the check of the eyes."""
    files = sorted((TAKE / "left_eye").glob("*.png"))[:24]
    eye = np.stack([cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files])
    options = write_take(tmp_path, {"left_eye": eye, "mouth": mouth[:5]})
    out, sheet = tmp_path / "placement.toml", tmp_path / "sheet.png"
    code, said, told = run("headset", "check", "headset-tracking3", *options, "--out", out, "--sheet", sheet)
    assert code == 0, told
    assert "mouth has 5 usable frames; at least 20 are needed" in said
    assert "left_eye: its frames fit" in said
    model = load_headset_predictor("headset-tracking3").model
    assert list(read_placement(out, model)) == ["left_eye"]
    code, said, _ = run("headset", "check", "headset-tracking3", *options, "--json")
    found = json.loads(said)["mouth"]
    assert (code, found["fits"], found["looks"], found["findings"][0]["misfit"]) == (0, False, None, "few")

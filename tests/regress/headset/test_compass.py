"""The shipped compass tells how a rendered eye lies, and what is said and found by it."""

from collections.abc import Mapping
from pathlib import Path

import cv2
import numpy as np
import pytest

from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.compass import ORIENTATIONS, eye_compass
from regress.runtime.headset.placing.found_placement import FoundPlacement
from regress.runtime.headset.placing.orientation import told_by_compass
from regress.runtime.headset.placing.placement_search import find_placement
from regress.runtime.headset.placing.placement_steps import Search
from regress.runtime.headset.recordings.footage import line_up
from tests.regress.headset.takes import recording, write_take

pytestmark = pytest.mark.slow

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
EYES = ("left_eye", "right_eye")

Take = Mapping[str, np.ndarray]


@pytest.fixture(scope="module")
def take() -> Take:
    """A rendered person's frames, of whom no network has learned anything."""
    return {
        name: np.stack(
            [cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in sorted((TAKE / name).glob("*.png"))[::6]]
        )
        for name in EYES
    }


def lying(pictures: np.ndarray, orientation: int) -> np.ndarray:
    """Views that are of an orientation where the pictures are of an eye upright."""
    quarter, mirrored = divmod(orientation, 2)
    placement = CameraPlacement(roll_deg=(90 * quarter + 180) % 360 - 180, mirror=bool(mirrored))
    side = pictures.shape[1]
    return np.stack([placement.view(one, width=side, height=side) for one in pictures])


@pytest.mark.parametrize("orientation", range(ORIENTATIONS))
def test_each_orientation_is_told(take: Take, orientation: int):
    told = eye_compass().log_shares(lying(take["left_eye"], orientation), of_right_eye=False)
    assert int(np.argmax(told)) == orientation
    assert np.exp(told).sum() <= 1 + 1e-6
    # a right eye is a left one in a mirror
    right = np.ascontiguousarray(lying(take["right_eye"][:, :, ::-1], orientation)[:, :, ::-1])
    assert int(np.argmax(eye_compass().log_shares(right, of_right_eye=True))) == orientation


def test_levels_and_contrast_do_not_count(take: Take):
    plain = eye_compass().log_shares(take["left_eye"], of_right_eye=False)
    dim = np.rint(60 + take["left_eye"] / 3).astype(np.uint8)
    assert np.abs(np.exp(plain) - np.exp(eye_compass().log_shares(dim, of_right_eye=False))).max() < 0.1


def footage(pictures: Take):
    sizes = {name: (one.shape[2], one.shape[1]) for name, one in pictures.items()}
    return line_up({name: recording(name, one) for name, one in pictures.items()}, sizes)


def test_eyes_that_are_turned_mirrored_or_exchanged_are_told_in_words(take: Take):
    assert told_by_compass(footage(take), eye_compass()) == []
    exchanged = {"left_eye": take["right_eye"], "right_eye": take["left_eye"]}
    told = told_by_compass(footage(exchanged), eye_compass())
    assert [line.split(" or of")[0] for line in told] == [
        "left_eye: its pictures look more like those of right_eye",
        "right_eye: its pictures look more like those of left_eye",
    ]
    (told,) = told_by_compass(
        footage(dict(take) | {"left_eye": take["left_eye"][:, ::-1, ::-1]}), eye_compass()
    )
    assert told.startswith(
        "left_eye: its pictures look more like those of an eye upside down than like a left eye"
    )
    # of a mouth it knows nothing
    mouth = {"mouth": np.ascontiguousarray(take["left_eye"][:, ::-1])}
    assert told_by_compass(footage(mouth), eye_compass()) == []


def test_of_two_places_as_good_the_one_with_an_eye_upright_is_taken(take: Take):
    predictor = load_headset_predictor("headset-any")
    for camera in EYES:
        search = Search(predictor, camera, EyePoints.of(predictor, camera), take[camera][:8], fades=False)
        upright, mirrored = (search.best(CameraPlacement(mirror=mirror)).upright for mirror in (False, True))
        assert upright > mirrored + 1
    found = {"placement": CameraPlacement(), "deviation": 0.1, "unrest": 0.02, "unsettled": 0.0}
    assert FoundPlacement(**found, upright=upright).score < FoundPlacement(**found, upright=mirrored).score


@pytest.mark.parametrize(("camera", "mirror"), [("left_eye", True), ("right_eye", False)])
def test_a_network_of_drawn_headsets_finds_an_eyes_side(take: Take, camera: str, mirror: bool):
    predictor = load_headset_predictor("headset-any")
    seen = np.ascontiguousarray(take[camera][:, :, :: -1 if mirror else 1])
    assert find_placement(predictor, camera, seen).placement.mirror == mirror


def test_predict_says_that_eyes_are_exchanged_whatever_the_headset(run, take: Take, tmp_path: Path):
    options = write_take(tmp_path, {"left_eye": take["right_eye"], "right_eye": take["left_eye"]})
    code, _, told = run("headset", "predict", "headset-any", *options, "--out", tmp_path / "exchanged.csv")
    assert code == 0
    assert "left_eye: its pictures look more like those of right_eye" in told
    assert "are cameras mixed up, or turned?" in told
    (tmp_path / "plain").mkdir()
    options = write_take(tmp_path / "plain", take)
    code, _, told = run("headset", "predict", "headset-any", *options, "--out", tmp_path / "plain.csv")
    assert (code, "look more like" in told) == (0, False)

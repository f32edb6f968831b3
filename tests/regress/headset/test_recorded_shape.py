"""What `check` sees in pictures before it looks for an eye: bars, halves that are shrunk, two views in one picture."""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from regress.runtime.headset.fitness.both_eyes import _same_eye
from regress.runtime.headset.fitness.fitness import judge
from regress.runtime.headset.fitness.misfits import Misfit
from regress.runtime.headset.fitness.shape import RecordedShape, two_views
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.headset.pictures.placement import NO_CUT, CameraPlacement
from regress.runtime.headset.placing.placement_file import read_placement
from tests.regress.headset.takes import write_take

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"


def recorded(camera: str, every: int = 1) -> np.ndarray:
    files = sorted((TAKE / camera).glob("*.png"))[::every]
    return np.stack([cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files])


def shrunk(pictures: np.ndarray) -> np.ndarray:
    """Half as wide."""
    size = (pictures.shape[2] // 2, pictures.shape[1])
    return np.stack([cv2.resize(one, size, interpolation=cv2.INTER_AREA) for one in pictures])


def beside(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Two views in pictures of one's size."""
    return np.concatenate([shrunk(one), shrunk(other)], axis=2)


@pytest.mark.parametrize(
    "placement",
    [CameraPlacement(), CameraPlacement(x=0.6, y=0.4, size=1.4, roll_deg=30.0), CameraPlacement(mirror=True)],
)
def test_a_stretched_placement_sees_what_the_plain_one_sees_before_it_was_shrunk(placement: CameraPlacement):
    plain = cv2.resize(recorded("left_eye", 30)[0], (200, 200), interpolation=cv2.INTER_CUBIC)
    wide = CameraPlacement(**{**vars(placement), "stretch": 2.0})
    seen = wide.view(shrunk(plain[None])[0], width=96, height=96).astype(int)
    wanted = placement.view(plain, width=96, height=96)
    assert np.abs(seen - wanted).mean() < 1.5
    matrix = wide.picture_from_view((100, 200), (96, 96))
    np.testing.assert_allclose(
        (matrix @ [3, 70, 1] + 0.5) * [2, 1],
        placement.picture_from_view((200, 200), (96, 96)) @ [3, 70, 1] + 0.5,
    )


@pytest.mark.parametrize("apart", [0, 4, 10])
def test_two_views_of_a_mouth_are_told_from_one(apart: int):
    mouth = recorded("mouth", 10)
    width = mouth.shape[2]
    (found,) = two_views("mouth", beside(mouth[:, :, : width - apart], mouth[:, :, apart:]))
    assert (found.misfit, "#left" in found.sentence) == (Misfit.VIEWS, True)
    for turn in range(4):
        assert not list(two_views("mouth", np.rot90(mouth, turn, axes=(1, 2))))
    assert not list(two_views("mouth", np.concatenate([mouth, mouth], axis=2))), "not square: #left is told"
    assert not list(two_views("mouth", np.full((20, 40, 40), 90, np.uint8)))


def test_narrow_pictures_alone_may_be_shrunk():
    for width, may in ((48, True), (57, True), (58, False), (96, False)):
        assert RecordedShape(pictures=np.zeros((1, 96, width), np.uint8)).may_be_shrunk((64, 64)) is may


def test_a_wide_picture_of_both_cameras_may_have_two_causes():
    for height, width, both in ((360, 640, True), (720, 1280, True), (480, 640, False)):
        said = _same_eye("left_eye", "right_eye", np.zeros((1, height, width), np.uint8))
        assert ("#left" in said) is both
        assert "cable" in said


@pytest.mark.slow
@pytest.mark.parametrize("camera", ["left_eye", "mouth"])
def test_a_half_that_is_shrunk_is_stretched(camera: str):
    pictures = recorded(camera, 4)
    predictor = load_headset_predictor("headset-tracking3")
    (one,) = judge(predictor, {camera: shrunk(pictures)})
    assert {finding.misfit for finding in one.findings} == {Misfit.SHRUNK}
    assert one.placement == CameraPlacement(stretch=2.0)


@pytest.mark.slow
def test_a_letterboxed_eye_is_found_as_without_its_bars(run, tmp_path: Path):
    pictures = recorded("left_eye", 4)
    bars = np.pad(pictures, ((0, 0), (20, 20), (0, 0)))
    options, out = write_take(tmp_path, {"left_eye": bars}), tmp_path / "placement.toml"
    code, said, _ = run("headset", "check", "headset-tracking3", *options, "--out", out)
    assert (code, said.count("\n")) == (0, 1), said
    assert said.startswith("left_eye has bars")
    placed = read_placement(out, load_headset_predictor("headset-tracking3").model)["left_eye"]
    np.testing.assert_array_equal(placed.view(bars[0], width=96, height=96), pictures[0])
    # written with four digits
    assert replace(placed, cut=NO_CUT, aspect=None) == CameraPlacement()


@pytest.mark.slow
def test_predict_places_by_itself_what_check_is_sure_of(run, tmp_path: Path):
    """And leaves an eye in a mirror, which may be the other one, to a person."""
    pictures = recorded("left_eye", 4)
    wide = {
        "sure": np.pad(pictures, ((0, 0), (0, 24), (0, 40)), mode="edge"),
        "mirrored": np.pad(pictures[:, :, ::-1], ((0, 0), (0, 24), (0, 40)), mode="edge"),
    }
    for what, seen in wide.items():
        options, out = write_take(tmp_path / what, {"left_eye": seen}), tmp_path / f"{what}.toml"
        assert run("headset", "check", "headset-tracking3", *options, "--out", out)[0] == 0
        named = out if what == "sure" else None
        words = ["headset", "predict", "headset-tracking3", *options]
        code, table, said = run(*words, "--placement", "auto")
        assert (code, "not sure" in said) == (0, what != "sure"), said
        plain = run(*words, *(["--placement", named] if named else []))[1]
        values, wanted = (
            np.array([row.split(",")[2:] for row in text.splitlines()[1:]], dtype=float)
            for text in (table, plain)
        )
        np.testing.assert_allclose(values, wanted, atol=0.2 if named else 0)  # a file has four digits


@pytest.mark.slow
def test_what_auto_sets_right_is_not_advised_and_bars_are_told(run, tmp_path: Path):
    pictures = recorded("left_eye", 4)
    seen = {"sure": pictures, "mirrored": pictures[:, :, ::-1], "few": pictures[:10]}
    for what, one in seen.items():
        options = write_take(tmp_path / what, {"left_eye": np.pad(one, ((0, 0), (20, 20), (0, 0)))})
        code, _, said = run("headset", "predict", "headset-tracking3", *options, "--placement", "auto")
        assert code == 0
        assert ("take --placement" in said) == (what == "mirrored"), said
        assert ("all of each picture but its bars is seen" in said) == (what != "sure"), said
        assert ("of what its bars leave" in said) == (what == "sure"), said


@pytest.mark.slow
def test_a_dataset_needs_no_placement(run, tmp_path: Path):
    (tmp_path / "renders").mkdir()
    code, _, said = run("headset", "predict", "headset-tracking3", tmp_path, "--placement", "auto")
    assert (code, "a dataset needs no placement" in said) == (2, True), said

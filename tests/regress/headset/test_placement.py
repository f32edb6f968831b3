"""Placements: what of a picture a network sees, pixels there and back, and their file."""

import string
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.errors import InputError
from regress.runtime.headset.answers.points import traced_points
from regress.runtime.headset.network.model import CameraInput, HeadsetModel, HeadsetTraining
from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.pictures.picture_file import fit_picture
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.placement_file import Placement, read_placement, write_placement
from regress.runtime.headset.recordings.footage import line_up
from regress.runtime.headset.recordings.recording import read_recording
from tests.regress.headset.takes import write_pictures
from tests.regress.headset.tiny import NAMES


def model_of(cameras: Iterable[str], **changes: object) -> HeadsetModel:
    """What a folder would say of a network of these cameras."""
    settings = {
        "headset": "tracking3",
        "cameras": tuple(CameraInput(name=name, width=64, height=64) for name in cameras),
        "parts": {},
        "modulation": 0.3,
        "architecture": "modular",
        "calibration": "optional",
        "network_sha256": "a" * 64,
        **changes,
    }
    return HeadsetModel(**settings)


sides = st.tuples(st.integers(40, 200), st.integers(40, 200))
placements = st.builds(
    CameraPlacement,
    x=st.floats(-0.5, 1.5),
    y=st.floats(-0.5, 1.5),
    size=st.floats(0.2, 3),
    roll_deg=st.floats(-180, 180),
    mirror=st.booleans(),
)


@given(placements, sides, sides)
def test_the_views_middle_lies_where_it_says_and_its_width_is_as_large(placement, picture, view):
    matrix = placement.picture_from_view(picture, view)
    middle = matrix[:, :2] @ ((np.array(view) - 1) / 2) + matrix[:, 2]
    np.testing.assert_allclose((middle + 0.5) / picture, [placement.x, placement.y], atol=1e-9)
    across = matrix[:, 0] * view[0]
    np.testing.assert_allclose(np.linalg.norm(across), placement.size * picture[0])
    assert (np.linalg.det(matrix[:, :2]) < 0) == placement.mirror


@given(placements)
def test_a_spot_is_seen_where_pixels_are_taken_to(placement):
    picture, view = (150, 120), (96, 80)
    matrix = placement.picture_from_view(picture, view)
    spot_view = np.array([41.0, 37.0])
    spot = matrix[:, :2] @ spot_view + matrix[:, 2]
    if not ((spot > 12) & (spot < np.array(picture) - 13)).all():
        return
    rows, columns = np.mgrid[: picture[1], : picture[0]]
    # as wide in the view whatever the size, so that sampling does not move its middle
    wide = 4 * placement.size * picture[0] / view[0]
    light = 200 * np.exp(-((columns - spot[0]) ** 2 + (rows - spot[1]) ** 2) / (2 * wide**2))
    seen = placement.view(light.astype(np.uint8), width=view[0], height=view[1]).astype(float)
    peak = np.unravel_index(np.argmax(cv2.GaussianBlur(seen, (0, 0), 2)), seen.shape)
    assert np.hypot(*(np.array(peak)[::-1] - spot_view)) < 2


def test_without_anything_named_a_picture_is_only_scaled():
    picture = cv2.GaussianBlur(np.random.default_rng(0).integers(0, 256, (96, 96), dtype=np.uint8), (0, 0), 2)
    np.testing.assert_array_equal(CameraPlacement().view(picture, width=96, height=96), picture)
    larger = picture.repeat(2, axis=0).repeat(2, axis=1)
    half = CameraPlacement().view(larger, width=96, height=96).astype(int)
    assert np.abs(half - picture).mean() < 3


def test_beyond_the_edges_their_pixels_are_repeated():
    picture = np.full((60, 80), 90, np.uint8)
    picture[:, 0], picture[-1] = 140, 30
    seen = CameraPlacement(size=2.0).view(picture, width=96, height=96)
    assert seen.min() > 25  # nothing is filled black
    assert (seen[40:50, :15] > 100).all()


def test_what_is_repeated_fades_the_more_the_farther_out_it_lies():
    """Streaks look like lids to networks; within the picture and at its edge nothing is blurred."""
    stripes = np.repeat(np.where(np.arange(60) // 4 % 2, 200, 40).astype(np.uint8)[:, None], 60, axis=1)
    seen = CameraPlacement(size=2.0).view(stripes, width=120, height=120).astype(int)
    contrast = np.ptp(seen[40:80], axis=0)
    assert (contrast[30:91] == contrast[60]).all()
    assert (np.diff(contrast[91:]) <= 0).all()
    assert (np.diff(contrast[:30]) >= 0).all()
    assert max(contrast[0], contrast[-1]) < 0.1 * contrast[60]
    assert abs(seen[40:80, -1].mean() - stripes.mean()) < 10  # no darker and no lighter


@given(placements)
def test_a_view_within_its_picture_is_not_blurred(placement):
    picture = np.random.default_rng(0).integers(0, 256, (60, 60), dtype=np.uint8)
    inside = replace(placement, x=0.5, y=0.5, size=min(placement.size, 0.65), low=None, high=None)
    plain = cv2.warpAffine(
        picture,
        inside.picture_from_view((60, 60), (96, 96)),
        (96, 96),
        flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
    )
    np.testing.assert_array_equal(inside.view(picture, width=96, height=96), plain)


@given(
    st.dictionaries(
        st.text(string.ascii_letters + string.digits + "_-.", max_size=20).map("c".__add__),
        placements.flatmap(
            lambda one: st.sampled_from([one, replace(one, low=-3.5, high=240.25, aspect=4 / 3)])
        ),
        min_size=1,
        max_size=4,
    ),
    st.text(max_size=50),
)
def test_a_file_says_what_was_written(tmp_path_factory, cameras, model):
    path = tmp_path_factory.mktemp("placement") / "placement.toml"
    write_placement(path, Placement(cameras=cameras, model=model))
    found = read_placement(path, model_of(cameras))
    assert list(found) == list(cameras)
    for name, one in cameras.items():
        written = {"x": 4, "y": 4, "size": 4, "roll_deg": 2, "low": 1, "high": 1, "aspect": 4}
        for field, digits in written.items():
            wanted = getattr(one, field)
            wanted = None if wanted is None else pytest.approx(wanted, abs=0.51 * 10**-digits)
            assert getattr(found[name], field) == wanted
        assert found[name].mirror == one.mirror


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("version = 2", "version = 2"),
        ("colour = 1", "colour"),
        ("[cameras.nose]\nx = 0.5", "the model has no camera 'nose'; it has left_eye"),
        ("[cameras.mouth]\nsize = 0.0", "cameras.mouth.size = 0.0"),
        ("[cameras.mouth]\nsize = nan", "cameras.mouth.size"),
        ("[cameras.mouth]\nroll_deg = 181.0", "cameras.mouth.roll_deg = 181.0"),
        ("[cameras.mouth]\nlow = 20.0", "low and high are given together"),
        ("[cameras.mouth]\nlow = 90.0\nhigh = 90.5", "low 90 must lie below high 90.5"),
        ("[cameras.mouth]\nzoom = 2.0", "zoom"),
        ("cameras = 3", "cameras"),
        ("x = ", "is not valid TOML"),
    ],
)
def test_what_is_no_placement_is_refused_by_name(tmp_path: Path, text: str, said: str):
    path = tmp_path / "placement.toml"
    path.write_text(text if text.startswith("version") else f"version = 1\n{text}")
    with pytest.raises(InputError, match="placement") as refused:
        read_placement(path, model_of(NAMES))
    assert said in str(refused.value)


@pytest.mark.parametrize(
    ("changes", "taken"),
    [
        ({}, True),
        ({"network_sha256": "b" * 64, "training": HeadsetTraining(began_as="a" * 64)}, True),
        (
            {
                "network_sha256": "b" * 64,
                "training": HeadsetTraining(began_as="c" * 64, adapted_from=("a" * 64, "c" * 64)),
            },
            True,
        ),
        ({"network_sha256": "b" * 64}, False),
        # a network for any headset may have begun as one for this
        (
            {"headset": "drawn", "network_sha256": "b" * 64, "training": HeadsetTraining(began_as="a" * 64)},
            False,
        ),
    ],
)
def test_a_placement_is_for_the_model_that_it_was_found_with_and_for_adapted_ones(
    tmp_path: Path, changes: dict[str, object], taken: bool
):
    path = tmp_path / "placement.toml"
    of = {"model": "headset-tracking3", "headset": "tracking3", "network_sha256": "a" * 64}
    write_placement(path, Placement(cameras={"mouth": CameraPlacement()}, **of))
    model = model_of(NAMES, **changes)
    if taken:
        assert read_placement(path, model) == {"mouth": CameraPlacement()}
    else:
        with pytest.raises(InputError, match=r"another network \(headset-tracking3") as refused:
            read_placement(path, model)
        assert "check" in str(refused.value)
    path.write_text("version = 1\n[cameras.mouth]\nx = 0.5\n")
    assert read_placement(path, model), "by hand, for any model"


class Tracer:
    """Stands for a model that traces a view's middle, whatever it sees."""

    def trace(self, pictures):
        return {
            name: np.full((len(stack), 1, 2), ((np.array(stack.shape[2:0:-1]) - 1) / 2).tolist(), np.float32)
            for name, stack in pictures.items()
        }


def test_points_are_given_in_the_pixels_that_were_recorded(tmp_path: Path):
    random = np.random.default_rng(1)
    folder = write_pictures(tmp_path / "eye", random.integers(60, 200, (3, 90, 160), dtype=np.uint8))
    placement = CameraPlacement(x=0.6, y=0.4, size=0.5, mirror=True)
    recording = read_recording(folder, "left_eye", width=64, height=64, placement=placement)
    footage = line_up({"left_eye": recording}, {"left_eye": (64, 64)})
    assert footage.present.all()

    class Predictor:
        graph = Tracer()

    found = traced_points(Predictor(), footage)["left_eye"]
    np.testing.assert_allclose(found[:, 0], np.tile([0.6 * 160 - 0.5, 0.4 * 90 - 0.5], (3, 1)), atol=1e-4)

    other = read_recording(folder, "mouth", width=64, height=64, placement=replace(placement, aspect=4 / 3))
    assert all(fault is Fault.SHAPE for fault in other.faults)
    found = traced_points(
        Predictor(),
        line_up({"left_eye": recording, "mouth": other}, {"left_eye": (64, 64), "mouth": (64, 64)}),
    )
    assert np.isfinite(found["left_eye"]).all()
    assert np.isnan(found["mouth"]).all(), "a placed camera none of whose pictures counts"


@pytest.mark.parametrize(
    ("height", "fault"), [(120, None), (60, None), (90, Fault.SHAPE), (160, Fault.SHAPE)]
)
def test_a_placement_takes_pictures_of_its_own_shape_alone(height: int, fault: Fault | None):
    """Pictures of 16 : 9 from a camera that gave 4 : 3 show another part of what it sees."""
    found = CameraPlacement(x=0.6, size=0.7, aspect=4 / 3)
    width = height * 4 // 3 if fault is None else 160
    picture = np.random.default_rng(1).integers(60, 200, (height, width), np.uint8)
    assert fit_picture(picture, width=64, height=64, placement=found).fault is fault
    assert fit_picture(picture, width=64, height=64, placement=replace(found, aspect=None)).fault is None


def test_a_live_picture_is_placed_as_a_recorded_one(tmp_path: Path):
    picture = np.random.default_rng(1).integers(60, 200, (90, 160), dtype=np.uint8)
    folder = write_pictures(tmp_path / "eye", picture[None])
    placement = CameraPlacement(x=0.6, y=0.4, size=0.7, roll_deg=12.0)
    recorded = read_recording(folder, "left_eye", width=64, height=64, placement=placement)
    live = fit_picture(picture, width=64, height=64, placement=placement)
    np.testing.assert_array_equal(recorded.pictures[0], live.picture)

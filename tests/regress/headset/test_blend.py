"""Blending of cameras, and parts by name."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

torch = pytest.importorskip("torch")

from facegen.conventions import BLENDSHAPES, mirrored_name  # noqa: E402
from regress.learning.headset.training.blend import blend  # noqa: E402
from regress.runtime.headset.network.parts import (  # noqa: E402
    encoder_owners,
    is_symmetric,
    mirror_partner,
    part_of,
    side_of,
    without_side,
)

CAMERAS = ("left_eye", "right_eye", "mouth")


def said(seed: int, cameras: int = 3, outputs: int = 6):
    random = np.random.default_rng(seed)
    means, log_variances = torch.from_numpy(random.standard_normal((2, 4, cameras, outputs)))
    modulation = torch.from_numpy(np.where(random.random((cameras, outputs)) < 0.5, 1.0, 0.3))
    return means, log_variances, modulation


@given(seed=st.integers(0, 10_000), lost=st.integers(0, 2))
def test_shares_add_up_and_a_missing_camera_has_none(seed: int, lost: int):
    means, log_variances, modulation = said(seed)
    present = torch.ones(4, 3, dtype=torch.float64)
    present[:, lost] = 0
    blended = blend(means, log_variances, modulation, present)
    np.testing.assert_allclose(blended.shares.sum(dim=1), 1, atol=1e-5)
    assert (blended.shares[:, lost] == 0).all()
    wild = means.clone()
    wild[:, lost] += 100
    np.testing.assert_array_equal(blend(wild, log_variances, modulation, present).mean, blended.mean)
    left = np.delete(means.numpy(), lost, axis=1)
    low, high = left.min(axis=1), left.max(axis=1)
    assert ((blended.mean.numpy() >= low - 1e-4) & (blended.mean.numpy() <= high + 1e-4)).all()


def test_shares_are_inverse_variances_times_modulation():
    log_variances = torch.log(torch.tensor([[[1.0], [4.0]]]))
    blended = blend(
        torch.tensor([[[10.0], [0.0]]]), log_variances, torch.tensor([[0.3], [1.0]]), torch.ones(1, 2)
    )
    np.testing.assert_allclose(blended.shares[0, :, 0], [0.3 / 0.55, 0.25 / 0.55], rtol=1e-5)
    np.testing.assert_allclose(blended.variance[0], (0.3 * 1 + 0.25 * 4) / 0.55, rtol=1e-5)


def test_without_any_camera_the_training_mean_is_said():
    means, log_variances, modulation = said(0)
    blended = blend(means, log_variances, modulation, torch.zeros(4, 3, dtype=torch.float64))
    np.testing.assert_array_equal(blended.mean, 0)
    np.testing.assert_array_equal(blended.variance, 1)


def test_every_shape_belongs_to_a_camera_and_mirrored_cameras_have_mirrored_parts():
    assert set().union(*(part_of(camera) for camera in CAMERAS)) == set(BLENDSHAPES)
    left, right = part_of("left_eye"), part_of("right_eye")
    assert {mirrored_name(name) for name in left} == set(right)
    assert {mirrored_name(name) for name in part_of("mouth")} == set(part_of("mouth"))
    assert set(left) & set(right) == {"browInnerUp"}
    assert part_of("wide") == BLENDSHAPES


def test_the_second_of_two_partners_shares_the_firsts_encoder():
    assert encoder_owners(CAMERAS) == {"left_eye": None, "right_eye": "left_eye", "mouth": None}
    assert encoder_owners(("right_brow", "left_brow")) == {"right_brow": None, "left_brow": "right_brow"}
    assert encoder_owners(("right_eye", "mouth")) == {"right_eye": None, "mouth": None}
    assert is_symmetric(CAMERAS)
    assert not is_symmetric(("left_eye", "mouth"))
    assert mirror_partner("mouth_left") == "mouth_right"


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("left_eye", "right_eye"),
        ("eye_l", "eye_r"),
        ("lefteye", "righteye"),
        ("leye", "reye"),
        ("undereye_l", "undereye_r"),
        ("clip_left_eye", "clip_right_eye"),
    ],
)
def test_sides_are_known_in_every_usual_spelling(left: str, right: str):
    assert (side_of(left), side_of(right)) == ("left", "right")
    assert (mirror_partner(left), mirror_partner(right)) == (right, left)
    assert part_of(left) == part_of("left_eye")
    assert encoder_owners((left, right, "mouth")) == {left: None, right: left, "mouth": None}
    assert is_symmetric((left, right, "mouth"))
    assert without_side((left, right, "mouth")) == []


def test_an_eye_of_no_side_is_nobodys_mirror_image():
    cameras = ("eye_a", "eye_b", "mouth")
    assert without_side(cameras) == ["eye_a", "eye_b"]
    assert not is_symmetric(cameras), "half of its training would be faces that its cameras cannot see"
    assert set(part_of("eye_a")) == set(part_of("left_eye")) | set(part_of("right_eye"))
    assert without_side(("left_eye", "eyes", "brows", "mouth")) == []
    assert is_symmetric(("eyes", "mouth")), "one camera of both"
    assert part_of("upperlip") == part_of("lowerjaw") == part_of("mouth")
    assert side_of("relay") is None
    assert mirror_partner("relay") == "relay"
    assert is_symmetric(("wide", "mouth"))

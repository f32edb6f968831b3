"""Randomised pictures differ as real cameras' do: other light, other glints, saturated skin; plain ones do not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

torch = pytest.importorskip("torch")

from regress.learning.headset.training.photometry import (  # noqa: E402
    draw_blobs,
    draw_patches,
    draw_photometry,
    saturated,
    softened,
    without_dots,
)

SIZE = 48


def _eye(dot_px: int) -> torch.Tensor:
    """A picture (1, SIZE, SIZE) in [0, 1]: skin, a darker disc, and a bright square of ``dot_px`` pixels in it."""
    picture = torch.full((1, SIZE, SIZE), 0.4)
    picture[:, 14:34, 14:34] = 0.15
    picture[:, 22 : 22 + dot_px, 20 : 20 + dot_px] = 1.0
    return picture


@pytest.mark.parametrize("dot_px", [1, 2, 3, 4])
def test_small_dots_go_and_what_is_round_them_stays(dot_px: int):
    assert torch.equal(without_dots(_eye(dot_px)), _eye(0))


def test_what_is_larger_than_a_dot_stays():
    assert torch.equal(without_dots(_eye(6)), _eye(6))


@given(percent=st.floats(20, 99), seed=st.integers(0, 99))
def test_saturation_flattens_what_is_bright_and_keeps_order(percent: float, seed: int):
    picture = torch.from_numpy(np.random.default_rng(seed).random((1, SIZE, SIZE), dtype=np.float32))
    flat = saturated(picture, torch.tensor([percent], dtype=torch.float32))
    assert float(flat.max()) <= float(picture.max()) + 1e-6
    # the percentile is that of every third pixel and line: exact there, and within five deviations of such a sample
    cut = (flat == flat.max()).float()
    assert abs(float(cut[:, ::3, ::3].mean()) - (1 - percent / 100)) < 0.01
    assert abs(float(cut.mean()) - (1 - percent / 100)) < 0.15
    order = picture.flatten().argsort()
    assert (flat.flatten()[order].diff() >= 0).all()


def test_blobs_are_few_bounded_and_of_many_sizes():
    light = draw_blobs(np.random.default_rng(0), 400, SIZE)
    assert light.shape == (400, SIZE, SIZE)
    assert 0 <= float(light.min())
    assert float(light.max()) == 1
    covered = (light > 0.5).float().mean(dim=(1, 2)).numpy()
    assert covered.max() < 3 * np.pi * 0.06**2 * 2.2
    assert np.percentile(covered, 90) > 5 * np.percentile(covered, 10)


def test_patches_are_light_and_dark_alike_bounded_and_of_soft_and_sharp_edges():
    levels = torch.log(draw_patches(np.random.default_rng(0), 400, SIZE, 0.35)).numpy()
    assert levels.shape == (400, SIZE, SIZE)
    amount = np.abs(levels).max(axis=(1, 2))
    assert np.median(amount) > 0.1
    assert amount.max() < 5 * 0.35
    assert abs(np.median(levels)) < 0.02
    steepest = np.abs(np.diff(levels, axis=2)).max(axis=(1, 2)) / amount
    assert np.percentile(steepest, 90) > 2.5 * np.percentile(steepest, 10)


def test_patches_are_as_strong_as_asked():
    strong, weak = (
        torch.log(draw_patches(np.random.default_rng(3), 8, SIZE, deviation)) for deviation in (0.4, 0.1)
    )
    assert torch.allclose(weak, 0.25 * strong, atol=1e-5)


def test_patches_are_drawn_where_they_are_asked_for_and_change_nothing_else():
    seen = torch.full((6, 3, SIZE, SIZE), 90.0)
    before, none, some = (
        draw_photometry(np.random.default_rng(7), seen, seen, 1.0, np.arange(6) == 0, **asked)
        for asked in ({}, {"patches": 0.0}, {"patches": 0.4})
    )
    assert torch.equal(none[0], before[0])
    assert torch.equal(some[0][0], seen[0]), "a plain frame stays"
    assert not torch.equal(some[0][1:], none[0][1:])


def test_softening_keeps_flat_pictures_and_spreads_a_point():
    point = torch.zeros(1, SIZE, SIZE)
    point[0, 9, 9] = 9.0
    assert torch.allclose(softened(torch.ones(2, SIZE, SIZE)), torch.ones(2, SIZE, SIZE))
    assert torch.allclose(softened(point)[0, 8:11, 8:11], torch.ones(3, 3))


@pytest.mark.parametrize("seed", range(8))
def test_one_picture_may_be_chosen_for_nothing(seed: int):
    seen = torch.full((1, 1, SIZE, SIZE), 90.0)
    pictures, _ = draw_photometry(np.random.default_rng(seed), seen, seen, 0.3, np.zeros(1, bool))
    assert torch.isfinite(pictures).all()
    assert (pictures != seen).any()


def test_a_camera_treats_frame_and_neutral_alike_but_for_noise_and_blobs():
    random = np.random.default_rng(4)
    seen = torch.from_numpy(random.uniform(20, 200, (64, 2, SIZE, SIZE)).astype(np.float32))
    pictures, neutral = draw_photometry(random, seen, seen, 1.0, np.zeros(64, bool))
    assert (pictures != seen).flatten(1).any(dim=1).all()
    assert 0 <= float(pictures.min())
    assert float(pictures.max()) <= 255
    levels = [given.mean(dim=(2, 3)).flatten().numpy() for given in (pictures, neutral, seen)]
    assert np.corrcoef(levels[0], levels[1])[0, 1] > 0.95
    assert np.std(levels[0]) > 10 * np.std(levels[2])


def test_the_same_seed_gives_the_same_pictures():
    seen = torch.full((6, 3, SIZE, SIZE), 90.0)
    first, second = (
        draw_photometry(np.random.default_rng(7), seen, seen, 1.0, np.zeros(6, bool)) for _ in range(2)
    )
    assert torch.equal(first[0], second[0])
    assert torch.equal(first[1], second[1])
    other, _ = draw_photometry(np.random.default_rng(8), seen, seen, 1.0, np.zeros(6, bool))
    assert not torch.equal(first[0], other)

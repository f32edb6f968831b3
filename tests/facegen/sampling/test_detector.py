"""The detector's errors: what stays on a person, what comes and goes."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import BLOCK, DETECTOR_DISAGREEMENT, LANDMARK_GROUPS
from facegen.geometry import rotation_from_angles
from facegen.randomness import stream
from facegen.sampling import draw_samples, plan_dataset
from facegen.sampling.detector import (
    OUTER_EYES_FACE_WIDTHS,
    along_face,
    draw_bias,
    draw_detector_noise,
    draw_dropped,
)
from facegen.spec import Landmarks, parse_spec

UPRIGHT = np.tile(np.eye(3), (BLOCK, 1, 1))


def test_by_default_only_jitter_is_drawn_as_it_always_was():
    noise = draw_detector_noise(Landmarks(), 7, 3, person=np.arange(BLOCK), rotation=UPRIGHT)
    np.testing.assert_array_equal(noise, stream(7, "detector", 3).standard_normal((BLOCK, 68, 2)) * 0.001)


def test_bias_stays_on_a_person_and_differs_between_people():
    person = np.arange(BLOCK) // 100 + 995  # across two blocks of people
    of = Landmarks(noise_face_widths=0.0, bias=1.0)
    first, second = (draw_detector_noise(of, 7, block, person=person, rotation=UPRIGHT) for block in (3, 4))
    np.testing.assert_array_equal(first, second)
    assert (first[:100] == first[0]).all()
    assert np.abs(first[0] - first[100]).max() > 0.005


def test_bias_is_as_large_as_two_detectors_disagree_and_moves_parts_as_a_whole():
    bias = draw_bias(np.random.Generator(np.random.PCG64(1)), 4000)
    for group, numbers in LANDMARK_GROUPS.items():
        part = bias[:, list(numbers)]
        rms = np.sqrt((part**2).sum(axis=-1).mean())
        assert rms == pytest.approx(DETECTOR_DISAGREEMENT[group] * OUTER_EYES_FACE_WIDTHS, rel=0.05), group
        # neighbours err together: half of the variance is the part's
        assert np.corrcoef(part[:, 0, 0], part[:, 1, 0])[0, 1] > 0.4, group


def test_bias_turns_with_the_face():
    offsets = np.zeros((1, 68, 2))
    offsets[..., 0] = 1.0  # towards the subject's left, which is right in the picture
    np.testing.assert_allclose(along_face(offsets, np.eye(3)[None])[0, 0], [1, 0], atol=1e-12)
    tilted = rotation_from_angles(0.0, 0.0, np.radians(30.0))[None]  # towards the left shoulder: downwards
    np.testing.assert_allclose(along_face(offsets, tilted)[0, 0], [np.sqrt(0.75), 0.5], atol=1e-12)


def test_outliers_take_whole_parts_at_their_share():
    of = Landmarks(noise_face_widths=0.0, outliers=0.1)
    noise = draw_detector_noise(of, 7, 0, person=np.arange(BLOCK), rotation=UPRIGHT)
    jaw = noise[:, :17]
    assert (jaw == jaw[:, :1]).all()
    assert 0.07 < (jaw[:, 0, 0] != 0).mean() < 0.13
    assert 0.03 < jaw[jaw != 0].std() < 0.07


@given(share=st.floats(0.001, 0.5), run=st.floats(1, 20), size=st.integers(1, 500), seed=st.integers(0, 99))
def test_dropped_frames_are_drawn_for_any_share(share, run, size, seed):
    assert draw_dropped(np.random.Generator(np.random.PCG64(seed)), size, share=share, run=run).shape == (
        size,
    )


def test_a_small_share_takes_no_memory_of_its_own():
    tracemalloc.start()
    dropped = draw_dropped(np.random.Generator(np.random.PCG64(1)), BLOCK, share=1e-6, run=6.0)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert not dropped.any()
    assert most < 16e6  # it was 6 GB


@pytest.mark.parametrize("share", [0.1, 0.5])
def test_frames_are_dropped_in_runs_at_their_share(share):
    dropped = draw_dropped(np.random.Generator(np.random.PCG64(1)), 200_000, share=share, run=6.0)
    assert dropped.mean() == pytest.approx(share, rel=0.1)
    runs = np.flatnonzero(np.diff(dropped.astype(int)) == 1).size
    assert dropped.sum() / runs == pytest.approx(6.0, rel=0.1)
    assert not draw_dropped(np.random.Generator(np.random.PCG64(1)), 100, share=0.0, run=6.0).any()


@pytest.mark.parametrize("kind", ["still", "sequence"])
def test_dropped_frames_have_no_detected_points(anny, kind):
    table = {"version": 1, "kind": kind, "seed": 7, "people": 30, "landmarks": {"dropped": 0.2}}
    samples = draw_samples(plan_dataset(parse_spec(table, where="test")), anny, 0)
    lost = np.isnan(samples.detector_noise)
    assert (lost.all(axis=(1, 2)) == lost.any(axis=(1, 2))).all()
    assert 0.1 < lost[:, 0, 0].mean() < 0.3


def test_stills_are_dropped_each_by_itself(anny):
    table = {"version": 1, "kind": "still", "seed": 7, "people": 400, "landmarks": {"dropped": 0.3}}
    plan = plan_dataset(parse_spec(table, where="test"))
    lost = [np.isnan(draw_samples(plan, anny, block).detector_noise[:, 0, 0]) for block in range(4)]
    dropped = np.concatenate(lost)
    assert dropped.mean() == pytest.approx(0.3, abs=0.03)
    assert (dropped[1:] & dropped[:-1]).mean() == pytest.approx(0.09, abs=0.02)


def test_offsets_follow_the_face_s_roll():
    """Upright, across and down stay so; a head that leans to its left takes them along, as a picture has them."""
    offsets = np.zeros((1, 68, 2))
    offsets[0, 0], offsets[0, 1] = [1, 0], [0, 1]
    np.testing.assert_allclose(along_face(offsets, np.eye(3)[None])[0, :2], [[1, 0], [0, 1]])
    turned = along_face(offsets, np.array([[[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]]))[0, :2]
    np.testing.assert_allclose(turned, [[0, -1], [1, 0]], atol=1e-12)

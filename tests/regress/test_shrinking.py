"""Movements that a detector shows smaller than they are: shorter by its share, whichever way the head is turned."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import LANDMARK_COUNT
from regress.learning.training.noise import DetectorNoise
from regress.learning.training.preparation import Faces, draw_detected
from regress.learning.training.shrinking import REGIONS, shrink
from regress.runtime.features import load_reference_shape

LIPS = list(REGIONS[-1])
DEGREES = st.floats(-25, 25)


def seen(points: np.ndarray, yaw_deg: float, pitch_deg: float, size: float = 1.0) -> np.ndarray:
    """Points (68, 2) of a head (68, 3), turned, from far away."""
    (a, b), (c, d) = np.cos(np.radians([yaw_deg, pitch_deg])), np.sin(np.radians([yaw_deg, pitch_deg]))
    turn = np.array([[a, 0, c], [0, 1, 0], [-c, 0, a]]) @ np.array([[1, 0, 0], [0, b, -d], [0, d, b]])
    return size * (points @ turn.T)[:, :2]


@settings(max_examples=50, deadline=None)
@given(yaw_deg=DEGREES, pitch_deg=DEGREES, size=st.floats(0.5, 300), share=st.floats(0.2, 1))
def test_a_turned_heads_lips_go_a_share_of_their_way(yaw_deg, pitch_deg, size, share):
    head = load_reference_shape().points
    width = np.ptp(head[:, 0])
    moved = head.copy()
    moved[LIPS] += 0.1 * width * np.random.default_rng(0).standard_normal((len(LIPS), 3))
    rest, there = (seen(each, yaw_deg, pitch_deg, size) for each in (head, moved))
    gains = np.ones((1, LANDMARK_COUNT, 1))
    gains[:, LIPS] = share
    found = shrink(there[None], seen(head, 0, 0)[None], gains)[0]
    np.testing.assert_allclose(found, rest + share * (there - rest), atol=1e-6 * width * size)


def test_each_region_of_a_training_face_has_one_share_and_neutral_faces_stay():
    head = load_reference_shape().points[:, :2]
    away = np.zeros_like(head)
    for region in REGIONS:
        away[list(region)] = [0.03, -0.02]
    away[[0, 1, 2, 14, 15, 16, 36, 39, 42, 45]] = 0  # where the head is laid by
    faces = Faces(
        points=np.repeat([head + away], 300, axis=0),
        neutral=np.repeat([head], 300, axis=0),
        weights=np.zeros((300, 52)),
    )
    rng = np.random.default_rng(1)
    found = draw_detected(faces, DetectorNoise(bias=0, drift=0, jitter=0, clean=0, movement=0.5), rng)
    np.testing.assert_array_equal(found.neutral, faces.neutral)
    for region in REGIONS:
        numbers = [number for number in region if away[number].any()]
        shares = (found.points - head)[:, numbers] / away[numbers]
        np.testing.assert_allclose(shares, shares[:, :1, :1] * np.ones_like(shares), atol=1e-9)
        assert shares.min() == pytest.approx(0.5, abs=0.02)
        assert shares.max() == pytest.approx(1, abs=0.02)
    whole = draw_detected(faces, DetectorNoise(bias=0, drift=0, jitter=0, clean=0), rng)
    np.testing.assert_array_equal(whole.points, faces.points)

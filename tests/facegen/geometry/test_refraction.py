"""Where light leaves a ball, against Snell's law."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.geometry import refract_through_sphere

RADIUS = 7.8e-3
direction = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array).filter(lambda v: np.linalg.norm(v) > 1e-3)
index = st.floats(1.0, 1.6)


def _unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


@given(direction, direction, st.floats(0.0, 0.99), st.floats(1.05, 20.0), direction, index)
def test_light_leaves_by_snells_law_towards_the_observer(point, observer, depth, distance, center, index):
    # within the aplanatic sphere every point is seen from everywhere; on the surface light has no direction inside
    point, observer = (
        center + _unit(point) * depth * RADIUS / index,
        center + _unit(observer) * distance * RADIUS,
    )
    place = refract_through_sphere(center, RADIUS, index, point, observer)
    normal = (place - center) / RADIUS
    assert np.linalg.norm(normal) == pytest.approx(1.0, abs=1e-9)
    inside, outside = _unit(place - point), _unit(observer - place)
    assert outside @ normal > -1e-6
    assert np.abs(np.cross(outside, normal) - index * np.cross(inside, normal)).max() < 1e-7


def test_a_ball_of_airs_index_leaves_rays_straight():
    rng = np.random.default_rng(1)
    point, observer = 3e-3 * _unit(rng.normal(size=(50, 3))), 0.04 * _unit(rng.normal(size=(50, 3)))
    place = refract_through_sphere(np.zeros(3), RADIUS, 1.0, point, observer)
    assert np.abs(np.cross(_unit(place - point), _unit(observer - point))).max() < 1e-12


def test_total_reflection_hides_what_lies_far_out():
    observer = np.array([0.0, 0.0, 0.04])
    angle = np.radians([30.0, 100.0])
    points = 0.95 * RADIUS * np.stack([np.sin(angle), 0.0 * angle, np.cos(angle)], axis=-1)
    place = refract_through_sphere(np.zeros(3), RADIUS, 1.336, points, observer)
    assert np.isnan(place).any(axis=-1).tolist() == [False, True]

"""Ellipses come back from their own points, and near them from disturbed ones."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from facegen.geometry import fit_ellipse

pixel = st.floats(-2000.0, 2000.0)


def _points(center, semi_axes, angle, count=32):
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    axes = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return center + np.stack([semi_axes[0] * np.cos(turn), semi_axes[1] * np.sin(turn)], axis=-1) @ axes


@given(pixel, pixel, st.floats(1.0, 300.0), st.floats(0.1, 0.99), st.floats(-np.pi / 2, np.pi / 2))
def test_an_ellipse_is_found_in_its_points(x, y, long, ratio, angle):
    found = fit_ellipse(_points((x, y), (long, ratio * long), angle))
    np.testing.assert_allclose(found.center, (x, y), atol=1e-6)
    np.testing.assert_allclose(found.semi_axes, (long, ratio * long), rtol=1e-7)
    assert abs((found.angle - angle + np.pi / 2) % np.pi - np.pi / 2) < 1e-6
    assert -np.pi / 2 < found.angle <= np.pi / 2


def test_noise_moves_it_by_as_much():
    rng = np.random.default_rng(4)
    points = _points((320.0, 240.0), (60.0, 35.0), 0.7, count=200)
    found = fit_ellipse(points + rng.normal(scale=0.2, size=points.shape))
    np.testing.assert_allclose(found.center, (320.0, 240.0), atol=0.1)
    np.testing.assert_allclose(found.semi_axes, (60.0, 35.0), atol=0.1)


def test_a_point_without_a_pixel_leaves_no_ellipse():
    points = _points((10.0, 20.0), (6.0, 3.0), 0.2)
    points[5] = np.nan
    found = fit_ellipse(points)
    assert np.isnan([*found.center, *found.semi_axes, found.angle]).all()

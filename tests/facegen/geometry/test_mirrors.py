"""Mirror points on spheres against the law of reflection, Fermat's principle, and traced pencils of rays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize

from facegen.geometry import reflect_in_sphere

coordinate = st.floats(-0.05, 0.05)
point = st.tuples(coordinate, coordinate, coordinate).map(np.array)
outside = point.filter(lambda p: np.linalg.norm(p) > 0.009)


def _unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


@given(outside, outside, st.floats(0.002, 0.0085), point)
def test_rays_leave_as_they_arrive(source, observer, radius, center):
    image = reflect_in_sphere(center, radius, source + center, observer + center)
    horizons = np.arccos(radius / np.linalg.norm(source)) + np.arccos(radius / np.linalg.norm(observer))
    between = np.arctan2(np.linalg.norm(np.cross(source, observer)), source @ observer)
    if between > horizons + 1e-9:  # no point of the sphere sees both
        assert np.isnan(image.point).all()
    if between > horizons - 1e-6:
        return
    normal = (image.point - center) / radius
    assert np.linalg.norm(normal) == pytest.approx(1.0, abs=1e-12)
    arriving, leaving = _unit(source + center - image.point), _unit(observer + center - image.point)
    assert arriving @ normal > 0
    # equal angles, in one plane: what both share is along the normal
    assert np.abs(arriving @ normal - leaving @ normal) < 1e-9
    assert np.abs(np.cross(arriving + leaving, normal)).max() < 1e-9
    assert image.cosine == pytest.approx(leaving @ normal, abs=1e-9)


def test_path_is_the_shortest_of_all_over_the_sphere():
    rng = np.random.default_rng(3)
    radius = 7.8e-3
    source, observer = (rng.normal(size=(20, 3)) * 0.01 + [0.0, 0.0, 0.04] for _ in range(2))
    image = reflect_in_sphere(np.zeros(3), radius, source, observer)
    for i in range(20):

        def on_sphere(angles):
            theta, phi = angles
            return radius * np.array([np.sin(theta) * np.cos(phi), np.sin(phi), np.cos(theta) * np.cos(phi)])

        def path(angles, i=i):
            p = on_sphere(angles)
            return 1e3 * (np.linalg.norm(p - source[i]) + np.linalg.norm(p - observer[i]))

        best = minimize(path, [0.0, 0.0], method="Nelder-Mead", options=dict(xatol=1e-9, fatol=1e-14))
        assert np.linalg.norm(on_sphere(best.x) - image.point[i]) < 2e-8


def test_brightness_and_size_are_those_of_a_traced_pencil():
    center, radius = np.array([0.001, 0.002, 0.0]), 7.8e-3
    source, observer = np.array([0.022, 0.013, 0.031]), np.array([-0.011, -0.016, 0.045])
    image = reflect_in_sphere(center, radius, source, observer)
    away = _unit(image.point - source)
    aside = _unit(np.cross(away, [0.0, 1.0, 0.0]))
    step = 1e-5

    def at_observer(offset):
        """Where a ray that leaves the source a little aside crosses the plane at the observer."""
        ray = _unit(away + offset)
        b = ray @ (source - center)
        foot = source + (-b - np.sqrt(b * b - np.sum((source - center) ** 2) + radius**2)) * ray
        normal = (foot - center) / radius
        out = ray - 2.0 * (ray @ normal) * normal
        plane = _unit(observer - image.point)
        return foot + out * ((observer - foot) @ plane) / (out @ plane)

    first, second = (
        (at_observer(step * d) - at_observer(-step * d)) / (2.0 * step)
        for d in (aside, np.cross(away, aside))
    )
    area_per_sr = np.linalg.norm(np.cross(first, second))
    assert image.gain == pytest.approx(1.0 / area_per_sr, rel=1e-4)
    assert image.shrinking == pytest.approx(np.sqrt(image.gain), rel=1e-12)
    # a distant, nearly flat mirror shows the source at its own distance
    flat = reflect_in_sphere(
        np.array([0.0, 0.0, -1e4]), 1e4, np.array([0.1, 0.0, 2.0]), np.array([0.0, 0.0, 3.0])
    )
    assert flat.shrinking == pytest.approx(1.0 / 5.0, rel=2e-3)

"""Points that a headset view shows, from a view's labels."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import IRIS_POINTS, LID_POINTS, MIRRORED_VIEW_POINTS, VIEW_POINTS, Visibility
from facegen.packing.view_points import view_points

LEFT_EYE = range(42, 48)
IRIS = [f"left_iris_{place}" for place in range(IRIS_POINTS)]


def an_ellipse(x=40.0, y=48.0, long=6.0, short=4.0, angle_rad=0.3) -> dict:
    return {"center": [x, y], "semi_axes": [long, short], "angle_rad": angle_rad}


def a_view(**changes) -> dict:
    """An open left eye, 40 pixels wide and 16 high, before its camera; the right eye is out of sight."""
    visibility = np.full(68, Visibility.OUTSIDE)
    visibility[list(LEFT_EYE)] = Visibility.VISIBLE
    across = np.linspace(20, 60, 9)
    arch = 8 * np.sin(np.linspace(0, np.pi, 9))
    lids = {
        "upper": np.stack([across, 48 - arch], 1).tolist(),
        "lower": np.stack([across, 48 + arch], 1).tolist(),
    }
    view = {
        "visibility": visibility.tolist(),
        "points_2d": np.random.default_rng(0).uniform(20, 60, (68, 2)).tolist(),
        **{f"{lid}_lid_2d": {"left": line, "right": line} for lid, line in lids.items()},
        "pupil_center_refracted_2d": {"left": [41.0, 47.0], "right": [None, None]},
        "iris_ellipse": {"left": an_ellipse(), "right": an_ellipse(None, None, None, None, None)},
    }
    return view | changes


def shown(view: dict) -> dict[str, np.ndarray]:
    points = view_points(view)
    assert points.shape == (len(VIEW_POINTS), 2)
    assert points.dtype == np.float32
    return {name: point for name, point in zip(VIEW_POINTS, points, strict=True) if np.isfinite(point).all()}


def test_what_the_picture_shows_is_there_and_nothing_else():
    view = a_view()
    found = shown(view)
    lids = [f"left_{lid}_lid_{place}" for lid in ("upper", "lower") for place in range(LID_POINTS)]
    assert set(found) == {*(f"landmark_{index}" for index in LEFT_EYE), *lids, "left_pupil", *IRIS}
    np.testing.assert_allclose(found["landmark_43"], view["points_2d"][43], rtol=1e-6)
    np.testing.assert_allclose(found["left_pupil"], [41, 47])


@pytest.mark.parametrize(("visible", "there"), [(3, True), (2, False)])
def test_lids_count_where_half_of_the_eyes_landmarks_are_seen(visible: int, there: bool):
    visibility = np.full(68, Visibility.HIDDEN)
    visibility[list(LEFT_EYE)[:visible]] = Visibility.VISIBLE
    found = shown(a_view(visibility=visibility.tolist()))
    assert ("left_upper_lid_0" in found) is there
    assert ("left_pupil" in found) is there


def test_a_pupil_behind_a_lid_is_not_shown():
    found = shown(a_view(pupil_center_refracted_2d={"left": [41.0, 38.0], "right": [None, None]}))
    assert "left_pupil" not in found
    assert set(IRIS) <= set(found)
    ellipses = {"left": an_ellipse(y=38.0), "right": an_ellipse(None, None, None, None, None)}
    assert not set(IRIS) & set(shown(a_view(iris_ellipse=ellipses)))


@given(long=st.floats(3, 9), flat=st.floats(0.2, 1), angle_rad=st.floats(-1.5, 1.5))
def test_an_iris_is_told_by_the_points_farthest_in_every_direction(
    long: float, flat: float, angle_rad: float
):
    ellipse = an_ellipse(long=long, short=flat * long, angle_rad=angle_rad)
    found = shown(a_view(iris_ellipse={"left": ellipse, "right": an_ellipse(*[None] * 5)}))
    way = np.linspace(0, 2 * np.pi, 4001)
    axis = np.array([np.cos(angle_rad), np.sin(angle_rad)])
    outline = np.cos(way)[:, None] * long * axis + np.sin(way)[:, None] * flat * long * [-axis[1], axis[0]]
    for place, name in enumerate(IRIS):
        direction = 2 * np.pi * place / IRIS_POINTS
        farthest = outline[(outline @ [np.cos(direction), np.sin(direction)]).argmax()]
        np.testing.assert_allclose(found[name], farthest + ellipse["center"], atol=0.02)


@given(count=st.integers(2, 30), seed=st.integers(0, 99))
def test_points_of_a_lid_are_equally_far_apart_and_end_at_the_canthi(count: int, seed: int):
    random = np.random.default_rng(seed)
    line = np.stack([np.sort(random.uniform(20, 60, count)), np.full(count, 40.0)], axis=1)
    view = a_view()
    view["upper_lid_2d"]["left"] = line.tolist()
    found = shown(view)
    points = np.array([found[f"left_upper_lid_{place}"] for place in range(LID_POINTS)])
    np.testing.assert_allclose(points[[0, -1]], line[[0, -1]], rtol=1e-5)
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    np.testing.assert_allclose(steps, steps.mean(), atol=1e-3)


def test_mirroring_twice_is_nothing_and_sides_change():
    mirrored = np.array(MIRRORED_VIEW_POINTS)
    assert sorted(mirrored) == list(range(len(VIEW_POINTS)))
    np.testing.assert_array_equal(mirrored[mirrored], np.arange(len(VIEW_POINTS)))
    other_side = {"left": "right", "right": "left"}
    for name, other in zip(VIEW_POINTS[68:], mirrored[68:], strict=True):
        side, part = name.split("_", 1)
        if not part.startswith("iris"):
            assert VIEW_POINTS[other] == f"{other_side[side]}_{part}"


@given(angle_rad=st.floats(-1.5, 1.5))
def test_an_iris_outline_is_mirrored_with_its_picture(angle_rad: float):
    ellipse = an_ellipse(angle_rad=angle_rad)
    flipped = an_ellipse(x=-40.0, angle_rad=-angle_rad)
    one = a_view(iris_ellipse={"left": ellipse, "right": an_ellipse(*[None] * 5)})
    other = a_view(iris_ellipse={"left": an_ellipse(*[None] * 5), "right": flipped})
    for lid in ("upper", "lower"):
        left = np.array(one[f"{lid}_lid_2d"]["left"])
        other[f"{lid}_lid_2d"]["right"] = (left * (-1, 1)).tolist()
    visibility = np.full(68, Visibility.HIDDEN)
    visibility[36:42] = Visibility.VISIBLE
    other["visibility"] = visibility.tolist()
    found, mirrored = view_points(one), view_points(other)[list(MIRRORED_VIEW_POINTS)] * (-1, 1)
    columns = [VIEW_POINTS.index(name) for name in IRIS]
    np.testing.assert_allclose(mirrored[columns], found[columns], atol=1e-4)

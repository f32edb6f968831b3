"""Picks the points of `VIEW_POINTS` that a headset view shows, from its labels."""

import cv2
import numpy as np

from facegen.conventions import IRIS_POINTS, LANDMARK_GROUPS, LID_POINTS, SIDES, Visibility

LEAST_LANDMARKS = 3
"""Of an eye's six landmarks, how many must be visible for its lids to count as shown."""


def view_points(view: dict) -> np.ndarray:
    """(P, 2) float32 pixels of ``VIEW_POINTS``, NaN where the picture does not show the point.

    Landmarks say themselves whether they are visible. The margins of an eye's lids count where at least
    `LEAST_LANDMARKS` of its landmarks do, so not through the housing; the pupil's centre where it lies between the
    lids as well, and the whole outline of the iris where its centre does. Lids and irises may reach beyond the picture.

    Parameters
    ----------
    view
        One of ``views`` of ``sample.json``.
    """
    visible = np.array(view["visibility"]) == Visibility.VISIBLE
    points = [np.where(visible[:, None], _numbers(view["points_2d"]), np.nan)]
    for side in SIDES:
        upper, lower = (_numbers(view[f"{lid}_lid_2d"][side]) for lid in ("upper", "lower"))
        opening = np.concatenate([upper, lower[::-1]]).astype(np.float32)
        pupil, iris = _numbers(view["pupil_center_refracted_2d"][side]), view["iris_ellipse"][side]
        eye = [
            _along(upper),
            _along(lower),
            np.where(_between(opening, pupil), pupil[None], np.nan),
            np.where(_between(opening, _numbers(iris["center"])), _outline(iris), np.nan),
        ]
        shown = visible[list(LANDMARK_GROUPS[f"{side}_eye"])].sum() >= LEAST_LANDMARKS
        points += [np.where(shown, part, np.nan) for part in eye]
    return np.concatenate(points).astype(np.float32)


def _numbers(values: object) -> np.ndarray:
    """Floats of nested lists in which None stands for NaN."""
    return np.array(values, dtype=np.float64)


def _between(opening: np.ndarray, point: np.ndarray) -> bool:
    return cv2.pointPolygonTest(opening, point.tolist(), measureDist=False) > 0


def _outline(ellipse: dict) -> np.ndarray:
    """Points (``IRIS_POINTS``, 2) of an ellipse that lie farthest in evenly spread directions.

    Those stay put where the ellipse is nearly a circle, whose axes do not.
    """
    long, short = _numbers(ellipse["semi_axes"])
    axis = _numbers(ellipse["angle_rad"])
    turn = np.array([[np.cos(axis), -np.sin(axis)], [np.sin(axis), np.cos(axis)]])
    spread = turn @ np.diag([long**2, short**2]) @ turn.T
    angles = 2 * np.pi * np.arange(IRIS_POINTS) / IRIS_POINTS
    towards = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    reach = towards @ spread
    return _numbers(ellipse["center"]) + reach / np.sqrt((reach * towards).sum(axis=-1, keepdims=True))


def _along(line: np.ndarray) -> np.ndarray:
    """``LID_POINTS`` points (n, 2) along a line (m, 2), equally far apart."""
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    distances = np.linspace(0.0, way[-1], LID_POINTS)
    return np.stack([np.interp(distances, way, column) for column in line.T], axis=-1)

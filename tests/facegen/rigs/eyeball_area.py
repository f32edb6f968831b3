"""Measures on the mesh how well lids cover the eye: eyeball area seen between, and outside, their margins."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import Part
from facegen.geometry import rotation_from_angles
from facegen.raster import faces_of_triangles, nearest_along_z, triangles_of
from facegen.rigs.evaluation import EvaluatedFaces
from facegen.rigs.eyes import CORNEA_RADIUS_M, GLOBE_AHEAD_M, cornea_center_offset
from facegen.rigs.lid_margins import lid_margins
from facegen.rigs.rig import Rig

STEP_M = 0.1e-3
"""Samples lie this far apart: one is 0.01 mm2."""
_HALF_WIDTH_M, _HALF_HEIGHT_M = 18e-3, 12e-3


@dataclass(frozen=True, kw_only=True, eq=False)
class EyeballSeen:
    """``area_mm2`` (2,) of eyeball seen, ``outside_mm2`` (2,) the part of it outside the lid margins."""

    area_mm2: np.ndarray
    outside_mm2: np.ndarray


def eyeball_seen(
    rig: Rig,
    faces: EvaluatedFaces,
    index: int,
    gaze: np.ndarray,
    *,
    yaw_deg: float = 0.0,
    pitch_deg: float = 0.0,
) -> EyeballSeen:
    """Area of each eye that one evaluated face (with all its vertices) shows to a distant camera.

    The eye is exact: each sample's line of sight is cut with the scleral sphere and the cornea's cap. Lashes
    are left out, they are not opaque.

    Parameters
    ----------
    gaze
        (2, 3) optical axes in the head frame.
    yaw_deg, pitch_deg
        Where the camera stands: towards the subject's left, and above.
    """
    turn = rotation_from_angles(np.radians(yaw_deg), np.radians(pitch_deg), 0.0)
    vertices = faces.vertices[index] @ turn
    triangles = triangles_of(rig.faces)[rig.part[faces_of_triangles(rig.faces)] != Part.LASHES]
    area, outside = np.zeros(2), np.zeros(2)
    for eye in range(2):
        centre = faces.eye_center[index, eye] @ turn
        origin = centre[:2] + np.array([-_HALF_WIDTH_M, _HALF_HEIGHT_M])
        shape = (round(2 * _HALF_HEIGHT_M / STEP_M), round(2 * _HALF_WIDTH_M / STEP_M))
        depth = nearest_along_z(vertices, triangles, origin=origin, step=STEP_M, shape=shape)
        surface = _eye_depth(faces.eye_radius[index, eye], gaze[eye] @ turn, shape) + centre[2]
        seen = surface > depth.value
        area[eye] = seen.sum() * (1e3 * STEP_M) ** 2
        upper, lower = lid_margins(rig, eye)
        margin = np.concatenate([upper, lower[-2:0:-1]])
        rows, columns = np.nonzero(seen)
        points = origin + STEP_M * np.stack([columns, -rows], axis=-1)
        outside[eye] = (~_in_polygon(points, vertices[margin, :2])).sum() * (1e3 * STEP_M) ** 2
    return EyeballSeen(area_mm2=area, outside_mm2=outside)


def _eye_depth(radius: float, axis: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """z of the eye's front over the eyeball's centre, -inf beside it: the nearer of its two balls."""
    x = -_HALF_WIDTH_M + STEP_M * np.arange(shape[1])
    y = _HALF_HEIGHT_M - STEP_M * np.arange(shape[0])[:, None]

    def ball(centre: np.ndarray, ball_radius: float) -> np.ndarray:
        square = ball_radius**2 - (x - centre[0]) ** 2 - (y - centre[1]) ** 2
        return np.where(square > 0.0, centre[2] + np.sqrt(np.maximum(square, 0.0)), -np.inf)

    return np.maximum(
        ball(GLOBE_AHEAD_M * axis, radius), ball(cornea_center_offset(radius) * axis, CORNEA_RADIUS_M)
    )


def _in_polygon(points: np.ndarray, polygon: np.ndarray) -> np.ndarray:
    """Whether points (n, 2) lie inside a polygon (m, 2): the even-odd rule."""
    inside = np.zeros(len(points), bool)
    x, y = points.T
    for (x0, y0), (x1, y1) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if y0 != y1:
            inside ^= ((y0 > y) != (y1 > y)) & (x < x0 + (y - y0) / (y1 - y0) * (x1 - x0))
    return inside

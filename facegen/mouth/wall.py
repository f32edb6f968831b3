"""The wall of lips and skin round the arches: how far out teeth and gums may reach.

A rig's lips know nothing of bones below them. They are drawn here, as seen from an upright axis inside the mouth, into
a map of distances over angle and height, and what reaches through is drawn back behind them. The inner side of lips and
cheeks is no wall: what stands in their flesh is not seen, and there is no gap between gum and lip.
"""

from functools import lru_cache

import numpy as np

from facegen.conventions import Part
from facegen.raster import nearest_triangles, triangles_of
from facegen.rigs import Rig

ANGLES, ANGLE_STEP = 97, np.radians(2.0)
"""Of the map, from -96 to 96 degrees about straight ahead."""
HEIGHT_STEP_M = 1e-3
"""Of the map."""
THROUGH_M = 15e-3
"""What is further out than this stands outside the mouth, and stays."""


@lru_cache(maxsize=8)
def wall_faces(rig: Rig) -> np.ndarray:
    """Triangles (t, 3) of the lips and of the skin around the mouth."""
    points = np.einsum("ln,lnc->lc", rig.landmark_weights, rig.vertices[rig.landmark_vertices])[48:]
    middle, reach = points.mean(axis=0), np.ptp(points[:, 0])
    faces = rig.faces[np.isin(rig.part, (Part.SKIN, Part.LIPS))]
    corners = rig.vertices[np.where(faces >= 0, faces, faces[:, :1])]
    centre = corners.mean(axis=1)
    near = np.linalg.norm((centre - middle) / (1.1, 1.0, 1.4), axis=-1) < reach
    return triangles_of(faces[near])


class Wall:
    """The wall of one face: ``vertices`` (V, 3), ``triangles`` (t, 3), head frame, seen from the y axis of ``frame``.

    ``frame`` (4, 4) leads to the head frame; z is straight ahead.
    """

    def __init__(self, vertices: np.ndarray, triangles: np.ndarray, frame: np.ndarray) -> None:
        self._frame = frame
        used, renumbered = np.unique(triangles, return_inverse=True)
        angle, height, distance = self._cylinder(vertices[used])
        self._low = float(height.min())
        rows = int((height.max() - self._low) / HEIGHT_STEP_M) + 2
        corners = renumbered.reshape(triangles.shape)
        spread = angle[corners]
        front = (np.ptp(spread, axis=1) < 1.0) & (np.abs(spread).max(axis=1) < 2.0)
        pixels = np.stack([angle / ANGLE_STEP + ANGLES // 2, (height - self._low) / HEIGHT_STEP_M], axis=-1)
        nearest = nearest_triangles(pixels, -distance, corners[front], shape=(rows, ANGLES))
        self.distance = _least_around(-nearest.value)

    def draw_back(self, points: np.ndarray, *, gap_m: float) -> np.ndarray:
        """By how much each point (n, 3) must near the axis to lie ``gap_m`` inside of the wall, (n,) metres."""
        angle, height, distance = self._cylinder(points)
        column = np.clip(np.rint(angle / ANGLE_STEP + ANGLES // 2), 0, ANGLES - 1).astype(int)
        row = np.rint((height - self._low) / HEIGHT_STEP_M).astype(int)
        inside = (row >= 0) & (row < len(self.distance)) & (np.abs(angle) < ANGLES // 2 * ANGLE_STEP)
        wall = np.where(inside, self.distance[np.clip(row, 0, len(self.distance) - 1), column], np.inf)
        through = distance - (wall - gap_m)
        return np.where((through > 0.0) & (through < THROUGH_M), through, 0.0)

    def drawn(self, points: np.ndarray, back_m: np.ndarray) -> np.ndarray:
        """Points (n, 3) moved towards the axis by ``back_m`` (n,)."""
        local = (points - self._frame[:3, 3]) @ self._frame[:3, :3]
        distance = np.hypot(local[:, 0], local[:, 2])
        keep = np.where(distance > 0.0, 1.0 - back_m / np.maximum(distance, 1e-9), 1.0)[:, None]
        return (local * np.concatenate([keep, np.ones_like(keep), keep], axis=1)) @ self._frame[
            :3, :3
        ].T + self._frame[:3, 3]

    def _cylinder(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        local = (points - self._frame[:3, 3]) @ self._frame[:3, :3]
        return np.arctan2(local[:, 0], local[:, 2]), local[:, 1], np.hypot(local[:, 0], local[:, 2])


def _least_around(values: np.ndarray) -> np.ndarray:
    """The least of each cell and its eight neighbours."""
    padded = np.pad(values, 1, constant_values=np.inf)
    rows, columns = values.shape
    return np.min([padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)], axis=0)

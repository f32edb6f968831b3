"""The skull under the hair, as distances from its middle, and directions from there."""

import cv2
import numpy as np
from scipy import ndimage

from facegen.raster import nearest_triangles

SKULL_M = np.array([0.0, 0.018, -0.085])
"""Middle of the skull in the head frame, for adults: directions of the hair start here."""


def skull_distance(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Distance (181, 361) of the head's innermost skin from `SKULL_M` by elevation and azimuth, degree by degree.

    The innermost, because ears stand off the skull; smoothed, because their folds remain.
    """
    away = vertices - SKULL_M
    distance = np.linalg.norm(away, axis=1)
    azimuth = np.degrees(np.arctan2(away[:, 0], away[:, 2]))
    elevation = np.degrees(np.arcsin(away[:, 1] / distance))
    corners = azimuth[triangles]
    whole = np.ptp(corners, axis=1) < 120.0
    rounds = []
    for shift in (-360.0, 0.0, 360.0):
        # those across the back are drawn at either border
        unrolled = np.where(~whole[:, None] & (corners < 0.0), corners + 360.0, corners) + shift
        places = np.stack([unrolled + 180.0, elevation[triangles] + 90.0], axis=-1).reshape(-1, 2)
        drawn = nearest_triangles(
            places,
            -distance[triangles].reshape(-1),
            np.arange(triangles.size).reshape(-1, 3),
            shape=(181, 361),
        )
        rounds.append(drawn.value)
    value = -np.max(rounds, axis=0)
    empty = ~np.isfinite(value)
    nearest = ndimage.distance_transform_edt(empty, return_distances=False, return_indices=True)
    value = value[tuple(nearest)]
    value = ndimage.median_filter(value, 9, mode="nearest")
    return cv2.GaussianBlur(np.pad(value, ((0, 0), (30, 30)), mode="wrap"), (0, 0), 4.0)[:, 30:-30]


def distance_at(skull: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Distances (...) that `skull_distance` gave, along unit vectors (..., 3)."""
    azimuth = np.degrees(np.arctan2(direction[..., 0], direction[..., 2])) + 180.0
    elevation = np.degrees(np.arcsin(np.clip(direction[..., 1], -1.0, 1.0))) + 90.0
    return ndimage.map_coordinates(skull, [elevation, azimuth], order=1, mode="nearest")


def direction_of(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    """Unit vectors (..., 3) at an azimuth, from the front to the subject's left, and an elevation in radians."""
    flat = np.cos(elevation)
    return np.stack([np.sin(azimuth) * flat, np.sin(elevation), np.cos(azimuth) * flat], axis=-1)


def between(start: np.ndarray, end: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Unit directions (k, n, 3) at shares (k,) of the arcs from ``start`` (3,) to ``end`` (1 or k, n, 3)."""
    angle = np.arccos(np.clip(end @ start, -1.0, 1.0))
    sine = np.sin(angle)
    share = share[:, None]
    first, second = np.sin((1.0 - share) * angle) / sine, np.sin(share * angle) / sine
    return first[..., None] * start + second[..., None] * end

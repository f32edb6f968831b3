"""Describes a camera by a few numbers that a network can read."""

import numpy as np

from facegen.geometry.cameras import Camera

PLACE_M = 0.05
"""Unit of a camera's place: cameras of headsets stand about so far from what they see."""


def camera_terms(camera: Camera, headset_from_camera: np.ndarray) -> np.ndarray:
    """(14,) `facegen.conventions.CAMERA_TERMS` of a camera whose pose (4, 4) in the headset's frame is in metres."""
    right, _, forward, place = np.asarray(headset_from_camera, np.float64)[:3].T
    size, focal = np.array([camera.width, camera.height]), np.array([camera.fx, camera.fy])
    off = (np.array([camera.cx, camera.cy]) - (size - 1) / 2.0) / size
    fisheye = float(camera.model == "fisheye")
    return np.concatenate([place / PLACE_M, forward, right, 0.5 * size / focal, off, [fisheye]])

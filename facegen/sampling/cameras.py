"""Draws the keypoint camera, and how the head is turned before it."""

import numpy as np

from facegen.geometry import rotation_from_angles, transform
from facegen.spec import Spec, draw

FACING = np.diag([1.0, -1.0, -1.0])
"""Turns the head frame (y up, z out of the face) into the frame of a camera that looks at the face."""


def draw_head_rotation(spec: Spec, rng: np.random.Generator, size: int) -> np.ndarray:
    """Rotations (size, 3, 3) of the head in its own frame."""
    angles = (draw(d, rng, size) for d in (spec.head.yaw_deg, spec.head.pitch_deg, spec.head.roll_deg))
    return rotation_from_angles(*(np.radians(angle) for angle in angles))


def draw_keypoint_camera(spec: Spec, rng: np.random.Generator, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Cameras as ``(intrinsics, head_position)``.

    Returns
    -------
    intrinsics : numpy.ndarray
        (size, 4): fx, fy, cx, cy in pixels.
    head_position : numpy.ndarray
        (size, 3): the head frame's origin in the camera frame, metres.
    """
    camera = spec.camera
    focal = camera.width_px / 2 / np.tan(np.radians(draw(camera.fov_deg, rng, size)) / 2)
    distance = draw(camera.distance_m, rng, size)
    offset_px = draw(camera.offset_px, rng, (size, 2))
    center = np.broadcast_to([(camera.width_px - 1) / 2, (camera.height_px - 1) / 2], (size, 2))
    intrinsics = np.concatenate([focal[:, None], focal[:, None], center], axis=1)
    position = np.concatenate([offset_px * (distance / focal)[:, None], distance[:, None]], axis=1)
    return intrinsics, position


def camera_from_head(rotation: np.ndarray, position: np.ndarray) -> np.ndarray:
    """(n, 4, 4) of heads turned by (n, 3, 3) whose origins lie at (n, 3) in the camera frame."""
    return transform(FACING @ rotation, position)

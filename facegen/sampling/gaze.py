"""Where the eyes look: both at one point, and the eyeLook* weights that say the same."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.geometry import angles_from_direction, direction_from_angles
from facegen.spec import Spec, draw

FULL_YAW_RAD = np.radians(30.0)
FULL_PITCH_RAD = np.radians(25.0)
"""Eye rotations at which an eyeLook* weight reaches 1."""

_LEFT, _RIGHT = 0, 1


def draw_gaze_target(spec: Spec, rng: np.random.Generator, size: int) -> np.ndarray:
    """Points (size, 3) that are looked at: head frame, metres, seen from midway between the eyes."""
    yaw, pitch, distance = (
        draw(d, rng, size) for d in (spec.gaze.yaw_deg, spec.gaze.pitch_deg, spec.gaze.distance_m)
    )
    return distance[:, None] * direction_from_angles(np.radians(yaw), np.radians(pitch))


def axes_from_target(target: np.ndarray, eye_center: np.ndarray) -> np.ndarray:
    """Unit optical axes (n, 2, 3), subject's left eye first, of eyes at (n, 2, 3) that look at points (n, 3)."""
    toward = target[:, None, :] - eye_center
    return toward / np.linalg.norm(toward, axis=-1, keepdims=True)


def weights_from_axes(axes: np.ndarray) -> dict[int, np.ndarray]:
    """Values (n,) of the eight eyeLook* weights, by blendshape index, of optical axes (n, 2, 3)."""
    yaw, pitch = angles_from_direction(axes)
    sideways, up = np.clip(yaw / FULL_YAW_RAD, -1, 1), np.clip(pitch / FULL_PITCH_RAD, -1, 1)
    values = {
        "eyeLookOutLeft": sideways[:, _LEFT],
        "eyeLookInLeft": -sideways[:, _LEFT],
        "eyeLookOutRight": -sideways[:, _RIGHT],
        "eyeLookInRight": sideways[:, _RIGHT],
        "eyeLookUpLeft": up[:, _LEFT],
        "eyeLookDownLeft": -up[:, _LEFT],
        "eyeLookUpRight": up[:, _RIGHT],
        "eyeLookDownRight": -up[:, _RIGHT],
    }
    return {BLENDSHAPE_INDEX[name]: np.maximum(value, 0.0) for name, value in values.items()}


def axes_from_weights(weights: np.ndarray) -> np.ndarray:
    """Unit optical axes (n, 2, 3) that eyeLook* weights (n, 52) stand for; the inverse of `weights_from_axes`."""

    def difference(plus: str, minus: str) -> np.ndarray:
        return weights[:, BLENDSHAPE_INDEX[plus]] - weights[:, BLENDSHAPE_INDEX[minus]]

    yaw = np.stack(
        [difference("eyeLookOutLeft", "eyeLookInLeft"), difference("eyeLookInRight", "eyeLookOutRight")],
        axis=-1,
    )
    pitch = np.stack(
        [difference("eyeLookUpLeft", "eyeLookDownLeft"), difference("eyeLookUpRight", "eyeLookDownRight")],
        axis=-1,
    )
    return direction_from_angles(yaw * FULL_YAW_RAD, pitch * FULL_PITCH_RAD)

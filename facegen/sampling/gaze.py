"""Draws where the eyes look, both at one point or, rarely, apart; converts gaze to eyeLook* weights and back."""

from collections.abc import Callable

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, EYE_LOOK_INDICES
from facegen.geometry import angles_from_direction, direction_from_angles
from facegen.spec import Spec, draw

FULL_YAW_RAD = np.radians(30.0)
FULL_PITCH_RAD = np.radians(25.0)
"""Eye rotations at which an eyeLook* weight reaches 1."""

FARTHEST_YAW_RAD, FARTHEST_PITCH_RAD = np.radians([42.0, 30.0])
"""How far wide looks go; eyes of healthy people reach about 45 degrees to either side, older ones about 30 upwards."""

AHEAD = (0.0, 0.0, 1.0)
"""Optical axis of an eye at rest."""

_LEFT, _RIGHT = 0, 1


WISH_DISTANCE_M = 10.0
"""Distance of points looked at through the whole range of the eyes: both eyes' weights reach 0.99 or more."""

DEVIATION_YAW_RAD, DEVIATION_PITCH_RAD = np.radians([3.0, 25.0]), np.radians([0.0, 8.0])
"""Least and largest angles between eyes that look apart (squints are mostly horizontal, 5 to 25 degrees)."""


def draw_gaze_target(
    spec: Spec, streams: Callable[[str], np.random.Generator], size: int, *, wish: np.ndarray
) -> np.ndarray:
    """Points (size, 3) that are looked at: head frame, metres, seen from midway between the eyes.

    Where any eyeLook* weight of ``wish`` (size, 52) is above 0, the point lies in that direction, far away. Of all
    other looks a share of ``spec.gaze.wide`` goes anywhere that eyes can turn to.
    """
    rng = streams("gaze")
    yaw, pitch, distance = (
        draw(d, rng, size) for d in (spec.gaze.yaw_deg, spec.gaze.pitch_deg, spec.gaze.distance_m)
    )
    rng = streams("gaze wide")
    wide = rng.random(size) < spec.gaze.wide
    wide_yaw, wide_pitch = draw_wide_looks(rng, size)
    yaw, pitch = np.where(wide, wide_yaw, np.radians(yaw)), np.where(wide, wide_pitch, np.radians(pitch))
    sideways, up = _shares(wish)
    wished = (wish[:, EYE_LOOK_INDICES] > 0).any(axis=1)
    yaw = np.where(wished, np.clip(sideways.sum(axis=-1), -1, 1) * FULL_YAW_RAD, yaw)
    pitch = np.where(wished, np.clip(up.sum(axis=-1), -1, 1) * FULL_PITCH_RAD, pitch)
    distance = np.where(wished, WISH_DISTANCE_M, distance)
    return distance[:, None] * direction_from_angles(yaw, pitch)


def draw_wide_looks(rng: np.random.Generator, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Yaw and pitch (size,) in radians, spread evenly over the ellipse that eyes can turn to."""
    radius, angle = np.sqrt(rng.random(size)), 2 * np.pi * rng.random(size)
    return FARTHEST_YAW_RAD * radius * np.cos(angle), FARTHEST_PITCH_RAD * radius * np.sin(angle)


def draw_deviation(rng: np.random.Generator, size: int) -> np.ndarray:
    """Angles (size, 2, 2) in radians, yaw and pitch of each eye off the point looked at; one of the eyes is 0."""
    unit, sign = rng.random((size, 2)), np.where(rng.random((size, 2)) < 0.5, -1.0, 1.0)
    low, high = np.stack([DEVIATION_YAW_RAD, DEVIATION_PITCH_RAD], axis=-1)
    side = rng.integers(0, 2, size)
    deviation = np.zeros((size, 2, 2))
    deviation[np.arange(size), side] = sign * (low + unit * (high - low))
    return deviation


def diverge(axes: np.ndarray, deviation: np.ndarray) -> np.ndarray:
    """Unit optical axes (n, 2, 3) turned by yaw and pitch (n, 2, 2), no further than eyes go."""
    yaw, pitch = angles_from_direction(axes)
    return direction_from_angles(
        np.clip(yaw + deviation[..., 0], -FULL_YAW_RAD, FULL_YAW_RAD),
        np.clip(pitch + deviation[..., 1], -FULL_PITCH_RAD, FULL_PITCH_RAD),
    )


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
    sideways, up = _shares(weights)
    return direction_from_angles(sideways * FULL_YAW_RAD, up * FULL_PITCH_RAD)


def _shares(weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Shares (n, 2) of the full angles to the subject's left and upwards, left eye first, of weights (n, 52)."""

    def difference(plus: str, minus: str) -> np.ndarray:
        return weights[:, BLENDSHAPE_INDEX[plus]] - weights[:, BLENDSHAPE_INDEX[minus]]

    sideways = np.stack(
        [difference("eyeLookOutLeft", "eyeLookInLeft"), difference("eyeLookInRight", "eyeLookOutRight")],
        axis=-1,
    )
    up = np.stack(
        [difference("eyeLookUpLeft", "eyeLookDownLeft"), difference("eyeLookUpRight", "eyeLookDownRight")],
        axis=-1,
    )
    return sideways, up

"""Rotations, rigid transforms and directions, in right-handed frames with y up and z out of the face."""

import numpy as np


def rotation_from_angles(yaw_rad: np.ndarray, pitch_rad: np.ndarray, roll_rad: np.ndarray) -> np.ndarray:
    """Rotation matrices that turn a head (or an eye) in its own frame: first roll, then pitch, then yaw.

    Parameters
    ----------
    yaw_rad
        Turn to the subject's left, positive about +y; shape (...).
    pitch_rad
        Turn upwards, positive about -x; shape (...).
    roll_rad
        Tilt of the head's top towards the subject's left shoulder, positive about -z; shape (...).

    Returns
    -------
    numpy.ndarray
        (..., 3, 3), ``Ry(yaw) @ Rx(-pitch) @ Rz(-roll)``.
    """
    yaw, pitch, roll = _compact(*np.broadcast_arrays(yaw_rad, pitch_rad, roll_rad))
    cy, sy, cp, sp, cr, sr = (f(a) for a in (yaw, pitch, roll) for f in (np.cos, np.sin))
    zero, one = np.zeros_like(cy), np.ones_like(cy)

    def matrix(*rows: tuple[np.ndarray, ...]) -> np.ndarray:
        return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    about_y = matrix((cy, zero, sy), (zero, one, zero), (-sy, zero, cy))
    about_x = matrix((one, zero, zero), (zero, cp, sp), (zero, -sp, cp))
    about_z = matrix((cr, sr, zero), (-sr, cr, zero), (zero, zero, one))
    return about_y @ about_x @ about_z


def angles_from_rotation(rotation: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """``(yaw_rad, pitch_rad, roll_rad)`` of rotations (..., 3, 3); the inverse of `rotation_from_angles`.

    For a pitch within +-90 degrees; at these two only the sum of yaw and roll is known.
    """
    rotation = np.asarray(rotation, np.float64)
    entries = ((0, 2), (2, 2), (1, 2), (1, 0), (1, 1))
    r02, r22, r12, r10, r11 = _compact(*(rotation[..., row, column] for row, column in entries))
    return np.arctan2(r02, r22), np.arcsin(np.clip(r12, -1.0, 1.0)), np.arctan2(-r10, r11)


def direction_from_angles(yaw_rad: np.ndarray, pitch_rad: np.ndarray) -> np.ndarray:
    """Unit vectors (..., 3) of a gaze: +z turned by ``yaw`` to the subject's left, by ``pitch`` upwards."""
    yaw, pitch = _compact(*np.broadcast_arrays(yaw_rad, pitch_rad))
    return np.stack([np.sin(yaw) * np.cos(pitch), np.sin(pitch), np.cos(yaw) * np.cos(pitch)], axis=-1)


def angles_from_direction(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """``(yaw_rad, pitch_rad)`` of unit vectors (..., 3); the inverse of `direction_from_angles`."""
    x, y, z = _compact(*np.moveaxis(np.asarray(direction), -1, 0))
    return np.arctan2(x, z), np.arcsin(np.clip(y, -1.0, 1.0))


def _compact(*values: np.ndarray) -> list[np.ndarray]:
    """Float64 arrays without gaps between their numbers.

    NumPy's functions for AVX-512 leave an array with gaps to libm where its span, the gap after its last number
    included, touches the result's memory. The two differ in the last bit: which one it was would hang on the heap.
    """
    return [np.array(each, np.float64, order="C") for each in values]


def transform(rotation: np.ndarray, translation: np.ndarray) -> np.ndarray:
    """Homogeneous (..., 4, 4) matrices of rotations (..., 3, 3) followed by translations (..., 3) in metres."""
    rotation, translation = np.asarray(rotation, np.float64), np.asarray(translation, np.float64)
    shape = np.broadcast_shapes(rotation.shape[:-2], translation.shape[:-1])
    matrix = np.zeros((*shape, 4, 4))
    matrix[..., :3, :3] = rotation
    matrix[..., :3, 3] = translation
    matrix[..., 3, 3] = 1.0
    return matrix


def invert_transform(matrix: np.ndarray) -> np.ndarray:
    """Inverse of rigid transforms (..., 4, 4): ``b_from_a`` gives ``a_from_b``."""
    rotation_t = np.swapaxes(matrix[..., :3, :3], -1, -2)
    return transform(rotation_t, -np.einsum("...ij,...j->...i", rotation_t, matrix[..., :3, 3]))


def apply_transform(b_from_a: np.ndarray, points_a: np.ndarray) -> np.ndarray:
    """Points (..., n, 3) moved from frame a to frame b by ``b_from_a`` (..., 4, 4)."""
    rotation_t = np.swapaxes(b_from_a[..., :3, :3], -1, -2)
    return points_a @ rotation_t + b_from_a[..., None, :3, 3]


def look_at(position: np.ndarray, target: np.ndarray, *, up: np.ndarray = (0.0, 1.0, 0.0)) -> np.ndarray:
    """``parent_from_camera`` (4, 4) of an OpenCV camera at ``position`` whose z axis meets ``target``.

    ``up`` is the parent's direction that appears upwards in the picture; it must not lie along the line of sight.
    """
    position, target, up = (np.asarray(a, np.float64) for a in (position, target, up))
    forward = (target - position) / np.linalg.norm(target - position)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    return transform(np.stack([right, down, forward], axis=-1), position)

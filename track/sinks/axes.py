"""Turns where a head is and where its eyes look into the frames of avatars: glTF's, and from there Unity's.

::

    camera (OpenCV)   x right in the picture, y down, z away from the camera     `regress.runtime.sample.Sample.head`
    glTF              x to the subject's left, y up, z out of the face           right-handed; a head that looks into
                                                                                 the camera is not turned
    Unity             x to the subject's right, y up, z out of the face          left-handed

The subject's left is the picture's right, so that glTF's frame is the camera's turned by half a turn about x.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification", 3.4: right-handed, y up, the front of an asset faces +z, metres.
.. [2] Unity Manual, "Quaternion and Euler rotations": left-handed, y up; ``Quaternion.Euler`` turns about z, then x,
   then y. An avatar looks along +z, so its left is -x.
"""

from dataclasses import dataclass

import numpy as np

NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadPose:
    """A head in glTF's frame, whose origin is the camera.

    Parameters
    ----------
    position : (3,) float64
        Metres.
    angles_rad : (3,) float64
        Yaw to the subject's left, pitch upwards, roll towards the left shoulder.
    """

    position: np.ndarray
    angles_rad: np.ndarray

    @property
    def rotation(self) -> np.ndarray:
        """The unit quaternion (4,) x, y, z, w."""
        return quaternion(*self.angles_rad)


def head_pose(head: np.ndarray | None) -> HeadPose | None:
    """A sample's head (6,) in glTF's frame; None where there is none, or it is not known."""
    if head is None or np.isnan(head).any():
        return None
    return HeadPose(position=head[:3] * [1, -1, -1], angles_rad=np.asarray(head[3:], dtype=np.float64))


def eye_turns(gaze: np.ndarray | None) -> np.ndarray | None:
    """Rotations (2, 4) of the left and the right eye in the head, of a sample's gaze (4,); None where not known."""
    if gaze is None or np.isnan(gaze).any():
        return None
    return np.stack([quaternion(gaze[0], gaze[1]), quaternion(gaze[2], gaze[3])])


def quaternion(yaw_rad: float, pitch_rad: float, roll_rad: float = 0.0) -> np.ndarray:
    """Unit quaternion (4,) x, y, z, w of ``Ry(yaw) Rx(-pitch) Rz(-roll)``, as `facegen.geometry` has rotations."""
    (cy, cx, cz), (sy, sx, sz) = (
        turn(np.array([yaw_rad, -pitch_rad, -roll_rad]) / 2) for turn in (np.cos, np.sin)
    )
    return np.array(
        [
            cy * sx * cz + sy * cx * sz,
            sy * cx * cz - cy * sx * sz,
            cy * cx * sz - sy * sx * cz,
            cy * cx * cz + sy * sx * sz,
        ]
    )


def share_of(rotation: np.ndarray, share: float) -> np.ndarray:
    """The rotation (4,) about the same axis by a share of the angle, the short way round."""
    rotation = rotation if rotation[3] >= 0 else -rotation
    sine = float(np.linalg.norm(rotation[:3]))
    half = share * np.arctan2(sine, rotation[3])
    return np.append(rotation[:3] * (np.sin(half) / sine if sine > 1e-12 else share), np.cos(half))


def unity_position(position: np.ndarray) -> np.ndarray:
    """A place (3,) of glTF's frame in Unity's: x is mirrored."""
    return position * [-1, 1, 1]


def unity_quaternion(rotation: np.ndarray) -> np.ndarray:
    """A rotation (4,) of glTF's frame in Unity's: mirroring x keeps turns about it and reverses the others."""
    return rotation * [1, -1, -1, 1]


def unity_euler_deg(angles_rad: np.ndarray) -> np.ndarray:
    """Degrees (3,) about x, y and z for ``Quaternion.Euler``, of yaw, pitch and roll (3,)."""
    yaw, pitch, roll = np.degrees(angles_rad)
    return np.array([-pitch, -yaw, roll])

"""Gaze from the centres of the irises: eyeballs behind the corners of the eyes, and the rays on which irises are seen.

References
----------
.. [1] F. Rüfer et al., "White-to-white corneal diameter", Cornea 24(3), 2005: irises are 11.7 mm across.
.. [2] D. Atchison, G. Smith, "Optics of the Human Eye", 2000: eyeballs of 12 mm radius.
.. [3] G. Fry and W. Hill, "The center of rotation of the eye", Am. J. Optometry 39(11), 1962: 13.5 mm behind the
   cornea's apex, which is 0.353 mm behind the middle of such a ball.
"""

from dataclasses import dataclass, field

import numpy as np

from facegen.conventions import SIDES
from regress.runtime.heads.camera import FaceCamera
from regress.runtime.heads.fit import HeadPoses

_BALL_RADIUS_M, _IRIS_RADIUS_M, _GLOBE_AHEAD_M = 12.0e-3, 5.9e-3, 0.353e-3

REACH_M = _GLOBE_AHEAD_M + float(np.sqrt(_BALL_RADIUS_M**2 - _IRIS_RADIUS_M**2))
"""From where an eyeball turns to the middle of its iris' outline, which is what detectors mark: 10.8 mm."""

CORNERS = ((42, 45), (36, 39))
"""Landmarks at the corners of the subject's left and right eye."""

_LIDS = (((43, 47), (44, 46)), ((37, 41), (38, 40)))
"""Landmarks above and below one another on the lids of each eye."""

_CORNERS_M = np.array([[0.0315, -0.0033, 0.0119], [-0.0315, -0.0033, 0.0119]])
"""Midway between each eye's corners in the head frame, of the mean face (regress/data/reference_shape.json)."""

_BALL_M = np.array([[-0.0002, 0.0018, -0.0064], [0.0002, 0.0018, -0.0064]])
"""From there to where an eyeball of 12 mm turns in the lids of the mean face (`facegen.rigs.human_eyes`)."""

_FARTHEST_PX = 1e15
"""Of an iris, as of landmarks (regress.runtime.inputs.faults)."""

FURTHEST_RAD = np.radians(45.0)
"""Eyes turn no further."""

_OPEN, _SHUT = 0.6, 0.35
"""Opening of the lids, over that of the same eye at rest, from which an iris is believed, and up to which it is not."""

_AT_REST = 0.33
"""Height of the mean face's opening, over its width."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Eyes:
    """Where a person's eyeballs lie, and how far the lids are open at rest; the subject's left eye first.

    Parameters
    ----------
    ball_m : (2, 3) float64
        From midway between an eye's corners to where its ball turns, head frame.
    opening : (2,) float64
        Height over width.
    ahead : (2, 2) float64
        Yaw and pitch that each reads where it looks straight ahead, as somebody's who looks below the camera; zeros
        where nobody has said it. Eyes that close go there.
    """

    ball_m: np.ndarray
    opening: np.ndarray
    ahead: np.ndarray = field(default_factory=lambda: np.zeros((len(SIDES), 2)))


MEAN_EYES = Eyes(ball_m=_BALL_M, opening=np.full(len(SIDES), _AT_REST))


def own_eyes(
    faces: np.ndarray, irises: np.ndarray, poses: HeadPoses, camera: FaceCamera, *, into_camera: bool = False
) -> Eyes:
    """A person's eyes, from neutral faces that look at one place: medians, so some of them may look elsewhere.

    Parameters
    ----------
    faces : (m, 68, 2) float64
    irises : (m, 2, 2) float64
        Centres, the subject's left eye first. Where no face has both, the eyes are the mean person's.
    into_camera
        Whether they look into the camera, from a head that may be turned; else straight ahead, where the head turns.
    """
    with np.errstate(all="ignore"):  # rays of irises that are not known
        ball, ray = _seen(faces, _known(irises), poses, camera, MEAN_EYES)
        towards = ray.start - ball if into_camera else np.broadcast_to([0.0, 0.0, 1.0], ball.shape)
        iris = ball + REACH_M * towards / np.linalg.norm(towards, axis=-1, keepdims=True)
        beside = ray.start + ray.along * ((iris - ray.start)[..., 2:] / ray.along[..., 2:]) - iris
    beside = beside[np.isfinite(beside).all(axis=(1, 2))]
    if not len(beside):
        return MEAN_EYES
    shift = np.median(beside, axis=0) * [1.0, 1.0, 0.0]
    return Eyes(ball_m=MEAN_EYES.ball_m + shift, opening=np.median(openings(faces), axis=0))


def gaze_angles(
    faces: np.ndarray, irises: np.ndarray, poses: HeadPoses, camera: FaceCamera, eyes: Eyes
) -> np.ndarray:
    """Yaw and pitch of each eye in the head frame.

    A closing eye, or one whose iris is not known, goes with the other one; where both close, the gaze goes back to
    straight ahead.

    Parameters
    ----------
    faces : (n, 68, 2) float64
    irises : (n, 2, 2) float64

    Returns
    -------
    (n, 2, 2) float64
        Radians; yaw to the subject's left, pitch upwards. NaN where neither iris is known.
    """
    with np.errstate(all="ignore"):  # what cannot be computed is NaN
        angles = _angles(*_seen(faces, _known(irises), poses, camera, eyes))
    known = np.isfinite(angles).all(axis=-1)
    trust = np.clip((openings(faces) / eyes.opening - _SHUT) / (_OPEN - _SHUT), 0, 1) * known
    angles = np.where(known[..., None], angles, 0)
    others = (1 - trust) * trust[:, ::-1]
    shared = trust[..., None] * angles + others[..., None] * angles[:, ::-1]
    least = np.maximum(trust + others, 0.5)
    shared = (shared + (least - trust - others)[..., None] * eyes.ahead) / least[..., None]
    return np.where(known.any(axis=-1)[:, None, None], shared, np.nan)


def _known(irises: np.ndarray) -> np.ndarray:
    """Irises with NaN for what is too far away to be computed with."""
    return np.where(np.abs(irises) < _FARTHEST_PX, irises, np.nan)


def _angles(ball: np.ndarray, ray: "_Rays") -> np.ndarray:
    """Yaw and pitch (n, 2, 2) of eyes in balls (n, 2, 3) whose irises lie on rays."""
    # where the ray enters the sphere on which the iris turns, or passes it closest
    toward = ball - ray.start
    length = np.linalg.norm(ray.along, axis=-1, keepdims=True)
    along = ray.along / length
    closest = (toward * along).sum(axis=-1, keepdims=True)
    off = (toward**2).sum(axis=-1, keepdims=True) - closest**2
    axis = along * (closest - np.sqrt(np.maximum(REACH_M**2 - off, 0))) - toward
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    angles = np.stack(
        [np.arctan2(axis[..., 0], axis[..., 2]), np.arcsin(np.clip(axis[..., 1], -1, 1))], axis=-1
    )
    return np.clip(angles, -FURTHEST_RAD, FURTHEST_RAD)


def openings(faces: np.ndarray) -> np.ndarray:
    """Height of the lids' opening over its width (n, 2), the subject's left eye first."""
    return np.stack(
        [
            np.mean([np.linalg.norm(faces[:, top] - faces[:, low], axis=1) for top, low in lids], axis=0)
            / np.maximum(np.linalg.norm(faces[:, first] - faces[:, last], axis=1), 1e-12)
            for lids, (first, last) in zip(_LIDS, CORNERS, strict=True)
        ],
        axis=1,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Rays:
    """Starts and directions (n, 2, 3) in the head frame."""

    start: np.ndarray
    along: np.ndarray


def _seen(
    faces: np.ndarray, irises: np.ndarray, poses: HeadPoses, camera: FaceCamera, eyes: Eyes
) -> tuple[np.ndarray, _Rays]:
    """Where the eyeballs turn (n, 2, 3), and the rays on which irises are seen, in the head frame."""

    def ray(points: np.ndarray) -> np.ndarray:
        beside = (points - camera.centre_px) / camera.focal_px
        return np.concatenate([beside, np.ones((*beside.shape[:-1], 1))], axis=-1) @ poses.rotation

    start = np.repeat(-poses.translation[:, None] @ poses.rotation, len(SIDES), axis=1)
    middle = ray(faces[:, np.array(CORNERS)].mean(axis=2))
    # the corners lie as far away as the pose has those of the mean face
    distance = (_CORNERS_M @ poses.rotation[:, 2, :, None])[..., 0] + poses.translation[:, 2:]
    ball = start + middle * distance[..., None] + eyes.ball_m
    return ball, _Rays(start=start, along=ray(irises))

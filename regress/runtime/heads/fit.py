"""Fits poses of heads to points in pictures: perspective-n-point by Levenberg-Marquardt, many faces at once.

Every product is one of each face by itself, so that a face gives the same digits alone and among others.

A head is a mean shape plus modes with coefficients of N(0, 1); pose and coefficients are found together, points weighed
by how far detectors disagree about them, so a long nose is not taken for a lifted chin. Without modes and with equal
weights it is perspective-n-point as ``cv2.solvePnP`` solves it (the tests compare the two).

References
----------
.. [1] V. Blanz, T. Vetter, "A morphable model for the synthesis of 3D faces", SIGGRAPH 1999: shape and pose as the most
   probable under a Gaussian prior.
"""

from dataclasses import dataclass, fields

import numpy as np

from regress.runtime.heads.camera import FaceCamera
from regress.runtime.heads.shape import HeadShape, shape_of_person

FACING = np.diag([1.0, -1.0, -1.0])
"""Rotation from the head frame to the camera's, of a head that looks into the camera."""

_STEPS, _ARRIVED = 15, 1e-9
"""Most steps, and the size of one (radians, metres, standard deviations) that is the last. Faces of the default dataset
take 5 to 8."""

_SMALLEST = 0.05
"""Of the shape laid upon a face, over the face's extent: profiles have .3 and more, points without any shape 0."""

_LEAST = 1e-9
"""Added to what is solved for, so that a head of which the camera sees nothing is no reason to stop the others."""

_BEHIND = 1e30
"""Residual of a point behind the camera: no step leads there."""

_ROUNDING = 1e-9
"""Rise of a sum of squares that is no reason against a step: without it, steps end 1e-8 before the pose."""

_DAMPING, _LESS, _MORE = 1e-3, 0.1, 10.0
"""Of the first step, and its factors after a step that was taken and one that was not."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadPoses:
    """Poses of n heads.

    Parameters
    ----------
    rotation : (n, 3, 3) float64
        From the head frame to the camera frame.
    translation : (n, 3) float64
        Of the head's origin, midway between the eyeballs, in the camera frame; metres.
    coefficients : (n, k) float64
        Of the shape's modes.
    """

    rotation: np.ndarray
    translation: np.ndarray
    coefficients: np.ndarray

    def take(self, rows: np.ndarray) -> "HeadPoses":
        """Some of the heads."""
        return HeadPoses(**{each.name: getattr(self, each.name)[rows] for each in fields(self)})

    def put(self, rows: np.ndarray, others: "HeadPoses") -> None:
        """Overwrite some of the heads."""
        for each in fields(self):
            getattr(self, each.name)[rows] = getattr(others, each.name)

    def spread(self, rows: np.ndarray) -> "HeadPoses":
        """These heads at the rows that are True, NaN at the others."""

        def spread(values: np.ndarray) -> np.ndarray:
            whole = np.full((len(rows), *values.shape[1:]), np.nan)
            whole[rows] = values
            return whole

        return HeadPoses(**{each.name: spread(getattr(self, each.name)) for each in fields(self)})


def fit_poses(faces: np.ndarray, camera: FaceCamera, shape: HeadShape) -> HeadPoses:
    """Most probable poses of heads with this shape.

    Parameters
    ----------
    faces : (n, 68, 2) float64
        Pixels, y down, without NaN.

    Returns
    -------
    HeadPoses
        NaN where the shape's points are all in one place or so far away that nothing can be computed.
    """
    with np.errstate(all="ignore"):  # what cannot be computed is NaN, and told apart at the end
        start = _start(faces, camera, shape)
        _, scale = shape.laid_upon(faces)
        size = np.abs(scale) * np.ptp(shape.points[:, 0])
        sound = np.isfinite(start.translation).all(axis=1) & (
            size > _SMALLEST * np.ptp(faces, axis=1).max(axis=1)
        )
        found = _refined(start.take(sound), faces[sound], camera, shape)
        return found.spread(sound)


def _refined(poses: HeadPoses, faces: np.ndarray, camera: FaceCamera, shape: HeadShape) -> HeadPoses:
    """Poses after some steps of Levenberg-Marquardt, each of which is taken only where it makes residuals smaller."""
    seen = (faces[:, shape.landmarks] - camera.centre_px) / camera.focal_px
    # what detectors are unsure of is as large in the picture as the face is
    _, scale = shape.laid_upon(faces)
    weight = camera.focal_px / (np.abs(scale)[:, None] * shape.uncertainty_m)
    damping = np.full(len(faces), _DAMPING)
    residual, jacobian = _linearised(poses, seen, weight, shape)
    cost = (residual**2).sum(axis=1)
    moving = np.arange(len(faces))
    for _ in range(_STEPS):
        across = np.swapaxes(jacobian, 1, 2)
        squared = across @ jacobian
        diagonal = np.einsum("nii->ni", squared)
        diagonal += damping[moving, None] * diagonal + _LEAST
        move = np.linalg.solve(squared, across @ residual[..., None])[..., 0]
        tried = _moved(poses.take(moving), move)
        residual_there, jacobian_there = _linearised(tried, seen[moving], weight[moving], shape)
        cost_there = (residual_there**2).sum(axis=1)
        better = cost_there <= cost[moving] * (1 + _ROUNDING)
        poses.put(moving[better], tried.take(better))
        cost[moving[better]] = cost_there[better]
        damping[moving] *= np.where(better, _LESS, _MORE)
        residual[better], jacobian[better] = residual_there[better], jacobian_there[better]
        still = ~(better & (np.abs(move).max(axis=1) < _ARRIVED))
        moving, residual, jacobian = moving[still], residual[still], jacobian[still]
        if not len(moving):
            break
    return poses


def own_shape(neutral: np.ndarray, camera: FaceCamera, shape: HeadShape) -> HeadShape:
    """A person's own shape as a detector gives it: of the neutral faces' x and y, and of the most probable depths.

    The median of the faces counts, so one of them may blink.

    Parameters
    ----------
    neutral : (m, 68, 2) float64
        Faces of one person; those with missing points are left out, and one must be whole.
    """
    faces = neutral[np.isfinite(neutral).all(axis=(1, 2))]
    poses = fit_poses(faces, camera, shape)
    depth = (shape.points + np.einsum("nk,kpd->npd", poses.coefficients, shape.modes))[..., 2]
    rays = np.concatenate(
        [(faces[:, shape.landmarks] - camera.centre_px) / camera.focal_px, np.ones((*depth.shape, 1))], axis=2
    )
    # where each point's ray meets the plane of its depth, in the head frame
    start = -np.einsum("nij,ni->nj", poses.rotation, poses.translation)
    along = np.einsum("nij,npi->npj", poses.rotation, rays)
    met = start[:, None] + along * ((depth - start[:, None, 2]) / along[..., 2])[..., None]
    return shape_of_person(np.median(met, axis=0))


def _start(faces: np.ndarray, camera: FaceCamera, shape: HeadShape) -> HeadPoses:
    """Heads that face the camera, where the similarity that lays the shape on the face has them."""
    middle, scale = shape.laid_upon(faces)
    roll = np.angle(scale)
    turned = np.zeros((len(faces), 3, 3))
    turned[:, 0, 0] = turned[:, 1, 1] = np.cos(roll)
    turned[:, 1, 0], turned[:, 0, 1], turned[:, 2, 2] = np.sin(roll), -np.sin(roll), 1.0
    distance = camera.focal_px / np.abs(scale)
    beside = (middle - complex(*camera.centre_px)) / camera.focal_px
    return HeadPoses(
        rotation=turned @ FACING,
        translation=distance[:, None] * np.stack([beside.real, beside.imag, np.ones(len(faces))], axis=1),
        coefficients=np.zeros((len(faces), len(shape.modes))),
    )


def _linearised(
    poses: HeadPoses, seen: np.ndarray, weight: np.ndarray, shape: HeadShape
) -> tuple[np.ndarray, np.ndarray]:
    """Residuals (n, 2p + k), and how what is seen moves with rotation, translation, coefficients (n, 2p + k, 6 + k)."""
    count, modes = poses.coefficients.shape
    shift = poses.coefficients[:, None] @ shape.modes.reshape(modes, shape.points.size)
    turned = (shape.points + shift.reshape(count, *shape.points.shape)) @ np.swapaxes(poses.rotation, 1, 2)
    in_camera = turned + poses.translation[:, None]
    before = in_camera[..., 2] > 0
    distance = np.where(before, in_camera[..., 2], 1.0)
    u, v = in_camera[..., 0] / distance, in_camera[..., 1] / distance
    slope = np.where(before, weight, 0.0) / distance
    jacobian = np.zeros((count, len(shape.points), 2, 6 + modes))
    # of u and v by the point in the camera frame, then by a turn: the cross product of the turned point and that
    by_point = jacobian[..., 3:6]
    by_point[..., 0, 0] = by_point[..., 1, 1] = slope
    by_point[..., 0, 2], by_point[..., 1, 2] = -u * slope, -v * slope
    x, y, z = turned[..., 0], turned[..., 1], turned[..., 2]
    jacobian[..., 0, 0], jacobian[..., 0, 1], jacobian[..., 0, 2] = (
        -y * u * slope,
        (z + x * u) * slope,
        -y * slope,
    )
    jacobian[..., 1, 0], jacobian[..., 1, 1], jacobian[..., 1, 2] = (
        (-y * v - z) * slope,
        x * v * slope,
        x * slope,
    )
    jacobian[..., 6:] = by_point @ (poses.rotation[:, None] @ np.moveaxis(shape.modes, 0, 2))
    apart = np.where(before[..., None], weight[..., None] * (seen - np.stack([u, v], axis=2)), _BEHIND)
    prior = np.zeros((count, modes, 6 + modes))
    prior[:, range(modes), range(6, 6 + modes)] = 1.0
    residual = np.concatenate([apart.reshape(count, 2 * len(shape.points)), -poses.coefficients], axis=1)
    return residual, np.concatenate(
        [jacobian.reshape(count, 2 * len(shape.points), 6 + modes), prior], axis=1
    )


def _moved(poses: HeadPoses, move: np.ndarray) -> HeadPoses:
    """Poses after a step (n, 6 + k): a turn in the camera frame as a vector, a shift, and the coefficients' change."""
    return HeadPoses(
        rotation=_rotation(move[:, :3]) @ poses.rotation,
        translation=poses.translation + move[:, 3:6],
        coefficients=poses.coefficients + move[:, 6:],
    )


def _rotation(vector: np.ndarray) -> np.ndarray:
    """Rotations (n, 3, 3) about vectors (n, 3) by their lengths in radians (Rodrigues)."""
    angle = np.linalg.norm(vector, axis=1)
    x, y, z = vector.T
    zero = np.zeros_like(x)
    cross = np.stack([np.stack([zero, -z, y], 1), np.stack([z, zero, -x], 1), np.stack([-y, x, zero], 1)], 1)
    # sinc(t / pi) is sin(t) / t; half of it squared at half the angle is (1 - cos t) / t^2
    first, second = np.sinc(angle / np.pi), np.sinc(angle / 2 / np.pi) ** 2 / 2
    return np.eye(3) + first[:, None, None] * cross + second[:, None, None] * cross @ cross

"""Aligns a face to a mean shape by the points that expressions move least."""

from collections.abc import Sequence

import numpy as np

from facegen.conventions import FACE_WIDTH_LANDMARKS, LANDMARK_GROUPS, MIRRORED_LANDMARKS

ANCHORS: tuple[int, ...] = (
    *LANDMARK_GROUPS["jaw"],
    *LANDMARK_GROUPS["right_brow"],
    *LANDMARK_GROUPS["left_brow"],
    *LANDMARK_GROUPS["nose_bridge"],
)
"""The outer 27 points (17 jaw, 10 brow) and the 4 nose-bridge points."""

STABLE: tuple[int, ...] = (*LANDMARK_GROUPS["nose_bridge"], 33, 36, 39, 42, 45)
"""Points that no expression moves by much: the nose's bridge and base, and the four corners of the eyes."""

ROUNDING = 1e-24
"""Spread of anchors, of the square of their place, that is rounding alone: they are one point."""

_MEAN_SHAPE_ROUNDS = 5
"""Rounds of averaging; the mean moves by less than 1e-6 face widths after the third."""


def align_affine(points: np.ndarray, mean_shape: np.ndarray) -> np.ndarray:
    """Map every face onto the mean shape by the affine map that fits its anchors best.

    Least squares in closed form: with the anchors centred, ``A = (P'P)^-1 P'Q``.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Faces in any unit.
    mean_shape : (68, 2) float64
        What they are aligned to.

    Returns
    -------
    (n, 68, 2) float64
        In the mean shape's unit and place. Rows with NaN, or whose anchors lie on one line, are NaN.
    """
    anchors = points[:, ANCHORS]
    centre = anchors.mean(axis=1, keepdims=True)
    target = mean_shape[list(ANCHORS)]
    target_centre = target.mean(axis=0)
    centred = anchors - centre
    moment = np.einsum("nai,naj->nij", centred, centred)
    cross = np.einsum("nai,aj->nij", centred, target - target_centre)
    determinant = moment[:, 0, 0] * moment[:, 1, 1] - moment[:, 0, 1] ** 2
    trace = moment[:, 0, 0] + moment[:, 1, 1]
    # Real faces have determinant/trace^2 above 0.1; 1e-12 is rounding of points on one line.
    determinant = np.where(determinant > 1e-12 * trace**2, determinant, np.nan)
    inverse = np.empty_like(moment)
    inverse[:, 0, 0], inverse[:, 1, 1] = moment[:, 1, 1], moment[:, 0, 0]
    inverse[:, 0, 1] = inverse[:, 1, 0] = -moment[:, 0, 1]
    matrix = (inverse / determinant[:, None, None]) @ cross
    return (points - centre) @ matrix + target_centre


def align_similarity(
    points: np.ndarray, mean_shape: np.ndarray, anchors: Sequence[int] = ANCHORS
) -> np.ndarray:
    """Turn, scale and shift every face onto the mean shape, as its anchors fit best; its shape stays.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Faces in any unit.
    mean_shape : (68, 2) float64
        What they are laid upon.
    anchors
        Landmarks that are fitted.

    Returns
    -------
    (n, 68, 2) float64
        In the mean shape's unit and place; rows with NaN, or whose anchors are one point, are NaN.
    """
    rows = list(anchors)
    faces, target = _as_complex(points), _as_complex(mean_shape)[rows]
    centre = target.mean()
    middle = faces[:, rows].mean(axis=1, keepdims=True)
    faces = faces - middle
    fitted = faces[:, rows]
    spread = np.sum(np.abs(fitted) ** 2, axis=1)
    # A complex factor is a rotation and a scale: the best one is <face, mean> / <face, face>.
    with np.errstate(invalid="ignore"):  # faces with missing points become NaN
        factor = (fitted.conj() @ (target - centre)) / np.where(
            spread > ROUNDING * np.abs(middle[:, 0]) ** 2, spread, np.nan
        )
    laid = faces * factor[:, None] + centre
    return np.stack([laid.real, laid.imag], axis=-1)


def mean_shape(points: np.ndarray) -> np.ndarray:
    """Mirror-symmetric mean of many faces, by Procrustes averaging with similarities.

    Affine averaging would let the mean drift in shear; symmetry makes a mirrored face give mirrored features.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Faces in pixels (y down), in any place, size and roll.

    Returns
    -------
    (68, 2) float64
        Face width 1, the anchors' centre at the origin, ears level, y down.
    """
    faces = _as_complex(points)
    faces = faces - faces[:, ANCHORS].mean(axis=1, keepdims=True)
    mean = _normalised(faces[0])
    for _ in range(_MEAN_SHAPE_ROUNDS):
        anchors = faces[:, ANCHORS]
        # A complex factor is a rotation and a scale: the best one is <face, mean> / <face, face>.
        factor = (anchors.conj() @ mean[list(ANCHORS)]) / np.sum(np.abs(anchors) ** 2, axis=1)
        mean = _normalised((faces * factor[:, None]).mean(axis=0))
    mirrored = -mean.conj()[list(MIRRORED_LANDMARKS)]
    mean = _normalised((mean + mirrored) / 2)
    return np.stack([mean.real, mean.imag], axis=-1)


def _as_complex(points: np.ndarray) -> np.ndarray:
    return points[..., 0] + 1j * points[..., 1]


def _normalised(face: np.ndarray) -> np.ndarray:
    right, left = (face[index] for index in FACE_WIDTH_LANDMARKS)
    face = face / (left - right)
    return face - face[list(ANCHORS)].mean()

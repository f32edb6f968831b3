"""Evaluates a rig: identity, blendshape weights and gaze of many faces to vertices, landmarks and eyes."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from facegen.errors import InputError
from facegen.rigs.lids import clamp_contact, close_lids
from facegen.rigs.occluder import occluder
from facegen.rigs.rig import Rig
from facegen.rigs.threads import one_blas_thread

CHUNK = 96
"""Rows computed at once, always: a product's last bits depend on its shape, a face's must not on others.

Nor must they on its place among them: 96 is the largest number, with 48, of 1 to 134 rows at which OpenBLAS treats all
alike on Haswell, Zen and AVX-512 (0.3.23; of 100 rows the last four differ from the others).
"""


@dataclass(frozen=True, kw_only=True, eq=False)
class EvaluatedFaces:
    """Faces in the head frame, in metres, float64.

    Attributes
    ----------
    vertices
        (n, V, 3), or those of `facegen.rigs.occluder` (n, m, 3), the cage's first, where only the cage was asked for.
    landmarks
        (n, 68, 3).
    eye_center, eye_radius
        (n, 2, 3) and (n, 2), the subject's left eye first.
    """

    vertices: np.ndarray
    landmarks: np.ndarray
    eye_center: np.ndarray
    eye_radius: np.ndarray


def evaluate(
    rig: Rig, identity: np.ndarray, weights: np.ndarray, gaze: np.ndarray, *, cage_only: bool = False
) -> EvaluatedFaces:
    """Shape of n faces.

    A row's result depends on this row alone, to the last bit: neither on the other rows nor on how many there
    are, and a vertex is the same with and without ``cage_only``.

    Parameters
    ----------
    rig
        The rig.
    identity
        (n, K) identity coefficients.
    weights
        (n, 52) blendshape weights in `facegen.conventions.BLENDSHAPES` order, meant to lie in [0, 1]; what
        recordings hold (-0.02 to 1.4) works too, lids stop where they touch.
    gaze
        (n, 2, 3) optical axes of both eyes in the head frame, the subject's left first; closed lids lie on
        the cornea.
    cage_only
        Leave out the vertices that only pictures need; those that hide keypoints stay (`facegen.rigs.occluder`).

    Raises
    ------
    InputError
        An array has another shape or holds values that are not finite.
    """
    identity, weights, gaze = (np.asarray(a, np.float64) for a in (identity, weights, gaze))
    people = len(identity)
    for name, array, shape in (
        ("identity", identity, (people, rig.components)),
        ("weights", weights, (people, len(rig.expression))),
        ("gaze", gaze, (people, 2, 3)),
    ):
        if array.shape != shape:
            raise InputError(
                f"{name} has shape {array.shape}, rig {rig.name!r} and {people} identities want {shape}"
            )
        if not np.isfinite(array).all():
            raise InputError(f"{name} holds values that are not finite numbers")
    gaze = gaze / np.sqrt(gaze[..., 0] ** 2 + gaze[..., 1] ** 2 + gaze[..., 2] ** 2)[..., None]
    padded = -(-people // CHUNK) * CHUNK
    kept = occluder(rig).vertices
    cage = np.empty((padded, len(kept), 3))
    eye_center, eye_radius = np.empty((people, 2, 3)), np.empty((people, 2))
    with one_blas_thread():
        for start in range(0, people, CHUNK):
            rows = slice(start, min(start + CHUNK, people))
            here = rows.stop - start
            who = np.resize(identity[rows], (CHUNK, rig.components))
            face = np.resize(weights[rows], (CHUNK, len(rig.expression)))
            np.matmul(
                np.concatenate([who, face, np.ones((CHUNK, 1))], axis=1),
                _cage_basis(rig),
                out=cage[start : start + CHUNK].reshape(CHUNK, -1),
            )
            center = who @ rig.eye_center_identity.reshape(-1, 6)
            eye_center[rows] = center.reshape(CHUNK, 2, 3)[:here] + rig.eye_center
            eye_radius[rows] = (who @ rig.eye_radius_identity)[:here] + rig.eye_radius
        vertices = cage[:people]
        if not cage_only:
            # one row at a time: only pictures need these vertices, and they need one face
            rest = [_beyond_cage(rig, *row) for row in zip(identity, weights, strict=True)]
            vertices = np.empty((people, *rig.vertices.shape))
            vertices[:, rig.cage_vertices :] = np.reshape(rest, vertices[:, rig.cage_vertices :].shape)
            vertices[:, kept] = cage[:people]
    close_lids(rig, vertices, weights=weights, eye_center=eye_center, eye_radius=eye_radius, gaze=gaze)
    return EvaluatedFaces(
        vertices=vertices,
        landmarks=_landmarks(rig, vertices),
        eye_center=eye_center,
        eye_radius=eye_radius,
    )


@lru_cache(maxsize=8)
def _cage_basis(rig: Rig) -> np.ndarray:
    """Rows (K + 53, 3 m) that identity, weights and a 1 multiply to give the m kept vertices with straight lids."""
    rows = np.concatenate([rig.identity, rig.expression, rig.vertices[None]])
    return np.ascontiguousarray(rows[:, occluder(rig).vertices].reshape(len(rows), -1))


def _beyond_cage(rig: Rig, identity: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """The other vertices (v, 3) of one face with straight lids."""
    rest = slice(rig.cage_vertices, None)
    base = rig.vertices[rest]
    moved = identity[None] @ rig.identity[:, rest].reshape(len(rig.identity), base.size)
    moved += weights[None] @ rig.expression[:, rest].reshape(len(rig.expression), base.size)
    return moved.reshape(-1, 3) + base


def _landmarks(rig: Rig, vertices: np.ndarray) -> np.ndarray:
    landmarks = np.zeros((len(vertices), len(rig.landmark_vertices), 3))
    for index, weight in zip(rig.landmark_vertices.T, rig.landmark_weights.T, strict=True):
        landmarks += weight[:, None] * vertices[:, index]
    clamp_contact(landmarks)
    return landmarks

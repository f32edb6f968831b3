"""Computes eyeball centres and neutral landmarks, which follow from identity alone."""

import numpy as np

from facegen.rigs.rig import Rig
from facegen.rigs.threads import one_blas_thread


def eye_centers(rig: Rig, identity: np.ndarray) -> np.ndarray:
    """Eyeball centres (n, 2, 3) of identities (n, K), subject's left first; head frame, metres."""
    # summed by einsum, not BLAS: a row's bits then depend on this row alone
    return rig.eye_center + np.einsum("nk,kec->nec", identity, rig.eye_center_identity)


def neutral_landmarks(rig: Rig, identity: np.ndarray) -> np.ndarray:
    """Landmarks (n, 68, 3) of neutral faces with identities (n, K); head frame, metres."""

    def picked(vertices: np.ndarray) -> np.ndarray:
        return np.einsum("ln,...lnc->...lc", rig.landmark_weights, vertices[..., rig.landmark_vertices, :])

    with one_blas_thread():
        return picked(rig.vertices) + np.einsum("nk,klc->nlc", identity, picked(rig.identity))

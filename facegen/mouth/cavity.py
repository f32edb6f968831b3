"""A pouch behind the lips for heads that have none: an open mouth would show the inside of the empty head."""

from functools import lru_cache

import numpy as np
import scipy

from facegen.conventions import LANDMARK_GROUPS, LOWER_LIP_SEAM, UPPER_LIP_SEAM, Part
from facegen.geometry.grids import ring_quads
from facegen.rigs import Rig

DEEP_M = 30e-3
"""A rig whose own cavity reaches this far behind the lips has one."""
AROUND, RINGS = 40, 12
LENGTH_M, HALF_WIDTH_M, UP_M, DOWN_M = 72e-3, 32e-3, 40e-3, 14e-3
"""Of the pouch: a little more than arches, palate and tongue take."""
CORNERS_M, CHIN_M = 14e-3, 22e-3
"""Its sides and its floor lie this far behind its middle, as cheeks and chin do: they would reach through the skin."""


@lru_cache(maxsize=8)
def has_own_cavity(rig: Rig) -> bool:
    """Whether faces of the rig's own close the mouth."""
    inside = np.setdiff1d(rig.faces[rig.part == Part.MOUTH_CAVITY], [-1])
    lip = np.einsum("ln,lnc->lc", rig.landmark_weights, rig.vertices[rig.landmark_vertices])[UPPER_LIP_SEAM]
    return bool(len(inside)) and bool(rig.vertices[inside, 2].min() < lip[2] - DEEP_M)


def cavity_surface(landmarks: np.ndarray, scale: float) -> tuple[np.ndarray, np.ndarray]:
    """The pouch of one face: vertices (V, 3), head frame, metres, and faces (F, 4) int32 that face the inside.

    It hangs on the inner border of the lips, landmarks 61 to 68 of ``landmarks`` (68, 3), and is ``scale`` times the
    size of a mean head's.
    """
    border = landmarks[list(LANDMARK_GROUPS["inner_lip"])]
    rim = scipy.interpolate.CubicSpline(
        np.arange(9), np.concatenate([border, border[:1]]), bc_type="periodic"
    )
    # from the subject's right corner over the upper lip to the left one, as the landmarks run
    ring = rim(np.arange(AROUND) * (8.0 / AROUND))
    middle = ring.mean(axis=0)
    turn = np.pi - np.arange(AROUND) * (2.0 * np.pi / AROUND)
    up = np.sin(turn)
    # measured from each lip: the mouth's middle falls when it opens, the palate does not
    lip = np.where(up > 0.0, landmarks[UPPER_LIP_SEAM, 1], landmarks[LOWER_LIP_SEAM, 1]) - middle[1]
    height = scale * np.where(up > 0.0, UP_M, DOWN_M) * up + lip * np.abs(up)
    behind = -scale * (CORNERS_M * np.cos(turn) ** 2 + CHIN_M * np.clip(-up, 0.0, None) ** 2)
    wide = np.stack([scale * HALF_WIDTH_M * np.cos(turn), height, behind], axis=-1)
    rings = []
    for share in np.linspace(0.0, 1.0, RINGS):
        blend = min(6.0 * share, 1.0) ** 0.5
        size = np.sqrt(1.0 - share**3)
        back = np.array([0.0, 0.0, -scale * (1e-3 + LENGTH_M * share)])
        rings.append(middle + back + size * ((1.0 - blend) * (ring - middle) + blend * wide))
    vertices = np.concatenate(rings)
    return vertices, ring_quads(RINGS, AROUND).astype(np.int32)

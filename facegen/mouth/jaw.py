"""The lower jaw's rigid motion in a rig whose blendshapes are linear."""

from functools import lru_cache

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, Part
from facegen.rigs import Rig

JAW_SHAPES = ("jawOpen", "jawForward", "jawLeft", "jawRight")
CHIN_LANDMARKS = (7, 8, 9)
CHIN_M = 20e-3
"""Reach of the skin about the chin that stands for the bone where a rig has no lower teeth."""


def jaw_motion(rig: Rig, identity: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """The rigid motion (4, 4) of one person's jaw from its rest, head frame.

    It is fitted [1]_ to what the four jaw shapes do to the rig's lower teeth, or to the skin of the chin where the rig
    has none. Other shapes move lips over the bone and do not count.

    Parameters
    ----------
    rig, identity, weights
        The rig, (K,) identity coefficients and (52,) blendshape weights.

    References
    ----------
    .. [1] W. Kabsch, "A solution for the best rotation to relate two sets of vectors", Acta Cryst. A32, 1976.
    """
    bone = bone_vertices(rig)
    shapes = [BLENDSHAPE_INDEX[name] for name in JAW_SHAPES]
    rest = rig.vertices[bone] + np.einsum("k,kvc->vc", identity, rig.identity[:, bone])
    moved = rest + np.einsum("k,kvc->vc", weights[shapes], rig.expression[np.ix_(shapes, bone)])
    return rigid_fit(rest, moved)


def rigid_fit(points: np.ndarray, moved: np.ndarray) -> np.ndarray:
    """The rotation and shift (4, 4) that bring ``points`` (n, 3) nearest to ``moved`` (n, 3) in the mean of squares."""
    middle, middle_moved = points.mean(axis=0), moved.mean(axis=0)
    u, _, vt = np.linalg.svd(np.einsum("ni,nj->ij", points - middle, moved - middle_moved))
    rotation = vt.T @ np.diag([1.0, 1.0, np.sign(np.linalg.det(vt.T @ u.T))]) @ u.T
    motion = np.eye(4)
    motion[:3, :3], motion[:3, 3] = rotation, middle_moved - rotation @ middle
    return motion


@lru_cache(maxsize=8)
def bone_vertices(rig: Rig) -> np.ndarray:
    """Vertices that move as the jaw does: the teeth that jawOpen moves, or the skin about the chin."""
    teeth = np.setdiff1d(rig.faces[rig.part == Part.TEETH], [-1])
    if len(teeth):
        reach = np.linalg.norm(rig.expression[BLENDSHAPE_INDEX["jawOpen"], teeth], axis=-1)
        if reach.max() > 0.0:
            return teeth[reach > 0.5 * reach.max()]
    points = np.einsum("ln,lnc->lc", rig.landmark_weights, rig.vertices[rig.landmark_vertices])
    skin = np.setdiff1d(rig.faces[rig.part == Part.SKIN], [-1])
    chin = points[list(CHIN_LANDMARKS)].mean(axis=0)
    return skin[np.linalg.norm(rig.vertices[skin] - chin, axis=-1) < CHIN_M]

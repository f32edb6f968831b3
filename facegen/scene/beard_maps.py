"""Maps a rig's mean face to regions where beards grow, which landmarks span, and to how hair lies in them."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from facegen.conventions import (
    CHIN,
    LEFT_JAW_END,
    LEFT_MOUTH_CORNER,
    LEFT_NOSE_WING,
    LOWER_LIP_BOTTOM,
    MIRRORED_LANDMARKS,
    NOSE_BASE,
    UPPER_LIP_TOP,
    Part,
)
from facegen.rigs import Rig

DENSER = 2.0
"""Of lip and chin beside cheeks and neck [1]_.

.. [1] G. Szabo, "The regional frequency and distribution of hair follicles in human skin", Adv. Biol. Skin 9, 1969.
"""
OFF_LIPS_M = 1.2e-3
"""Between the red of the lips and the nearest root."""
EDGE_M = 2.5e-3
"""Standard deviation by which single hairs stand outside a beard's outline, or are missing inside it."""
NEAR_M = 0.14
"""Of the middle of the jaw: what may bear a beard, and the cheeks and the neck about it."""
LINING_M = 7e-3
"""What lies this much further in than its neighbours is the lining of a mouth or a nose."""

LEFT_UPPER_LIP = list(range(UPPER_LIP_TOP, LEFT_MOUTH_CORNER + 1))
LEFT_LOWER_LIP = list(range(LOWER_LIP_BOTTOM, LEFT_MOUTH_CORNER - 1, -1))
"""From the middle of the outer line to the corner."""
LEFT_JAW_ANGLE = 12
LEFT_JAW = slice(LEFT_JAW_ANGLE, CHIN - 1, -1)
"""From its angle to the chin."""

BEARD_REGIONS = {
    "stubble": ("moustache", "chin", "beside", "cheeks"),
    "moustache": ("moustache",),
    "goatee": ("moustache", "chin", "beside"),
    "full": ("moustache", "chin", "beside", "cheeks"),
}
"""Kinds of beards, and the regions that they cover."""


@dataclass(frozen=True, kw_only=True, eq=False)
class BeardMap:
    """Skin of a rig's mean face on which beards may grow.

    Attributes
    ----------
    triangles, share
        (t, 3) vertex numbers and (t,) how many of the roots each bears, up to a factor.
    skin
        Triangles (s, 3) of skin and lips round it that strands must not enter.
    landmarks
        (68, 3), made symmetric, metres.
    """

    triangles: np.ndarray
    share: np.ndarray
    skin: np.ndarray
    landmarks: np.ndarray


@lru_cache(maxsize=8)
def beard_map(rig: Rig) -> BeardMap:
    """Where beards may grow on a rig: outer skin within 8 mm of the largest one's outline."""
    landmarks = (rig.landmark_weights[..., None] * rig.vertices[rig.landmark_vertices]).sum(axis=1)
    landmarks = 0.5 * (landmarks + landmarks[list(MIRRORED_LANDMARKS)] * (-1.0, 1.0, 1.0))
    triangles, part = _outer_triangles(rig, landmarks)
    corners = rig.vertices[triangles]
    inside, _ = margins(landmarks, corners.mean(axis=1))
    margin = np.maximum.reduce([inside[name] for name in BEARD_REGIONS["full"]])
    near, around = (part == Part.SKIN) & (margin > -8e-3), margin > -25e-3
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    dense = np.maximum.reduce([inside[name] for name in BEARD_REGIONS["goatee"]]) > -EDGE_M
    share = np.linalg.norm(across, axis=-1) * np.where(dense, DENSER, 1.0)
    return BeardMap(triangles=triangles[near], share=share[near], skin=triangles[around], landmarks=landmarks)


def _outer_triangles(rig: Rig, landmarks: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (t, 3) of skin and lips that nothing covers, seen from inside the head, and their parts (t,).

    The lining of a mouth lies a centimetre inside the cheek; a user's own head may call it skin.
    """
    chosen = np.isin(rig.part, (Part.SKIN, Part.LIPS))
    quads, part = rig.faces[chosen], rig.part[chosen]
    whole = quads[:, 3] >= 0
    triangles = np.concatenate([quads[:, :3], quads[whole][:, [0, 2, 3]]])
    part = np.concatenate([part, part[whole]])
    inmost = np.array(
        [
            0.0,
            landmarks[LEFT_MOUTH_CORNER, 1],
            0.5 * (landmarks[LEFT_MOUTH_CORNER, 2] + landmarks[LEFT_JAW_END, 2]),
        ]
    )
    away = rig.vertices[triangles].mean(axis=1) - inmost
    reach = np.linalg.norm(away, axis=-1)
    near = reach < NEAR_M
    triangles, part, away, reach = triangles[near], part[near], away[near], reach[near]
    neighbours = scipy.spatial.cKDTree(away / reach[:, None]).query(away / reach[:, None], k=12)[1]
    outer = reach > reach[neighbours].max(axis=1) - LINING_M
    return triangles[outer], part[outer]


def margins(landmarks: np.ndarray, points: np.ndarray) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """How far places (n, 3) of the mean face lie inside each region, metres (n,), and above the upper lip.

    Regions are bounded by lines that the landmarks span, as barbers know them: a moustache between nose, lip and the
    folds beside them; chin and soul patch below the lower lip; cheeks below a line from ear to mouth; a neck line
    2 cm under the jaw.
    """
    aside, y, z = np.abs(points[:, 0]), points[:, 1], points[:, 2]
    corner, wing, ear, chin = (landmarks[i] for i in (LEFT_MOUTH_CORNER, LEFT_NOSE_WING, LEFT_JAW_END, CHIN))
    upper, lower = landmarks[LEFT_UPPER_LIP], landmarks[LEFT_LOWER_LIP]
    lip_top = np.interp(aside, upper[:, 0], upper[:, 1])
    lip_bottom = np.interp(aside, lower[:, 0], lower[:, 1])
    front = z - (corner[2] - 14e-3)
    beside_lips = aside - corner[0]
    bare_lips = np.maximum.reduce([y - lip_top, lip_bottom - y, beside_lips]) - OFF_LIPS_M

    fold_x = [0.0, wing[0], corner[0] + 9e-3]
    fold = np.interp(aside, fold_x, [landmarks[NOSE_BASE, 1] - 4e-3, wing[1] - 4e-3, corner[1] + 4e-3])
    below_nose = np.where(aside < wing[0] + 3e-3, fold + 2e-3 - y, np.inf)
    moustache = np.minimum.reduce([fold - y, y - lip_top, corner[0] + 6e-3 - aside, front])
    # the soul patch reaches the lip, beside it skin is bare
    bare = np.interp(aside, [4e-3, 9e-3], [0.0, 7e-3])
    jaw = landmarks[LEFT_JAW]
    jaw_z = np.maximum.accumulate(jaw[:, 2])
    line = np.interp(z, jaw_z, jaw[:, 1])
    neck = y - (line - np.interp(z, jaw_z, [4e-3, 12e-3, 18e-3, 22e-3, 22e-3]))
    chin_width = np.interp(y, [chin[1], lip_bottom.min()], [0.95 * corner[0], 0.8 * corner[0]])
    chin_part = np.minimum.reduce(
        [lip_bottom - bare - y, chin_width - aside, y - (chin[1] - 12e-3), neck, front]
    )
    beside = np.minimum.reduce(
        [5.5e-3 - np.abs(beside_lips - 2e-3), corner[1] + 6e-3 - y, y - (chin[1] + 8e-3), front]
    )
    share = np.clip((corner[2] - 6e-3 - z) / (corner[2] - 6e-3 - (ear[2] + 14e-3)), 0.0, 1.0)
    cheek_line = corner[1] - 2e-3 + (ear[1] - corner[1]) * share**2.2
    # before the ear, and below it as far back as the jaw
    behind = z - (ear[2] + np.where(y > landmarks[LEFT_JAW_ANGLE + 1, 1], 5e-3, -4e-3))
    cheeks = np.minimum.reduce([cheek_line - y, neck, behind, aside - 0.75 * corner[0]])
    under = np.minimum.reduce([chin[1] + 4e-3 - y, neck, behind])
    regions = {
        "moustache": moustache,
        "chin": chin_part,
        "beside": beside,
        "cheeks": np.maximum(cheeks, under),
        "anything": np.minimum(bare_lips, below_nose),
    }
    return regions, y - lip_top


def combed(landmarks: np.ndarray, root: np.ndarray) -> np.ndarray:
    """Directions (n, 3) in which hair lies: down and a little forward, a moustache to its side."""
    corner = landmarks[LEFT_MOUTH_CORNER]
    above_mouth = np.clip((root[:, 1] - corner[1]) / 6e-3, 0.0, 1.0) * (np.abs(root[:, 0]) < corner[0] + 8e-3)
    aside = 0.9 * above_mouth * np.clip(root[:, 0] / (0.4 * corner[0]), -1.0, 1.0)
    return np.stack([aside, -np.ones(len(root)), np.full(len(root), 0.35)], axis=-1)

"""Measures neutral faces as callipers would: the distances that surveys of people publish (docs/population.md)."""

import numpy as np

from facegen.conventions import CHIN, LEFT_MOUTH_CORNER, NOSE_BASE, RIGHT_MOUTH_CORNER, Part
from facegen.rigs.neutral import eye_centers, neutral_landmarks
from facegen.rigs.rig import Rig

MEASURES = ("interpupillary distance", "face width", "face height", "mouth width", "nose length")
ARCH_M = (-0.037, -0.010)
"""Where along z callipers find the cheekbones' arches, the further end half way from the eye's corner to the ear."""
ROOT_M = 0.015
"""How far above and below the eyes the nose's root may lie."""
MIDDLE_M = 5e-4
"""Skin this near to the middle plane is of the profile."""


def measures_mm(rig: Rig, identity: np.ndarray) -> dict[str, np.ndarray]:
    """Lengths (n,) of the neutral faces of identities (n, K), by `MEASURES`.

    Face width is the widest place of the skin between the eyes and the nose's base; face height goes from the chin, and
    nose length from the nose's base, to the sellion: the deepest point of the nose's root. A rig without skin at these
    places lacks the measures.
    """
    points, eyes = 1e3 * neutral_landmarks(rig, identity), 1e3 * eye_centers(rig, identity)
    skin = np.unique(rig.faces[np.isin(rig.part, (Part.SKIN, Part.BROWS))])
    skin = skin[skin >= 0]
    x, y, z = rig.vertices[skin].T
    found = {
        "interpupillary distance": eyes[:, 0, 0] - eyes[:, 1, 0],
        "mouth width": np.linalg.norm(points[:, RIGHT_MOUTH_CORNER] - points[:, LEFT_MOUTH_CORNER], axis=1),
    }
    nose_m = 1e-3 * points[:, NOSE_BASE, 1].mean() if len(points) else 0.0
    cheek = skin[(y < 0) & (y > nose_m) & (z > ARCH_M[0]) & (z < ARCH_M[1])]
    if len(cheek):
        found["face width"] = np.ptp(_skin_mm(rig, identity, cheek)[..., 0], axis=1)
    profile = skin[(np.abs(x) < MIDDLE_M) & (np.abs(y) < ROOT_M) & (z > 0)]
    if len(profile):
        root = _skin_mm(rig, identity, profile)
        sellion = root[np.arange(len(root)), np.argmin(root[..., 2], axis=1)]
        found["face height"] = np.linalg.norm(sellion - points[:, CHIN], axis=1)
        found["nose length"] = np.linalg.norm(sellion - points[:, NOSE_BASE], axis=1)
    return {name: found[name] for name in MEASURES if name in found}


def _skin_mm(rig: Rig, identity: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Positions (n, v, 3) of some of the neutral faces' vertices, away from the lids."""
    # sizes in numbers: a user's own head has no identities, and NumPy guesses no size from nothing
    moved = identity @ rig.identity[:, vertices].reshape(rig.components, 3 * len(vertices))
    return 1e3 * (rig.vertices[vertices] + moved.reshape(len(identity), len(vertices), 3))

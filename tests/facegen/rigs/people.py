"""Inputs of rigs that the tests of this folder share."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.rigs import Rig

PEOPLE = 20


def people(rig: Rig, count: int = PEOPLE) -> np.ndarray:
    """Identity coefficients (count, K) of people within two sigma, the mean person first."""
    identity = np.clip(
        np.random.Generator(np.random.PCG64(3)).standard_normal((count, rig.components)), -2, 2
    )
    identity[0] = 0.0
    return identity


def weights(count: int, **values: float) -> np.ndarray:
    """Equal weights (count, 52); a name without its side, such as ``eyeBlink``, sets both sides."""
    rows = np.zeros((count, len(BLENDSHAPES)))
    for name, value in values.items():
        for full in (name, f"{name}Left", f"{name}Right"):
            if full in BLENDSHAPE_INDEX:
                rows[:, BLENDSHAPE_INDEX[full]] = value
    return rows


def straight(count: int) -> np.ndarray:
    """Gaze (count, 2, 3) straight ahead."""
    return np.tile((0.0, 0.0, 1.0), (count, 2, 1))

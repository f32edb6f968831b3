"""Couplings without jumps: what `restrain` would cut off at once is given up gradually."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.expression.couplings import EXCLUSIVE, TONGUE_NEEDS_JAW

TONGUE_OUT_WITHIN = 0.3
"""Beyond the least jawOpen, the tongue comes out over this much more of it."""

_JAW, _TONGUE = BLENDSHAPE_INDEX["jawOpen"], BLENDSHAPE_INDEX["tongueOut"]


def ease(weights: np.ndarray) -> np.ndarray:
    """Weights (n, 52) on which `facegen.expression.restrain` has no jump left to make; a copy.

    Of two shapes that exclude each other `restrain` drops the weaker one, so that both jump where they cross. Here each
    pair becomes one signed number: their difference, or for lids the way from wide open (-eyeWide) to closed (1).
    The tongue goes in as the jaw closes.
    """
    weights = weights.copy()
    for first, second in EXCLUSIVE:
        a, b = weights[:, BLENDSHAPE_INDEX[first]], weights[:, BLENDSHAPE_INDEX[second]]
        signed = a - b * (1 - a) if first.startswith("eyeBlink") else a - b
        weights[:, BLENDSHAPE_INDEX[first]] = np.maximum(signed, 0.0)
        weights[:, BLENDSHAPE_INDEX[second]] = np.maximum(-signed, 0.0)
    room = np.clip((weights[:, _JAW] - TONGUE_NEEDS_JAW) / TONGUE_OUT_WITHIN, 0.0, 1.0)
    weights[:, _TONGUE] = np.minimum(weights[:, _TONGUE], room)
    return weights

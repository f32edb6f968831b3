"""Couples shapes that exclude, limit or carry one another: what a face cannot do.

The limits hold on every frame of a recorded range-of-motion take (4,030 frames of one person; benchmarks/
bench_expressions.py says by how much frames of any take would be changed), and are what FACS and anatomy say.
"""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.expression.templates import CLOSING, columns

EXCLUSIVE: tuple[tuple[str, str], ...] = (
    ("jawLeft", "jawRight"),
    ("mouthLeft", "mouthRight"),
    ("mouthSmileLeft", "mouthFrownLeft"),
    ("mouthSmileRight", "mouthFrownRight"),
    ("eyeBlinkLeft", "eyeWideLeft"),
    ("eyeBlinkRight", "eyeWideRight"),
)
"""Pairs that no face shows together: the weaker one of each is dropped, both where they are equal."""

CLOSE_BEYOND_JAW = 0.06
"""mouthClose passes jawOpen by no more than this (0.058 at most in the range-of-motion take, above it in half)."""

TONGUE_NEEDS_JAW = 0.4
"""tongueOut with less jawOpen pushes the tongue through the lips (measured on the default rig)."""

MEETING = (
    "mouthRollLower",
    "mouthRollUpper",
    "mouthPressLeft",
    "mouthPressRight",
    "mouthShrugLower",
    "cheekPuff",
)
"""Shapes that need lips which meet, or nearly."""
MEETING_FALLS, MEETING_REST = 1.25, 0.06
"""They reach 1 - 1.25 x (jawOpen - mouthClose), and 0.06 in the widest mouth: recorded frames stay well below."""

OPPOSED = (
    ("mouthRollUpper", ("mouthUpperUp",)),
    ("mouthRollLower", ("mouthLowerDown",)),
    ("mouthShrugLower", ("mouthLowerDown",)),
    ("mouthPress", ("mouthLowerDown",)),
    ("mouthPucker", ("mouthSmile", "mouthStretch")),
)
"""Shapes with the shapes that pull the same lip another way: two of them add up to 1 at most (0.64 to 0.91 recorded);
the first gives way."""

ANTAGONISTS = (
    ("mouthFrown", ("mouthSmile", "mouthUpperUp")),
    ("mouthPucker", ("mouthSmile", "mouthStretch")),
    ("mouthFunnel", ("mouthSmile",)),
    ("mouthSmile", ("mouthFunnel", "mouthPucker")),
    ("mouthDimple", ("mouthLowerDown", "mouthFunnel", "mouthPucker")),
    ("mouthShrugLower", ("mouthLowerDown",)),
    ("mouthPress", ("mouthLowerDown",)),
    ("mouthRollLower", ("mouthLowerDown",)),
    ("mouthRollUpper", ("mouthUpperUp",)),
    ("cheekPuff", ("mouthLowerDown", "mouthSmile")),
)
"""Shapes that fade in living faces as their antagonists work (r = -0.3 to -0.65 in the range-of-motion take)."""
FADES = 1.5
"""Share of a shape that goes per weight of its strongest antagonist: nothing is left from 2/3 on."""

_JAW, _TONGUE = BLENDSHAPE_INDEX["jawOpen"], BLENDSHAPE_INDEX["tongueOut"]


def close_lips(weights: np.ndarray, *, beyond: np.ndarray) -> None:
    """Turn the closing in the column of mouthClose (see `templates`) into mouthClose, in place.

    Parameters
    ----------
    weights
        (n, 52) with a share of jawOpen in the column `CLOSING`.
    beyond
        (n,) 0 to `CLOSE_BEYOND_JAW`: how far lips that are closed are closed more than jawOpen opens them.
    """
    weights[:, CLOSING] *= np.minimum(weights[:, _JAW] + beyond, 1.0)


def fade(weights: np.ndarray) -> np.ndarray:
    """Weights (n, 52) of living faces, each shape weaker the more its `ANTAGONISTS` work; a copy."""
    faded = weights.copy()
    for name, others in ANTAGONISTS:
        against = weights[:, [column for other in others for column in columns(other)]].max(axis=1)
        for column in columns(name):
            faded[:, column] *= np.clip(1 - FADES * against, 0, 1)
    return faded


def restrain(weights: np.ndarray) -> np.ndarray:
    """Weights (n, 52) without what a face cannot show; a copy. Doing it twice changes nothing."""
    weights = weights.copy()
    for first, second in EXCLUSIVE:
        a, b = BLENDSHAPE_INDEX[first], BLENDSHAPE_INDEX[second]
        difference = weights[:, a] - weights[:, b]
        weights[difference <= 0, a] = 0.0
        weights[difference >= 0, b] = 0.0
    jaw = weights[:, _JAW]
    weights[:, CLOSING] = np.minimum(weights[:, CLOSING], jaw + CLOSE_BEYOND_JAW)
    weights[jaw <= TONGUE_NEEDS_JAW, _TONGUE] = 0.0
    limit = np.clip(1 - MEETING_FALLS * (jaw - weights[:, CLOSING]), MEETING_REST, 1.0)
    for name in MEETING:
        index = BLENDSHAPE_INDEX[name]
        weights[:, index] = np.minimum(weights[:, index], limit)
    for name, others in OPPOSED:
        left = 1 - weights[:, [column for other in others for column in columns(other)]].max(axis=1)
        for column in columns(name):
            weights[:, column] = np.minimum(weights[:, column], left)
    return weights


def follow_gaze(weights: np.ndarray, *, down: np.ndarray, up: np.ndarray) -> None:
    """Let the lids follow eyes that look up or down, in place.

    The rigs' eyeLook* shapes carry the lids already; a tracker says a part of it as eyeBlink or eyeWide as well
    (in the range-of-motion take eyeBlink is about 0.7 of eyeLookDown, and rises with it by r = 0.33).

    Parameters
    ----------
    weights
        (n, 52) with the eyeLook* weights in them.
    down, up
        (n,) shares of eyeLookDown and of eyeLookUp that are added to eyeBlink and eyeWide.
    """
    for side in ("Left", "Right"):
        for looks, lid, share in (("eyeLookDown", "eyeBlink", down), ("eyeLookUp", "eyeWide", up)):
            column = BLENDSHAPE_INDEX[lid + side]
            follows = share * weights[:, BLENDSHAPE_INDEX[looks + side]]
            weights[:, column] = 1 - (1 - weights[:, column]) * (1 - follows)

"""How faces move: a mixture of sparse and dense random combinations that keep to what a face can do."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, mirrored_name
from facegen.spec import Spec

EXCLUSIVE: tuple[tuple[str, str], ...] = (
    ("jawLeft", "jawRight"),
    ("mouthLeft", "mouthRight"),
    ("mouthFunnel", "mouthPucker"),
    ("mouthSmileLeft", "mouthFrownLeft"),
    ("mouthSmileRight", "mouthFrownRight"),
    ("eyeBlinkLeft", "eyeWideLeft"),
    ("eyeBlinkRight", "eyeWideRight"),
    ("eyeSquintLeft", "eyeWideLeft"),
    ("eyeSquintRight", "eyeWideRight"),
)
"""Pairs that no face shows together: the weaker one of each is dropped."""

TONGUE_NEEDS_JAW = 0.4
"""tongueOut with less jawOpen pushes the tongue through the lips (measured on the default rig)."""

_FROM_GAZE = tuple(index for index, name in enumerate(BLENDSHAPES) if name.startswith("eyeLook"))
_LEFT = tuple(
    index
    for index, name in enumerate(BLENDSHAPES)
    if name.endswith("Left") and name not in ("jawLeft", "mouthLeft")
)
_RIGHT = tuple(BLENDSHAPE_INDEX[mirrored_name(BLENDSHAPES[index])] for index in _LEFT)


def draw_expression(spec: Spec, rng: np.random.Generator, size: int) -> np.ndarray:
    """Weights (size, 52) in [0, 1]; the eyeLook* weights are left at 0, they follow from the gaze."""
    settings = spec.expression
    shapes = len(BLENDSHAPES)
    is_sparse = rng.random(size) < settings.sparse
    fewest, most = settings.sparse_shapes
    count = rng.integers(fewest, most + 1, size)
    rank = rng.random((size, shapes)).argsort(axis=1).argsort(axis=1)
    # gaze shapes take part in the ranking, so a sparse face may have fewer active shapes than drawn
    active_sparse = rank < count[:, None]
    active_dense = rng.random((size, shapes)) < settings.dense_active
    strength = rng.random((size, shapes)) * np.where(is_sparse, 1.0, settings.dense_scale)[:, None]
    weights = np.where(np.where(is_sparse[:, None], active_sparse, active_dense), strength, 0.0)
    symmetric = rng.random(size) < settings.symmetric
    weights[np.ix_(symmetric, _RIGHT)] = weights[np.ix_(symmetric, _LEFT)]
    weights[:, _FROM_GAZE] = 0.0
    return restrain(weights)


def restrain(weights: np.ndarray) -> np.ndarray:
    """Weights (n, 52) without the combinations that a face cannot show; a copy.

    The weaker of each `EXCLUSIVE` pair is dropped, mouthClose closes no more than jawOpen opens, and the tongue
    comes out of an open mouth only.
    """
    weights = weights.copy()
    for first, second in EXCLUSIVE:
        a, b = BLENDSHAPE_INDEX[first], BLENDSHAPE_INDEX[second]
        keep_first = weights[:, a] >= weights[:, b]
        weights[~keep_first, a] = 0.0
        weights[keep_first, b] = 0.0
    jaw = weights[:, BLENDSHAPE_INDEX["jawOpen"]]
    close, tongue = BLENDSHAPE_INDEX["mouthClose"], BLENDSHAPE_INDEX["tongueOut"]
    weights[:, close] = np.minimum(weights[:, close], jaw)
    weights[jaw < TONGUE_NEEDS_JAW, tongue] = 0.0
    return weights

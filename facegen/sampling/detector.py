"""Draws how a landmark detector errs: bias that stays on a person, jitter, parts found elsewhere, no face at all.

Bias and jitter are measured apart (two detectors and one tracked face): two detectors disagree by a constant of 2.4 %
of the outer-eye distance at the eyes, 3.1 % at the nose, 3.2 % at the lips, 6.0 % at the brows and 8.3 % at the jaw,
because they mean different points; the frame-to-frame jitter of either is about 0.1 %.
"""

import numpy as np

from facegen.conventions import (
    BIAS_ALONE,
    BIAS_BENDS,
    BIAS_SMOOTH,
    BIAS_TOGETHER,
    BLOCK,
    DETECTOR_DISAGREEMENT,
    LANDMARK_COUNT,
    LANDMARK_GROUPS,
)
from facegen.randomness import stream
from facegen.sampling.blocks import blocks_of
from facegen.spec import Landmarks

OUTER_EYES_FACE_WIDTHS = 0.62
"""Distance of landmarks 36 and 45 as a share of that of 0 and 16, on the default rig's mean face."""

OUTLIER_FACE_WIDTHS = 0.05
"""Standard deviation of how far off a part is found: a brow's other edge, the collar for the jaw."""

RUN = 6.0
"""Frames without a face in a row, on average, in clips: 0.1 to 0.2 s, a hand or a fast turn."""


def draw_detector_noise(
    landmarks: Landmarks, seed: int, block: int, *, person: np.ndarray, rotation: np.ndarray
) -> np.ndarray:
    """Displacements (1,000, 68, 2) of a block's landmarks: shares of the face's width in the picture, x right, y down.

    Parameters
    ----------
    landmarks
        The spec's ``[landmarks]``.
    seed, block
        What the draws of frames are keyed by; those of people are keyed by their own blocks.
    person
        (1,000,) numbers of the people.
    rotation
        (1,000, 3, 3) of the heads: the bias turns with the face.
    """
    jitter = stream(seed, "detector", block).standard_normal((BLOCK, LANDMARK_COUNT, 2))
    noise = jitter * landmarks.noise_face_widths
    if landmarks.bias > 0:
        noise += along_face(landmarks.bias * _bias_of(seed, person), rotation)
    if landmarks.outliers > 0:
        rng = stream(seed, "detector outliers", block)
        is_outlier = rng.random((BLOCK, len(LANDMARK_GROUPS))) < landmarks.outliers
        shift = OUTLIER_FACE_WIDTHS * rng.standard_normal((BLOCK, len(LANDMARK_GROUPS), 2))
        for number, group in enumerate(LANDMARK_GROUPS.values()):
            noise[:, list(group)] += (is_outlier[:, number, None] * shift[:, number])[:, None]
    return noise


def draw_bias(rng: np.random.Generator, size: int) -> np.ndarray:
    """What a detector puts its points beside the truth by on ``size`` people.

    Returns
    -------
    (size, 68, 2) float64
        Face widths; x along the eyes towards the subject's left, y down.
    """
    bias = np.empty((size, LANDMARK_COUNT, 2))
    for group, numbers in LANDMARK_GROUPS.items():
        along = (np.arange(len(numbers)) + 0.5) / len(numbers)
        bends = np.sqrt(2) * np.cos(np.pi * np.outer(np.arange(1, BIAS_BENDS + 1), along))
        shape = np.sqrt(BIAS_TOGETHER) * rng.standard_normal((size, 1, 2))
        shape = shape + np.sqrt(BIAS_ALONE) * rng.standard_normal((size, len(numbers), 2))
        shape += np.sqrt(BIAS_SMOOTH / BIAS_BENDS) * np.einsum(
            "cbd,bn->cnd", rng.standard_normal((size, BIAS_BENDS, 2)), bends
        )
        bias[:, list(numbers)] = shape * (DETECTOR_DISAGREEMENT[group] * OUTER_EYES_FACE_WIDTHS / np.sqrt(2))
    return bias


def along_face(offsets: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """Offsets (n, 68, 2) along faces as offsets in the picture, for heads turned by (n, 3, 3)."""
    across = np.stack([rotation[:, 0, 0], -rotation[:, 1, 0]], axis=-1)  # the camera's y points down
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    down = np.stack([-across[:, 1], across[:, 0]], axis=-1)
    return offsets[..., :1] * across[:, None] + offsets[..., 1:] * down[:, None]


def draw_dropped(rng: np.random.Generator, size: int, *, share: float, run: float) -> np.ndarray:
    """(size,) bool: frames without a face, a share of all, in runs of ``run`` frames on average."""
    if share == 0:
        return np.zeros(size, bool)
    # runs without and with a face in turn, of geometric lengths; as many as are surely enough
    gaps = rng.geometric(share / (run * (1 - share)), size)
    runs = rng.geometric(1 / run, size)
    # of a gap without end what is seen
    lengths = np.minimum(np.stack([gaps, runs], axis=-1).ravel(), 2 * size)
    begin = rng.integers(0, size)  # anywhere in the middle: the first frame is no beginning
    # counted, not listed frame by frame: a small share's gaps would not fit into memory
    return np.searchsorted(np.cumsum(lengths), np.arange(begin, begin + size), side="right") % 2 == 1


def _bias_of(seed: int, person: np.ndarray) -> np.ndarray:
    """Bias (n, 68, 2) of people by number (n,); whole blocks of people are drawn, then picked from."""
    blocks, row = blocks_of(person)
    return np.concatenate([draw_bias(stream(seed, "detector bias", b), BLOCK) for b in blocks])[row]

"""Makes training targets: 52 weights and four gaze angles, as z-scores that mirroring leaves alone."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.learning.headset.arrays import HeadsetArrays
from regress.runtime.headset.network.outputs import MIRROR, MIRROR_SIGN
from regress.runtime.headset.network.parts import part_of

_LEAST_STD = 0.02
"""A shape that hardly moves in the data would count as much as all others otherwise."""


@dataclass(frozen=True, kw_only=True)
class Targets:
    """Mean and standard deviation (56,) float32 of the outputs over training frames and their mirror images."""

    mean: np.ndarray
    std: np.ndarray


def outputs_of(arrays: HeadsetArrays) -> np.ndarray:
    """(n, 56) float32: weights and gaze angles of every row."""
    return np.concatenate([arrays.weights, arrays.gaze], axis=1).astype(np.float32)


def target_scale(outputs: np.ndarray) -> Targets:
    """Scale of (n, 56) outputs; both sides of the face share theirs, so that encoders can be shared."""
    both = np.concatenate([outputs, outputs[:, MIRROR] * MIRROR_SIGN]).astype(np.float64)
    std = np.maximum(both.std(axis=0), _LEAST_STD)
    return Targets(mean=both.mean(axis=0).astype(np.float32), std=std.astype(np.float32))


def part_mask(camera: str) -> np.ndarray:
    """(56,) bool: outputs of a camera's part; an eye's gaze belongs to the cameras of its side."""
    part = part_of(camera)
    eyes = [f"eyeBlink{side}" in part for side in ("Left", "Left", "Right", "Right")]
    return np.array([name in part for name in BLENDSHAPES] + eyes)

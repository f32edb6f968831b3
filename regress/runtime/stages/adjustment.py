"""What people change by taste: gain, offset, dead zone and limits by shape; mirror; symmetry."""

from dataclasses import dataclass, fields

import numpy as np

from facegen.conventions import BLENDSHAPES, MIRRORED_BLENDSHAPES

_DIRECTIONS = ("eyeLookIn", "eyeLookOut", "jawLeft", "jawRight", "mouthLeft", "mouthRight")
"""Shapes whose partner means the other direction: a mean of the two would stop gaze and jaw."""


@dataclass(frozen=True, kw_only=True)
class ShapeAdjustment:
    """``limits(gain * dead_zone(weight + offset))`` of one shape.

    Parameters
    ----------
    gain, offset
        Factor and addend.
    dead_zone
        Weights up to this become 0; those above are stretched, so that 1 stays 1.
    low, high
        Limits of the result.
    """

    gain: float = 1.0
    offset: float = 0.0
    dead_zone: float = 0.0
    low: float = 0.0
    high: float = 1.0


def adjust(weights: np.ndarray, adjustments: dict[str, ShapeAdjustment]) -> np.ndarray:
    """Weights (n, 52) after each shape's adjustment; rows of NaN stay NaN."""
    chosen = [adjustments.get(name, adjustments.get("*", ShapeAdjustment())) for name in BLENDSHAPES]
    gain, offset, dead, low, high = (
        np.array([getattr(entry, field.name) for entry in chosen]) for field in fields(ShapeAdjustment)
    )
    moved = weights + offset
    moved = np.where(dead > 0, np.maximum(moved - dead, 0) / (1 - dead), moved)
    return np.clip(gain * moved, low, high)


def mirror(weights: np.ndarray) -> np.ndarray:
    """Left and right exchanged: what a mirror shows."""
    return weights[:, list(MIRRORED_BLENDSHAPES)]


def blend_sides(weights: np.ndarray, share: float) -> np.ndarray:
    """Left and right brought together: 0 leaves them, 1 gives both their mean.

    Gaze and what moves sideways keep their direction.
    """
    partner = mirror(weights)
    sided = [not name.startswith(_DIRECTIONS) for name in BLENDSHAPES]
    return np.where(sided, weights + share / 2 * (partner - weights), weights)

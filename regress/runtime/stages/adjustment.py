"""What people change by taste: gain, offset, dead zone and limits by shape; mirror; symmetry."""

import json
import os
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPES, MIRRORED_BLENDSHAPES
from regress.errors import InputError

FORMAT = "regress-adjustment"

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


def read_adjustments(path: str | os.PathLike[str]) -> dict[str, ShapeAdjustment]:
    """Read an adjustment file: JSON with ``format``, and under ``shapes`` a ShapeAdjustment by name.

    The name ``"*"`` stands for every shape that is not named.

    Raises
    ------
    InputError
        Where the file is missing or says something that is not known.
    """
    path = Path(path)
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{path} is not a readable JSON file: {error}") from error
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise InputError(f'{path} is not an adjustment file: "format" must be "{FORMAT}"')
    shapes = document.get("shapes", {})
    if not isinstance(shapes, dict):
        raise InputError(f"{path}: shapes must be an object of names")
    return {name: _adjustment(entry, name, path) for name, entry in shapes.items()}


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


def _adjustment(entry: Any, name: str, path: Path) -> ShapeAdjustment:
    if name != "*" and name not in BLENDSHAPES:
        raise InputError(f"{path}: shapes.{name} is not one of the 52 ARKit names, nor *")
    known = [field.name for field in fields(ShapeAdjustment)]
    if not isinstance(entry, dict):
        raise InputError(f"{path}: shapes.{name} must be an object with any of {', '.join(known)}")
    for key, value in entry.items():
        if key not in known:
            raise InputError(f"{path}: shapes.{name}.{key} is not known; known are {', '.join(known)}")
        if isinstance(value, bool) or not isinstance(value, int | float) or not np.isfinite(value):
            raise InputError(f"{path}: shapes.{name}.{key} is {value!r}; a number is needed")
    adjustment = ShapeAdjustment(**entry)
    if not 0 <= adjustment.dead_zone < 1:
        raise InputError(
            f"{path}: shapes.{name}.dead_zone is {adjustment.dead_zone}; 0 to below 1 is allowed"
        )
    if adjustment.low > adjustment.high:
        raise InputError(f"{path}: shapes.{name} has low {adjustment.low} above high {adjustment.high}")
    return adjustment

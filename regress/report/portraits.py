"""Draws faces by their 68 points."""

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from regress.report.svg import picture

_SIDE = 150.0
_CLOSED = ("right_eye", "left_eye", "outer_lip", "inner_lip")


def portrait(points: np.ndarray, description: str) -> str:
    """A face (68, 2), pixels with y down, as SVG: one line for each part of it."""
    low, high = points.min(axis=0), points.max(axis=0)
    scale = (_SIDE - 12) / (high - low).max()
    placed = (points - (low + high) / 2) * scale + _SIDE / 2
    lines = []
    for group, numbers in LANDMARK_GROUPS.items():
        corners = "L".join(f"{x:.1f} {y:.1f}" for x, y in placed[list(numbers)])
        lines.append(f'<path class="face" d="M{corners}{"Z" if group in _CLOSED else ""}"/>')
    dots = "".join(f"M{x:.1f} {y:.1f}h0" for x, y in placed)
    return picture(_SIDE, _SIDE, [*lines, f'<path class="dots" d="{dots}"/>'], description)

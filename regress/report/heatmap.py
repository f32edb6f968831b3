"""Draws tables of numbers as shaded cells."""

from collections.abc import Sequence
from html import escape

import numpy as np

from regress.report.axes import figure, label
from regress.report.svg import picture, text, upright_text

CELL = 15
_NAMES = 132


def pose_map(values: np.ndarray, *, yaw_deg: Sequence[float], pitch_deg: Sequence[float], most: float) -> str:
    """Errors (P, Y) by pitch, upwards at the top, and yaw; shade is the error against ``most``."""
    width, height, left, top = 54, 34, 44, 8
    parts = []
    for row, pitch in enumerate(reversed(pitch_deg)):
        y = top + row * height
        parts.append(text(left - 8, y + height / 2 + 4, f"{label(pitch)}°", "tick end"))
        for column, value in enumerate(values[len(pitch_deg) - 1 - row]):
            x = left + column * width
            opacity = 0.04 + 0.66 * min(max(value / most, 0.0), 1.0)
            parts.append(_cell(x, y, width, height, "less", opacity))
            parts.append(text(x + width / 2, y + height / 2 + 4, figure(value), "number middle"))
    bottom = top + len(pitch_deg) * height
    for column, yaw in enumerate(yaw_deg):
        parts.append(text(left + (column + 0.5) * width, bottom + 16, f"{label(yaw)}°", "tick middle"))
    return picture(
        left + len(yaw_deg) * width + 2, bottom + 24, parts, "Error by pitch (rows) and yaw (columns)"
    )


def leak_map(change: np.ndarray, names: Sequence[str], *, full: float) -> str:
    """Changes (O, O) of outputs, columns, when shapes, rows, move by ``full``; below 0.02 a cell stays empty."""
    top = _NAMES
    parts = []
    for row, name in enumerate(names):
        y = top + row * CELL
        parts.append(text(_NAMES - 6, y + 11, name, "small end"))
        parts.append(upright_text(_NAMES + row * CELL + 11, top - 6, name, "small"))
        for column, value in enumerate(change[row]):
            if abs(value) >= 0.02:
                title = f"{name} moves {names[column]} by {value:+.2f}"
                # leaks of a tenth stay visible beside the diagonal
                shade = min(abs(value) / full, 1.0) ** 0.7
                kind = "more" if value > 0 else "less"
                parts.append(_cell(_NAMES + column * CELL, y, CELL, CELL, kind, shade, title))
    end = top + len(names) * CELL
    frame = f'<rect class="frame" x="{_NAMES}" y="{top}" width="{end - top}" height="{end - top}"/>'
    return picture(
        _NAMES + len(names) * CELL + 4, end + 4, [frame, *parts], "Which shape leaks into which output"
    )


def _cell(
    x: float, y: float, width: float, height: float, kind: str, opacity: float, title: str | None = None
) -> str:
    rectangle = (
        f'<rect class="{kind}" fill-opacity="{opacity:.2f}" x="{x + 0.5:.1f}" y="{y + 0.5:.1f}" '
        f'width="{width - 1:.1f}" height="{height - 1:.1f}"'
    )
    return f"{rectangle}/>" if title is None else f"{rectangle}><title>{escape(title)}</title></rect>"

"""Draws the error of headset networks over the number of people that they learned from."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regress.report.axes import Scale, label
from regress.report.svg import line, picture, text
from regress.runtime.headset.network.figures import Evaluation

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 900, 300, 52, 150, 14, 46
SERIES = (("uncalibrated", "test", "no neutral picture"), ("same_seat", "train", "neutral picture"))
"""Condition, class of its curve, words."""


@dataclass(frozen=True, kw_only=True)
class CurvePoint:
    """A model that was trained on so many people and frames (rows), and its figures."""

    title: str
    people: int
    rows: int
    figures: Evaluation


def people_curve(points: Sequence[CurvePoint]) -> str:
    """Geometry error in mm, without and with a neutral picture, over people (logarithmic).

    Parameters
    ----------
    points
        In any order.
    """
    points = sorted(points, key=lambda point: (point.people, point.rows))
    people = np.array([point.people for point in points], float)
    series = [
        (
            kind,
            words,
            np.array([_error_mm(point, name) for point in points]),
        )
        for name, kind, words in SERIES
    ]
    highest = np.nanmax([errors for *_, errors in series])
    x = Scale(low=people[0] * 0.9, high=people[-1] * 1.1, start=LEFT, stop=WIDTH - RIGHT, logarithmic=True)
    y = Scale(low=0.0, high=float(highest) * 1.1, start=HEIGHT - BOTTOM, stop=TOP)
    parts = []
    for tick in y.ticks():
        parts.append(line(LEFT, y(tick), WIDTH - RIGHT, y(tick), "grid"))
        parts.append(text(LEFT - 6, y(tick) + 4, label(tick), "tick end"))
    for count in sorted(set(people)):
        parts.append(text(x(count), HEIGHT - BOTTOM + 18, label(count), "tick middle"))
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(text(middle, HEIGHT - 8, "people learned from; error in mm upwards", "tick middle"))
    for kind, words, errors in series:
        measured = np.isfinite(errors)
        if measured.any():
            corners = list(zip(x(people[measured]), y(errors[measured]), strict=True))
            path = "L".join(f"{a:.1f} {b:.1f}" for a, b in corners)
            parts.append(f'<path class="curve {kind}" d="M{path}"/>')
            parts += [f'<circle class="label {kind}" cx="{a:.1f}" cy="{b:.1f}" r="3.5"/>' for a, b in corners]
            parts.append(text(WIDTH - RIGHT + 8, corners[-1][1] + 4, words, f"label {kind}"))
    return picture(WIDTH, HEIGHT, parts, "Error by people learned from")


def _error_mm(point: CurvePoint, condition: str) -> float:
    summary = point.figures.conditions.get(condition)
    return np.nan if summary is None else summary.geometry_mm

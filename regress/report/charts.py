"""Draws the report's figures as SVG text: in classes, so that the page's style decides the colours."""

from collections.abc import Sequence

import numpy as np

from regress.report.axes import Scale, label
from regress.report.content import LearningCurve, RegressionPlot
from regress.report.svg import line, picture, text, upright_text

SMALLEST_ERROR = 1e-4
"""Errors below are drawn here: a shape that never moves has error 0, which no logarithm shows."""


def error_range(curves: Sequence[LearningCurve]) -> tuple[float, float]:
    """Lower and upper end of an axis that shows all of the curves."""
    errors = [values for curve in curves for values in (curve.train, curve.validation, curve.test)]
    errors = np.maximum(np.concatenate([[SMALLEST_ERROR], *errors])[1:], SMALLEST_ERROR)
    return float(errors.min() * 0.9), float(errors.max() * 1.1)


def learning_curves(curve: LearningCurve) -> str:
    """Training, validation and test error against steps, logarithmic, with the chosen step marked."""
    width, height, left, bottom = 560, 300, 52, 46
    low, high = error_range([curve])
    parts = _curve_parts(curve, (left, 14, width - 112, height - bottom), large=True, low=low, high=high)
    return picture(width, height, parts, f"Learning curves, {curve.name}")


def small_curves(curve: LearningCurve, *, low: float, high: float) -> str:
    """The same, small, to stand in a grid: one range of errors for all."""
    box = (30, 20, 206, 112)
    parts = _curve_parts(curve, box, large=False, low=low, high=high)
    return picture(214, 132, [text(30, 12, curve.name, "name"), *parts], f"Learning curves of {curve.name}")


def _curve_parts(curve: LearningCurve, box, *, large: bool, low: float, high: float) -> list[str]:
    left, top, right, bottom = box
    series = {"train": curve.train, "validation": curve.validation, "test": curve.test}
    y = Scale(low=low, high=high, start=bottom, stop=top, logarithmic=True)
    steps = max(len(curve.train) - 1, 1)
    x = Scale(low=0, high=steps, start=left, stop=right)
    parts = []
    for tick in y.ticks():
        parts.append(line(left, y(tick), right, y(tick), "grid"))
        if large or f"{tick:e}"[0] == "1":
            parts.append(text(left - 6, y(tick) + 4, label(tick), "tick end"))
    for tick in x.ticks(6) if large else (0, steps):
        if tick == int(tick):
            parts.append(text(x(tick), bottom + (18 if large else 14), label(tick), "tick middle"))
    if curve.best_step is not None:
        parts.append(line(x(curve.best_step), top, x(curve.best_step), bottom, "chosen"))
    for name, values in series.items():
        if len(values):
            corners = zip(x(np.arange(len(values))), y(np.asarray(values)), strict=True)
            path = "L".join(f"{a:.1f} {b:.1f}" for a, b in corners)
            parts.append(f'<path class="curve {name}" d="M{path}"/>')
    if large:
        parts += _end_labels(series, y, right)
        parts.append(text((left + right) / 2, bottom + 38, "Levenberg-Marquardt step", "tick middle"))
    return parts


def _end_labels(series: dict[str, np.ndarray], y: Scale, right: float) -> list[str]:
    """Names at the curves' ends, kept 15 units apart where curves end close together."""
    ends = sorted((float(y(values[-1])), name) for name, values in series.items() if len(values))
    parts, last = [], -np.inf
    for place, name in ends:
        last = max(place, last + 15)
        parts.append(text(right + 8, last + 4, name, f"label {name}"))
    return parts


PANEL = 280
PANEL_SHADES = 9


def regression_panel(plot: RegressionPlot) -> str:
    """Predicted against true weights as a density, with the line of equality and the best fit."""
    low, high = -0.03, 1.03
    x = Scale(low=low, high=high, start=38, stop=PANEL - 6)
    y = Scale(low=low, high=high, start=PANEL - 40, stop=8)
    ticks = (0, 0.25, 0.5, 0.75, 1)
    parts = [line(x(tick), y(low), x(tick), y(high), "grid") for tick in ticks]
    parts += [line(x(low), y(tick), x(high), y(tick), "grid") for tick in ticks]
    parts += _density(plot.counts, x, y)
    parts.append(line(x(0), y(0), x(1), y(1), "equal"))
    if np.isfinite(plot.slope):
        start, stop = plot.intercept, plot.intercept + plot.slope
        parts.append(line(x(0), y(start), x(1), y(stop), "fit"))
    parts += [text(x(tick), PANEL - 24, label(tick), "tick middle") for tick in ticks]
    parts += [text(32, y(tick) + 4, label(tick), "tick end") for tick in ticks]
    parts.append(text((x(low) + x(high)) / 2, PANEL - 6, "true weight", "tick middle"))
    parts.append(upright_text(9, (y(low) + y(high)) / 2, "predicted", "tick middle"))
    return picture(PANEL, PANEL, parts, f"Predicted against true weights, {plot.split} faces")


def _density(counts: np.ndarray, x: Scale, y: Scale) -> list[str]:
    """Cells in a few shades, one path a shade; shades follow the logarithm of the count."""
    shades = np.log1p(counts) / np.log1p(max(counts.max(), 1))
    shades = np.minimum(np.ceil(PANEL_SHADES * shades), PANEL_SHADES).astype(int)
    centres = np.linspace(0, 1, len(counts))
    width, height = x(centres[1]) - x(0), y(0) - y(centres[1])
    parts = []
    for shade in range(1, PANEL_SHADES + 1):
        cells = "".join(
            f"M{x(centres[i]) - width / 2:.1f} {y(centres[j]) - height / 2:.1f}"
            f"h{width:.2f}v{height:.2f}h-{width:.2f}z"
            for i, j in np.argwhere(shades == shade)
        )
        if cells:
            opacity = 0.06 + 0.94 * shade / PANEL_SHADES
            parts.append(f'<path class="cell" fill-opacity="{opacity:.2f}" d="{cells}"/>')
    return parts

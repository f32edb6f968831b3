"""Draws how values spread over people."""

import numpy as np

from regress.report.axes import Scale, label
from regress.report.svg import line, picture, text


def histogram(values: np.ndarray, *, bins: int = 30) -> str:
    """Counts of positive values (n,), from 0 to the largest, with the median marked."""
    width, height, left, bottom = 430, 190, 34, 30
    most = float(values.max()) * 1.0001 or 1.0
    counts, edges = np.histogram(values, bins=bins, range=(0, most))
    x = Scale(low=0, high=most, start=left, stop=width - 8)
    y = Scale(low=0, high=max(int(counts.max()), 1), start=height - bottom, stop=10)
    parts = []
    for tick in y.ticks(4):
        if tick == int(tick):
            parts.append(line(left, y(tick), width - 8, y(tick), "grid"))
            parts.append(text(left - 6, y(tick) + 4, label(tick), "tick end"))
    for count, start, stop in zip(counts, edges[:-1], edges[1:], strict=True):
        if count:
            parts.append(
                f'<rect class="bar seen" x="{x(start) + 0.5:.1f}" y="{y(count):.1f}" '
                f'width="{x(stop) - x(start) - 1:.1f}" height="{y(0) - y(count):.1f}"/>'
            )
    for tick in x.ticks(6):
        parts.append(text(x(tick), height - 12, label(tick), "tick middle"))
    median = float(x(np.median(values)))
    parts.append(line(median, 6, median, height - bottom, "fit"))
    return picture(width, height, parts, "People by error")

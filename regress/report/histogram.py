"""Draws how values spread over people."""

import numpy as np

from regress.report.axes import Scale, label
from regress.report.svg import line, picture, text, upright_text


def histogram(values: np.ndarray, what: str, *, bins: int = 30) -> str:
    """Counts of people by positive values (n,) from 0 to the largest, with the median marked.

    ``what`` the values are stands below the axis, with its unit.
    """
    width, height, left, top, bottom = 430, 226, 44, 24, 44
    most = float(values.max()) * 1.0001 or 1.0
    counts, edges = np.histogram(values, bins=bins, range=(0, most))
    x = Scale(low=0, high=most, start=left, stop=width - 8)
    y = Scale(low=0, high=max(int(counts.max()), 1), start=height - bottom, stop=top)
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
        parts.append(text(x(tick), height - bottom + 17, label(tick), "tick middle"))
    parts.append(text((left + width - 8) / 2, height - 8, what, "tick middle"))
    parts.append(upright_text(12, (top + height - bottom) / 2, "people", "tick middle"))
    median = float(x(np.median(values)))
    parts.append(line(median, top - 6, median, height - bottom, "fit"))
    # above the bars, and inside of the picture
    beside = float(np.clip(median, left + 44, width - 52))
    parts.append(text(beside, 13, f"median {np.median(values):.3g}", "tick middle"))
    return picture(width, height, parts, "People by error")

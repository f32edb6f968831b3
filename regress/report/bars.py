"""Lays out the scores of shapes as bars: of the page's own boxes, so that words keep their size on a narrow screen."""

from collections.abc import Sequence
from html import escape

import numpy as np

from regress.report.axes import Scale, figure, label
from regress.report.content import ShapeScores


def score_bars(scores: Sequence[ShapeScores]) -> str:
    """One row a shape: the network's R2 as a bar, ridge regression's as a mark; grouped by region.

    Places are per cent of the row's track.
    """
    # Below -0.2 a shape is simply not seen; a longer bar would squeeze all the others.
    lowest = np.nanmin([[0.0, 0.0], *([score.network.r2, score.ridge.r2] for score in scores)])
    x = Scale(low=max(-0.2, float(lowest)), high=1.0, start=0.0, stop=100.0)
    ticks = [tick for tick in x.ticks() if tick >= x.low]
    grid = "".join(
        f'<i class="{"zero" if tick == 0 else "grid"}" style="left:{x(tick):.1f}%"></i>' for tick in ticks
    )
    names = "".join(f'<span style="left:{x(tick):.1f}%">{label(tick)}</span>' for tick in ticks)
    rows, region = [f'<div class="score axis"><span></span><div>{names}</div><span></span></div>'], None
    for score in scores:
        if score.region != region:
            region = score.region
            rows.append(f"<h3>{escape(region)}</h3>")
        rows.append(_row(score, x, grid))
    return f'<div class="bars">{"".join(rows)}</div>'


def _row(score: ShapeScores, x: Scale, grid: str) -> str:
    network, ridge = score.network.r2, score.ridge.r2
    name = f"<span>{escape(score.name)}</span>"
    if score.grade == "unmoved":
        return f'<div class="score">{name}<div><small>never moves in the test split</small></div><span></span></div>'
    left, right = sorted((float(x(0.0)), float(x(network))))
    title = escape(f"{score.name}: network {network:.3f}, ridge {ridge:.3f}")
    return (
        f'<div class="score" title="{title}">{name}<div>{grid}'
        f'<b class="{score.grade}" style="left:{left:.1f}%;width:{max(right - left, 0.3):.1f}%"></b>'
        f'<i class="ridge" style="left:{x(ridge):.1f}%"></i></div><span>{figure(network)}</span></div>'
    )

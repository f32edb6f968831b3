"""Renders a report's HTML: one file that opens without a network, figures inside."""

import numpy as np
from markupsafe import Markup

from regress.report.axes import figure
from regress.report.bars import score_bars
from regress.report.charts import error_range, learning_curves, regression_panel, small_curves
from regress.report.content import PARTLY_R2, SEEN_R2, ReportContent, ShapeScores, grade
from regress.report.probed import Probed
from regress.report.template import rendered


def render_page(content: ReportContent, probed: Probed | None = None) -> str:
    """Draw the figures and fill in the page, with what probes found where they ran; equal content gives equal text."""
    low, high = error_range(content.curves)
    return rendered(
        "report.html",
        content=content,
        probed=probed,
        grade=grade,
        seen_r2=SEEN_R2,
        partly_r2=PARTLY_R2,
        hidden=[score.name for score in content.scores if score.grade == "hidden"],
        inferred=[score.name for score in content.scores if score.inferred],
        unmoved=[score.name for score in content.scores if score.grade == "unmoved"],
        bars=Markup(score_bars(content.scores)),
        regressions=[(plot, Markup(regression_panel(plot))) for plot in content.regressions],
        curve=Markup(learning_curves(content.curve)),
        small_curves=[Markup(small_curves(curve, low=low, high=high)) for curve in content.curves],
        cells=_cells,
        figure=figure,
    )


def _cells(score: ShapeScores) -> Markup:
    """The eight figures of a row, the best of each kind in bold."""
    methods = (score.network, score.ridge, score.mean)
    r2 = [method.r2 for method in methods]
    mae = [method.mae for method in methods]
    pearson = [method.pearson for method in methods[:2]]
    cells = []
    for values, best in ((r2, np.fmax.reduce(r2)), (mae, min(mae)), (pearson, np.fmax.reduce(pearson))):
        for index, value in enumerate(values):
            kinds = [kind for kind, so in (("group", index == 0), ("best", value == best)) if so]
            kind = f' class="{" ".join(kinds)}"' if kinds else ""
            cells.append(f"<td{kind}>{figure(value)}</td>")
    return Markup("".join(cells))

"""Writes the statistics of a dataset as one HTML file, figures inside."""

import io

import matplotlib.style
import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from facegen.conventions import BLENDSHAPES
from facegen.preview.statistics import Statistics
from facegen.store import Dataset

_BLUE, _INK = "#1f6feb", "#1d2327"
_STYLE = {"font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "facegen"}
_BINS = np.linspace(0, 1, 21)


def statistics_page(dataset: Dataset, statistics: Statistics) -> str:
    """Text of the page; equal data give equal text."""
    environment = Environment(
        loader=PackageLoader("facegen.preview"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    with matplotlib.style.context(_STYLE):
        figures = {
            "weights": _weights(statistics),
            "coactivation": _coactivation(statistics),
            "poses": _poses(statistics),
            "visible": _visible(statistics),
        }
    return environment.get_template("statistics.html").render(
        name=dataset.folder.path.resolve().name,
        rig=", ".join(rig.name for rig in dataset.rigs),
        seed=dataset.spec.seed,
        samples=dataset.plan.samples,
        statistics=statistics,
        figures={name: Markup(text) for name, text in figures.items()},
    )


def _weights(statistics: Statistics) -> str:
    """Histogram of every weight where it is not 0, and how often it is 0."""
    columns = 7
    figure = Figure(figsize=(11, 11.5))
    grid = figure.subplots(-(-len(BLENDSHAPES) // columns), columns, sharex=True)
    for axes in grid.ravel()[len(BLENDSHAPES) :]:
        axes.axis("off")
    for axes in grid.ravel()[len(BLENDSHAPES) - columns : len(BLENDSHAPES)]:
        axes.tick_params(labelbottom=True)
    for axes, name, values in zip(grid.ravel(), BLENDSHAPES, statistics.weights.T, strict=False):
        shares = np.histogram(values[values > 0], _BINS)[0] / len(values)
        axes.bar(_BINS[:-1], shares, width=_BINS[1], align="edge", color=_BLUE)
        axes.set_title(name, fontsize=7.5)
        axes.text(
            0.97,
            0.92,
            f"0: {np.mean(values <= 0):.0%}",
            transform=axes.transAxes,
            ha="right",
            va="top",
            fontsize=7,
        )
        axes.set_yticks([])
        axes.set_xlim(0, 1)
        axes.set_xticks([0, 0.5, 1], ["0", ".5", "1"])
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.02, top=0.98, hspace=0.45, wspace=0.12)
    return _svg(figure)


def _coactivation(statistics: Statistics) -> str:
    figure = Figure(figsize=(11, 10))
    axes = figure.subplots()
    picture = axes.imshow(statistics.coactivation, cmap="RdBu_r", vmin=-1, vmax=1)
    axes.set_xticks(range(len(BLENDSHAPES)), BLENDSHAPES, rotation=90, fontsize=7)
    axes.set_yticks(range(len(BLENDSHAPES)), BLENDSHAPES, fontsize=7)
    figure.colorbar(picture, ax=axes, fraction=0.03, pad=0.02, label="correlation")
    figure.tight_layout()
    return _svg(figure)


def _poses(statistics: Statistics) -> str:
    figure = Figure(figsize=(11, 5.2))
    grid = figure.subplots(2, 3)
    heads = zip(("yaw", "pitch", "roll"), statistics.head_deg.T, strict=True)
    panels = [(f"{name} of the head, degrees", values) for name, values in heads]
    panels.append(("age, years", statistics.age_years))
    for axes, (title, values) in zip(grid.ravel(), panels, strict=False):
        axes.hist(values, bins=40, color=_BLUE)
        axes.set_title(title)
        axes.set_yticks([])
    axes = grid[1, 1]
    yaw, pitch = statistics.gaze_deg.T
    bins = np.arange(-40, 41, 2.0)
    axes.hist2d(yaw, pitch, bins=(bins, bins), cmap="Blues")
    axes.set_title("gaze of the left eye in the head, degrees")
    axes.set_xlabel("yaw")
    axes.set_ylabel("pitch")
    axes.set_aspect("equal")
    axes = grid[1, 2]
    names, counts = zip(*list(statistics.counts["component"].items())[::-1], strict=True)
    axes.barh(names, np.array(counts) / statistics.rows, color=_BLUE)
    axes.set_title("what made the faces, share of rows")
    figure.tight_layout()
    return _svg(figure)


def _visible(statistics: Statistics) -> str:
    figure = Figure(figsize=(11, 2.2))
    axes = figure.subplots()
    axes.bar(range(68), statistics.visible, color=_BLUE)
    axes.set_xlim(-1, 68)
    axes.set_ylim(0, 1)
    axes.set_xlabel("landmark, counted from 0")
    axes.set_ylabel("visible")
    figure.tight_layout()
    return _svg(figure)


def _svg(figure: Figure) -> str:
    buffer = io.StringIO()
    FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]

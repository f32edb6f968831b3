"""Makes the tables of a headset network's report: figures of an evaluation, row by row, as text and shades."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.learning.headset.comparison import Rivalry
from regress.report.axes import figure
from regress.report.content import grade
from regress.report.people_curve import CurvePoint
from regress.runtime.headset.network.figures import Evaluation, Summary
from regress.runtime.headset.network.model import Temporal

Entry = TypeVar("Entry")

MAIN = ("uncalibrated", "same_seat", "same_seat_fallback", "other_seat", "other_seat_fallback")
"""Conditions in the order of the page; those of lost and single cameras follow."""

WORDS = {
    "uncalibrated": "no neutral picture",
    "same_seat": "neutral picture, same seat",
    "same_seat_fallback": "same seat, left out if doubted",
    "other_seat": "neutral picture, another seat",
    "other_seat_fallback": "another seat, left out if doubted",
}
FLOORS = {"mean": "floor: always the training mean", "rest": "floor: always the resting face"}


@dataclass(frozen=True, kw_only=True)
class Cell:
    """One figure and its shade: a class of the page, or none."""

    text: str
    shade: str = ""


@dataclass(frozen=True, kw_only=True)
class PageTable:
    """A head and rows of the same length; the first cell of each is its name."""

    head: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    tinted: bool = False


def conditions_table(conditions: dict[str, Summary], floors: dict[str, Summary]) -> PageTable:
    """Every condition's summary, floors last."""
    head = ("given", "frames", "error in mm", "mean R²", "MAE", "RMSE", "blink R²", "gaze in degrees")
    keys = ("geometry_mm", "r2", "mae", "rmse", "blink_r2", "gaze_deg")
    named = [(condition_words(name), figures) for name, figures in _ordered(conditions)]
    named += [(FLOORS[name], figures) for name, figures in floors.items()]
    rows = [
        (Cell(text=name), Cell(text=f"{figures.rows:,}"), *(cell(getattr(figures, key)) for key in keys))
        for name, figures in named
    ]
    return PageTable(head=head, rows=tuple(rows))


def shapes_table(figures: Evaluation) -> PageTable:
    """R2, MAE and RMSE of every shape, without and with calibration, and R2 from each camera alone."""
    shapes, cameras = figures.shapes, figures.cameras
    conditions = [name for name in MAIN if name in shapes[BLENDSHAPES[0]]]
    short = {"uncalibrated": "alone", "same_seat": "calibrated", "other_seat": "other seat"}
    head = (
        "shape",
        *(f"R² {short[name]}" for name in conditions),
        *(f"R² {camera.replace('_', ' ')} only" for camera in cameras),
        *(f"{what} {short[name]}" for what in ("MAE", "RMSE") for name in conditions[:2]),
    )
    rows = [
        (
            Cell(text=shape),
            *(r2_cell(shapes[shape][name].r2) for name in conditions),
            *(r2_cell(cameras[camera][shape]) for camera in cameras),
            *(
                cell(getattr(shapes[shape][name], what))
                for what in ("mae", "rmse")
                for name in conditions[:2]
            ),
        )
        for shape in BLENDSHAPES
    ]
    return PageTable(head=head, rows=tuple(rows), tinted=True)


def components_table(figures: Evaluation) -> PageTable:
    """Geometry error of each component of the sampler, by the main conditions."""
    components = figures.components
    conditions = [name for name in MAIN if name in next(iter(components.values())).mm]
    rows = [
        (
            Cell(text=name.replace("_", " ")),
            Cell(text=f"{one.rows:,}"),
            *(cell(one.mm[condition]) for condition in conditions),
        )
        for name, one in components.items()
    ]
    return PageTable(head=("component", "frames", *map(condition_words, conditions)), rows=tuple(rows))


def people_table(figures: Evaluation) -> PageTable:
    """Median, bad and worst geometry error of a person, by condition."""
    people = [person.mm for person in figures.people_mm.values()]
    rows = []
    for name in (name for name in MAIN if name in people[0]):
        errors = np.array([errors_mm[name] for errors_mm in people])
        values = (*np.percentile(errors, (5, 50, 95)), errors.max())
        rows.append((Cell(text=condition_words(name)), *(cell(float(value)) for value in values)))
    return PageTable(
        head=("given", "one in twenty below", "median", "one in twenty above", "worst"), rows=tuple(rows)
    )


def rivals_table(entries: dict[str, Rivalry], *, names: tuple[str, str]) -> PageTable:
    """Geometry error of two networks, how much less the first has, and how often."""
    head = ("given", "frames", *names, "difference", "better frames", "better people")
    rows = [
        (
            Cell(text=condition_words(name)),
            Cell(text=f"{one.rows:,}"),
            cell(one.geometry_mm),
            cell(one.rival_mm),
            Cell(text=percent(one.geometry_mm / one.rival_mm - 1, signed=True)),
            Cell(text=percent(one.better)),
            Cell(text=percent(one.people)),
        )
        for name, one in _ordered(entries)
    ]
    return PageTable(head=head, rows=tuple(rows))


def curve_table(points: Sequence[CurvePoint]) -> PageTable:
    """Figures by how many people a model was trained on."""
    head = ("model", "people", "frames", "error in mm", "mean R²", "calibrated, mm", "calibrated, R²")
    rows = []
    for point in sorted(points, key=lambda point: (point.people, point.rows)):
        summaries = [point.figures.conditions.get(name) for name in MAIN[:2]]
        cells = [cell(getattr(one, key, None)) for one in summaries for key in ("geometry_mm", "r2")]
        counts = (Cell(text=f"{count:,}") for count in (point.people, point.rows))
        rows.append((Cell(text=point.title), *counts, *cells))
    return PageTable(head=head, rows=tuple(rows))


def temporal_table(temporal: Temporal) -> PageTable:
    """What the frames before add, on clips."""
    head = (
        "what is said of a frame",
        "frames",
        "error in mm",
        "mean R²",
        "blink R²",
        "gaze in degrees",
        "shake",
    )
    rows = [
        (
            Cell(text={"taps": "frames before, by their taps"}.get(name, name)),
            Cell(text=f"{one.rows:,}"),
            *(cell(getattr(one, key)) for key in ("geometry_mm", "r2", "blink_r2", "gaze_deg", "shake")),
        )
        for name, one in temporal.scores.items()
    ]
    return PageTable(head=head, rows=tuple(rows))


def condition_words(name: str) -> str:
    """A condition in words."""
    return WORDS.get(name, name.replace("_", " "))


def cell(value: float | None) -> Cell:
    """A figure with three decimals; a dash where there is none."""
    return Cell(text=figure(float("nan") if value is None else value))


def r2_cell(value: float | None) -> Cell:
    """The same, shaded by how well a shape is seen."""
    shade = "" if value is None else grade(value)
    return Cell(text=cell(value).text, shade=shade if shade in ("seen", "partly") else "")


def percent(share: float, *, signed: bool = False) -> str:
    """A share as per cent with one decimal."""
    return f"{100 * share:{'+' if signed else ''}.1f} %".replace("-", "\N{MINUS SIGN}")


def _ordered(entries: dict[str, Entry]) -> Iterable[tuple[str, Entry]]:
    """Main conditions first, then the others as they are."""
    names = [name for name in MAIN if name in entries]
    return [(name, entries[name]) for name in (*names, *(name for name in entries if name not in names))]

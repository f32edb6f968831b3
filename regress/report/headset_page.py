"""Writes a headset network's report as one HTML page: figures on arrays, a rival, people, frames that go wrong."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from markupsafe import Markup

from facegen.conventions import BLENDSHAPES
from facegen.files import output_errors, write_whole
from regress.errors import ModelError
from regress.learning.headset.comparison import Comparison
from regress.learning.headset.worst import WorstFrame
from regress.report.axes import figure
from regress.report.content import PARTLY_R2, SEEN_R2, Headline
from regress.report.head import head_image
from regress.report.headset_tables import (
    PageTable,
    components_table,
    conditions_table,
    curve_table,
    people_table,
    percent,
    rivals_table,
    shapes_table,
    temporal_table,
)
from regress.report.histogram import histogram
from regress.report.people_curve import CurvePoint, people_curve
from regress.report.template import rendered
from regress.runtime.headset.network.figures import Evaluation
from regress.runtime.headset.network.model import HeadsetModel


@dataclass(frozen=True, kw_only=True, eq=False)
class Judged:
    """What was measured on one folder of arrays.

    Parameters
    ----------
    title
        What the frames are.
    figures
        Of the model.
    rivals
        Title of another model, and the comparison with it.
    worst
        Frames with the largest errors.
    """

    title: str
    figures: Evaluation
    rivals: tuple[tuple[str, Comparison], ...] = ()
    worst: tuple[WorstFrame, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Section:
    """Tables of one folder of arrays, ready for the page."""

    title: str
    lead: str
    conditions: PageTable
    combined: PageTable | None
    shapes: PageTable
    components: PageTable
    people: PageTable
    histogram: Markup
    variance_calibration: str
    rivals: tuple[tuple[str, tuple[tuple[str, PageTable], ...]], ...]
    worst: tuple[tuple[WorstFrame, tuple[tuple[str, Markup], ...], tuple[tuple[str, Markup], ...]], ...]


def write_headset_report(
    model: HeadsetModel,
    path: Path,
    judged: Sequence[Judged] = (),
    *,
    name: str,
    curve: Sequence[CurvePoint] = (),
    timings: Sequence[tuple[str, float]] = (),
) -> Path:
    """Write the page.

    Parameters
    ----------
    model, name
        The model and what to call it.
    judged
        What was measured; without anything the figures of the model's own training data stand.
    curve
        Models trained on fewer people.
    timings
        Microseconds a frame, by how the network was run.

    Raises
    ------
    ModelError
        Where there is nothing to report.
    OutputError
        Where the file cannot be written.
    """
    if not judged:
        if model.scores is None:
            raise ModelError("the model has no figures of its own; give --data to measure some")
        judged = [Judged(title="the test split of its training data", figures=model.scores)]
    for one in judged:
        _check_complete(one.figures)
    page = rendered(
        "headset.html",
        name=name,
        lead=_lead(model, judged[0]),
        headlines=_headlines(judged[0].figures, timings),
        sections=[_section(one, name) for one in judged],
        curve=curve_table(curve) if curve else None,
        drawn_curve=Markup(people_curve(curve)) if curve else None,
        temporal=temporal_table(model.temporal) if model.temporal and model.temporal.scores else None,
        temporal_unseen=model.temporal is not None and model.temporal.unseen,
        timings=[(how, f"{microseconds / 1000:.2f} ms") for how, microseconds in timings],
        hidden=_hidden(judged[0].figures),
        few=judged[0].figures.few.replace("R2", "R²"),
        provenance=_provenance(model),
        seen_r2=SEEN_R2,
        partly_r2=PARTLY_R2,
        figure=figure,
    )
    with output_errors(path):
        path.parent.mkdir(parents=True, exist_ok=True)
    return write_whole(path, page)


def _check_complete(figures: Evaluation) -> None:
    """Refuse figures without what the page is made of; a model's own are as its model.json has them."""
    lacking = [
        what
        for what, there in (
            ("conditions.uncalibrated", "uncalibrated" in figures.conditions),
            ("floors.rest", "rest" in figures.floors),
            ("components", figures.components),
            ("people_mm", figures.people_mm),
        )
        if not there
    ]
    if lacking:
        raise ModelError(
            f"the model's figures have no {lacking[0]}, which a report needs; give --data to measure them"
        )


def _section(judged: Judged, name: str) -> Section:
    figures = judged.figures
    errors = np.array([person.mm["uncalibrated"] for person in figures.people_mm.values()])
    rivals = tuple(
        (
            title,
            tuple(
                (what, rivals_table(entries, names=(name, title)))
                for what, entries in (
                    ("Ordinary frames", compared.conditions),
                    ("An open jaw and closing lids", compared.combined),
                    ("By component, no neutral picture", compared.components),
                )
                if entries
            ),
        )
        for title, compared in judged.rivals
    )
    return Section(
        title=judged.title,
        lead=f"{figures.rows:,} frames of {figures.people:,} people ({figures.split} split).",
        conditions=conditions_table(figures.conditions, figures.floors),
        combined=conditions_table(figures.combined, {}) if figures.combined else None,
        shapes=shapes_table(figures),
        components=components_table(figures),
        people=people_table(figures),
        histogram=Markup(histogram(errors, "error in mm, no neutral picture")),
        variance_calibration=_deviation(figures),
        rivals=rivals,
        worst=tuple(
            (
                one,
                tuple((camera, _image(picture, camera)) for camera, picture in one.pictures.items()),
                tuple(
                    (words, head_image(weights, f"sample {one.sample}: {words} weights"))
                    for words, weights in (("true", one.true), ("predicted", one.predicted))
                ),
            )
            for one in judged.worst
        ),
    )


def _lead(model: HeadsetModel, first: Judged) -> str:
    cameras = ", ".join(camera.name.replace("_", " ") for camera in model.cameras)
    return (
        f"A {model.architecture} network turns the pictures of {len(model.cameras)} cameras of the headset "
        f"{model.headset} ({cameras}) into {len(model.weights)} avatar weights and the gaze. Trained on "
        f"{model.training.rows:,} synthetic frames of {model.training.people:,} people. The first "
        f"figures are of {first.title}: {_whose(first.figures)}."
    )


def _whose(figures: Evaluation) -> str:
    """The people of an evaluation, and whether the network knows them; older figures do not say."""
    people = f"{figures.people:,} people"
    if figures.split == "train":
        return f"{people} of the training split, whom it may have learned from"
    if figures.people_in_training:
        return f"{people}, of whom {figures.people_in_training:,} are in the training split too"
    return f"{people} that it has never seen" if figures.unseen else f"{people} of the {figures.split} split"


def _headlines(figures: Evaluation, timings: Sequence[tuple[str, float]]) -> list[Headline]:
    alone, calibrated = figures.conditions["uncalibrated"], figures.conditions.get("same_seat")
    rest = figures.floors["rest"]
    beside = "" if calibrated is None else f"; with a neutral picture {figure(calibrated.geometry_mm)}"
    r2 = "" if calibrated is None else f"; with a neutral picture {_known(calibrated.r2)}"
    blink = "" if calibrated is None else f"; with a neutral picture {_known(calibrated.blink_r2)}"
    gaze = "" if calibrated is None else f"; with a neutral picture {calibrated.gaze_deg:.1f}°"
    lines = [
        Headline(
            value=f"{alone.geometry_mm:.2f} mm",
            caption=f"mean error of the face's vertices{beside}; a resting face {figure(rest.geometry_mm)}",
        ),
        Headline(value=_known(alone.r2), caption=f"mean R² of 51 shapes{r2}"),
        Headline(value=_known(alone.blink_r2), caption=f"R² of the eyes' blink{blink}"),
        Headline(value=f"{alone.gaze_deg:.1f}°", caption=f"mean angle between predicted and true gaze{gaze}"),
    ]
    if timings:
        lines.append(
            Headline(value=f"{timings[0][1] / 1000:.2f} ms", caption="a frame in onnxruntime on one core")
        )
    return lines


def _hidden(figures: Evaluation) -> list[str]:
    """Shapes that the cameras show neither without nor with a neutral picture."""
    return [
        shape
        for shape in BLENDSHAPES
        if all((one.r2 if one.r2 is not None else 0.0) < PARTLY_R2 for one in figures.shapes[shape].values())
    ]


def _deviation(figures: Evaluation) -> str:
    deviation = figures.deviation
    text = (
        f"Squared errors are {deviation.squared_error_over_variance:.2f} times the variance that the network "
        f"predicts for them; 1 is honest."
    )
    if deviation.correlation is not None:
        text += f" Errors and predicted deviations correlate with {deviation.correlation:.2f}."
    same, other = figures.seat.get("same_seat"), figures.seat.get("other_seat")
    if same is not None:
        text += f" It takes {percent(same)} of the neutral pictures of the same seat for such"
        text += "." if other is None else f", and {percent(other)} of those of another seat."
    return text


def _provenance(model: HeadsetModel) -> list[tuple[str, str]]:
    record = model.training
    recipe = ", ".join(f"{key.replace('_', ' ')} {value}" for key, value in record.recipe.items())
    rows = [
        ("headset", model.headset),
        ("rig of the data", model.rig),
        ("dataset", model.dataset_hash),
        ("licence of the data", "; ".join(model.licences)),
        ("network SHA-256", model.network_sha256),
        ("recipe", recipe),
    ]
    if record.parameters is not None:
        rows.append(("parameters", f"{record.parameters:,}"))
    if record.cpu_s is not None:
        rows.append(("processor time of the training", f"{record.cpu_s / 60:.1f} minutes"))
    if record.onnx_difference is not None:
        rows.append(("largest difference of ONNX and PyTorch", f"{record.onnx_difference:.1e}"))
    rows += record.versions.items()
    return [(term, value) for term, value in rows if value]


def _image(picture: np.ndarray, description: str) -> Markup:
    """A grey picture (h, w) inside the page, as PNG."""
    data = base64.b64encode(cv2.imencode(".png", picture)[1]).decode()
    return Markup('<img alt="{}" src="data:image/png;base64,{}">').format(description, data)


def _known(value: float | None) -> str:
    return figure(float("nan") if value is None else value)

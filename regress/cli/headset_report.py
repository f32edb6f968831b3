"""``regress headset report``: what a headset network can do, as one page."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from facegen.console import say
from facegen.files import refuse_ending, refuse_sources, write_whole
from regress.cli.evaluate import SplitOption
from regress.errors import InputError, ModelError

if TYPE_CHECKING:
    from regress.report.headset_page import Judged
    from regress.report.people_curve import CurvePoint


def report(
    model: Annotated[Path, typer.Argument(help="Model folder of `regress headset train`.")],
    out: Annotated[Path, typer.Option("--out", help="HTML file to write.")] = Path("report.html"),
    data: Annotated[
        list[Path] | None,
        typer.Option(
            "--data", help="Folder of arrays to measure on; may be given again, the main one first."
        ),
    ] = None,
    against: Annotated[
        list[Path] | None,
        typer.Option("--against", help="Another model to compare with; may be given again."),
    ] = None,
    curve: Annotated[
        list[Path] | None,
        typer.Option(
            "--curve", help="A model trained on fewer people, for the learning curve; may be given again."
        ),
    ] = None,
    split: SplitOption = "test",
    figures: Annotated[
        Path | None, typer.Option("--figures", help="JSON file for all that was measured, unrounded.")
    ] = None,
    timed: Annotated[
        bool, typer.Option("--time/--no-time", help="Time a frame; without it equal input gives equal bytes.")
    ] = True,
) -> None:
    """Write one HTML file with a headset network's figures and its worst frames: it opens without a network.

    Example: regress headset report models/headset --data datasets/out/headset-test-arrays --against models/holistic
    --out report.html
    """
    from regress.learning.headset.arrays import read_arrays
    from regress.learning.headset.comparison import compare
    from regress.learning.headset.evaluation import evaluate
    from regress.learning.headset.worst import worst_frames
    from regress.report.headset_page import Judged, write_headset_report
    from regress.report.people_curve import CurvePoint
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.ready_made import model_folder
    from regress.timing import time_headset

    refuse_ending(out, ".html", ".htm", what="a report")
    if figures is not None:
        refuse_ending(figures, ".json", what="a file of figures", option="--figures")
    models = [model_folder(path) for path in (model, *(against or []), *(curve or []))]
    sources = [folder / name for folder in models for name in ("model.json", "network.onnx")]
    sources += [folder / "arrays.json" for folder in data or []]
    refuse_sources(out, sources)
    if figures is not None:
        refuse_sources(figures, sources, option="--figures")
    predictor = load_headset_predictor(model)
    rivals = [(name, load_headset_predictor(path)) for name, path in _titled("--against", against)]
    fewer = [(name, load_headset_predictor(path)) for name, path in _titled("--curve", curve)]
    folders = [(name, read_arrays(path)) for name, path in _titled("--data", data)]
    judged, points = [], []
    for title, arrays in folders:
        judged.append(
            Judged(
                title=title,
                figures=evaluate(predictor.graph, predictor.model, arrays, split=split),
                rivals=tuple(
                    (name, compare(predictor, rival, arrays, split=split)) for name, rival in rivals
                ),
                worst=worst_frames(predictor, arrays, split=split),
            )
        )
    for name, one in [*fewer, *([(model.name, predictor)] if fewer else [])]:
        evaluation = one.model.scores
        if folders:
            evaluation = evaluate(one.graph, one.model, folders[0][1], split=split)
        elif evaluation is None:
            raise ModelError(f"{name} has no scores on a test split; give --data to measure some")
        training = one.model.training
        points.append(CurvePoint(title=name, people=training.people, rows=training.rows, figures=evaluation))
    timings = [(timing.name, timing.microseconds) for timing in time_headset(predictor)] if timed else []
    typer.echo(
        write_headset_report(predictor.model, out, judged, name=model.name, curve=points, timings=timings)
    )
    if figures is not None:
        _write_figures(figures, judged, points, timings)


def _titled(option: str, paths: list[Path] | None) -> list[tuple[str, Path]]:
    """Folders by their names, or by their paths where names are not enough to tell them apart."""
    paths = paths or []
    names = [path.resolve().name for path in paths]
    titled = [
        (str(path) if names.count(name) > 1 else name, path) for name, path in zip(names, paths, strict=True)
    ]
    for title, path in titled:
        if [other for other, _ in titled].count(title) > 1:
            raise InputError(f"{option} {path} is given twice")
    return titled


def _write_figures(
    path: Path,
    judged: "Sequence[Judged]",
    points: "Sequence[CurvePoint]",
    timings: Sequence[tuple[str, float]],
) -> None:
    from regress.runtime.headset.network.figures import evaluation_to_json

    document = {
        "data": {one.title: evaluation_to_json(one.figures) for one in judged},
        "against": {
            one.title: {title: asdict(comparison) for title, comparison in one.rivals} for one in judged
        },
        "curve": [
            {
                "model": point.title,
                "people": point.people,
                "rows": point.rows,
                "figures": evaluation_to_json(point.figures),
            }
            for point in points
        ],
        "microseconds": dict(timings),
    }
    write_whole(path, json.dumps(document, indent=1, allow_nan=False) + "\n")
    say(f"figures in {path}")

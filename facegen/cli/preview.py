"""``facegen preview``."""

import os
from pathlib import Path
from typing import Annotated

import typer

from facegen.errors import InputError


def preview(
    dataset: Annotated[Path, typer.Argument(help="Folder of a dataset.")],
    out: Annotated[Path, typer.Option("--out", help="PNG file to write.")] = Path("contact-sheet.png"),
    samples: Annotated[
        str | None,
        typer.Option("--samples", help="Samples to show: 0-3,17. Default: the first rendered ones."),
    ] = None,
    columns: Annotated[int, typer.Option("--columns", min=1, max=8, help="Samples side by side.")] = 2,
    landmarks: Annotated[
        bool, typer.Option("--landmarks/--no-landmarks", help="Draw landmarks over the pictures.")
    ] = True,
) -> None:
    """Draw a contact sheet: the headset's views with landmarks, the keypoints, and the largest weights of each sample.

    Example: facegen preview datasets/out/tiny --out tiny.png
    """
    from facegen.preview import contact_sheet
    from facegen.spec import sample_numbers
    from facegen.store import open_dataset, output_errors

    opened = open_dataset(dataset)
    there = {int(number) for number in opened.keypoints()["sample"].to_numpy()}
    if samples is not None:
        numbers = sample_numbers(samples, total=opened.plan.samples, where="--samples")
    else:
        numbers = opened.folder.rendered()[:8] or sorted(there)[:8]
    missing = sorted(set(numbers) - there)
    if missing or not numbers:
        raise InputError(
            f"{dataset}: sample {missing[0] if missing else 0} has not been made; run facegen generate first"
        )
    figure = contact_sheet(opened, numbers, columns=columns, landmarks=landmarks)
    part = out.with_name(f".{out.name}.{os.getpid()}.png")
    with output_errors(out):
        try:
            figure.savefig(part, facecolor=figure.get_facecolor())
            os.replace(part, out)
        finally:
            part.unlink(missing_ok=True)
    print(out)

"""Defines ``facegen develop``."""

from pathlib import Path
from typing import Annotated

import typer

from facegen.console import counted, progress


def develop(
    dataset: Annotated[Path, typer.Argument(help="Folder of a dataset with rendered samples.")],
    out: Annotated[Path, typer.Option("--out", help="Folder for the new pictures.")],
    samples: Annotated[
        str | None,
        typer.Option("--samples", help="Samples to develop: 0-99,140. Default: all rendered ones."),
    ] = None,
    exposure: Annotated[
        float | None,
        typer.Option("--exposure", min=1e-9, max=1e9, help="Instead of the headset's sensor.exposure."),
    ] = None,
    gain: Annotated[
        float | None, typer.Option("--gain", min=1e-6, max=1e6, help="Instead of the headset's sensor.gain.")
    ] = None,
    noise: Annotated[
        float | None,
        typer.Option("--noise", min=0, max=10, help="Instead of the spec's sensor.noise, a factor."),
    ] = None,
    seed: Annotated[
        int | None, typer.Option("--seed", min=0, help="Draw exposure, motion, noise, room and flash anew.")
    ] = None,
) -> None:
    """Make pictures anew from the radiance in a dataset's EXR files: milliseconds each, nothing is rendered.

    Without options the pictures are the dataset's own, byte for byte; the same options always give the same bytes.

    Example: facegen develop datasets/out/tiny --out brighter --exposure 0.6 --seed 7
    """
    from facegen.spec import sample_numbers
    from facegen.store import open_dataset
    from facegen.work import Settings, develop_dataset

    opened = open_dataset(dataset)
    numbers = None
    if samples is not None:
        numbers = sample_numbers(samples, total=opened.plan.samples, where="--samples")
    settings = Settings(exposure=exposure, gain=gain, noise=noise, seed=seed)
    total = len(opened.folder.rendered() if numbers is None else numbers)
    with progress() as show:
        made = develop_dataset(
            opened, out, settings, numbers, on_progress=lambda done: show("samples developed", done, total)
        )
    print(f"{out}: {counted(made, 'sample')} developed, {total - made:,} there already")

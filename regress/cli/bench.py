"""``regress bench``: how long a frame takes on this machine."""

import dataclasses
import json
from pathlib import Path
from typing import Annotated

import typer


def bench(
    model: Annotated[Path, typer.Argument(help="Model folder of `regress train` or `regress headset train`")],
    as_json: Annotated[bool, typer.Option("--json", help="Unrounded figures for programs.")] = False,
) -> None:
    """Time a model in NumPy and in each export that can run here, or a headset's network, preprocessing included.

    Example: regress bench models/default
    """
    import numpy as np

    from regress.runtime.headset.network.predictor import is_headset_model, load_headset_predictor
    from regress.runtime.model import load_model
    from regress.timing import time_headset, time_model

    if is_headset_model(model):
        timings = time_headset(load_headset_predictor(model))
    else:
        import numpy as np

        loaded = load_model(model)
        noise = np.random.default_rng(0).normal(size=(100, 68, 2)) * 0.01
        timings = time_model(loaded, (loaded.features.mean_shape + noise) * 300 + 900)
    if as_json:
        typer.echo(json.dumps([dataclasses.asdict(timing) for timing in timings]))
        return
    for timing in timings:
        taken = "-" if timing.microseconds is None else f"{timing.microseconds:.1f}"
        typer.echo(f"{timing.name:<22} {taken:>8} \N{MICRO SIGN}s  {timing.note}")

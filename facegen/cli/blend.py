"""Defines ``facegen blend``."""

from pathlib import Path
from typing import Annotated

import typer


def blend(
    spec: Annotated[Path, typer.Argument(help="TOML file of a dataset's spec, also OUT/spec.toml.")],
    sample: Annotated[int, typer.Option("--sample", min=0, help="Number of the sample.")],
    out: Annotated[Path, typer.Option("--out", help="The .blend file to write.")],
    view: Annotated[
        str | None,
        typer.Option("--view", help="Active camera, whose LEDs are lit. Default: the headset's first."),
    ] = None,
) -> None:
    """Write a sample as a .blend file (Blender 4.5) that renders as in the dataset, lens and all.

    Glints are missing there: facegen solves them and adds them to the finished radiance.

    Example: facegen blend datasets/tiny.toml --sample 1 --view mouth --out mouth.blend
    """
    from facegen.files import refuse_ending
    from facegen.spec import load_spec
    from facegen.store import resolve
    from facegen.work import save_blend

    refuse_ending(out, ".blend", what="a file of Blender")
    save_blend(resolve(load_spec(spec), out.parent), sample, out, view=view)
    print(out)

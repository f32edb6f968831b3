"""``regress edges``: make the reference shape's file from 68 points of a face."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from facegen.console import say
from facegen.files import refuse_ending, refuse_sources, write_whole
from regress.errors import InputError

if TYPE_CHECKING:
    import numpy as np


_MOST_BYTES = 1024**2
"""Of 68 points, which take 10,000 as text."""


def edges(
    points: Annotated[Path, typer.Argument(help="68 points in 3D, head frame, metres: .npy or .json.")],
    out: Annotated[Path, typer.Option("--out", help="File to write, .json.")],
    name: Annotated[str, typer.Option("--name", help="Whose face it is.")] = "anny mean face",
    source: Annotated[str, typer.Option("--source", help="How the points were made.")] = "",
    tilt_deg: Annotated[
        float | None,
        typer.Option("--tilt-deg", min=-90, max=90, help="Tilt about x before projection; 1.5 if not given."),
    ] = None,
) -> None:
    """Triangulate a reference face; the package ships the result and copies it into each model.

    Example: facegen rig landmarks anny --out anny.npy && regress edges anny.npy --out reference_shape.json
    """
    from regress.learning.reference_shape import TILT_DEG, make_reference_shape, reference_shape_json

    refuse_ending(out, ".json", what="a reference shape")
    refuse_sources(out, [points])
    tilt_deg = TILT_DEG if tilt_deg is None else tilt_deg
    try:
        shape = make_reference_shape(_read(points), name=name, source=source, tilt_deg=tilt_deg)
    except InputError as error:
        raise error if str(points) in str(error) else InputError(f"{points}: {error}") from error
    write_whole(out, reference_shape_json(shape))
    say(f"{len(shape.edges)} edges of {shape.name}, SHA-256 {shape.sha256[:12]}, in {out}")


def _read(path: Path) -> "np.ndarray":
    import numpy as np

    from facegen.archives import load_npy
    from facegen.documents import load_json

    if path.suffix not in (".npy", ".json"):
        raise InputError(f"{path} is neither .npy nor .json")
    read = load_npy if path.suffix == ".npy" else load_json
    points = read(path, most_bytes=_MOST_BYTES)
    try:
        return np.asarray(points).astype(np.float64, casting="same_kind")
    except (ValueError, TypeError, OverflowError) as error:
        raise InputError(f"{path} holds something else than numbers ({error})") from error

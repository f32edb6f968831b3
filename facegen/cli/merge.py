"""Defines ``facegen merge``."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import counted, progress


def merge(
    datasets: Annotated[list[Path], typer.Argument(help="Folders of datasets of one spec.")],
    out: Annotated[Path, typer.Option("--out", help="Folder of the joined dataset.")],
    copy: Annotated[bool, typer.Option("--copy", help="Copy files instead of linking them.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Join runs of one spec that were made apart: pictures in several must be equal byte for byte, keypoints by value.

    Files become hard links where the file system allows it, and take no space twice.

    Example: facegen merge runs/a runs/b --out datasets/out/all
    """
    from facegen.store import merge as join

    with progress() as show:
        merged = join(
            datasets,
            out,
            copy=copy,
            on_progress=lambda done, total: show("shards and rendered samples", done, total),
        )
    if as_json:
        print(json.dumps({"out": str(out)} | asdict(merged)))
    else:
        taken = counted(merged.taken, "shard or rendered sample", "shards and rendered samples")
        print(f"{out}: {taken} taken over, {merged.found} there already")

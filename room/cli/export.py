"""Defines ``room export``."""

from pathlib import Path
from typing import Annotated

import typer

from facegen.console import counted, say


def export(
    recording: Annotated[Path, typer.Argument(help="File of `room serve --record`.")],
    out: Annotated[Path, typer.Option(help="Table to write, NAME.parquet.")],
) -> None:
    """Make a table of a recording, one row for each state; needs the extra `learn`, for Parquet.

    Example: room export meeting.jsonl --out meeting.parquet
    """
    from room.recording.table import write_table

    say(f"room: {counted(write_table(recording, out), 'row')} in {out}")

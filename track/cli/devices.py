"""``track devices``: which cameras there are, and what each of them sees."""

import json
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import one_line, say


def devices(
    pictures: Annotated[
        Path | None, typer.Option(help="Folder to write a picture of each camera into, camera-N.jpg")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print a JSON list")] = False,
) -> None:
    """List the cameras of this machine with the size and rate of their pictures, and a picture of each where asked.

    Example: track devices --pictures cameras
    """
    from track.sources.devices import look_at_webcams

    seen = look_at_webcams(pictures)
    if not seen and not as_json:
        say(
            "track devices: this machine has no camera that its system tells of; plug one in, or say --camera FILM"
        )
    if as_json:
        print(json.dumps([each.record() for each in seen], indent=2, ensure_ascii=False))
        return
    for each in seen:
        size = f"{each.width} x {each.height}" if each.fault is None else each.fault
        rate = "" if each.fps is None else f"{each.fps:.0f} a second"
        print(
            "  ".join(
                [
                    f"{each.number:2}",
                    one_line(each.name),
                    size,
                    *([rate] if rate else []),
                    *([str(each.picture)] if each.picture else []),
                ]
            )
        )

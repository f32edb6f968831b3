"""Defines ``room replay``."""

from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say
from room.cli.links import print_links


def replay(
    recording: Annotated[Path, typer.Argument(help="File of `room serve --record`.")],
    host: Annotated[str, typer.Option(help="Interface; 0.0.0.0 for all, which needs --cert.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="0 takes any that is free.", min=0, max=65535)] = 8443,
    cert: Annotated[Path | None, typer.Option(help="Certificate (PEM) for https.")] = None,
    key: Annotated[Path | None, typer.Option(help="Its private key (PEM).")] = None,
) -> None:
    """Open a room in which recorded people move as they moved; it begins with the first who looks, and goes round.

    Example: room replay meeting.jsonl
    """
    from room.recording import check_recording
    from room.server import Address, Limits, Relays, Rooms, new_keys, serve

    survey, keys = check_recording(recording), new_keys()
    address = Address(host=host, port=port, certificate=cert, private_key=key)

    def started(where: str) -> None:
        print_links(keys, (survey.heading.room,), where)
        say("room: a replay; Ctrl-C stops it, and its links end with it")

    serve(Rooms(keys, limits=Limits(), relays=Relays(), replayed=survey), address, started=started)
    say("room: stopped; its links have ended")

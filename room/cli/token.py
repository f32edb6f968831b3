"""Defines ``room token``."""

from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say
from room.cli.links import RoomNames, print_links


def token(
    keys: Annotated[Path, typer.Option(help="File of the secret, as `room serve --keys` has it.")],
    names: RoomNames = ("meeting",),
    address: Annotated[str, typer.Option(help="Where the server is reached.")] = "http://127.0.0.1:8443",
) -> None:
    """Print the links of rooms: whoever has one may come in.

    Example: room token --keys room.keys --room lecture --address https://rooms.example
    """
    from room.server import load_keys

    known = keys.exists()
    held = load_keys(keys)
    if not known:
        say(
            f"room: {keys} was not there and is made: these links open rooms of `room serve --keys {keys}` alone"
        )
    print_links(held, names, address)

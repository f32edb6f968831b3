"""Defines ``room token``."""

from pathlib import Path
from typing import Annotated

import typer

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

    print_links(load_keys(keys), names, address)

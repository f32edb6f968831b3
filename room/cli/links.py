"""Prints the links of rooms, for ``room serve`` and ``room token``."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated

import typer

from room.errors import InputError

if TYPE_CHECKING:
    from room.server import Keys


def _names(
    rooms: list,
) -> list[str]:  # Python 3.10 takes list[str] for a class, and typer asks whose child it is
    """The names, before anything else is looked at: a refused command writes no file of keys."""
    from room.server.room_sockets import ROOM_NAME

    for room in rooms:
        if not ROOM_NAME.fullmatch(room):
            raise InputError(
                f"--room {room!r}: must be of 1 to 40 characters a-z, 0-9 and -, and not begin with -"
            )
    return rooms


RoomNames = Annotated[
    list[str],
    typer.Option("--room", help="Name of a room, a-z, 0-9 and -; may be repeated.", callback=_names),
]


def print_links(keys: "Keys", rooms: Iterable[str], where: str) -> None:
    """Print two lines for each room: the link of its guests, and that of its moderators."""
    for room in rooms:
        for role in ("guest", "moderator"):
            print(f"{room}\t{role}\t{where.rstrip('/')}/room/{room}#{keys.key(room, role)}", flush=True)

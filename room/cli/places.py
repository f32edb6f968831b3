"""Reads what ``--place`` says: where the people of which room meet."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from facegen.console import say

if TYPE_CHECKING:
    from room.places import Place


def read_places(wishes: Sequence[str]) -> "dict[str, Place]":
    """Places by the name of the room; an empty name stands for all others.

    Parameters
    ----------
    wishes
        ``PLACE`` for all rooms, or ``ROOM=PLACE`` for one; a place is the name of one that comes with the server, or
        a .glb file.

    Raises
    ------
    InputError
        If a room gets two places, or a place has no such name.
    FormatError
        If a file is none, or more than a page can be asked to load.
    """
    from room.errors import InputError
    from room.places import read_place
    from room.server.room_sockets import ROOM_NAME

    places: dict[str, Place] = {}
    for wish in wishes:
        room, sign, name = wish.partition("=")
        if not sign or not ROOM_NAME.fullmatch(room) or Path(wish).is_file():
            room, name = "", wish
        if room in places:
            whose = f"room {room}" if room else "all rooms"
            raise InputError(f"--place {wish}: {whose} would have two places; leave one of them out")
        places[room] = place = read_place(name)
        if place.word:
            say(f"room: {name}: {place.word}")
    return places

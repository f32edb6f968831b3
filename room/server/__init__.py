"""The server of rooms: what brings people together, with the page that they open."""

from room.server.application import Rooms
from room.server.keys import Keys, keep_keys, load_keys, new_keys, read_keys
from room.server.limits import Limits
from room.server.serve import Address, serve
from room.server.turn import Relays

__all__ = [
    "Address",
    "Keys",
    "Limits",
    "Relays",
    "Rooms",
    "keep_keys",
    "load_keys",
    "new_keys",
    "read_keys",
    "serve",
]

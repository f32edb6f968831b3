"""Where people meet: a .glb with named places to stand, seats and screens, checked before others' browsers load it."""

from room.places.place import BUILT_IN, PLAIN, Place, read_place

__all__ = ["BUILT_IN", "PLAIN", "Place", "read_place"]

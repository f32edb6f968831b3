"""Files of others that browsers are to load: what a glTF document may hold, whether it is an avatar or a place."""

from room.gltf.check import Bounds, check_gltf

__all__ = ["Bounds", "check_gltf"]

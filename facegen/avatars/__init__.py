"""Avatars: a rig as skinned, textured surfaces with 52 morph targets, written as glTF files."""

from facegen.avatars.complexion import Complexion
from facegen.avatars.head import head_bytes

__all__ = ["Complexion", "head_bytes"]

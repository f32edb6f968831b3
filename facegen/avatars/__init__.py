"""Avatars: a rig as skinned, textured surfaces with 52 morph targets, written as glTF files."""

from facegen.avatars.export import export_avatar

__all__ = ["export_avatar"]

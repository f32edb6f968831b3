"""Holds the colours of an operating room's things, linear."""

from blender_assets.rooms.kit import rgb

STEEL = rgb("c8cecd")
WHITE = rgb("eef2f0")
GREY = rgb("aab4b4")
DARK = rgb("2d3537")
TEAL = rgb("3b8a88")
DRAPE = rgb("5f9fae")
BLUE = rgb("5f8ea8")

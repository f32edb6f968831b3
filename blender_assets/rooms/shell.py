"""Builds what encloses a room: floor, panelled walls, ceiling with lights, doors."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import bmesh
from mathutils import Vector

from blender_assets.rooms.kit import GLOW, METAL, Colour, Lamp, Room, rgb

GAP_M = 0.007
"""Between two panels of a wall: what the eye takes for a seam."""
SEAM = 0.45
"""Of the panels' own colour."""

WHITE = rgb("f4f6f4")
FRAME = rgb("c9d1d0")


@dataclass(frozen=True, kw_only=True)
class Wall:
    """A straight wall of panels, seen from inside.

    Attributes
    ----------
    start
        Of its left end, seen from inside; metres, x and y.
    turn
        Direction from there, about z in radians; inside is to the left of it.
    length
        In metres.
    colours
        Of the rows of panels, from the floor up.
    rows
        Heights of their upper edges in metres.
    panel
        Greatest width of a panel in metres.
    openings
        From, to and height of what is left open, in metres along the wall.
    """

    start: tuple[float, float]
    turn: float
    length: float
    colours: tuple[Colour, ...]
    rows: tuple[float, ...]
    panel: float = 1.2
    openings: tuple[tuple[float, float, float], ...] = ()

    def at(self, along: float, inward: float, height: float) -> tuple[float, float, float]:
        """A point by metres along the wall, off it into the room, and above the floor."""
        cos, sin = math.cos(self.turn), math.sin(self.turn)
        return (
            self.start[0] + along * cos - inward * sin,
            self.start[1] + along * sin + inward * cos,
            height,
        )


def rectangle(room: Room, corners: Sequence[Sequence[float]], colour: Colour, layer: str = "shell") -> None:
    """Put a flat face through four corners, counter-clockwise seen from its front."""
    part = bmesh.new()
    part.faces.new([part.verts.new(corner) for corner in corners])
    room.add(part, colour, layer)


def put_wall(room: Room, wall: Wall, *, height: float, skirting: Colour) -> None:
    """Put a wall's rows of panels, dark seams between them, and a skirting."""
    edges = sorted({0.0, wall.length, *(edge for low, high, _ in wall.openings for edge in (low, high))})
    for low, high in itertools.pairwise(edges):
        above = next((top for a, b, top in wall.openings if a <= low and high <= b), 0.0)
        count = max(1, math.ceil((high - low) / wall.panel - 1e-6))
        floor = 0.0
        for colour, top in zip(wall.colours, wall.rows, strict=True):
            bottom = max(floor, above)
            if top - bottom > 0.02:
                _put_flat(room, wall, (low, high), (bottom, top), 0.0, colour)
                dark = tuple(SEAM * part for part in colour)
                for k in range(1, count):
                    seam = low + k * (high - low) / count
                    _put_flat(room, wall, (seam - GAP_M / 2, seam + GAP_M / 2), (bottom, top), 0.0015, dark)
                if bottom > above:
                    _put_flat(room, wall, (low, high), (bottom - GAP_M / 2, bottom + GAP_M / 2), 0.002, dark)
            floor = top
        if not above:
            middle = wall.at((low + high) / 2, 0.008, 0.06)
            room.box(middle, (high - low, 0.03, 0.12), skirting, "shell", turn=wall.turn)


def _put_flat(
    room: Room,
    wall: Wall,
    along: tuple[float, float],
    high: tuple[float, float],
    inward: float,
    colour: Colour,
) -> None:
    """Put a rectangle on a wall, so far before it."""
    corners = ((along[0], high[0]), (along[0], high[1]), (along[1], high[1]), (along[1], high[0]))
    rectangle(room, [wall.at(u, inward, z) for u, z in corners], colour)


def put_sliding_door(room: Room, wall: Wall, low: float, high: float, top: float, colour: Colour) -> None:
    """Close an opening with a sliding door: a frame, a leaf with a window, a long handle, the rail above."""
    middle, width = (low + high) / 2, high - low
    for along in (low + 0.03, high - 0.03):
        room.box(wall.at(along, 0.0, top / 2), (0.09, 0.1, top), FRAME, "shell", turn=wall.turn)
    room.box(wall.at(middle, 0.0, top + 0.0), (width + 0.03, 0.1, 0.09), FRAME, "shell", turn=wall.turn)
    room.box(wall.at(middle, 0.0, top / 2), (width - 0.08, 0.04, top - 0.02), colour, "shell", turn=wall.turn)
    room.box(
        wall.at(middle, 0.055, top + 0.12),
        (width + 0.5, 0.11, 0.16),
        WHITE,
        "shell",
        bevel=0.02,
        turn=wall.turn,
    )
    glass = wall.at(middle + 0.12 * width, 0.02, 1.5)
    room.box(glass, (0.36, 0.024, 0.72), rgb("5e7a80"), "shell", bevel=0.04, turn=wall.turn)
    room.box(
        wall.at(middle + 0.12 * width, 0.018, 1.5),
        (0.42, 0.02, 0.78),
        FRAME,
        "shell",
        bevel=0.05,
        turn=wall.turn,
    )
    foot, head = wall.at(middle - 0.36 * width, 0.07, 0.75), wall.at(middle - 0.36 * width, 0.07, 1.45)
    room.tube([foot, head], 0.014, rgb("d4d8d8"), METAL)
    for height in (0.8, 1.4):
        ends = [wall.at(middle - 0.36 * width, inward, height) for inward in (0.02, 0.07)]
        room.tube(ends, 0.009, rgb("d4d8d8"), METAL)
    room.box(
        wall.at(middle, 0.022, 0.16),
        (width - 0.12, 0.008, 0.26),
        rgb("aeb8b8"),
        "shell",
        bevel=0.002,
        turn=wall.turn,
    )


def put_ceiling(
    room: Room, size: tuple[float, float], height: float, colour: Colour, *, tile: float = 0.6
) -> None:
    """Put a ceiling, and the dark seams of its square tiles."""
    x, y = size[0] / 2, size[1] / 2
    rectangle(room, [(-x, y, height), (x, y, height), (x, -y, height), (-x, -y, height)], colour)
    half, below = 0.004, height - 0.002
    for k in range(1, round(size[0] / tile)):
        at = -x + k * size[0] / round(size[0] / tile)
        corners = ((at - half, y), (at + half, y), (at + half, -y), (at - half, -y))
        rectangle(room, [(u, v, below) for u, v in corners], rgb("b7c0be"))
    for k in range(1, round(size[1] / tile)):
        at = -y + k * size[1] / round(size[1] / tile)
        corners = ((-x, at + half), (x, at + half), (x, at - half), (-x, at - half))
        rectangle(room, [(u, v, below) for u, v in corners], rgb("b7c0be"))


def put_fill(room: Room, size: tuple[float, float], height: float, watts: float) -> None:
    """Let light come up from the whole of a room, as from a pale floor: ceilings are grey without."""
    at = (0.0, 0.0, height)
    room.lamps.append(Lamp(at=at, size=size, watts=watts, towards=(0.0, 0.0, height + 1.0)))


def put_light(
    room: Room, at: Sequence[float], size: tuple[float, float], watts: float, colour: Colour = (1, 1, 1)
) -> None:
    """Put a flat light under the ceiling: a frame, what shines, and the lamp that lights the room."""
    room.box(
        (at[0], at[1], at[2] - 0.012), (size[0] + 0.06, size[1] + 0.06, 0.03), WHITE, "shell", bevel=0.006
    )
    room.box((at[0], at[1], at[2] - 0.02), (size[0], size[1], 0.03), (1.0, 0.99, 0.96), GLOW, bevel=0.004)
    room.lamps.append(Lamp(at=(at[0], at[1], at[2] - 0.045), size=size, watts=watts, colour=colour))


def drop_outside(shell: bmesh.types.BMesh) -> None:
    """Leave out the faces of walls and ceiling that look away from the room: nobody sees them, and they cost light."""
    middle = Vector((0.0, 0.0, 1.4))
    away = [
        face
        for face in shell.faces
        if face.normal.dot((middle - face.calc_center_median()).normalized()) < -0.2
    ]
    bmesh.ops.delete(shell, geom=away, context="FACES")

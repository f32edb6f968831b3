"""Builds parts of a room, box by box, into a few layers of coloured triangles.

Blender's frame: metres, z up; a person who looks along -y looks along glTF's +z. All parts of a layer are drawn at
once, so that a room of a thousand parts costs a page five draws.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

Colour = tuple[float, float, float]
"""Linear red, green, blue."""
Point = Sequence[float]

BAKED = ("shell", "things")
"""Layers whose light is baked: floor, walls and ceiling; what stands between them."""
METAL = "metal"
"""Bare steel: it mirrors the room, so that no baked light is right from two sides."""
GLOW = "glow"
"""What shines by itself: its colour is all there is."""


def rgb(text: str) -> Colour:
    """Linear colour of a web page's ``"rrggbb"``."""
    values = [int(text[place : place + 2], 16) / 255 for place in (0, 2, 4)]
    red, green, blue = (v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in values)
    return red, green, blue


@dataclass(frozen=True, kw_only=True)
class Named:
    """A place by its name: where somebody stands or sits, what they cannot walk through.

    Attributes
    ----------
    name
        As docs/room-places.md lists them.
    at
        Metres, Blender's frame.
    turn
        About z in radians; 0 looks along -y.
    half
        Half sizes of a box along its own axes; (1, 1, 1) for a mere place.
    """

    name: str
    at: tuple[float, float, float]
    turn: float = 0.0
    half: tuple[float, float, float] = (1.0, 1.0, 1.0)


@dataclass(frozen=True, kw_only=True)
class Screen:
    """A flat rectangle that shows a picture, its front towards ``turn``."""

    name: str
    at: tuple[float, float, float]
    size: tuple[float, float]
    picture: bytes
    turn: float = 0.0
    tilt: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Lamp:
    """A rectangle or disc that shines downwards, or towards a point."""

    at: tuple[float, float, float]
    size: tuple[float, float]
    watts: float
    towards: tuple[float, float, float] | None = None
    colour: Colour = (1.0, 1.0, 1.0)


@dataclass
class Room:
    """All of a room, as its parts were put into it."""

    name: str
    layers: dict[str, bmesh.types.BMesh] = field(default_factory=dict)
    named: list[Named] = field(default_factory=list)
    screens: list[Screen] = field(default_factory=list)
    lamps: list[Lamp] = field(default_factory=list)

    def add(
        self, part: bmesh.types.BMesh, colour: Colour, layer: str = "things", *, smooth: bool = True
    ) -> None:
        """Put a mesh into a layer; frees it."""
        tint = part.loops.layers.float_color.new("colour")
        for face in part.faces:
            face.smooth = smooth
            for loop in face.loops:
                loop[tint] = (*colour, 1.0)
        mesh = bpy.data.meshes.new("part")
        part.to_mesh(mesh)
        part.free()
        if layer not in self.layers:
            self.layers[layer] = bmesh.new()
            self.layers[layer].loops.layers.float_color.new("colour")
        self.layers[layer].from_mesh(mesh)
        bpy.data.meshes.remove(mesh)

    def box(
        self,
        at: Point,
        size: Point,
        colour: Colour,
        layer: str = "things",
        *,
        bevel: float = 0.006,
        turn: float = 0.0,
        tilt: float = 0.0,
    ) -> None:
        """Put a box with rounded edges around ``at``; ``tilt`` turns it about its own x, then ``turn`` about z."""
        part = bmesh.new()
        bmesh.ops.create_cube(part, size=1.0, matrix=Matrix.Diagonal((*size, 1.0)))
        if bevel:
            width = min(bevel, 0.45 * min(size))
            bmesh.ops.bevel(
                part,
                geom=part.edges[:],
                offset=width,
                segments=2 if width > 0.004 else 1,
                profile=0.5,
                affect="EDGES",
            )
        turned = (
            Matrix.Translation(Vector(at)) @ Matrix.Rotation(turn, 4, "Z") @ Matrix.Rotation(tilt, 4, "X")
        )
        part.transform(turned)
        self.add(part, colour, layer, smooth=False)

    def lathe(
        self,
        at: Point,
        profile: Sequence[tuple[float, float]],
        colour: Colour,
        layer: str = "things",
        *,
        steps: int = 32,
        axis: Point = (0, 0, 1),
        scale: Point = (1, 1, 1),
    ) -> None:
        """Turn ``profile`` (radius, height) about an axis through ``at``; ends on the axis are closed."""
        part = bmesh.new()
        rings = []
        for radius, height in profile:
            if radius < 1e-6:
                rings.append([part.verts.new((0, 0, height))] * steps)
            else:
                angles = [2 * math.pi * k / steps for k in range(steps)]
                rings.append(
                    [part.verts.new((radius * math.cos(a), radius * math.sin(a), height)) for a in angles]
                )
        for low, high in itertools.pairwise(rings):
            for k in range(steps):
                corners = (low[k], low[(k + 1) % steps], high[(k + 1) % steps], high[k])
                part.faces.new(list(dict.fromkeys(corners)))
        bmesh.ops.recalc_face_normals(part, faces=part.faces[:])
        towards = Vector(axis).to_track_quat("Z", "Y").to_matrix().to_4x4()
        part.transform(Matrix.Translation(Vector(at)) @ towards @ Matrix.Diagonal((*scale, 1.0)))
        sharp = [edge for edge in part.edges if edge.is_manifold and edge.calc_face_angle(0.0) > 0.7]
        bmesh.ops.split_edges(part, edges=sharp)
        self.add(part, colour, layer)

    def disc(
        self, at: Point, radius: float, height: float, colour: Colour, layer: str = "things", **more
    ) -> None:
        """Put an upright cylinder with a small rounding at its top and bottom; ``at`` is its foot."""
        edge = min(0.006, 0.3 * height, 0.3 * radius)
        profile = [
            (0, 0),
            (radius - edge, 0),
            (radius, edge),
            (radius, height - edge),
            (radius - edge, height),
            (0, height),
        ]
        self.lathe(at, profile, colour, layer, **more)

    def ball(
        self,
        at: Point,
        radius: float,
        colour: Colour,
        layer: str = "things",
        *,
        scale: Point = (1, 1, 1),
        steps: int = 24,
    ) -> None:
        """Put a sphere, or an ellipsoid."""
        angles = [math.pi * k / (steps // 2) for k in range(steps // 2 + 1)]
        profile = [(radius * math.sin(a), -radius * math.cos(a)) for a in angles]
        self.lathe(at, profile, colour, layer, steps=steps, scale=scale)

    def tube(
        self, path: Sequence[Point], radius: float, colour: Colour, layer: str = "things", *, steps: int = 12
    ) -> None:
        """Put a round bar along ``path``, whose corners are as they are."""
        part = bmesh.new()
        points = [Vector(point) for point in path]
        rings = []
        side = None
        for index, point in enumerate(points):
            ahead = points[min(index + 1, len(points) - 1)] - points[max(index - 1, 0)]
            ahead.normalize()
            if side is None:
                side = ahead.orthogonal().normalized()
            side = (side - ahead * side.dot(ahead)).normalized()
            other = ahead.cross(side)
            angles = [2 * math.pi * k / steps for k in range(steps)]
            rings.append(
                [part.verts.new(point + radius * (math.cos(a) * side + math.sin(a) * other)) for a in angles]
            )
        for low, high in itertools.pairwise(rings):
            for k in range(steps):
                part.faces.new((low[k], low[(k + 1) % steps], high[(k + 1) % steps], high[k]))
        part.faces.new(rings[0][::-1])
        part.faces.new(rings[-1])
        bmesh.ops.recalc_face_normals(part, faces=part.faces[:])
        bmesh.ops.split_edges(part, edges=[edge for edge in part.edges if edge.calc_face_angle(0.0) > 0.9])
        self.add(part, colour, layer)

    def sheet(
        self, points: np.ndarray, colour: Colour, layer: str = "things", *, front: Point | None = (0, 0, 1)
    ) -> None:
        """Put a surface through a grid (rows, columns, 3) of points, seen from both sides by a page.

        Its light is that of its front, which looks along ``front`` on the whole; None for rows that go round
        something, lower ones first, once against the clock.
        """
        part = bmesh.new()
        rows, columns = points.shape[:2]
        verts = [[part.verts.new(points[i, j]) for j in range(columns)] for i in range(rows)]
        for i in range(rows - 1):
            for j in range(columns - 1):
                part.faces.new((verts[i][j], verts[i][j + 1], verts[i + 1][j + 1], verts[i + 1][j]))
        bmesh.ops.triangulate(part, faces=part.faces[:])
        part.normal_update()
        whole = sum((face.normal * face.calc_area() for face in part.faces), Vector())
        if front is not None and whole.dot(Vector(front)) < 0:
            bmesh.ops.reverse_faces(part, faces=part.faces[:])
        self.add(part, colour, layer)

    def block(self, name: str, at: Point, size: Point, turn: float = 0.0) -> None:
        """Say that nobody walks through a box on the floor, of sides ``size`` around ``at``, both x and y."""
        half = (size[0] / 2, size[1] / 2, 0.5)
        self.named.append(Named(name=f"block.{name}", at=(at[0], at[1], 0.5), turn=turn, half=half))


def curve(points: Sequence[Point], steps: int = 10) -> list[Point]:
    """A smooth way through points (Catmull-Rom)."""
    table = np.array([points[0], *points, points[-1]], float)
    way = []
    for a, b, c, d in zip(table, table[1:], table[2:], table[3:], strict=False):
        for t in np.linspace(0, 1, steps, endpoint=False):
            way.append(
                0.5
                * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)
            )
    return [tuple(point) for point in [*way, table[-1]]]

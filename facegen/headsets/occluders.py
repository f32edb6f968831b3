"""Parts of a headset that hide the face: rings, cylinders and boxes, as meshes in the headset frame."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from facegen.geometry import rotation_from_angles
from facegen.headsets.quantities import MM, Name, Share, Vector, record

SEGMENTS = 72
"""Corners of a round outline: 0.1 mm inside the circle at a radius of 100 mm."""
MAX_SIZE_MM = 1000.0

Length = Annotated[float, Field(gt=0, le=MAX_SIZE_MM)]


@record()
class Occluder:
    """A solid with its middle at ``position_mm``, turned by ``turn_deg`` (yaw, pitch, roll) about it.

    Before turning, a ``ring`` and a ``cylinder`` lie in the plane of x and y: an ellipse with the outer radii
    ``radii_mm`` along x and y, ``depth_mm`` deep along z; of a ring only a rim ``rim_mm`` wide is there. A ``box`` has
    the edges ``size_mm`` along x, y and z. ``albedo`` is its diffuse reflectance at the LEDs' wavelength.
    """

    name: Name
    shape: Literal["ring", "cylinder", "box"]
    position_mm: Vector
    turn_deg: Vector = (0.0, 0.0, 0.0)
    radii_mm: tuple[Length, Length] | None = None
    rim_mm: Length | None = None
    depth_mm: Length | None = None
    size_mm: tuple[Length, Length, Length] | None = None
    albedo: Share = 0.04

    @model_validator(mode="after")
    def _check(self) -> "Occluder":
        keys = KEYS_OF_SHAPE[self.shape]
        for key in ("radii_mm", "rim_mm", "depth_mm", "size_mm"):
            if (getattr(self, key) is not None) != (key in keys):
                verb = "needs" if key in keys else "has no"
                raise ValueError(f"a {self.shape} {verb} {key}; its keys are {', '.join(keys)}")
        if self.shape == "ring" and self.rim_mm >= min(self.radii_mm):
            raise ValueError(
                f"rim_mm is {self.rim_mm:g}, but must be below both radii_mm; a cylinder has no hole"
            )
        return self

    def contains(self, point: np.ndarray) -> bool:
        """Whether a point (3,) of the headset frame, metres, lies inside the solid."""
        x, y, z = (point / MM - self.position_mm) @ self._turn
        if self.shape == "box":
            return bool((2.0 * np.abs([x, y, z]) <= self.size_mm).all())
        a, b = self.radii_mm
        inside = np.hypot(x / a, y / b) <= 1.0 and 2.0 * abs(z) <= self.depth_mm
        if self.shape == "ring":
            inside &= np.hypot(x / (a - self.rim_mm), y / (b - self.rim_mm)) >= 1.0
        return bool(inside)

    def mesh(self) -> tuple[np.ndarray, np.ndarray]:
        """Vertices (V, 3) in the headset frame, metres, and faces (F, 4) int32, counter-clockwise from outside.

        Edges are sharp: faces on their two sides share no vertices.
        """
        bands = (
            _box(self.size_mm) if self.shape == "box" else _bands(self.radii_mm, self.depth_mm, self.rim_mm)
        )
        vertices, faces, start = [], [], 0
        for points, corners in bands:
            vertices.append(points)
            faces.append(corners + start)
            start += len(points)
        placed = np.concatenate(vertices) @ self._turn.T + self.position_mm
        return placed * MM, np.concatenate(faces).astype(np.int32)

    @property
    def _turn(self) -> np.ndarray:
        return rotation_from_angles(*np.radians(self.turn_deg))


KEYS_OF_SHAPE = {
    "ring": ("radii_mm", "rim_mm", "depth_mm"),
    "cylinder": ("radii_mm", "depth_mm"),
    "box": ("size_mm",),
}
"""Keys of an occluder that say how large each shape is."""


def _bands(
    radii: tuple[float, float], depth: float, rim: float | None
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Wall, front, inner wall and back: each between two loops of `SEGMENTS` points; a cylinder's hole is a line."""
    around = np.linspace(0.0, 2.0 * np.pi, SEGMENTS, endpoint=False)
    circle = np.stack([np.cos(around), np.sin(around)], axis=-1)
    inner = np.subtract(radii, rim) if rim is not None else np.multiply(radii, 1e-6)
    loops = [
        np.column_stack([circle * size, np.full(SEGMENTS, z)])
        for size, z in ((radii, -depth / 2), (radii, depth / 2), (inner, depth / 2), (inner, -depth / 2))
    ]
    first = np.arange(SEGMENTS)
    following = (first + 1) % SEGMENTS
    faces = np.stack([first, following, following + SEGMENTS, first + SEGMENTS], axis=-1)
    return [(np.concatenate([loops[i], loops[(i + 1) % 4]]), faces) for i in range(4)]


def _box(size: tuple[float, float, float]) -> list[tuple[np.ndarray, np.ndarray]]:
    half = np.divide(size, 2.0)
    sides = []
    for axis in range(3):
        u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
        for sign in (1.0, -1.0):
            square = [a * u + b * sign * v for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            sides.append(((np.array(square) + sign * np.eye(3)[axis]) * half, np.array([[0, 1, 2, 3]])))
    return sides

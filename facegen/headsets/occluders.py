"""Parts of a headset that hide the face: rings, cylinders and boxes, as meshes in the headset frame."""

from functools import cached_property
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from facegen.geometry import rotation_from_angles
from facegen.headsets.quantities import MM, Fraction, Name, Vector, record

SEGMENTS = 72
"""Corners of a round outline: 0.1 mm inside the circle at a radius of 100 mm."""
FACE_MM = 5.0
"""Longest edge of a face along a straight line. Ray casting leaves out faces that reach behind the camera
(`facegen.raster.nearest_depth`); of small ones nothing is in the picture."""
MAX_SIZE_MM = 1000.0

Length = Annotated[float, Field(gt=0, le=MAX_SIZE_MM)]


@record()
class HeadsetOccluder:
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
    albedo: Fraction = 0.04

    @model_validator(mode="after")
    def _check(self) -> "HeadsetOccluder":
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

    @cached_property
    def _turn(self) -> np.ndarray:
        return rotation_from_angles(*np.radians(self.turn_deg))


KEYS_OF_SHAPE = {
    "ring": ("radii_mm", "rim_mm", "depth_mm"),
    "cylinder": ("radii_mm", "depth_mm"),
    "box": ("size_mm",),
}
"""Keys of an occluder that say how large each shape is."""


_Surface = tuple[np.ndarray, np.ndarray]
"""Points (n, 3) and faces (m, 4)."""


def _bands(radii: tuple[float, float], depth: float, rim: float | None) -> list[_Surface]:
    """Wall, front, inner wall and back, each between two loops of `SEGMENTS` points; a cylinder's hole is a line."""
    around = np.linspace(0.0, 2.0 * np.pi, SEGMENTS, endpoint=False)
    circle = np.stack([np.cos(around), np.sin(around)], axis=-1)
    inner = np.subtract(radii, rim) if rim is not None else np.multiply(radii, 1e-6)
    loops = [
        np.column_stack([circle * size, np.full(SEGMENTS, z)])
        for size, z in ((radii, -depth / 2), (radii, depth / 2), (inner, depth / 2), (inner, -depth / 2))
    ]
    return [_between(loops[i], loops[(i + 1) % 4], closed=True) for i in range(4)]


def _box(size: tuple[float, float, float]) -> list[_Surface]:
    sides = []
    for axis in range(3):
        out, u, v = (np.eye(3)[(axis + k) % 3] * size[(axis + k) % 3] / 2.0 for k in range(3))
        along = np.linspace(-1.0, 1.0, _steps(2.0 * np.linalg.norm(u)) + 1)[:, None]
        sides += [_between(s * out + along * u - s * v, s * out + along * u + s * v) for s in (1.0, -1.0)]
    return sides


def _between(first: np.ndarray, last: np.ndarray, *, closed: bool = False) -> _Surface:
    """The surface between two lines of as many points (n, 3); closed lines end where they begin."""
    steps = _steps(np.linalg.norm(last - first, axis=-1).max())
    share = np.linspace(0.0, 1.0, steps + 1)[:, None, None]
    points = (1.0 - share) * first + share * last
    here = np.arange(len(first))
    following = np.roll(here, -1)
    here, following = (here, following) if closed else (here[:-1], following[:-1])
    faces = np.stack([here, following, following + len(first), here + len(first)], axis=-1)
    rows = np.arange(steps)[:, None, None] * len(first)
    return points.reshape(-1, 3), (faces + rows).reshape(-1, 4)


def _steps(length_mm: float) -> int:
    return max(int(np.ceil(length_mm / FACE_MM)), 1)

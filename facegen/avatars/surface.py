"""What an avatar is made of: surfaces with materials, morph targets and bones, before they become a file."""

from dataclasses import dataclass, field, replace

import numpy as np
from scipy import sparse


@dataclass(frozen=True, kw_only=True)
class Material:
    """How a surface looks, in glTF's terms.

    Attributes
    ----------
    name
        In the file.
    colour
        Red, green, blue and opacity, linear, 0 to 1; multiplies picture and vertex colours.
    roughness
        0 to 1.
    picture, normals
        Encoded PNG or JPEG of the colour (sRGB) and of the normals in tangent space; empty for none.
    alpha
        ``"OPAQUE"``, ``"MASK"`` (cut at 0.5) or ``"BLEND"``.
    both_sides
        Whether the back is drawn.
    """

    name: str
    colour: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    roughness: float = 0.6
    picture: bytes = b""
    normals: bytes = b""
    alpha: str = "OPAQUE"
    both_sides: bool = False


@dataclass(frozen=True, kw_only=True)
class Bone:
    """A bone of the skeleton: its parent's name (None for the root), and its rest pose.

    ``place`` is where its head lies in the avatar's frame, metres; ``turn`` a quaternion x, y, z, w from its own axes
    to the avatar's.
    """

    name: str
    parent: str | None
    place: tuple[float, float, float]
    turn: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Surface:
    """Triangles of one material, V vertices; the avatar's frame, metres.

    Attributes
    ----------
    mesh
        Name of the mesh it is a part of; surfaces of one mesh share morph targets.
    material
        How it looks.
    positions, normals
        (V, 3).
    triangles
        (T, 3) counter-clockwise seen from outside.
    uv
        (V, 2) v downwards as glTF has it; None without a picture.
    colours
        (V, 4) linear, 0 to 1; None for white.
    moved, turned
        (52, V, 3) what each blendshape does to positions and normals; None for a mesh that no blendshape moves.
    still_m
        A vertex that a blendshape moves by less stays.
    upright
        A normal that a blendshape turns by less stays: it would not be seen, and the file would be larger.
    bones
        Names of the bones that carry it.
    shares
        (V, len(bones)) of each bone.
    """

    mesh: str
    material: Material
    positions: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    uv: np.ndarray | None = None
    colours: np.ndarray | None = None
    moved: np.ndarray | None = None
    turned: np.ndarray | None = None
    still_m: float = 1.5e-4
    upright: float = 0.15
    bones: tuple[str, ...] = ("Head",)
    shares: np.ndarray = field(default_factory=lambda: np.zeros((0, 1)))

    def carried(self, bones: tuple[str, ...], shares: np.ndarray) -> "Surface":
        """The same surface carried by bones, with (V, len(bones)) shares."""
        return replace(self, bones=bones, shares=shares)


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Unit normals (..., V, 3) of vertices (..., V, 3), each the mean of its triangles' by area."""
    corners = vertices[..., triangles, :]
    normal = np.cross(corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :])
    flat = normal.reshape(-1, *normal.shape[-2:])
    sums = np.zeros((len(flat), vertices.shape[-2], 3))
    for row, one in zip(sums, flat, strict=True):
        for axis in range(3):
            weight = np.repeat(one[:, axis], 3)
            row[:, axis] = np.bincount(triangles.ravel(), weight, vertices.shape[-2])
    sums = sums.reshape(vertices.shape)
    return sums / np.maximum(np.linalg.norm(sums, axis=-1, keepdims=True), 1e-20)


def cut(surface: Surface, kept: np.ndarray) -> Surface:
    """The surface with only the triangles ``kept`` (T,) bool, and without the vertices that no other uses."""
    triangles = surface.triangles[kept]
    used, numbers = np.unique(triangles, return_inverse=True)

    def of(values: np.ndarray | None, axis: int = 0) -> np.ndarray | None:
        return None if values is None else np.take(values, used, axis=axis)

    return replace(
        surface,
        positions=surface.positions[used],
        normals=surface.normals[used],
        triangles=numbers.reshape(-1, 3),
        uv=of(surface.uv),
        colours=of(surface.colours),
        moved=of(surface.moved, 1),
        turned=of(surface.turned, 1),
        shares=of(surface.shares) if len(surface.shares) else surface.shares,
    )


def trimmed(surface: Surface, inside: np.ndarray) -> Surface:
    """The surface cut along the line where ``inside`` (V,) is 0.

    Vertices beyond it, of triangles that cross it, are drawn to the mean of the places where their edges do.
    """
    outside = inside < 0.0
    kept = ~outside[surface.triangles].all(axis=1)
    sides = surface.triangles[kept][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    sides = np.unique(np.concatenate([sides, sides[:, ::-1]]), axis=0)
    start, end = sides[outside[sides[:, 0]] & ~outside[sides[:, 1]]].T
    count = len(outside)
    share = inside[start] / (inside[start] - inside[end]) / np.bincount(start, minlength=count)[start]
    own = 1.0 - np.bincount(start, share, count)
    blend = sparse.diags(own) + sparse.csr_matrix((share, (start, end)), shape=(count, count))

    def between(values: np.ndarray | None, axis: int = 0) -> np.ndarray | None:
        if values is None or values.shape[axis] == 0:
            return values
        first = np.moveaxis(values, axis, 0)
        return np.moveaxis((blend @ first.reshape(count, -1)).reshape(first.shape), 0, axis)

    drawn = replace(
        surface,
        positions=between(surface.positions),
        normals=between(surface.normals),
        uv=between(surface.uv),
        colours=between(surface.colours),
        moved=between(surface.moved, 1),
        turned=between(surface.turned, 1),
        shares=between(surface.shares),
    )
    return cut(drawn, kept)

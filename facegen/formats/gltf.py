"""Reads meshes with morph targets out of glTF 2.0 files (.glb, .gltf), as they stand in the file's scene.

Not among the names of `facegen.formats`, because it imports pygltflib, which few runs need.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 3.6.2 accessors (sparse ones in 3.6.2.3), 3.7.2.2 morph targets,
   3.7.3 skins, 3.5 nodes.
"""

import json
import struct
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from facegen.errors import FormatError
from facegen.formats.gltf_buffers import read_buffers
from facegen.formats.gltf_container import check_amount, is_binary, json_of, read_gltf_bytes
from facegen.formats.gltf_targets import target_names

MOST_VERTICES = 500_000
"""Of a file's primitives together, ten times a head's of film studios: each takes 3 kB with 52 shapes."""

MOST_TRIANGLES = 2_000_000
"""Of a file's primitives together; a mesh has two a vertex."""

MOST_NUMBERS = 100_000_000
"""Of all accessors that a file's primitives name, each time that they do: 0.8 GB."""

_DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TRIANGLES = 4
_MOST_JOINTS = 65_536  # vertices name them in 16 bits
COMPRESSIONS = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression")
"""Extensions by which meshes are stored as nothing here reads them."""


@dataclass(frozen=True, kw_only=True, eq=False)
class GltfPart:
    """One primitive of a mesh: what has one material.

    Attributes
    ----------
    mesh, node, material
        Names; empty where the file gives none.
    positions
        (V, 3) in the scene's frame (y up, front towards +z) and unit (metres, says the format), skinned by the
        pose in the file.
    triangles
        (T, 3) indices into ``positions``, counter-clockwise seen from outside.
    uv
        (V, 2) first texture coordinates, v upwards (the file's run downwards); zeros where there are none.
    morphs
        Displacements (V, 3) by morph target, the same frame and unit; in the file's order.
    """

    mesh: str
    node: str
    material: str
    positions: np.ndarray
    triangles: np.ndarray
    uv: np.ndarray
    morphs: dict[str, np.ndarray]


def read_gltf(path: Path) -> tuple[GltfPart, ...]:
    """Every triangle primitive in the file's scene: nodes in the scene's order, primitives in their mesh's.

    Weights that the file gives to morph targets are not applied: positions are the neutral shape.

    Raises
    ------
    FormatError
        The file is no glTF 2.0 file, is damaged, too large or compressed, or a number in it is not finite.
    """
    from pygltflib import GLTF2

    with damage_told(path):
        content = read_gltf_bytes(path)
        check_amount(json_of(content), path)
        # by what it holds: pygltflib's own `load` takes all but .glb for JSON, .vrm too
        load = GLTF2.load_binary if is_binary(content) else GLTF2.load_json
        gltf = load(str(path))
        compressed = [name for name in COMPRESSIONS if name in (gltf.extensionsRequired or [])]
        if compressed:
            raise FormatError(
                f"{path} is compressed with {compressed[0]}, which facegen does not read; export it without "
                "compression"
            )
        return tuple(_parts(GltfFile(gltf, read_buffers(gltf, path.parent))))


@contextmanager
def damage_told(path: Path) -> Iterator[None]:
    """Make one sentence of whatever a damaged file makes pygltflib and NumPy raise.

    Raises
    ------
    FormatError
        In place of that, with the file's name.
    """
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("error", UserWarning)  # pygltflib warns of versions it does not know
            yield
    except FormatError as error:
        raise error if str(path) in str(error) else FormatError(f"{path}: {error}") from error
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise FormatError(f"{path} cannot be read as a glTF 2.0 file (it is neither GLB nor JSON)") from error
    # by where the damage lies
    except (
        *(OSError, ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError),
        *(UserWarning, struct.error),
    ) as error:
        reason = str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
        raise FormatError(f"{path} cannot be read as a glTF 2.0 file ({reason})") from error


class GltfFile:
    """A file's records and buffers, and how much of what it may hold has been taken."""

    def __init__(self, gltf: Any, buffers: list[bytes]) -> None:
        self.gltf, self.buffers = gltf, buffers
        self._taken = {"vertices": 0, "triangles": 0, "numbers": 0}

    def take(self, what: str, count: int, most: int) -> None:
        """Refuse a file that goes beyond a bound; a count comes before what it counts is allocated."""
        self._taken[what] += count
        if not 0 <= count <= most or self._taken[what] > most:
            raise FormatError(f"it has {self._taken[what]:,} {what}, and at most {most:,} are read")

    def item(self, kind: str, index: Any) -> Any:
        """One of the file's meshes, nodes, skins and so on, by its number."""
        records = getattr(self.gltf, kind)
        if not isinstance(index, int) or not 0 <= index < len(records):
            raise FormatError(f"it names number {index} of its {kind}, of which it has {len(records)}")
        return records[index]


def _parts(file: GltfFile) -> Iterator[GltfPart]:
    placed = _world_from_node(file)
    for index, world in placed.items():
        node = file.item("nodes", index)
        if node.mesh is None:
            continue
        mesh = file.item("meshes", node.mesh)
        for primitive in mesh.primitives:
            if primitive.mode in (None, _TRIANGLES):
                yield _part(file, node, mesh, primitive, world, placed)


def _part(
    file: GltfFile, node: Any, mesh: Any, primitive: Any, world: np.ndarray, placed: dict[int, np.ndarray]
) -> GltfPart:
    attributes = vars(primitive.attributes)
    count = file.item("accessors", attributes["POSITION"]).count
    file.take("vertices", count, MOST_VERTICES)
    positions = accessor_values(file, attributes["POSITION"], "VEC3")
    deform = _skinning(file, node.skin, attributes, placed, count) if node.skin is not None else world[None]
    turn = deform[:, :3, :3]
    uv = attributes.get("TEXCOORD_0")
    uv = np.zeros((count, 2)) if uv is None else accessor_values(file, uv, "VEC2", count)
    morphs = {}
    for name, target in zip(target_names(mesh), primitive.targets or [], strict=False):
        moved = (target if isinstance(target, dict) else vars(target)).get("POSITION")
        if moved is not None:
            morphs[name] = _turned(turn, accessor_values(file, moved, "VEC3", count))
    triangles = _triangles(file, primitive.indices, count)
    if np.median(np.linalg.det(turn)) < 0:  # a mirrored node turns the winding round (glTF 2.0, 3.7.4)
        triangles = triangles[:, ::-1]
    material = None if primitive.material is None else file.item("materials", primitive.material)
    part = GltfPart(
        mesh=_name(mesh),
        node=_name(node),
        material=_name(material),
        positions=_turned(turn, positions) + deform[:, :3, 3],
        triangles=triangles,
        uv=np.stack([uv[:, 0], 1.0 - uv[:, 1]], axis=1),
        morphs=morphs,
    )
    if not all(np.isfinite(array).all() for array in (part.positions, part.uv, *morphs.values())):
        raise FormatError(
            f"mesh {part.mesh!r} has a position, a texture coordinate or a shape that is not finite"
        )
    return part


def _name(record: Any) -> str:
    return record.name if record is not None and isinstance(record.name, str) else ""


def _turned(turn: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    return np.einsum("...ij,...j->...i", turn, vectors)


def _triangles(file: GltfFile, index: int | None, vertices: int) -> np.ndarray:
    order = np.arange(vertices) if index is None else accessor_values(file, index, "SCALAR")[:, 0]
    file.take("triangles", len(order) // 3, MOST_TRIANGLES)
    outside = order[~((order >= 0) & (order < vertices))]
    if len(outside):
        raise FormatError(f"a triangle names vertex {outside[0]:g}, its mesh has {vertices}")
    return order.astype(int).reshape(-1, 3)


def _world_from_node(file: GltfFile) -> dict[int, np.ndarray]:
    """Matrices (4, 4) of the scene's nodes, in the order in which the scene is walked."""
    gltf = file.gltf
    children = {child for node in gltf.nodes for child in node.children or []}
    roots = [index for index in range(len(gltf.nodes)) if index not in children]
    if gltf.scenes:
        roots = file.item("scenes", gltf.scene or 0).nodes or roots
    world: dict[int, np.ndarray] = {}
    waiting = [(index, np.eye(4)) for index in reversed(roots)]
    while waiting:
        index, parent = waiting.pop()
        if index in world:
            raise FormatError(f"node {index} stands in the scene twice")
        node = file.item("nodes", index)
        world[index] = parent @ _local(node)
        waiting += [(child, world[index]) for child in reversed(node.children or [])]
    return world


def _local(node: object) -> np.ndarray:
    if node.matrix:
        return np.reshape(np.array(node.matrix, np.float64), (4, 4)).T
    x, y, z, w = node.rotation or (0.0, 0.0, 0.0, 1.0)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(node.scale or (1.0, 1.0, 1.0))
    matrix[:3, 3] = node.translation or (0.0, 0.0, 0.0)
    return matrix


def _skinning(
    file: GltfFile, index: int, attributes: dict, placed: dict[int, np.ndarray], vertices: int
) -> np.ndarray:
    """(V, 4, 4): each vertex's mean of its joints' matrices; the node's own place does not count [1]_."""
    skin = file.item("skins", index)
    if not 0 < len(skin.joints) <= _MOST_JOINTS:
        raise FormatError(f"skin {index} has {len(skin.joints)} joints; 1 to {_MOST_JOINTS:,} can be named")
    joints = np.stack([placed.get(joint, np.eye(4)) for joint in skin.joints])
    if skin.inverseBindMatrices is not None:
        inverse = accessor_values(file, skin.inverseBindMatrices, "MAT4")[: len(joints)]
        joints = joints @ inverse.reshape(-1, 4, 4).transpose(0, 2, 1)
    chosen = accessor_values(file, attributes["JOINTS_0"], "VEC4", vertices)
    share = accessor_values(file, attributes["WEIGHTS_0"], "VEC4", vertices)
    if not ((chosen >= 0) & (chosen < len(joints))).all():
        raise FormatError(f"a vertex names a joint that its skin, of {len(joints)} joints, does not have")
    share = share / np.maximum(share.sum(axis=1, keepdims=True), 1e-12)
    return np.einsum("vj,vjab->vab", share, joints[chosen.astype(int)])


def accessor_values(file: GltfFile, index: int, kind: str, count: int | None = None) -> np.ndarray:
    """Values (count, width) in float64, sparse ones filled in, normalised integers divided by their range."""
    accessor = file.item("accessors", index)
    if accessor.type != kind or (count is not None and accessor.count != count):
        wish = kind if count is None else f"{count} {kind}"
        raise FormatError(f"accessor {index} has {accessor.count} {accessor.type} where {wish} are needed")
    dtype, width = np.dtype(_DTYPES[accessor.componentType]), _WIDTHS[kind]
    file.take("numbers", accessor.count * width, MOST_NUMBERS)
    if accessor.bufferView is None:
        values = np.zeros((accessor.count, width), dtype)
    else:
        values = _view(file, accessor.bufferView, accessor.byteOffset, dtype, (accessor.count, width))
    sparse = accessor.sparse
    if sparse is not None:
        where, what = sparse.indices, sparse.values
        kind_of_row = np.dtype(_DTYPES[where.componentType])
        rows = _view(file, where.bufferView, where.byteOffset, kind_of_row, (sparse.count, 1))[:, 0]
        if len(rows) and not 0 <= rows.min() <= rows.max() < accessor.count:
            raise FormatError(f"accessor {index} replaces a row that it does not have")
        values = values.copy()
        values[rows] = _view(file, what.bufferView, what.byteOffset, dtype, (sparse.count, width))
    if accessor.normalized and dtype.kind in "iu":
        return np.maximum(values / np.iinfo(dtype).max, -1.0)
    return values.astype(np.float64)


def _view(
    file: GltfFile, index: int, offset: int | None, dtype: np.dtype, shape: tuple[int, int]
) -> np.ndarray:
    view = file.item("bufferViews", index)
    if not isinstance(view.buffer, int) or not 0 <= view.buffer < len(file.buffers):
        raise FormatError(
            f"it names number {view.buffer} of its buffers, of which it has {len(file.buffers)}"
        )
    stride = view.byteStride or shape[1] * dtype.itemsize
    return np.ndarray(
        shape,
        dtype,
        file.buffers[view.buffer],
        (view.byteOffset or 0) + (offset or 0),
        (stride, dtype.itemsize),
    )

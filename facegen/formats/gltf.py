"""Reads meshes with morph targets out of glTF 2.0 files (.glb, .gltf), as they stand in the file's scene.

Not among the names of `facegen.formats`, because it imports pygltflib, which few runs need.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 3.6.2 accessors (sparse ones in 3.6.2.3), 3.7.2.2 morph targets,
   3.7.3 skins, 3.5 nodes. The names of morph targets stand in ``mesh.extras.targetNames``, as its
   implementation note suggests and Blender, three.js and Ready Player Me write them.
"""

import struct
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.errors import FormatError

_DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TRIANGLES = 4
_COMPRESSED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")


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
        The file is no glTF 2.0 file, is damaged, or is compressed.
    """
    from pygltflib import GLTF2

    if not path.is_file():
        raise FormatError(f"{path} does not exist; a glTF file (.glb or .gltf) is needed")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # pygltflib warns of versions it does not know
            gltf = GLTF2().load(str(path))
        compressed = [name for name in _COMPRESSED if name in (gltf.extensionsRequired or [])]
        if compressed:
            raise FormatError(
                f"{path} is compressed with {compressed[0]}, which facegen does not read; export it without "
                "compression"
            )
        file = _File(gltf=gltf, buffers=[gltf.get_data_from_buffer_uri(b.uri) for b in gltf.buffers])
        return tuple(_parts(file))
    except FormatError:
        raise
    # what pygltflib and NumPy raise on damage, by where it lies
    except (OSError, ValueError, LookupError, TypeError, AttributeError, UserWarning, struct.error) as error:
        reason = str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
        raise FormatError(f"{path} cannot be read as a glTF 2.0 file ({reason})") from error


@dataclass(frozen=True, kw_only=True, eq=False)
class _File:
    gltf: object
    buffers: list[bytes]


def _parts(file: _File) -> Iterator[GltfPart]:
    gltf, placed = file.gltf, _world_from_node(file.gltf)
    for index, world in placed.items():
        node = gltf.nodes[index]
        if node.mesh is None:
            continue
        mesh = gltf.meshes[node.mesh]
        names = (mesh.extras or {}).get("targetNames", [])
        for primitive in mesh.primitives:
            if primitive.mode not in (None, _TRIANGLES):
                continue
            attributes = vars(primitive.attributes)
            positions = _accessor(file, attributes["POSITION"])
            deform = _skinning(file, node.skin, attributes, placed) if node.skin is not None else world[None]
            turn = deform[:, :3, :3]
            uv = attributes.get("TEXCOORD_0")
            uv = np.zeros((len(positions), 2)) if uv is None else _accessor(file, uv)
            morphs = {}
            for name, target in zip(names, primitive.targets or [], strict=False):
                moved = (target if isinstance(target, dict) else vars(target)).get("POSITION")
                if moved is not None:
                    morphs[str(name)] = _turned(turn, _accessor(file, moved))
            yield GltfPart(
                mesh=mesh.name or "",
                node=node.name or "",
                material=_material(gltf, primitive.material),
                positions=_turned(turn, positions) + deform[:, :3, 3],
                triangles=_triangles(file, primitive.indices, len(positions)),
                uv=np.stack([uv[:, 0], 1.0 - uv[:, 1]], axis=1),
                morphs=morphs,
            )


def _material(gltf: object, index: int | None) -> str:
    return "" if index is None else gltf.materials[index].name or ""


def _turned(turn: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    return np.einsum("...ij,...j->...i", turn, vectors)


def _triangles(file: _File, index: int | None, vertices: int) -> np.ndarray:
    order = np.arange(vertices) if index is None else _accessor(file, index)[:, 0].astype(int)
    if order.size and order.max() >= vertices:
        raise FormatError(f"a triangle names vertex {order.max()}, its mesh has {vertices}")
    return order.reshape(-1, 3)


def _world_from_node(gltf: object) -> dict[int, np.ndarray]:
    """Matrices (4, 4) of the scene's nodes, in the order in which the scene is walked."""
    children = {child for node in gltf.nodes for child in node.children or []}
    roots = [index for index in range(len(gltf.nodes)) if index not in children]
    if gltf.scenes:
        roots = gltf.scenes[gltf.scene or 0].nodes or roots
    world: dict[int, np.ndarray] = {}
    waiting = [(index, np.eye(4)) for index in reversed(roots)]
    while waiting:
        index, parent = waiting.pop()
        if index in world:
            raise FormatError(f"node {index} stands in the scene twice")
        world[index] = parent @ _local(gltf.nodes[index])
        waiting += [(child, world[index]) for child in reversed(gltf.nodes[index].children or [])]
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


def _skinning(file: _File, skin: int, attributes: dict, placed: dict[int, np.ndarray]) -> np.ndarray:
    """(V, 4, 4): each vertex's mean of its joints' matrices; the node's own place does not count [1]_."""
    skin = file.gltf.skins[skin]
    joints = np.stack([placed.get(joint, np.eye(4)) for joint in skin.joints])
    if skin.inverseBindMatrices is not None:
        joints = joints @ _accessor(file, skin.inverseBindMatrices).reshape(-1, 4, 4).transpose(0, 2, 1)
    chosen, share = (
        _accessor(file, attributes["JOINTS_0"]).astype(int),
        _accessor(file, attributes["WEIGHTS_0"]),
    )
    share = share / np.maximum(share.sum(axis=1, keepdims=True), 1e-12)
    return np.einsum("vj,vjab->vab", share, joints[chosen])


def _accessor(file: _File, index: int) -> np.ndarray:
    """Values (count, width) in float64, sparse ones filled in, normalised integers divided by their range."""
    accessor = file.gltf.accessors[index]
    dtype, width = np.dtype(_DTYPES[accessor.componentType]), _WIDTHS[accessor.type]
    if accessor.bufferView is None:
        values = np.zeros((accessor.count, width), dtype)
    else:
        values = _view(file, accessor.bufferView, accessor.byteOffset, dtype, (accessor.count, width))
    sparse = accessor.sparse
    if sparse is not None:
        where, what = sparse.indices, sparse.values
        rows = _view(
            file,
            where.bufferView,
            where.byteOffset,
            np.dtype(_DTYPES[where.componentType]),
            (sparse.count, 1),
        )
        values = values.copy()
        values[rows[:, 0]] = _view(file, what.bufferView, what.byteOffset, dtype, (sparse.count, width))
    if accessor.normalized and dtype.kind in "iu":
        return np.maximum(values / np.iinfo(dtype).max, -1.0)
    return values.astype(np.float64)


def _view(file: _File, index: int, offset: int | None, dtype: np.dtype, shape: tuple[int, int]) -> np.ndarray:
    view = file.gltf.bufferViews[index]
    stride = view.byteStride or shape[1] * dtype.itemsize
    return np.ndarray(
        shape,
        dtype,
        file.buffers[view.buffer],
        (view.byteOffset or 0) + (offset or 0),
        (stride, dtype.itemsize),
    )

"""Writes an avatar's surfaces and skeleton as a .glb file, morph targets as sparse accessors."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from facegen.avatars.surface import Bone, Material, Surface
from facegen.conventions import BLENDSHAPES
from facegen.formats.gltf_writer import INDICES, VERTICES, GltfWriter

BONES_A_VERTEX = 4
"""That carry a vertex: what graphics cards take."""


def avatar_bytes(
    surfaces: Sequence[Surface], bones: Sequence[Bone], *, copyright: str, extras: dict[str, Any]
) -> bytes:
    """Bytes of a .glb file with one scene: the skeleton, and a skinned node for each mesh.

    Parameters
    ----------
    surfaces
        In drawing order; those of one mesh stand together.
    bones
        Parents before children, one root.
    copyright, extras
        Stand in ``asset``.
    """
    writer = GltfWriter(copyright=copyright, extras=extras)
    number = {bone.name: index for index, bone in enumerate(bones)}
    for record in _bone_records(bones, number):
        writer.add("nodes", record)
    world = [_matrix(bone.place, bone.turn) for bone in bones]
    inverse = np.stack([np.linalg.inv(matrix).T.reshape(16) for matrix in world])
    writer.add(
        "skins",
        {
            "joints": list(range(len(bones))),
            "inverseBindMatrices": writer.numbers(inverse.astype("<f4")),
            "skeleton": 0,
        },
    )
    materials: dict[str, int] = {}
    roots = [0]
    for name in dict.fromkeys(surface.mesh for surface in surfaces):
        members = [surface for surface in surfaces if surface.mesh == name]
        mesh: dict[str, Any] = {
            "name": name,
            "primitives": [_primitive(writer, surface, number, materials) for surface in members],
        }
        if members[0].moved is not None:
            mesh |= {"weights": [0.0] * len(BLENDSHAPES), "extras": {"targetNames": list(BLENDSHAPES)}}
        node = {"name": name, "mesh": writer.add("meshes", mesh), "skin": 0}
        roots.append(writer.add("nodes", node))
    writer.scene(roots)
    return writer.content()


def _bone_records(bones: Sequence[Bone], number: dict[str, int]) -> list[dict[str, Any]]:
    world = {bone.name: _matrix(bone.place, bone.turn) for bone in bones}
    turns = {bone.name: np.array(bone.turn) for bone in bones}
    records = []
    for bone in bones:
        local, turn = world[bone.name], turns[bone.name]
        if bone.parent is not None:
            local = np.linalg.inv(world[bone.parent]) @ local
            turn = _product(turns[bone.parent] * [-1.0, -1.0, -1.0, 1.0], turn)
        record: dict[str, Any] = {"name": bone.name, "translation": [float(x) for x in local[:3, 3]]}
        if np.abs(turn[:3]).max() > 1e-9:
            record["rotation"] = [float(x) for x in turn / np.linalg.norm(turn)]
        children = [number[other.name] for other in bones if other.parent == bone.name]
        records.append(record | ({"children": children} if children else {}))
    return records


def _primitive(
    writer: GltfWriter, surface: Surface, number: dict[str, int], materials: dict[str, int]
) -> dict[str, Any]:
    count = len(surface.positions)
    attributes = {
        "POSITION": writer.numbers(surface.positions.astype("<f4"), target=VERTICES, bounds=True),
        "NORMAL": writer.numbers(_unit(surface.normals).astype("<f4"), target=VERTICES),
    }
    if surface.uv is not None:
        attributes["TEXCOORD_0"] = writer.numbers(surface.uv.astype("<f4"), target=VERTICES)
    if surface.colours is not None:
        colours = np.rint(255.0 * np.clip(surface.colours, 0.0, 1.0)).astype("u1")
        attributes["COLOR_0"] = writer.numbers(colours, target=VERTICES, normalized=True)
    joints, shares = _influences(surface, number)
    attributes["JOINTS_0"] = writer.numbers(joints, target=VERTICES)
    attributes["WEIGHTS_0"] = writer.numbers(shares, target=VERTICES, normalized=True)
    kind = "<u2" if count <= 65_535 else "<u4"
    primitive: dict[str, Any] = {
        "attributes": attributes,
        "indices": writer.numbers(surface.triangles.reshape(-1).astype(kind), target=INDICES),
        "material": _material(writer, surface.material, materials),
    }
    if surface.moved is not None:
        primitive["targets"] = [_target(writer, surface, shape) for shape in range(len(BLENDSHAPES))]
    return primitive


def _target(writer: GltfWriter, surface: Surface, shape: int) -> dict[str, int]:
    accessors = {}
    for name, change, least in (
        ("POSITION", surface.moved, surface.still_m),
        ("NORMAL", surface.turned, surface.upright),
    ):
        rows = np.flatnonzero(np.linalg.norm(change[shape], axis=1) > least)
        accessors[name] = writer.sparse(
            rows, change[shape][rows], len(surface.positions), bounds=name == "POSITION"
        )
    return accessors


def _influences(surface: Surface, number: dict[str, int]) -> tuple[np.ndarray, np.ndarray]:
    """Joints and weights (V, 4) as bytes; the weights' sum is 255."""
    count = len(surface.positions)
    shares = surface.shares if len(surface.shares) else np.ones((count, len(surface.bones)))
    order = np.argsort(-shares, axis=1, kind="stable")[:, :BONES_A_VERTEX]
    best = np.take_along_axis(shares, order, axis=1)
    weights = np.floor(255.0 * best / best.sum(axis=1, keepdims=True)).astype(int)
    weights[:, 0] += 255 - weights.sum(axis=1)
    joints = np.array([number[name] for name in surface.bones])[order] * (weights > 0)
    padding = ((0, 0), (0, BONES_A_VERTEX - order.shape[1]))
    return np.pad(joints, padding).astype("u1"), np.pad(weights, padding).astype("u1")


def _material(writer: GltfWriter, material: Material, known: dict[str, int]) -> int:
    if material.name in known:
        return known[material.name]
    surface: dict[str, Any] = {
        "baseColorFactor": list(material.colour),
        "metallicFactor": 0.0,
        "roughnessFactor": material.roughness,
    }
    if material.picture:
        surface["baseColorTexture"] = {"index": writer.texture(material.picture, material.name)}
    record: dict[str, Any] = {"name": material.name, "pbrMetallicRoughness": surface}
    if material.normals:
        record["normalTexture"] = {"index": writer.texture(material.normals, f"{material.name} normals")}
    if material.alpha != "OPAQUE":
        record["alphaMode"] = material.alpha
    if material.both_sides:
        record["doubleSided"] = True
    known[material.name] = writer.add("materials", record)
    return known[material.name]


def _unit(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors; straight up where there is no direction."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.where(length > 0.5, vectors / np.maximum(length, 1e-12), [0.0, 1.0, 0.0])


def _matrix(place: Sequence[float], turn: Sequence[float]) -> np.ndarray:
    x, y, z, w = np.array(turn) / np.linalg.norm(turn)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = place
    return matrix


def _product(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Quaternions multiplied: the second turns first."""
    vector = first[3] * second[:3] + second[3] * first[:3] + np.cross(first[:3], second[:3])
    return np.array([*vector, first[3] * second[3] - first[:3] @ second[:3]])

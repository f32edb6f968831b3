"""Writes a room as one .glb: a mesh a layer, a rectangle a screen, an empty node a place."""

import math

import bpy
import numpy as np

from blender_assets.rooms.kit import BAKED, GLOW, METAL, Named, Room, Screen
from facegen.formats.gltf_writer import INDICES, VERTICES, GltfWriter

COPYRIGHT = "CC0 1.0; made by blender_assets/rooms of facegen"
UNLIT = "KHR_materials_unlit"


def room_bytes(room: Room, objects: dict[str, bpy.types.Object], light: dict[str, bytes]) -> bytes:
    """Bytes of the file."""
    writer = GltfWriter(copyright=COPYRIGHT, extras={"license": "CC0-1.0", "room": room.name})
    writer.document["extensionsUsed"] = [UNLIT]
    roots = [_layer(writer, name, thing, light.get(name)) for name, thing in sorted(objects.items())]
    roots += [_screen(writer, screen) for screen in room.screens]
    roots += [_place(writer, named) for named in sorted(room.named, key=lambda named: named.name)]
    writer.scene(roots)
    return writer.content()


def _gltf(points: np.ndarray) -> np.ndarray:
    """From Blender's z up to glTF's y up."""
    return np.stack([points[..., 0], points[..., 2], -points[..., 1]], axis=-1)


def _layer(writer: GltfWriter, name: str, thing: bpy.types.Object, light: bytes | None) -> int:
    """A node of all triangles of a layer; corners that are the same in all stand once."""
    mesh = thing.data
    mesh.calc_loop_triangles()
    corners = _numbers(mesh.loop_triangles, "loops", 3 * len(mesh.loop_triangles), np.int32)
    vertices = _numbers(mesh.loops, "vertex_index", len(mesh.loops), np.int32)
    places = _gltf(_numbers(mesh.vertices, "co", 3 * len(mesh.vertices)).reshape(-1, 3)[vertices])
    colours = _numbers(mesh.attributes["colour"].data, "color", 4 * len(mesh.loops)).reshape(-1, 4)
    columns = [np.round(places, 5), np.rint(255 * np.clip(colours, 0, 1))]
    if light:
        uv = _numbers(mesh.uv_layers.active.data, "uv", 2 * len(mesh.loops)).reshape(-1, 2)
        columns.append(np.rint(65535 * np.clip(np.stack([uv[:, 0], 1 - uv[:, 1]], axis=-1), 0, 1)))
    if name == METAL:
        normals = _gltf(_numbers(mesh.corner_normals, "vector", 3 * len(mesh.loops)).reshape(-1, 3))
        columns.append(np.round(normals, 3))
    table, which = np.unique(np.concatenate(columns, axis=1)[corners], axis=0, return_inverse=True)
    which = which.reshape(-1, 3)
    which = which[(which[:, 0] != which[:, 1]) & (which[:, 1] != which[:, 2]) & (which[:, 0] != which[:, 2])]
    attributes = {
        "POSITION": writer.numbers(table[:, :3].astype("<f4"), target=VERTICES, bounds=True),
        "COLOR_0": writer.numbers(table[:, 3:7].astype("u1"), target=VERTICES, normalized=True),
    }
    if light:
        attributes["TEXCOORD_0"] = writer.numbers(
            table[:, 7:9].astype("<u2"), target=VERTICES, normalized=True
        )
    if name == METAL:
        unit = table[:, 7:10] / np.maximum(np.linalg.norm(table[:, 7:10], axis=1, keepdims=True), 1e-9)
        attributes["NORMAL"] = writer.numbers(unit.astype("<f4"), target=VERTICES)
    kind = "<u2" if len(table) <= 65_535 else "<u4"
    primitive = {
        "attributes": attributes,
        "indices": writer.numbers(which.reshape(-1).astype(kind), target=INDICES),
        "material": writer.add("materials", _material(writer, name, light)),
    }
    number = writer.add("meshes", {"name": name, "primitives": [primitive]})
    return writer.add("nodes", {"name": name, "mesh": number})


def _material(writer: GltfWriter, name: str, light: bytes | None) -> dict:
    if name == METAL:
        return {"name": "steel", "pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.32}}
    surface: dict = {"metallicFactor": 0.0, "roughnessFactor": 1.0}
    if light:
        surface["baseColorTexture"] = {"index": writer.texture(light, f"light of {name}")}
    record = {"name": name, "pbrMetallicRoughness": surface, "extensions": {UNLIT: {}}}
    if name in BAKED and name != "shell":
        record["doubleSided"] = True  # cloth is one sheet
    if name not in (*BAKED, GLOW):
        raise ValueError(f"no material for the layer {name!r}")
    return record


def _screen(writer: GltfWriter, screen: Screen) -> int:
    """A rectangle in its node's x and y, seen from +z."""
    x, y = screen.size[0] / 2, screen.size[1] / 2
    corners = np.array([[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]], "<f4")
    primitive = {
        "attributes": {
            "POSITION": writer.numbers(corners, target=VERTICES, bounds=True),
            "TEXCOORD_0": writer.numbers(np.array([[0, 1], [1, 1], [1, 0], [0, 0]], "<f4"), target=VERTICES),
        },
        "indices": writer.numbers(np.array([0, 1, 2, 0, 2, 3], "<u2"), target=INDICES),
        "material": writer.add(
            "materials",
            {
                "name": screen.name,
                "pbrMetallicRoughness": {
                    "baseColorTexture": {"index": writer.texture(screen.picture, screen.name)},
                    "metallicFactor": 0.0,
                },
                "extensions": {UNLIT: {}},
            },
        ),
    }
    node = {
        "name": screen.name,
        "mesh": writer.add("meshes", {"name": screen.name, "primitives": [primitive]}),
        "translation": _list(screen.at),
        "rotation": _rotation(screen.turn, screen.tilt),
    }
    return writer.add("nodes", node)


def _place(writer: GltfWriter, named: Named) -> int:
    node: dict = {"name": named.name, "translation": _list(named.at)}
    if named.turn:
        node["rotation"] = _rotation(named.turn)
    if named.half != (1.0, 1.0, 1.0):
        x, y, z = named.half
        node["scale"] = [x, z, y]
    return writer.add("nodes", node)


def _list(at: tuple[float, float, float]) -> list[float]:
    return [round(float(value), 6) + 0.0 for value in (at[0], at[2], -at[1])]


def _rotation(turn: float, tilt: float = 0.0) -> list[float]:
    """Turn about y, after a tilt about x."""
    cos_y, sin_y, cos_x, sin_x = (
        math.cos(turn / 2),
        math.sin(turn / 2),
        math.cos(tilt / 2),
        math.sin(tilt / 2),
    )
    return [round(value, 9) for value in (cos_y * sin_x, sin_y * cos_x, -sin_y * sin_x, cos_y * cos_x)]


def _numbers(records, name: str, count: int, dtype=np.float32) -> np.ndarray:
    values = np.empty(count, dtype)
    records.foreach_get(name, values)
    return values

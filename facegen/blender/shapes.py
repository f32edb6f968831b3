"""Makes Blender's meshes and hair curves of a scene's."""

import bpy
import numpy as np

from facegen.scene.scene import Mesh, Strands


def new_mesh(mesh: Mesh, materials: list[bpy.types.Material]) -> bpy.types.Mesh:
    """Blender's mesh with smooth normals, a texture map ``uv``, a face attribute ``part`` and the mesh's fields.

    Attributes are filled by a copy of memory; through ``vertices``, ``loops`` and ``polygons`` Blender goes value by
    value, which takes a hundred times as long.
    """
    data = bpy.data.meshes.new(mesh.name)
    corners = mesh.faces >= 0
    sizes = corners.sum(axis=1)
    data.vertices.add(len(mesh.vertices))
    position = np.ascontiguousarray(mesh.vertices, np.float32)
    data.attributes["position"].data.foreach_set("vector", position.ravel())
    data.loops.add(int(sizes.sum()))
    data.attributes[".corner_vert"].data.foreach_set("value", mesh.faces[corners].astype(np.int32))
    data.polygons.add(len(sizes))
    data.polygons.foreach_set("loop_start", np.concatenate([[0], np.cumsum(sizes)[:-1]]).astype(np.int32))
    material = data.attributes.new("material_index", "INT", "FACE")
    material.data.foreach_set("value", mesh.face_material.astype(np.int32))
    for each in materials:
        data.materials.append(each)
    if mesh.uv is not None:
        data.uv_layers.new(name="uv").uv.foreach_set("vector", mesh.uv[corners].astype(np.float32).ravel())
    part = data.attributes.new("part", "FLOAT", "FACE")
    part.data.foreach_set("value", mesh.part.astype(np.float32))
    for name, values in mesh.fields.items():
        data.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", values.astype(np.float32))
    data.update(calc_edges=True)
    return data


def new_curves(strands: Strands, material: bpy.types.Material) -> bpy.types.Curves:
    """Blender's hair curves with their thickness and, as one value each, ``part``."""
    count, points = strands.points.shape[:2]
    data = bpy.data.hair_curves.new(strands.name)
    data.add_curves([points] * count)
    position = np.ascontiguousarray(strands.points, np.float32)
    data.attributes["position"].data.foreach_set("vector", position.ravel())
    radius = data.attributes.get("radius") or data.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", strands.radius_m.astype(np.float32).ravel())
    part = data.attributes.new("part", "FLOAT", "CURVE")
    part.data.foreach_set("value", np.full(count, strands.part, np.float32))
    data.materials.append(material)
    return data


def remove(data: bpy.types.ID) -> None:
    """Take a mesh or curves out of Blender's memory."""
    (bpy.data.meshes if isinstance(data, bpy.types.Mesh) else bpy.data.hair_curves).remove(data)

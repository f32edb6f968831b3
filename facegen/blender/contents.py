"""Brings what Blender's scene holds in line with a `Scene` and a view: objects, lamps, cameras, materials."""

import bpy
import numpy as np
from mathutils import Matrix

from facegen.blender.materials import build_material
from facegen.blender.nodes import set_parameters
from facegen.blender.runtime import compile_lens
from facegen.blender.shapes import new_curves, new_mesh, remove
from facegen.geometry import Camera, invert_transform
from facegen.geometry.cameras import DISTORTION_TERMS
from facegen.scene.materials import material_values
from facegen.scene.scene import Lamp, Mesh, Scene, View

BLENDER_FROM_OPENCV = np.diag([1.0, -1.0, -1.0, 1.0])
"""Blender's cameras look along -z with y up."""
CLIP_M = (1e-3, 10.0)
"""Blender's default near plane of 0.1 m would hide a whole headset."""
ABOUT_EQUAL = 1.3
"""Lamps whose powers differ by no more than this factor count as equal: units of one kind differ by 5 %."""


class SceneContents:
    """Data-blocks of one Blender scene, kept from one `Scene` to the next.

    Parameters
    ----------
    scene
        Blender's scene, empty.
    subsurface
        Whether skin scatters light below its surface.
    """

    def __init__(self, scene: bpy.types.Scene, *, subsurface: bool) -> None:
        self._scene = scene
        self._subsurface = subsurface
        self._lens = compile_lens()
        self._materials: dict[str, bpy.types.Material] = {}
        self._objects: dict[str, bpy.types.Object] = {}
        self._lamps: dict[str, bpy.types.Object] = {}
        self._cameras: dict[str, bpy.types.Object] = {}
        self._loaded: Scene | None = None

    def paint(self, scene: Scene, view: View) -> None:
        """Give the loaded materials the parameters that they have in a view."""
        for name, material in self._materials.items():
            changed = scene.materials.get(name, {}) | view.materials.get(name, {})
            set_parameters(material, material_values(name, changed))

    def load(self, scene: Scene) -> None:
        """Make Blender hold a scene's meshes, strands and lamps and no others; nothing to do for the one it holds."""
        if scene is self._loaded:
            return
        for name in scene.materials:
            material_values(name, scene.materials[name])
        for mesh in scene.meshes:
            self._place_mesh(mesh, scene)
        for strands in scene.strands:
            self._place(strands.name, new_curves(strands, self._material(strands.material, scene)))
        for lamp in scene.lamps:
            self._place_lamp(lamp)
        for name in set(self._objects) - {placed.name for placed in (*scene.meshes, *scene.strands)}:
            remove(self._objects.pop(name).data)
        for name in set(self._lamps) - {lamp.name for lamp in scene.lamps}:
            bpy.data.lights.remove(self._lamps.pop(name).data)
        self._loaded = scene

    def _material(self, name: str, scene: Scene) -> bpy.types.Material:
        values = material_values(name, scene.materials.get(name, {}))
        if name not in self._materials:
            self._materials[name] = build_material(name, subsurface=self._subsurface)
            set_parameters(self._materials[name], values)
        return self._materials[name]

    def _place_mesh(self, mesh: Mesh, scene: Scene) -> None:
        """Give the mesh's object new data.

        Moving the old data's vertices would be cheaper by some milliseconds, but then Cycles refits its
        search tree instead of building it, and the next picture's normals differ in their last bit from a
        fresh process's.
        """
        self._place(mesh.name, new_mesh(mesh, [self._material(name, scene) for name in mesh.materials]))

    def _place(self, name: str, data: bpy.types.ID) -> None:
        if name in self._objects:
            old = self._objects[name].data
            self._objects[name].data = data
            remove(old)
        else:
            self._objects[name] = bpy.data.objects.new(name, data)
            self._scene.collection.objects.link(self._objects[name])

    def _place_lamp(self, lamp: Lamp) -> None:
        if lamp.name not in self._lamps:
            light = bpy.data.lights.new(lamp.name, "AREA")
            light.shape = "DISK"
            self._lamps[lamp.name] = bpy.data.objects.new(lamp.name, light)
            self._scene.collection.objects.link(self._lamps[lamp.name])
        placed = self._lamps[lamp.name]
        placed.data.size, placed.data.energy, placed.data.spread = (
            lamp.diameter_m,
            lamp.power_w,
            lamp.spread_rad,
        )
        placed.matrix_world = _matrix(_pose_along(lamp.position, lamp.direction))

    def light(self, view: View | None) -> None:
        """Switch on the lamps of a view and no others."""
        for name, placed in self._lamps.items():
            placed.hide_render = view is None or name not in view.lamps
        powers = [
            self._lamps[name].data.energy for name in (view.lamps if view else ()) if name in self._lamps
        ]
        # measured: among equal lamps any choice is as good, and the tree costs a fifth of an eye's view; among lamps of
        # different weight it more than pays (a mouth's noise at equal time is 0.42 of that without)
        self._scene.cycles.use_light_tree = bool(powers) and max(powers) > ABOUT_EQUAL * min(powers)

    def aim(self, view: View) -> None:
        """Make the view's camera the scene's."""
        if view.name not in self._cameras:
            data = bpy.data.cameras.new(view.name)
            data.type, data.custom_mode = "CUSTOM", "INTERNAL"
            data.custom_bytecode, data.custom_bytecode_hash = self._lens
            data.clip_start, data.clip_end = CLIP_M
            self._cameras[view.name] = bpy.data.objects.new(view.name, data)
            self._scene.collection.objects.link(self._cameras[view.name])
        placed = self._cameras[view.name]
        for key, value in _lens_parameters(view.camera).items():
            placed.data.cycles_custom[key] = value
        placed.data.update_tag()
        placed.matrix_world = _matrix(invert_transform(view.camera_from_head) @ BLENDER_FROM_OPENCV)
        self._scene.camera = placed
        self._scene.render.resolution_x, self._scene.render.resolution_y = (
            view.camera.width,
            view.camera.height,
        )


def _lens_parameters(camera: Camera) -> dict[str, float | int]:
    # custom properties keep Python's types, and the shader looks them up by type
    values = {term: 0.0 for term in ("k1", "k2", "k3", "k4", "p1", "p2")}
    values |= {
        term: float(k) for term, k in zip(DISTORTION_TERMS[camera.model], camera.coefficients, strict=True)
    }
    return values | {
        "fisheye": int(camera.model == "fisheye"),
        "width": float(camera.width),
        "height": float(camera.height),
        "fx": float(camera.fx),
        "fy": float(camera.fy),
        "cx": float(camera.cx),
        "cy": float(camera.cy),
    }


def _pose_along(position: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Pose whose -z axis points along ``direction``; a round lamp does not care about the turn about it."""
    z = -np.asarray(direction, np.float64)
    x = np.cross((0.0, 1.0, 0.0) if abs(z[1]) < 0.9 else (1.0, 0.0, 0.0), z)
    x /= np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([x, np.cross(z, x), z], axis=-1)
    pose[:3, 3] = position
    return pose


def _matrix(pose: np.ndarray) -> Matrix:
    return Matrix(pose.tolist())

"""Cycles as a function from a `Scene` and a view to linear `Layers`: one scene kept alive, no files."""

from functools import lru_cache
from pathlib import Path

import bpy
import numpy as np

from facegen.blender.materials import build_material, build_truth_material
from facegen.blender.nodes import set_parameters
from facegen.blender.passes import passes_of_renders
from facegen.blender.runtime import LENS, choose_device, compile_lens, quiet_stdout
from facegen.blender.shapes import new_curves, new_mesh, remove
from facegen.conventions import Part
from facegen.errors import InputError
from facegen.geometry import Camera, invert_transform, pixel_rays
from facegen.geometry.cameras import DISTORTION_TERMS
from facegen.scene.materials import material_values
from facegen.scene.scene import Glimpse, Lamp, Layers, Mesh, Scene, View

BLENDER_FROM_OPENCV = np.diag([1.0, -1.0, -1.0, 1.0])
"""Blender's cameras look along -z with y up."""
CLIP_M = (1e-3, 10.0)
"""Blender's default near plane of 0.1 m would hide a whole headset."""
ABOUT_EQUAL = 1.3
"""Lamps whose powers differ by no more than this factor count as equal: units of one kind differ by 5 %."""
NOTHING_M = 1e9
"""Cycles writes 1e10 where a ray meets nothing."""
HALF_MAX = float(np.finfo(np.float16).max)
DEPTH_STEP_M, UV_STEP = 2.0**-20, 2.0**-16
"""A micrometre, and a 32nd of a pixel of a 2,048 texture: digits below mean nothing and do not compress."""


class Renderer:
    """Renders scenes in this process; make one and keep it (a second one takes over Blender's only scene).

    Pictures depend on the scene, the view, ``samples`` and ``seed`` alone: not on what was rendered before,
    on the number of threads, nor on the process.

    Parameters
    ----------
    threads
        Threads of Cycles, at least two. Fixed for the renderer's life, because Cycles takes a change up one
        render late.
    subsurface
        Whether skin scatters light below its surface. Off: a third of the time, and harder shadows.
    device
        See `facegen.blender.runtime.choose_device`.
    """

    def __init__(self, *, threads: int = 1, subsurface: bool = True, device: str = "cpu") -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self._scene = bpy.context.scene
        self._set_up(threads)
        self.device = choose_device(device)
        self._subsurface = subsurface
        self._lens = compile_lens()
        self._truth = build_truth_material()
        self._materials: dict[str, bpy.types.Material] = {}
        self._objects: dict[str, bpy.types.Object] = {}
        self._lamps: dict[str, bpy.types.Object] = {}
        self._cameras: dict[str, bpy.types.Object] = {}
        self._loaded: Scene | None = None

    def _set_up(self, threads: int) -> None:
        scene = self._scene
        world = bpy.data.worlds.new("dark")
        world.use_nodes = True
        world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
        scene.world = world
        scene.render.engine = "CYCLES"
        scene.render.threads_mode = "FIXED"
        # measured: a single thread is joined by a second one that does nothing but wait, at full load; two
        # share the work
        scene.render.threads = max(2, threads)
        # kept data made pictures depend on chance: Cycles may take a new mesh for an old one at the same address, and
        # then normals and hits differ in the last bit (in half of 98 renders; in none of 40 without, for 0.1 s a view)
        scene.render.use_persistent_data = False
        scene.render.use_compositing = False
        scene.render.use_sequencer = False
        scene.render.resolution_percentage = 100
        cycles = scene.cycles
        cycles.use_adaptive_sampling = False
        cycles.use_animated_seed = False
        # measured: the default, blue noise, gives other noise after a render with more samples, for good
        cycles.sampling_pattern = "TABULATED_SOBOL"
        # measured: more bounces change nothing, a second diffuse one is 1 % of the brightness
        cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces = 4, 2, 2
        cycles.transmission_bounces, cycles.transparent_max_bounces = 4, 4
        cycles.caustics_reflective = cycles.caustics_refractive = False
        cycles.denoiser = "OPENIMAGEDENOISE"
        cycles.denoising_input_passes = "RGB_ALBEDO_NORMAL"
        # ACCURATE costs a second more per view and changes less than 1 dB; the quick network saves less than the paths
        # that its pictures need in addition (2 paths with HIGH and FAST are as good as 4 with FAST and NONE)
        cycles.denoising_prefilter = "FAST"
        cycles.denoising_use_gpu = False

    def render(
        self, scene: Scene, view_name: str, *, samples: int, seed: int, denoise: bool = True
    ) -> Layers:
        """Radiance with ``samples`` paths a pixel, and what is true at each pixel's centre.

        Parameters
        ----------
        scene
            What to render. Loaded once however many of its views are asked for in a row.
        view_name
            One of its views.
        samples
            Paths a pixel; 8 with denoising do.
        seed
            0 to 2**31 - 1: give every view of every sample its own.
        denoise
            Whether Open Image Denoise cleans the radiance.
        """
        view = _view(scene, view_name)
        self._load(scene)
        self._paint(scene, view)
        self._aim(view)
        truth = self._truth_passes(view)
        self._light(view)
        self._sample(samples, seed, denoise)
        return _layers(view, _radiance(self._passes()), truth)

    def glimpse(
        self, scene: Scene, view_name: str, *, samples: int, seed: int, denoise: bool = True
    ) -> Glimpse:
        """The radiance of `render`, bit for bit, and the denoiser's guides instead of the truth: one render, not two.

        Parameters are those of `render`.
        """
        view = _view(scene, view_name)
        self._load(scene)
        self._paint(scene, view)
        self._aim(view)
        self._light(view)
        self._sample(samples, seed, denoise)
        guides = self._scene.view_layers[0].cycles
        guides.denoising_store_passes = True
        try:
            passes = self._passes()
        finally:
            guides.denoising_store_passes = False
        return Glimpse(
            radiance=_radiance(passes),
            normal=passes["Denoising Normal"] * np.float32([1, -1, 1]),
            albedo=passes["Denoising Albedo"][..., 0],
        )

    def save(
        self, scene: Scene, view_name: str, path: Path, *, samples: int, seed: int, denoise: bool = True
    ) -> None:
        """Write a .blend file that renders a view's radiance as `render` does, but for glints; nothing lies outside it.

        All cameras are in it, the view's own is active, and its lamps alone are lit. The other parameters are those of
        `render`.
        """
        view = _view(scene, view_name)
        self._load(scene)
        self._paint(scene, view)
        for other in (*scene.views, view):
            self._aim(other)
        self._light(view)
        self._sample(samples, seed, denoise)
        # cameras hold the compiled lens; its source is for readers
        source = bpy.data.texts.get(LENS.name) or bpy.data.texts.new(LENS.name)
        source.from_string(LENS.read_text(encoding="utf-8"))
        source.use_fake_user = True
        with quiet_stdout():
            bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True, copy=True)

    def _sample(self, samples: int, seed: int, denoise: bool) -> None:
        cycles = self._scene.cycles
        cycles.samples, cycles.seed, cycles.use_denoising = samples, seed, denoise

    def _truth_passes(self, view: View) -> dict[str, np.ndarray]:
        """One sample a pixel, which Cycles puts at its centre, with the label material on everything."""
        cycles, layer = self._scene.cycles, self._scene.view_layers[0]
        self._light(None)
        layer.material_override = self._truth
        layer.use_pass_z = layer.use_pass_normal = True
        cycles.samples, cycles.seed, cycles.use_denoising = 1, 0, False
        try:
            return self._passes()
        finally:
            layer.material_override = None
            layer.use_pass_z = layer.use_pass_normal = False

    def _passes(self) -> dict[str, np.ndarray]:
        """Render the scene as it stands; float32 arrays (h, w, channels) by pass name, row 0 on top."""
        with passes_of_renders() as passes, quiet_stdout():
            bpy.ops.render.render()
        return passes

    def _paint(self, scene: Scene, view: View) -> None:
        """Give the loaded materials the parameters that they have in a view."""
        for name, material in self._materials.items():
            given = scene.materials.get(name, {}) | view.materials.get(name, {})
            set_parameters(material, material_values(name, given))

    def _load(self, scene: Scene) -> None:
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

    def _light(self, view: View | None) -> None:
        """Switch on the lamps of a view and no others."""
        for name, placed in self._lamps.items():
            placed.hide_render = view is None or name not in view.lamps
        powers = [
            self._lamps[name].data.energy for name in (view.lamps if view else ()) if name in self._lamps
        ]
        # measured: among equal lamps any choice is as good, and the tree costs a fifth of an eye's view; among lamps of
        # different weight it more than pays (a mouth's noise at equal time is 0.42 of that without)
        self._scene.cycles.use_light_tree = bool(powers) and max(powers) > ABOUT_EQUAL * min(powers)

    def _aim(self, view: View) -> None:
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


def _view(scene: Scene, name: str) -> View:
    views = {view.name: view for view in scene.views}
    if name not in views:
        raise InputError(f"the scene has no view {name!r}; it has {', '.join(views)}")
    return views[name]


def _layers(view: View, radiance: np.ndarray, truth: dict[str, np.ndarray]) -> Layers:
    """What Cycles gives, in the camera's frame and our units."""
    ray_length = truth["Depth"][..., 0]
    nothing = ray_length > NOTHING_M
    # custom cameras measure along the ray; labels want the distance along the camera's axis
    depth = np.where(nothing, np.inf, ray_length * _ray_z(view.camera))
    normal = np.where(nothing[..., None], 0.0, truth["Normal"] @ view.camera_from_head[:3, :3].T)
    label = truth["Combined"]
    part = np.rint(label[..., 0]).astype(np.uint8)
    return Layers(
        radiance=radiance,
        depth=_rounded(depth, DEPTH_STEP_M),
        normal=normal.astype(np.float16).astype(np.float32),
        part=part,
        uv=np.where(part[..., None] == Part.BACKGROUND, 0.0, _rounded(label[..., 1:3], UV_STEP)),
    )


def _radiance(passes: dict[str, np.ndarray]) -> np.ndarray:
    return np.clip(passes["Combined"][..., 0], 0.0, HALF_MAX).astype(np.float16).astype(np.float32)


def _rounded(values: np.ndarray, step: float) -> np.ndarray:
    return (np.rint(values / step) * step).astype(np.float32)


@lru_cache(maxsize=32)
def _ray_z(camera: Camera) -> np.ndarray:
    return pixel_rays(camera)[..., 2]


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


def _matrix(pose: np.ndarray):
    from mathutils import Matrix

    return Matrix(pose.tolist())

"""Renders a view of a `Scene` with Cycles to linear `Layers`, in this process and without files."""

import errno
import os
from pathlib import Path

import bpy
import numpy as np

from facegen.blender.contents import SceneContents
from facegen.blender.layers import glimpse_of_passes, layers_of_passes
from facegen.blender.materials import build_truth_material
from facegen.blender.passes import passes_of_renders
from facegen.blender.runtime import LENS, choose_device, quiet_stdout
from facegen.blender.settings import set_up_cycles
from facegen.errors import InputError
from facegen.scene.scene import Glimpse, Layers, Scene, View

_WRITING = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EACCES, errno.EIO)
"""The system's refusals that Blender repeats in its own error."""


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
        set_up_cycles(self._scene, threads=threads)
        self.device = choose_device(device)
        self._contents = SceneContents(self._scene, subsurface=subsurface)
        self._truth = build_truth_material()

    def render(
        self, scene: Scene, view_name: str, *, samples: int, seed: int, denoise: bool = True
    ) -> Layers:
        """Render radiance with ``samples`` paths a pixel, and what is true at each pixel's centre.

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
        self._contents.load(scene)
        self._contents.paint(scene, view)
        self._contents.aim(view)
        truth = self._truth_passes(view)
        self._contents.light(view)
        self._sample(samples, seed, denoise)
        return layers_of_passes(view, self._passes(), truth)

    def glimpse(
        self, scene: Scene, view_name: str, *, samples: int, seed: int, denoise: bool = True
    ) -> Glimpse:
        """Render the radiance of `render`, bit for bit, and the denoiser's guides instead of the truth, in one pass.

        Parameters are those of `render`.
        """
        view = _view(scene, view_name)
        self._contents.load(scene)
        self._contents.paint(scene, view)
        self._contents.aim(view)
        self._contents.light(view)
        self._sample(samples, seed, denoise)
        guides = self._scene.view_layers[0].cycles
        guides.denoising_store_passes = True
        try:
            passes = self._passes()
        finally:
            guides.denoising_store_passes = False
        return glimpse_of_passes(passes)

    def save(
        self,
        scene: Scene,
        view_name: str,
        path: Path,
        *,
        samples: int,
        seed: int,
        denoise: bool = True,
        licences: str = "",
    ) -> None:
        """Write a .blend file that renders a view's radiance as `render` does, but for glints; nothing lies outside it.

        All cameras are in it, the view's own is active, and its lamps alone are lit. Its text ``LICENSE.txt`` holds
        ``licences``. The other parameters are those of `render`.

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        view = _view(scene, view_name)
        self._contents.load(scene)
        self._contents.paint(scene, view)
        for other in (*scene.views, view):
            self._contents.aim(other)
        self._contents.light(view)
        self._sample(samples, seed, denoise)
        # cameras hold the compiled lens; its source is for readers
        for name, content in ((LENS.name, LENS.read_text(encoding="utf-8")), ("LICENSE.txt", licences)):
            text = bpy.data.texts.get(name) or bpy.data.texts.new(name)
            text.from_string(content)
            text.use_fake_user = True
        try:
            with quiet_stdout():
                bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True, copy=True)
        except RuntimeError as error:  # Blender's own, with the system's words in it
            code = next((code for code in _WRITING if os.strerror(code) in str(error)), errno.EIO)
            raise OSError(code, os.strerror(code), str(path)) from error

    def _sample(self, samples: int, seed: int, denoise: bool) -> None:
        cycles = self._scene.cycles
        cycles.samples, cycles.seed, cycles.use_denoising = samples, seed, denoise

    def _truth_passes(self, view: View) -> dict[str, np.ndarray]:
        """One sample a pixel, which Cycles puts at its centre, with the label material on everything."""
        cycles, layer = self._scene.cycles, self._scene.view_layers[0]
        self._contents.light(None)
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


def _view(scene: Scene, name: str) -> View:
    views = {view.name: view for view in scene.views}
    if name not in views:
        raise InputError(f"the scene has no view {name!r}; it has {', '.join(views)}")
    return views[name]

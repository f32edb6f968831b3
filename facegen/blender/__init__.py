"""Renders scenes with Cycles: the only package that imports ``bpy``, and only when asked to render."""

from typing import TYPE_CHECKING

from facegen.blender.runtime import import_bpy

if TYPE_CHECKING:
    from facegen.blender.renderer import Renderer

__all__ = ["open_renderer"]


def open_renderer(*, threads: int = 1, subsurface: bool = True, device: str = "cpu") -> "Renderer":
    """Start Blender in this process and return its `facegen.blender.renderer.Renderer`.

    Call it in spawned processes only: a child that was forked after Blender started hangs in its first
    render.

    Raises
    ------
    MissingAsset
        Where Blender or a system library it needs is not installed; the message names the package.
    """
    import_bpy()
    from facegen.blender.renderer import Renderer

    return Renderer(threads=threads, subsurface=subsurface, device=device)

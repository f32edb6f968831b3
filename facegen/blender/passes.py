"""Takes the pixels of a render from the engine itself, without files: in background mode Blender keeps none.

Blender's own EXR and PNG writers put times into their headers, and its Viewer node stays black without a
window. The engine's result is there right after its ``render`` returns, bit-equal to what a file would hold,
in 20 microseconds.
"""

import contextlib
from collections.abc import Iterator

import numpy as np


@contextlib.contextmanager
def passes_of_renders() -> Iterator[dict[str, np.ndarray]]:
    """Collect the passes of the render that runs inside: float32 (h, w, channels) by name, row 0 on top."""
    from cycles import CyclesRender  # Blender's add-on, importable once bpy is

    kept: dict[str, np.ndarray] = {}
    plain_render = CyclesRender.render

    def render_and_keep(engine: CyclesRender, depsgraph: object) -> None:
        plain_render(engine, depsgraph)
        result = engine.get_result()
        width, height = result.resolution_x, result.resolution_y
        for layer_pass in result.layers[0].passes:
            pixels = np.empty(width * height * layer_pass.channels, np.float32)
            layer_pass.rect.foreach_get(pixels)
            kept[layer_pass.name] = pixels.reshape(height, width, -1)[::-1]

    CyclesRender.render = render_and_keep
    try:
        yield kept
    finally:
        CyclesRender.render = plain_render

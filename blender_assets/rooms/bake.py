"""Lights a room with Cycles and bakes the light into one picture a layer."""

import io
import tempfile
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector
from PIL import Image

from blender_assets.rooms.kit import Lamp, Room

MARGIN_PX = 6
"""Of light around each island, so that a smaller copy of the picture takes none of the black between them."""
CEILING = 0.97
"""Linear light of the brightest texel: more than white cannot be written."""
SATURATION = 0.5
"""Of the light's own colour: a camera's white balance takes as much away, and walls stay as they were painted."""
KNEE = 0.72
"""Above this, light is pressed together rather than cut off: what a lamp looks at keeps its folds."""


def baked(
    room: Room,
    objects: dict[str, bpy.types.Object],
    *,
    sizes: dict[str, int],
    samples: int,
    seed: int,
    exposure: float,
) -> dict[str, bytes]:
    """Light of each baked layer as JPEG, by its name; the objects get a UV map for it."""
    for index, lamp in enumerate(room.lamps):
        _put_lamp(lamp, index)
    scene = bpy.context.scene
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 5
    scene.render.bake.margin = MARGIN_PX
    pictures = {}
    for name, size in sizes.items():
        thing = objects[name]
        _unwrap(thing, size)
        image = bpy.data.images.new(f"light {name}", size, size, float_buffer=True, alpha=False)
        image.colorspace_settings.name = "Non-Color"
        node = thing.data.materials[0].node_tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        thing.data.materials[0].node_tree.nodes.active = node
        _select(thing)
        bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, use_clear=True)
        light = np.empty(size * size * 4, np.float32)
        image.pixels.foreach_get(light)
        light = light.reshape(size, size, 4)[..., :3]
        pictures[name] = _jpeg(_denoised(light, scene) * exposure)
    return pictures


def _put_lamp(lamp: Lamp, index: int) -> None:
    data = bpy.data.lights.new(f"lamp {index}", "AREA")
    data.shape, data.size, data.size_y = "RECTANGLE", *lamp.size
    data.energy, data.color = lamp.watts, lamp.colour
    thing = bpy.data.objects.new(data.name, data)
    thing.location = lamp.at
    if lamp.towards is not None:
        data.shape = "DISK" if lamp.size[0] == lamp.size[1] else "RECTANGLE"
        thing.rotation_euler = (Vector(lamp.towards) - Vector(lamp.at)).to_track_quat("-Z", "Y").to_euler()
        data.spread = 1.0 if data.shape == "DISK" else 2.6
    bpy.context.collection.objects.link(thing)


def _select(thing: bpy.types.Object) -> None:
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def _unwrap(thing: bpy.types.Object, size: int) -> None:
    """Give each island its place in the picture, all at one scale."""
    _select(thing)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(
        angle_limit=1.15, island_margin=0.0, area_weight=0.0, correct_aspect=False, scale_to_bounds=False
    )
    bpy.ops.uv.select_all(action="SELECT")
    bpy.ops.uv.average_islands_scale()
    bpy.ops.uv.pack_islands(
        udim_source="CLOSEST_UDIM",
        rotate=True,
        rotate_method="AXIS_ALIGNED",
        scale=True,
        margin_method="FRACTION",
        margin=3.0 / size,
        shape_method="AABB",
    )
    bpy.ops.object.mode_set(mode="OBJECT")


def _denoised(light: np.ndarray, scene: bpy.types.Scene) -> np.ndarray:
    """Run the picture through Open Image Denoise, which Blender has as a node of its compositor."""
    size = light.shape[0]
    image = bpy.data.images.new("noisy", size, size, float_buffer=True, alpha=False)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(np.dstack([light, np.ones((size, size, 1), np.float32)]).ravel())
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    source = tree.nodes.new("CompositorNodeImage")
    source.image = image
    denoise = tree.nodes.new("CompositorNodeDenoise")
    denoise.use_hdr, denoise.prefilter = True, "NONE"
    end = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(source.outputs["Image"], denoise.inputs["Image"])
    tree.links.new(denoise.outputs["Image"], end.inputs["Image"])
    scene.render.use_compositing = True
    scene.render.resolution_x = scene.render.resolution_y = size
    camera = bpy.data.objects.get("no eye") or bpy.data.objects.new("no eye", bpy.data.cameras.new("no eye"))
    if scene.camera is None:
        bpy.context.collection.objects.link(camera)
        scene.camera = camera
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    layer = scene.view_layers[0]
    layer.use = False  # only the node's work, no picture of the scene
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "clean.exr")
        bpy.ops.render.render(write_still=True)
        written = bpy.data.images.load(scene.render.filepath)
        clean = np.empty(size * size * 4, np.float32)
        written.pixels.foreach_get(clean)
    layer.use = True
    return clean.reshape(size, size, 4)[..., :3]


def _jpeg(light: np.ndarray) -> bytes:
    """The light as an sRGB picture, upper row first."""
    grey = light @ [0.2126, 0.7152, 0.0722]
    light = grey[..., None] + SATURATION * (light - grey[..., None])
    over = np.maximum(light - KNEE, 0)
    reach = CEILING - KNEE
    pressed = np.minimum(light, KNEE) + reach * (1 - np.exp(-over / reach))
    encoded = np.where(
        pressed <= 0.0031308, 12.92 * pressed, 1.055 * np.maximum(pressed, 1e-9) ** (1 / 2.4) - 0.055
    )
    table = np.rint(255 * np.clip(encoded, 0, 1)).astype(np.uint8)[::-1]
    content = io.BytesIO()
    Image.fromarray(table).save(content, "JPEG", quality=86, subsampling=0, optimize=True)
    return content.getvalue()

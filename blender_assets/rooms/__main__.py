"""Makes the places of `room`: python -m blender_assets.rooms [operating] [meeting] --out FOLDER."""

import argparse
import json
import sys
import time
from pathlib import Path

import bpy

from blender_assets.rooms.bake import baked
from blender_assets.rooms.glb import room_bytes
from blender_assets.rooms.kit import BAKED, METAL, Room
from blender_assets.rooms.meeting import meeting_room
from blender_assets.rooms.operating import operating_room
from blender_assets.rooms.shell import drop_outside
from facegen.blender.runtime import quiet_stdout
from facegen.blender.settings import set_up_cycles
from facegen.files import write_whole

ROOMS = {"operating": operating_room, "meeting": meeting_room}
SEED = 1
TEXELS = {"operating": {"shell": 1024, "things": 1024}, "meeting": {"shell": 1024, "things": 1024}}
"""Width of the pictures of light: 6 to 10 mm a texel on what stands in a room, 2 cm on its walls."""


def main() -> None:
    """Make the rooms that were named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rooms", nargs="*", choices=[*ROOMS, []], help="all where none is named")
    parser.add_argument("--out", type=Path, required=True, help="folder")
    parser.add_argument("--samples", type=int, default=16, help="paths a texel")
    parser.add_argument("--exposure", type=float, default=0.43)
    parser.add_argument("--texels", type=int, help="width of the pictures of light, for a quick look")
    parser.add_argument("--threads", type=int, default=2)
    wish = parser.parse_args()
    wish.out.mkdir(parents=True, exist_ok=True)
    for name in wish.rooms or ROOMS:
        begun = time.monotonic()
        with quiet_stdout():
            content = make(
                name, samples=wish.samples, threads=wish.threads, exposure=wish.exposure, texels=wish.texels
            )
        path = write_whole(wish.out / f"{name}.glb", content)
        length = int.from_bytes(content[12:16], "little")
        document = json.loads(content[20 : 20 + length])
        triangles = sum(
            document["accessors"][mesh["primitives"][0]["indices"]]["count"] // 3
            for mesh in document["meshes"]
        )
        sys.stdout.write(
            f"{path}: {len(content) / 1e6:.2f} MB, {triangles:,} triangles, {time.monotonic() - begun:.0f} s\n"
        )


def make(name: str, *, samples: int, threads: int, exposure: float, texels: int | None = None) -> bytes:
    """Bytes of one room's file: the same for the same code on one machine."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    set_up_cycles(scene, threads=threads)
    room = ROOMS[name]()
    objects = _objects(room)
    sizes = {layer: texels or size for layer, size in TEXELS[name].items()}
    light = baked(room, objects, sizes=sizes, samples=samples, seed=SEED, exposure=exposure)
    return room_bytes(room, objects, light)


def _objects(room: Room) -> dict[str, bpy.types.Object]:
    """Blender's objects of the layers, each with its material."""
    objects = {}
    for name, layer in room.layers.items():
        if name == "shell":
            drop_outside(layer)
        mesh = bpy.data.meshes.new(name)
        layer.to_mesh(mesh)
        layer.free()
        thing = bpy.data.objects.new(name, mesh)
        bpy.context.collection.objects.link(thing)
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        surface = nodes["Principled BSDF"]
        colour = nodes.new("ShaderNodeVertexColor")
        colour.layer_name = "colour"
        links.new(colour.outputs["Color"], surface.inputs["Base Color"])
        surface.inputs["Roughness"].default_value = 0.35 if name == METAL else 0.9
        surface.inputs["Metallic"].default_value = 1.0 if name == METAL else 0.0
        surface.inputs["Specular IOR Level"].default_value = 0.0 if name in BAKED else 0.5
        mesh.materials.append(material)
        objects[name] = thing
    return objects


if __name__ == "__main__":
    main()

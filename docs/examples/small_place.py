"""Makes a small place to meet in: a floor, four walls, a table, two seats, a screen. Run by Blender or its module bpy.

python docs/examples/small_place.py shed.glb
"""

import sys

import bpy


def box(name, at, size, colour):
    """A box of metres, in Blender's frame."""
    bpy.ops.mesh.primitive_cube_add(size=1, location=at, scale=size)
    thing = bpy.context.object
    thing.name = name
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*colour, 1)
    thing.data.materials.append(material)


def empty(name, at, turn=0.0, half=(1, 1, 1)):
    """A name on a point of the floor; who stands there looks along -y, turned by so many radians."""
    thing = bpy.data.objects.new(name, None)
    thing.location, thing.rotation_euler, thing.scale = at, (0, 0, turn), half
    bpy.context.collection.objects.link(thing)


bpy.ops.wm.read_factory_settings(use_empty=True)
box("floor", (0, 0, -0.05), (5, 4, 0.1), (0.35, 0.3, 0.25))
for x, y, wide, deep in ((0, 2.05, 5, 0.1), (0, -2.05, 5, 0.1), (2.55, 0, 0.1, 4.2), (-2.55, 0, 0.1, 4.2)):
    box("wall", (x, y, 1.25), (wide, deep, 2.5), (0.75, 0.74, 0.7))
box("table", (0, 0, 0.37), (1.2, 0.8, 0.74), (0.5, 0.33, 0.2))

empty("walk", (0, 0, 0), half=(2.5, 2.0, 1))
empty("block", (0, 0, 0), half=(0.6, 0.4, 1))
empty("place.1", (0, -1.2, 0), turn=3.14159)  # looks along +y, over the table at the screen
empty("place.2", (1.5, 0, 0), turn=-1.5708)
empty("place.3", (-1.5, 0, 0), turn=1.5708)
empty("seat.1", (-0.3, 0.75, 0))
empty("seat.2", (0.3, 0.75, 0))

bpy.ops.mesh.primitive_plane_add(size=1, location=(0, 1.99, 1.5), rotation=(1.5708, 0, 0))
bpy.context.object.name = "screen"
bpy.context.object.scale = (1.6, 0.9, 1)
bpy.ops.export_scene.gltf(filepath=sys.argv[-1], export_format="GLB", export_yup=True)

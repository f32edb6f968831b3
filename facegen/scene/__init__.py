"""Scenes as plain data, the eyes that go into them, and their assembly from a head and a headset."""

from facegen.scene.assembly import assemble
from facegen.scene.eyes import eye_meshes
from facegen.scene.lids import tear_lines
from facegen.scene.looks import Look, draw_look
from facegen.scene.make_up import made_up
from facegen.scene.materials import MATERIALS, material_values
from facegen.scene.scene import Glimpse, Lamp, Layers, Mesh, Scene, View

__all__ = [
    "MATERIALS",
    "Glimpse",
    "Lamp",
    "Layers",
    "Look",
    "Mesh",
    "Scene",
    "View",
    "assemble",
    "draw_look",
    "eye_meshes",
    "made_up",
    "material_values",
    "tear_lines",
]

"""Scenes as plain data, and the eyes that go into them."""

from facegen.scene.scene import Lamp, Layers, Mesh, Scene, View

__all__ = ["Lamp", "Layers", "Mesh", "Scene", "View"]

"""Writes Blender's shader graphs in few words: a node is made together with its inputs."""

from typing import Any

import bpy

Socket = Any
"""An output socket, or a plain number, or a tuple for a vector or colour."""


class Graph:
    """The node tree of one new material, with one Value node for each of its parameters."""

    def __init__(self, name: str, parameters: dict[str, float]) -> None:
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        # label materials and lamps aside, nothing here is a light: keep meshes out of the light tree (0.7 s a
        # switch)
        self.material.cycles.emission_sampling = "NONE"
        self._tree = self.material.node_tree
        self._tree.nodes.clear()
        self.parameters = {key: self._parameter(key, value) for key, value in parameters.items()}

    def _parameter(self, key: str, value: float) -> Socket:
        node = self._tree.nodes.new("ShaderNodeValue")
        node.name = key
        node.outputs[0].default_value = value
        return node.outputs[0]

    def node(
        self, kind: str, *inputs: Socket, output: int | str = 0, settings: dict | None = None, **named: Socket
    ) -> Socket:
        """Make a node and return one of its outputs.

        Positional inputs go to its sockets in order (None leaves a default), named ones by name with ``_``
        for spaces.
        """
        node = self._tree.nodes.new(f"ShaderNode{kind}")
        for key, value in (settings or {}).items():
            setattr(node, key, value)
        for index, value in enumerate(inputs):
            self._connect(node.inputs[index], value)
        for key, value in named.items():
            self._connect(node.inputs[key.replace("_", " ")], value)
        return node.outputs[output]

    def _connect(self, socket: Socket, value: Socket) -> None:
        if value is None:
            return
        if isinstance(value, bpy.types.NodeSocket):
            self._tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation: str, *inputs: Socket) -> Socket:
        """A Math node."""
        return self.node("Math", *inputs, settings={"operation": operation})

    def mix(self, factor: Socket, first: Socket, second: Socket) -> Socket:
        """The shader that is ``first`` at factor 0 and ``second`` at factor 1."""
        return self.node("MixShader", factor, first, second)

    def noise(self, place: Socket, scale: Socket, *, detail: float = 3.0, flat: bool = False) -> Socket:
        """Smooth noise about 0, roughly within -1 to 1, at a place (vector, of which ``flat`` noise takes x and y)."""
        settings = {"noise_dimensions": "2D"} if flat else None
        value = self.node("TexNoise", settings=settings, Vector=place, Scale=scale, Detail=detail)
        return self.math("MULTIPLY_ADD", value, 4.0, -2.0)

    def finish(self, surface: Socket) -> bpy.types.Material:
        """Make ``surface`` the material's shader and return the material."""
        self.node_output(surface)
        return self.material

    def node_output(self, surface: Socket) -> None:
        """Connect the surface to the material's output."""
        output = self._tree.nodes.new("ShaderNodeOutputMaterial")
        self._connect(output.inputs["Surface"], surface)


def set_parameters(material: bpy.types.Material, values: dict[str, float]) -> None:
    """Give a graph's Value nodes new numbers; equal ones are left alone, so nothing is synchronised."""
    nodes = material.node_tree.nodes
    for key, value in values.items():
        socket = nodes[key].outputs[0]
        if socket.default_value != value:
            socket.default_value = value

"""Builds near infra-red materials as Cycles shaders, named as in `facegen.scene.materials`.

Albedos are plain greys with equal scattering in all channels, so a picture has no colour noise and one
channel says all.
"""

from collections.abc import Callable

import bpy

from facegen.blender.eyes import cornea, iris, sclera
from facegen.blender.nodes import Graph, Socket
from facegen.blender.skin import skin
from facegen.blender.surfaces import surface
from facegen.conventions import Part
from facegen.scene.materials import MATERIALS

EYE_INDEX = MATERIALS["cornea"]["index"]


def _plain(graph: Graph, subsurface: bool) -> Socket:
    return surface(graph, graph.parameters["albedo"], subsurface=subsurface)


def _matte(graph: Graph, subsurface: bool) -> Socket:
    return graph.node("BsdfDiffuse", graph.parameters["albedo"])


def _headset(graph: Graph, subsurface: bool) -> Socket:
    """Matte, each part with an albedo of its own (`facegen.scene.housing`)."""
    return graph.node(
        "BsdfDiffuse", graph.node("Attribute", output="Fac", settings={"attribute_name": "albedo"})
    )


def _frame(graph: Graph, subsurface: bool) -> Socket:
    """Plastic: dark, with a sheen."""
    return surface(graph, graph.parameters["albedo"], subsurface=False)


def _lens(graph: Graph, subsurface: bool) -> Socket:
    """Thin and clear: rays go straight on, a little fainter; images of lamps are added afterwards, as on corneas."""
    clear = graph.parameters["transmission"]
    return graph.node("BsdfTransparent", graph.node("CombineXYZ", clear, clear, clear))


def _emitter(graph: Graph, subsurface: bool) -> Socket:
    """Shines evenly: markers of tests and calibration targets."""
    return graph.node("Emission", None, graph.parameters["radiance"])


SHADERS: dict[str, Callable[[Graph, bool], Socket]] = {
    "skin": skin,
    "lips": skin,
    "cavity": _plain,
    "conjunctiva": _plain,
    "caruncle": _plain,
    "sclera": sclera,
    "iris": iris,
    "pupil": _matte,
    "cornea": cornea,
    "teeth": _plain,
    "gums": _plain,
    "tongue": _plain,
    "lashes": _matte,
    "hair": _matte,
    "frame": _frame,
    "lens": _lens,
    "headset": _headset,
    "emitter": _emitter,
}
"""Shader of every material in `facegen.scene.materials.MATERIALS`."""


def build_material(name: str, *, subsurface: bool) -> bpy.types.Material:
    """Build a Blender material with default parameters; without ``subsurface`` it is a third cheaper."""
    graph = Graph(name, MATERIALS[name])
    return graph.finish(SHADERS[name](graph, subsurface))


def build_truth_material() -> bpy.types.Material:
    """Build the one material of truth passes: it emits (part, u, v) as a colour, and
    lets rays through where eyes do.

    Parts come from a face attribute, so they are exact integers; Cycles traces the refraction, so they are
    what appears.
    """
    graph = Graph("truth", {})
    part = graph.node("Attribute", output="Fac", settings={"attribute_name": "part"})
    uv = graph.node("UVMap", settings={"uv_map": "uv"})
    u, v = (graph.node("SeparateXYZ", uv, output=axis) for axis in ("X", "Y"))
    label = graph.node("Emission", graph.node("CombineXYZ", part, u, v), 1.0)
    refraction = graph.node("BsdfRefraction", IOR=EYE_INDEX, Roughness=0.0)
    is_cornea, is_lens = (
        graph.math("COMPARE", part, float(clear), 0.1) for clear in (Part.CORNEA, Part.LENS)
    )
    shown = graph.mix(is_cornea, label, refraction)
    return graph.finish(graph.mix(is_lens, shown, graph.node("BsdfTransparent")))

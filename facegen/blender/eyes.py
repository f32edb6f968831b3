"""Builds the shaders of an eye: sclera with vessels, iris with fibres, cornea that refracts."""

from facegen.blender.nodes import Graph, Socket
from facegen.blender.surfaces import mottled, surface


def sclera(graph: Graph, subsurface: bool) -> Socket:
    """White with vessels that wander from the corners to the limbus, and no gloss."""
    p = graph.parameters
    uv = graph.node("UVMap", settings={"uv_map": "uv"})
    u, v = (graph.node("SeparateXYZ", uv, output=axis) for axis in ("X", "Y"))
    # vessels run along the meridians: stretch the noise along v; u wraps through the cosine and sine of its
    # angle
    albedo = mottled(graph, _around(graph, u, 9.0, graph.math("MULTIPLY", v, 4.0)), p["albedo"], 1.0)
    # vessels: where smooth noise crosses zero, thin lines that wander from the corners to the limbus
    wandering = _around(graph, u, 7.0, graph.math("MULTIPLY", v, 9.0))
    line = graph.math("ABSOLUTE", graph.noise(wandering, 1.0, detail=2.0))
    vessel = graph.node("MapRange", line, 0.0, 0.1, p["vessels"], 0.0)
    albedo = graph.math("MULTIPLY", albedo, graph.math("SUBTRACT", 1.0, vessel))
    edge = graph.node(
        "MapRange", v, 0.94, 1.0, 0.0, p["limbus"], settings={"interpolation_type": "SMOOTHSTEP"}
    )
    albedo = graph.math("MULTIPLY", albedo, graph.math("SUBTRACT", 1.0, edge))
    # no gloss: the tear film's images of lamps are added afterwards (`facegen.labels.glints`)
    return surface(graph, albedo, subsurface=subsurface, Specular_IOR_Level=0.0)


def _around(graph: Graph, u: Socket, frequency: float, along: Socket) -> Socket:
    """A place for noise that closes around the eye: (f cos, f sin, along) of the angle 2 pi u."""
    angle = graph.math("MULTIPLY", u, 6.283185307)
    cosine, sine = (graph.math("MULTIPLY", graph.math(name, angle), frequency) for name in ("COSINE", "SINE"))
    return graph.node("CombineXYZ", cosine, sine, along)


def iris(graph: Graph, subsurface: bool) -> Socket:
    """Fibres around the pupil, lighter inside the collarette and darker at the limbus."""
    p = graph.parameters
    uv = graph.node("UVMap", settings={"uv_map": "uv"})
    u, v = (graph.node("SeparateXYZ", uv, output=axis) for axis in ("X", "Y"))
    along = graph.math("MULTIPLY_ADD", v, 1.2, graph.math("MULTIPLY", p["pattern"], 17.0))
    fibres = graph.node("TexNoise", Vector=_around(graph, u, 9.0, along), Scale=1.6, Detail=4.0)
    fibres = graph.math("MULTIPLY", graph.math("MULTIPLY_ADD", fibres, 4.0, -2.0), p["contrast"])
    # the collarette lies a third of the way out; inside it the iris is a little lighter, at the limbus darker
    inner = graph.node(
        "MapRange", v, 0.2, 0.45, p["collarette"], 0.0, settings={"interpolation_type": "SMOOTHSTEP"}
    )
    # refraction magnifies: what is at v = 0.87 appears at the limbus
    outer = graph.node(
        "MapRange", v, 0.62, 0.9, 0.0, p["limbus"], settings={"interpolation_type": "SMOOTHSTEP"}
    )
    relative = graph.math("ADD", graph.math("ADD", fibres, 1.0), graph.math("SUBTRACT", inner, outer))
    albedo = graph.math("MULTIPLY", p["albedo"], graph.math("MAXIMUM", relative, 0.15))
    return graph.node("BsdfDiffuse", albedo)


def cornea(graph: Graph, subsurface: bool) -> Socket:
    """Refracts the camera's rays and is clear for shadow and diffuse ones: no caustics, no noise.

    It mirrors nothing: images of lamps are added afterwards (`facegen.labels.glints`), and the rest is dark.
    """
    refraction = graph.node("BsdfRefraction", IOR=graph.parameters["index"], Roughness=0.0)
    straight = graph.math(
        "MAXIMUM",
        graph.node("LightPath", output="Is Shadow Ray"),
        graph.node("LightPath", output="Is Diffuse Ray"),
    )
    return graph.mix(straight, refraction, graph.node("BsdfTransparent", (0.95, 0.95, 0.95, 1.0)))

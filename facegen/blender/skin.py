"""Builds the shader of skin and lips: pores, fine lines, the lid's crease, eyeliner."""

from facegen.blender.nodes import Graph, Socket
from facegen.blender.surfaces import mottled, surface

LINER_M = 1.1e-3
"""Half the width of eyeliner, from the lid's margin."""
CREASE_DEPTH_M, CREASE_SHADE = 0.5e-3, 0.4
"""Of a lid crease of strength 1: depth, and the share of light that its ground lacks."""
PORE_M, PORE_SHADE, LINE_M, LINE_SHADE = 0.3e-3, 1.0, 1.0e-3, 0.7
"""Distance of pores, length of fine lines, and what both take of the albedo, in shares of ``mottle``."""
UV_METRES = 0.9
"""Length on the face of one unit of the head's texture coordinates, about (0.43 mm a pixel at 2,048)."""


def _face_place(graph: Graph) -> Socket:
    """Texture coordinates of the head in about metres, so that patterns stay on the skin when it moves."""
    uv = graph.node("UVMap", settings={"uv_map": "uv"})
    return graph.node("VectorMath", uv, (UV_METRES,) * 3, settings={"operation": "MULTIPLY"})


def skin(graph: Graph, subsurface: bool) -> Socket:
    """Skin that scatters below its surface, with all its patterns fixed to the texture coordinates."""
    p, place, math = graph.parameters, _face_place(graph), graph.math
    albedo = mottled(graph, place, p["albedo"], 12e-3, 2.5e-3, 0.8e-3)
    albedo = math("MULTIPLY", albedo, math("MULTIPLY_ADD", _grain(graph, place), p["mottle"], 1.0))
    # fine wrinkles
    height = math("MULTIPLY", graph.noise(place, 1.0 / 1.0e-3, detail=1.0), p["bump_m"])
    crease = _crease(graph, place)
    height = math("MULTIPLY_ADD", crease, -CREASE_DEPTH_M, height)
    # in its ground little light arrives, and scattering would fill a mere change of normals with light again
    albedo = math("MULTIPLY", albedo, math("MULTIPLY_ADD", crease, -CREASE_SHADE, 1.0))
    albedo = math("MULTIPLY", albedo, math("SUBTRACT", 1.0, math("MULTIPLY", _liner(graph), p["liner"])))
    normal = graph.node("Bump", Strength=1.0, Distance=1.0, Height=height)
    return surface(graph, albedo, subsurface=subsurface, normal=normal, Specular_IOR_Level=p["specular"])


def _grain(graph: Graph, place: Socket) -> Socket:
    """Darkness of pores and of the fine lines between them: 0 beside them, down to -3 or so.

    In the albedo, for light that scatters below the skin fills what changes only its normals.
    """
    pores = graph.noise(place, 1.0 / PORE_M, detail=0.0, flat=True)
    pores = graph.node(
        "MapRange", pores, 0.0, 1.0, 0.0, -PORE_SHADE, settings={"interpolation_type": "SMOOTHSTEP"}
    )
    along = graph.node("VectorMath", place, (1.0, 2.2, 1.0), settings={"operation": "MULTIPLY"})
    lines = graph.math("ABSOLUTE", graph.noise(along, 1.0 / LINE_M, detail=1.0, flat=True))
    lines = graph.node("MapRange", lines, 0.0, 0.25, -LINE_SHADE, 0.0)
    return graph.math("ADD", pores, lines)


def _liner(graph: Graph) -> Socket:
    """1 on the upper lid's margin, 0 beyond a line's width; it fades towards the corners as creases do."""
    distance, share = (
        graph.node("Attribute", output="Fac", settings={"attribute_name": name})
        for name in ("crease_distance_m", "crease_share")
    )
    line = graph.node(
        "MapRange", distance, 0.4 * LINER_M, LINER_M, 1.0, 0.0, settings={"interpolation_type": "SMOOTHSTEP"}
    )
    return graph.math("MULTIPLY", line, share)


def _crease(graph: Graph, place: Socket) -> Socket:
    """Depth of the lid's crease, 0 to ``crease``: a soft groove that wanders a little, with a faint second one."""
    p, math = graph.parameters, graph.math
    distance, share = (
        graph.node("Attribute", output="Fac", settings={"attribute_name": name})
        for name in ("crease_distance_m", "crease_share")
    )
    wander = math("MULTIPLY_ADD", graph.noise(place, 1.0 / 9.0e-3, detail=0.0), 0.6e-3, distance)

    def groove(at: Socket, width_m: float) -> Socket:
        off = math("DIVIDE", math("SUBTRACT", wander, at), width_m)
        return math("EXPONENT", math("MULTIPLY", math("MULTIPLY", off, off), -1.0))

    # lines of folded skin are deep in places and lost in others
    depth = math("MULTIPLY_ADD", graph.noise(place, 1.0 / 5.0e-3, detail=0.0, flat=True), 0.5, 0.8)
    second = math("MULTIPLY", groove(math("ADD", p["crease_m"], 1.7e-3), 0.3e-3), 0.25)
    both = math("MULTIPLY", math("ADD", groove(p["crease_m"], 0.35e-3), second), depth)
    return math("MULTIPLY", math("MULTIPLY", both, share), p["crease"])

"""Near infra-red materials as Cycles shaders, named as in `facegen.scene.materials`.

Albedos are plain greys with equal scattering in all channels, so a picture has no colour noise and one
channel says all.
"""

from collections.abc import Callable

import bpy

from facegen.blender.nodes import Graph, Socket
from facegen.conventions import Part
from facegen.scene.materials import MATERIALS

EYE_INDEX = MATERIALS["cornea"]["index"]
LINER_M = 1.1e-3
"""Half the width of eyeliner, from the lid's margin."""
CREASE_DEPTH_M, CREASE_SHADE = 0.5e-3, 0.4
"""Of a lid crease of strength 1: depth, and the share of light that its ground lacks."""
PORE_M, PORE_SHADE, LINE_M, LINE_SHADE = 0.3e-3, 1.0, 1.0e-3, 0.7
"""Distance of pores, length of fine lines, and what both take of the albedo, in shares of ``mottle``."""
UV_METRES = 0.9
"""Length on the face of one unit of the head's texture coordinates, about (0.43 mm a pixel at 2,048)."""


def _surface(
    graph: Graph, albedo: Socket, *, subsurface: bool, normal: Socket = None, **extra: Socket
) -> Socket:
    """A Principled surface that scatters below it, where it has a ``scatter_m`` and the option is on."""
    p = graph.parameters
    inputs = dict(Base_Color=albedo, Roughness=p["roughness"], IOR=1.4, **extra)
    settings = {}
    if subsurface and "scatter_m" in p:
        # BURLEY: RANDOM_WALK looks a little better and costs 1.75 times as much
        settings["subsurface_method"] = "BURLEY"
        inputs |= dict(
            Subsurface_Weight=1.0, Subsurface_Radius=(1.0, 1.0, 1.0), Subsurface_Scale=p["scatter_m"]
        )
    if normal is not None:
        inputs["Normal"] = normal
    return graph.node("BsdfPrincipled", settings=settings, **inputs)


def _mottled(graph: Graph, place: Socket, albedo: Socket, *sizes_m: float) -> Socket:
    """Albedo that varies around its mean with the relative depth ``mottle``, at each of the given sizes."""
    total: Socket = 0.0
    for size in sizes_m:
        total = graph.math("ADD", total, graph.noise(place, 1.0 / size, detail=1.0))
    relative = graph.math(
        "MULTIPLY_ADD", total, graph.math("DIVIDE", graph.parameters["mottle"], len(sizes_m)), 1.0
    )
    return graph.math("MULTIPLY", albedo, relative)


def _face_place(graph: Graph) -> Socket:
    """Texture coordinates of the head in about metres, so that patterns stay on the skin when it moves."""
    uv = graph.node("UVMap", settings={"uv_map": "uv"})
    return graph.node("VectorMath", uv, (UV_METRES,) * 3, settings={"operation": "MULTIPLY"})


def _skin(graph: Graph, subsurface: bool) -> Socket:
    p, place, math = graph.parameters, _face_place(graph), graph.math
    albedo = _mottled(graph, place, p["albedo"], 12e-3, 2.5e-3, 0.8e-3)
    albedo = math("MULTIPLY", albedo, math("MULTIPLY_ADD", _grain(graph, place), p["mottle"], 1.0))
    # fine wrinkles
    height = math("MULTIPLY", graph.noise(place, 1.0 / 1.0e-3, detail=1.0), p["bump_m"])
    crease = _crease(graph, place)
    height = math("MULTIPLY_ADD", crease, -CREASE_DEPTH_M, height)
    # in its ground little light arrives, and scattering would fill a mere change of normals with light again
    albedo = math("MULTIPLY", albedo, math("MULTIPLY_ADD", crease, -CREASE_SHADE, 1.0))
    albedo = math("MULTIPLY", albedo, math("SUBTRACT", 1.0, math("MULTIPLY", _liner(graph), p["liner"])))
    normal = graph.node("Bump", Strength=1.0, Distance=1.0, Height=height)
    return _surface(graph, albedo, subsurface=subsurface, normal=normal, Specular_IOR_Level=p["specular"])


def _grain(graph: Graph, place: Socket) -> Socket:
    """What skin lacks of light in pores and in the fine lines between them: 0 beside them, down to -3 or so.

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


def _plain(graph: Graph, subsurface: bool) -> Socket:
    return _surface(graph, graph.parameters["albedo"], subsurface=subsurface)


def _sclera(graph: Graph, subsurface: bool) -> Socket:
    p = graph.parameters
    uv = graph.node("UVMap", settings={"uv_map": "uv"})
    u, v = (graph.node("SeparateXYZ", uv, output=axis) for axis in ("X", "Y"))
    # vessels run along the meridians: stretch the noise along v; u wraps through the cosine and sine of its
    # angle
    albedo = _mottled(graph, _around(graph, u, 9.0, graph.math("MULTIPLY", v, 4.0)), p["albedo"], 1.0)
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
    return _surface(graph, albedo, subsurface=subsurface, Specular_IOR_Level=0.0)


def _around(graph: Graph, u: Socket, frequency: float, along: Socket) -> Socket:
    """A place for noise that closes around the eye: (f cos, f sin, along) of the angle 2 pi u."""
    angle = graph.math("MULTIPLY", u, 6.283185307)
    cosine, sine = (graph.math("MULTIPLY", graph.math(name, angle), frequency) for name in ("COSINE", "SINE"))
    return graph.node("CombineXYZ", cosine, sine, along)


def _iris(graph: Graph, subsurface: bool) -> Socket:
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


def _matte(graph: Graph, subsurface: bool) -> Socket:
    return graph.node("BsdfDiffuse", graph.parameters["albedo"])


def _cornea(graph: Graph, subsurface: bool) -> Socket:
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


def _headset(graph: Graph, subsurface: bool) -> Socket:
    """Matte, each part with an albedo of its own (`facegen.scene.housing`)."""
    return graph.node(
        "BsdfDiffuse", graph.node("Attribute", output="Fac", settings={"attribute_name": "albedo"})
    )


def _frame(graph: Graph, subsurface: bool) -> Socket:
    """Plastic: dark, with a sheen."""
    return _surface(graph, graph.parameters["albedo"], subsurface=False)


def _lens(graph: Graph, subsurface: bool) -> Socket:
    """Thin and clear: rays go straight on, a little fainter; images of lamps are added afterwards, as on corneas."""
    clear = graph.parameters["transmission"]
    return graph.node("BsdfTransparent", graph.node("CombineXYZ", clear, clear, clear))


def _emitter(graph: Graph, subsurface: bool) -> Socket:
    """Shines evenly: markers of tests and calibration targets."""
    return graph.node("Emission", None, graph.parameters["radiance"])


SHADERS: dict[str, Callable[[Graph, bool], Socket]] = {
    "skin": _skin,
    "lips": _skin,
    "cavity": _plain,
    "conjunctiva": _plain,
    "caruncle": _plain,
    "sclera": _sclera,
    "iris": _iris,
    "pupil": _matte,
    "cornea": _cornea,
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
    """A new Blender material with default parameters; without ``subsurface`` it is a third cheaper."""
    graph = Graph(name, MATERIALS[name])
    return graph.finish(SHADERS[name](graph, subsurface))


def build_truth_material() -> bpy.types.Material:
    """The one material of truth passes: emits (part, u, v) as a colour, and lets rays through where eyes do.

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

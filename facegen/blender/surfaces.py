"""Builds what several materials share: a surface that scatters below it, and an albedo that varies."""

from facegen.blender.nodes import Graph, Socket


def surface(
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


def mottled(graph: Graph, place: Socket, albedo: Socket, *sizes_m: float) -> Socket:
    """Albedo that varies around its mean with the relative depth ``mottle``, at each of the given sizes."""
    total: Socket = 0.0
    for size in sizes_m:
        total = graph.math("ADD", total, graph.noise(place, 1.0 / size, detail=1.0))
    relative = graph.math(
        "MULTIPLY_ADD", total, graph.math("DIVIDE", graph.parameters["mottle"], len(sizes_m)), 1.0
    )
    return graph.math("MULTIPLY", albedo, relative)

"""Joins what is opaque in a scene into one mesh, which hides labels behind it."""

import numpy as np

from facegen.conventions import Part
from facegen.raster import triangles_of
from facegen.scene import Mesh

TRANSPARENT = (Part.CORNEA, Part.LENS, Part.LASHES, Part.HAIR)
"""Parts that hide no landmark behind them: cornea and lenses are clear, lashes and hair are strands."""


def occluders(
    meshes: tuple[Mesh, ...], *, transparent: tuple[Part, ...] = TRANSPARENT
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) and triangles (T, 3) of everything opaque in a scene, as one mesh in the head frame."""
    vertices, triangles, start = [], [], 0
    for mesh in meshes:
        opaque = ~np.isin(mesh.part, transparent)
        vertices.append(mesh.vertices)
        triangles.append(triangles_of(mesh.faces[opaque]) + start)
        start += len(mesh.vertices)
    return np.concatenate(vertices), np.concatenate(triangles)

"""A second renderer: what hides what, and what is nearest, without Blender."""

from facegen.raster.occlusion import faces_of_triangles, hidden, hidden_by_own, nearest_depth, triangles_of
from facegen.raster.z_buffer import Nearest, nearest_along_z, nearest_triangles

__all__ = [
    "Nearest",
    "faces_of_triangles",
    "hidden",
    "hidden_by_own",
    "nearest_along_z",
    "nearest_depth",
    "nearest_triangles",
    "triangles_of",
]

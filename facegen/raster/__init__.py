"""A second renderer, in NumPy: what hides what, and depth without Blender."""

from facegen.raster.depth import depth_image
from facegen.raster.occlusion import hidden, nearest_depth, triangles_of

__all__ = ["depth_image", "hidden", "nearest_depth", "triangles_of"]

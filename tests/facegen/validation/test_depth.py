"""A landmark's depth against pixels: the best of nine counts, and hairs before the skin do not."""

import numpy as np

from facegen.conventions import Part
from facegen.scene import Layers
from facegen.validation.renders import depth_difference


def layers(depth: float, part: Part) -> Layers:
    empty = np.zeros((5, 5), np.float32)
    return Layers(
        radiance=empty,
        depth=np.full((5, 5), depth, np.float32),
        normal=np.zeros((5, 5, 3), np.float32),
        part=np.full((5, 5), part, np.uint8),
        uv=np.zeros((5, 5, 2), np.float32),
    )


def test_the_nearest_of_nine_pixels_counts():
    seen = layers(0.1, Part.SKIN)
    seen.depth[3, 1] = 0.0504
    assert abs(depth_difference(seen, np.array([2.3, 1.8]), 0.05) - 0.0004) < 1e-6
    assert abs(depth_difference(seen, np.array([2.3, 0.8]), 0.05) - 0.05) < 1e-6


def test_a_hair_before_the_skin_is_no_contradiction_but_anything_else_is():
    point = np.array([2.0, 2.0])
    assert depth_difference(layers(0.047, Part.HAIR), point, 0.05) == 0.0
    assert depth_difference(layers(0.047, Part.LASHES), point, 0.05) == 0.0
    assert depth_difference(layers(0.047, Part.SKIN), point, 0.05) > 1e-3
    assert depth_difference(layers(0.053, Part.HAIR), point, 0.05) > 1e-3, "behind the point"
    assert depth_difference(layers(0.027, Part.HAIR), point, 0.05) > 1e-3, "further off than beards grow"
    assert depth_difference(layers(0.034, Part.LASHES), point, 0.05) > 1e-3, "further off than lashes grow"

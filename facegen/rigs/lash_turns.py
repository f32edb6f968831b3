"""Turns upper lashes with the lid that they grow on: a lid goes round the eyeball, and its lashes point where it goes.

MakeHuman's shapes carry lashes along and hardly turn them: those of a shut eye pointed ahead, 22 degrees below where
they point from an open one, though the margin had gone 54 degrees round the eye. On real eyes they hang down before
the lower lid.
"""

from dataclasses import replace

import numpy as np

from facegen.rigs.lash_strips import lash_strips
from facegen.rigs.rig import Rig

TURN = 1.4
"""Angle by which lashes turn for each that the margin goes round the eye: the lid's edge rolls as well. Those of
ICT-FaceKit's shapes turn by 63 degrees where the margin goes 45."""
RIM = 0.25
"""Share of a strip's depth that lies on the lid's edge and goes where that goes."""


def with_turning_lashes(rig: Rig) -> Rig:
    """The rig whose shapes turn each column of the upper lashes as one piece, from the lid's edge on.

    The angle is that by which a shape takes the column's root round the middle of the eyeball, about the axis from side
    to side, times `TURN`. Shapes stay linear, so that lashes of a half-shut lid are a fifth shorter.
    """
    expression = rig.expression.copy()
    for strip in lash_strips(rig):
        if strip.lid != "upper":
            continue
        columns = rig.vertices[strip.grid]
        center = rig.eye_center[0 if columns[0, 0, 0] > 0.0 else 1]
        moved = columns[:, 0] + expression[:, strip.grid[:, 0]]
        angle = TURN * (_elevation(moved - center) - _elevation(columns[:, 0] - center))
        hinge = round(RIM * (strip.grid.shape[1] - 1))
        carried = expression[:, strip.grid[:, hinge], None]
        hair = columns[:, hinge + 1 :] - columns[:, hinge, None]
        expression[:, strip.grid[:, hinge + 1 :]] = carried + _turned(hair, angle[..., None]) - hair
    return replace(rig, expression=expression)


def _elevation(vectors: np.ndarray) -> np.ndarray:
    """Angles (...) in radians above straight ahead of vectors (..., 3)."""
    return np.arctan2(vectors[..., 1], vectors[..., 2])


def _turned(vectors: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Vectors (..., 3) turned up by angles (...), about the axis from side to side."""
    cos, sin = np.cos(angle), np.sin(angle)
    aside, up, ahead = np.moveaxis(vectors, -1, 0)
    turned = np.broadcast_arrays(aside, cos * up + sin * ahead, cos * ahead - sin * up)
    return np.stack(turned, axis=-1)

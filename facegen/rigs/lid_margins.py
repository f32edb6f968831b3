"""Finds the margins of the lids on a rig, and measures how far they stand apart."""

from functools import lru_cache

import numpy as np

from facegen.rigs.evaluation import evaluate
from facegen.rigs.marking import face_sides
from facegen.rigs.rig import Rig


@lru_cache(maxsize=16)  # two eyes
def lid_margins(rig: Rig, eye: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertices along the upper and the lower margin of eye 0 (subject's left) or 1, inner canthus first.

    Both have the canthi, and what subdivision put between the cage's vertices.
    """
    sides = face_sides(rig.faces)[0]
    sides = np.concatenate([sides, sides[:, ::-1]])
    margins = []
    for coarse in (rig.upper_lid[eye], rig.lower_lid[eye]):
        beside = {int(vertex): set(sides[sides[:, 0] == vertex, 1].tolist()) for vertex in coarse}
        fine = [int(coarse[0])]
        for vertex, following in zip(coarse[:-1].tolist(), coarse[1:].tolist(), strict=True):
            if following == vertex:
                continue  # the shorter of two margins ends with its last vertex again
            if following not in beside[vertex]:
                between = beside[vertex] & beside[following]
                fine += sorted(made for made in between if made >= rig.cage_vertices)[:1]
            fine.append(following)
        margins.append(np.array(fine))
    return margins[0], margins[1]


def lid_gap(rig: Rig, vertices: np.ndarray) -> np.ndarray:
    """Height (2,) of each eye's upper margin over the lower one, midway between the canthi, subject's left first.

    Along the head's y, in metres, on the cage's margins; 0 where the lids touch or pass each other.

    Parameters
    ----------
    rig
        The rig.
    vertices
        (V, 3) an evaluated head, or its first vertices, the cage's; head frame, metres.
    """
    gaps = np.empty(2)
    for eye, outwards in enumerate((1.0, -1.0)):
        upper, lower = vertices[rig.upper_lid[eye]], vertices[rig.lower_lid[eye]]
        middle = outwards * 0.5 * (upper[0, 0] + upper[-1, 0])
        above, below = (
            np.interp(middle, np.maximum.accumulate(outwards * margin[:, 0]), margin[:, 1])
            for margin in (upper, lower)
        )
        gaps[eye] = max(above - below, 0.0)
    return gaps


@lru_cache(maxsize=8)
def open_lid_gap(rig: Rig, identity: tuple[float, ...]) -> np.ndarray:
    """The `lid_gap` (2,) of a neutral face that looks straight ahead; its K identity coefficients as a tuple."""
    # kept: a person's samples stand side by side
    ahead = np.broadcast_to([0.0, 0.0, 1.0], (1, 2, 3))
    face = evaluate(rig, np.array([identity]), np.zeros((1, len(rig.expression))), ahead, cage_only=True)
    return lid_gap(rig, face.vertices[0])

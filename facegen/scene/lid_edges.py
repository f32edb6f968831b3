"""Makes the edges of the lids: the wet strip from a lid's margin to the eyeball, in whose corners pockets would gape.

Rigs' margins are lines, some way before the eye; at the corners they leave it by up to 5 mm, as people's do, where the
lining of the lids, the plica and the caruncle fill the room.
"""

from collections.abc import Sequence

import numpy as np

from facegen.conventions import SIDES, Part
from facegen.geometry.grids import facing_back, ring_quads
from facegen.rigs import EyeGeometry, Rig, lid_margins, lid_support_radius
from facegen.scene.scene import Mesh

EDGE_M = 1.0e-3
"""As far from the eye the edge goes straight to it, as a lid's does; what lies farther slopes towards the opening."""
SLOPE = 0.8
"""Of the way beyond that, which the foot of the strip goes towards the opening's middle."""
OPEN_M = 3.0e-3
"""Of lids that stand less far apart edges slope less: those of shut ones lie behind the skin."""
INTO_M = 0.15e-3
"""The foot lies so deep in the eye."""
ROWS = 6


def lid_edge_meshes(
    rig: Rig,
    vertices: np.ndarray,
    eyes: Sequence[EyeGeometry],
    *,
    rows: int = ROWS,
    into_m: float = INTO_M,
) -> tuple[Mesh, ...]:
    """The edges of both eyes' lids on an evaluated head.

    Parameters
    ----------
    rig
        The rig.
    vertices
        (V, 3) head frame, metres.
    eyes
        The subject's left and right eye.
    rows, into_m
        Of vertices from the margin to the foot, and how deep in the eye this is.
    """
    return tuple(
        _edge(vertices[upper], vertices[lower], eye, name, rows, into_m)
        for eye, name, (upper, lower) in zip(
            eyes, SIDES, (lid_margins(rig, side) for side in range(len(SIDES))), strict=True
        )
    )


def _edge(
    upper: np.ndarray, lower: np.ndarray, eye: EyeGeometry, side: str, rows: int, into_m: float
) -> Mesh:
    loop = np.concatenate([upper, lower[-2:0:-1]])
    away = loop - eye.center
    length = np.linalg.norm(away, axis=-1, keepdims=True)
    clear = length - _surface(away / length, eye)
    middle = away.mean(axis=0) / np.linalg.norm(away.mean(axis=0))
    height = np.linalg.norm(upper[len(upper) // 2] - lower[len(lower) // 2])
    slope = SLOPE * np.clip(height / OPEN_M, 0.0, 1.0) * np.maximum(clear - EDGE_M, 0.0)
    towards = length * middle - away
    way = np.linalg.norm(towards, axis=-1, keepdims=True)
    foot = away + np.minimum(slope / np.maximum(way, 1e-6), 0.5) * towards
    foot /= np.linalg.norm(foot, axis=-1, keepdims=True)
    foot *= _surface(foot, eye) - into_m
    share = np.linspace(0.0, 1.0, rows)[:, None, None]
    points = eye.center + away + share * (foot - away)
    faces = facing_back(ring_quads(rows, len(loop))).astype(np.int32)
    if side == SIDES[0]:
        faces = faces[:, ::-1]
    return Mesh(
        name=f"{side}_lid_edge",
        vertices=points.reshape(-1, 3),
        faces=faces,
        part=np.full(len(faces), Part.EYE_CAVITY, np.uint8),
        materials=("caruncle",),
        face_material=np.zeros(len(faces), np.int32),
    )


def _surface(direction: np.ndarray, eye: EyeGeometry) -> np.ndarray:
    return lid_support_radius(direction, np.array(eye.radius), eye.axis)[:, None]

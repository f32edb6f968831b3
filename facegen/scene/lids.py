"""Makes the lid crease, the caruncle, and the line of tears, which no rig's mesh has."""

from functools import lru_cache

import numpy as np

from facegen.conventions import SIDES, Part
from facegen.geometry.grids import ring_quads
from facegen.rigs import Rig
from facegen.scene.scene import Mesh

BESIDE_M = 25e-3
"""Pushes places beside and below the upper lid out of a crease's reach."""
FADED, FULL = 0.1, 0.23
"""Where along the margin creases end and where they are full: share of the way times what is left of it."""
CARUNCLE_M = (3.6e-3, 3.0e-3, 1.1e-3)
"""Largest half axes along the lids, across them and outwards; of it lids and eyeball leave 4 to 5 mm by 3 mm [1]_.

.. [1] R. S. Snell and M. A. Lemp, "Clinical Anatomy of the Eye", 2nd ed., 1998, the lacrimal caruncle.
"""
CARUNCLE_BEHIND_M, CARUNCLE_IN_M = 1.9e-3, 1.2e-3
"""Its middle lies this far behind the lids' margins, so that these frame it, and this far from the corner, where it
ends: beyond, the nose's side falls away, and it would come through the skin."""
CARUNCLE_LEAST_M = 0.05e-3
"""What is left of its height between lids that touch."""
TEARS_BEFORE_M = 0.25e-3
"""The meniscus stands this far before the lower lid's edge, as seen from the eyeball's centre."""


@lru_cache(maxsize=8)
def crease_fields(rig: Rig) -> dict[str, np.ndarray]:
    """Where lid creases run, on the neutral head's vertices.

    Returns
    -------
    dict
        ``crease_distance_m`` (V,), the distance from the nearer upper lid's margin: true above the lid's middle, larger
        towards the corners, where creases come down to the margin, and still larger beside and below the eye.
        ``crease_share`` (V,) in 0 to 1: creases fade towards the corners.
    """
    nearest, faded = np.full(len(rig.vertices), np.inf), np.zeros(len(rig.vertices))
    for margin in rig.upper_lid:
        start, step = rig.vertices[margin[:-1]], np.diff(rig.vertices[margin], axis=0)
        real = step.any(axis=1)  # the shorter of two margins ends with its last vertex again
        start, step = start[real], step[real]
        from_start = rig.vertices[:, None] - start
        share = np.clip((from_start * step).sum(axis=-1) / (step * step).sum(axis=-1), 0.0, 1.0)
        away = from_start - share[..., None] * step
        distance = np.linalg.norm(away, axis=-1)
        best = distance.argmin(axis=1)
        rows = np.arange(len(distance))
        distance, height = distance[rows, best], away[rows, best, 1]
        upright = height / np.maximum(distance, 1e-9)
        course = (best + share[rows, best]) / len(step)
        arch = np.maximum(4.0 * course * (1.0 - course), 0.1) ** 0.35
        field = distance / arch + BESIDE_M * np.clip(0.8 - upright, 0.0, 2.0) ** 2
        middle = np.clip((course * (1.0 - course) - FADED) / (FULL - FADED), 0.0, 1.0)
        faded = np.where(field < nearest, middle * middle * (3.0 - 2.0 * middle), faded)
        nearest = np.minimum(nearest, field)
    return {"crease_distance_m": nearest, "crease_share": faded}


def tear_lines(rig: Rig, vertices: np.ndarray, eye_center: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where tears stand on the lower lids' edges: polylines (L, 3) of both eyes, inner canthus first, metres.

    Parameters
    ----------
    rig
        The rig.
    vertices
        (V, 3) evaluated head.
    eye_center
        (2, 3).
    """
    lines = []
    for margin, center in zip(rig.lower_lid, eye_center, strict=True):
        away = vertices[margin] - center
        length = np.linalg.norm(away, axis=-1, keepdims=True)
        lines.append(center + away * (length + TEARS_BEFORE_M) / length)
    return lines[0], lines[1]


def caruncle_meshes(rig: Rig, vertices: np.ndarray, eye_center: np.ndarray) -> tuple[Mesh, ...]:
    """The wet mounds in the inner corners of both eyes: half ellipsoids between the lids, flat when these close."""
    return tuple(
        _caruncle(vertices[rig.upper_lid[side]], vertices[rig.lower_lid[side]], eye_center[side], name)
        for side, name in enumerate(SIDES)
    )


def _caruncle(upper: np.ndarray, lower: np.ndarray, eye_center: np.ndarray, side: str) -> Mesh:
    inner, outer = upper[0], upper[-1]
    along = (outer - inner) / np.linalg.norm(outer - inner)
    above, below = (_at(margin, along, inner, CARUNCLE_IN_M) for margin in (upper, lower))
    middle = 0.5 * (above + below)
    outwards = middle - eye_center
    outwards -= (outwards @ along) * along
    outwards /= np.linalg.norm(outwards)
    across = np.cross(outwards, along)
    opening = np.sign(across[1]) * ((above - below) @ across)
    half = np.clip(1.2 * opening, CARUNCLE_LEAST_M, CARUNCLE_M[1])
    rings, segments = 12, 32
    polar, turn = np.meshgrid(
        np.linspace(0.0, 0.75 * np.pi, rings),
        np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False),
        indexing="ij",
    )
    # a little uneven, as a gland with small hairs is
    uneven = 1.0 + 0.08 * np.sin(3.0 * turn + 1.0) * np.sin(2.0 * polar)
    reach = np.where(np.cos(turn) < 0.0, CARUNCLE_IN_M, CARUNCLE_M[0])
    centre = middle - CARUNCLE_BEHIND_M * outwards
    points = (
        centre
        + (np.sin(polar) * np.cos(turn) * uneven * reach)[..., None] * along
        + (np.sin(polar) * np.sin(turn) * uneven * half)[..., None] * across
        + (np.cos(polar) * min(CARUNCLE_M[2], half))[..., None] * outwards
    )
    faces = ring_quads(rings, segments).astype(np.int32)
    if np.dot(np.cross(along, across), outwards) < 0.0:
        faces = faces[:, ::-1]
    return Mesh(
        name=f"{side}_caruncle",
        vertices=points.reshape(-1, 3),
        faces=faces,
        part=np.full(len(faces), Part.EYE_CAVITY, np.uint8),
        materials=("caruncle",),
        face_material=np.zeros(len(faces), np.int32),
    )


def _at(margin: np.ndarray, along: np.ndarray, start: np.ndarray, reach: float) -> np.ndarray:
    """The point of a margin (n, 3) that lies ``reach`` beyond ``start``, counted along the eye."""
    place = np.maximum.accumulate((margin - start) @ along)
    return np.array([np.interp(reach, place, margin[:, axis]) for axis in range(3)])

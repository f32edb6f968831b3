"""Brows: short strands on the skin round the line of the brow landmarks, so that pixels and labels agree."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import LANDMARK_GROUPS, Part
from facegen.errors import InputError
from facegen.rigs import Rig
from facegen.scene.strands import strand_tubes

POINTS = 5
"""Of a strand, from root to tip."""
STRANDS = 330
"""Of a brow, at a density of 1."""
COURSE = np.linspace(0.0, 1.0, 5)
"""Places of the five landmarks along a brow, from its inner to its outer end; what follows is given there."""
HALF_WIDTH_M = np.array([4.2, 4.4, 3.8, 2.6, 1.0]) * 1e-3
LEAN_RAD = np.radians([72.0, 45.0, 22.0, 4.0, -14.0])
"""Directions of the strands: from straight up (90) at the inner end to outwards and down."""
LENGTH_M = np.array([5.0, 7.0, 8.0, 7.0, 4.5]) * 1e-3
COMBING_RAD = np.radians(28.0)
"""Strands of the upper edge lean down by this, those of the lower edge up: they meet along the middle."""
ROOT_RADIUS_M, TIP_RADIUS_M = 0.05e-3, 0.012e-3
NEAR_M = 12e-3
"""Skin further than this from the landmarks is not looked at."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Brows:
    """Where the n strands of one person's brows grow.

    Attributes
    ----------
    triangle, weight
        (n, 3) vertices of the triangle each root lies in, and their weights.
    lean_rad, bend_rad, length_m, lift, outwards
        (n,) direction of the root between outwards (0) and up (pi / 2), by how much the tip turns from it, length,
        height over the skin as a share of it, and 1 on the subject's left, -1 on the right.
    thickness
        (n,) relative to `ROOT_RADIUS_M`.
    """

    triangle: np.ndarray
    weight: np.ndarray
    lean_rad: np.ndarray
    bend_rad: np.ndarray
    length_m: np.ndarray
    lift: np.ndarray
    outwards: np.ndarray
    thickness: np.ndarray


def draw_brows(rng: np.random.Generator, rig: Rig, *, density: float = 1.0, width: float = 1.0) -> Brows:
    """A person's brows.

    Parameters
    ----------
    rng
        The person's stream.
    density, width
        Relative to `STRANDS` and `HALF_WIDTH_M`.

    Raises
    ------
    InputError
        Where no skin that looks ahead is near a brow's landmarks.
    """
    count = round(STRANDS * density)
    landmarks = (rig.landmark_weights[..., None] * rig.vertices[rig.landmark_vertices]).sum(axis=1)
    brows = []
    for group, outwards in (("left_brow", 1.0), ("right_brow", -1.0)):
        line = landmarks[list(LANDMARK_GROUPS[group])]
        line = line if outwards > 0 else line[::-1]  # iBUG goes from the right brow's outer end to the left's
        course = rng.uniform(-0.03, 1.0, count)
        across = np.clip(rng.normal(0.0, 0.5, count), -1.0, 1.0)
        middle = np.stack([np.interp(course, COURSE, line[:, axis]) for axis in range(2)], axis=-1)
        middle[:, 1] += across * width * np.interp(course, COURSE, HALF_WIDTH_M)
        triangle, weight, on_skin = _on_skin(rig, middle, line)
        lean = np.interp(course, COURSE, LEAN_RAD) - across * COMBING_RAD + rng.normal(0.0, 0.14, count)
        brows.append(
            Brows(
                triangle=triangle[on_skin],
                weight=weight[on_skin],
                lean_rad=lean[on_skin],
                bend_rad=rng.normal(-0.35, 0.15, count)[on_skin],
                length_m=(np.interp(course, COURSE, LENGTH_M) * rng.uniform(0.6, 1.1, count))[on_skin],
                lift=rng.uniform(0.03, 0.09, count)[on_skin],
                outwards=np.full(on_skin.sum(), outwards),
                thickness=rng.uniform(0.7, 1.2, count)[on_skin],
            )
        )
    return Brows(
        **{key: np.concatenate([getattr(one, key) for one in brows]) for key in Brows.__dataclass_fields__}
    )


def _on_skin(
    rig: Rig, line_points: np.ndarray, line: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles (n, 3), weights (n, 3) and whether there is one, of places (n, 2) of the mean face from the front."""
    faces = rig.faces[np.isin(rig.part, (Part.SKIN, Part.BROWS))]
    triangles = np.concatenate([faces[:, :3], faces[faces[:, 3] >= 0][:, [0, 2, 3]]])
    corners = rig.vertices[triangles]
    away = np.linalg.norm(corners.mean(axis=1)[:, None] - line, axis=-1).min(axis=1)
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2]
    near = (away < NEAR_M) & (area > 0.0)  # and facing the front
    if not near.any():
        raise InputError(
            f"rig {rig.name!r} has no skin that looks ahead within {1e3 * NEAR_M:.0f} mm of a brow's landmarks, where "
            "brows would grow; see with facegen rig preview where they lie, and which way the faces look"
        )
    triangles, (a, b, c), area = triangles[near], np.moveaxis(corners[near, :, :2], 1, 0), area[near]
    here = line_points[:, None]
    weights = np.stack(
        [_cross(b - here, c - here), _cross(c - here, a - here), _cross(a - here, b - here)], axis=-1
    )
    weights /= area[:, None]
    smallest = weights.min(axis=-1)
    best = smallest.argmax(axis=1)
    rows = np.arange(len(line_points))
    return triangles[best], weights[rows, best], smallest[rows, best] >= 0.0


def _cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def brow_tubes(brows: Brows, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) and quads (Q, 4) of a person's brows on an evaluated head (V, 3), metres."""
    corners = vertices[brows.triangle]
    root = (brows.weight[..., None] * corners).sum(axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    t = np.linspace(0.0, 1.0, POINTS)
    lean = brows.lean_rad[:, None] + brows.bend_rad[:, None] * t
    heading = np.stack([np.cos(lean) * brows.outwards[:, None], np.sin(lean), np.zeros_like(lean)], axis=-1)
    heading -= (heading * normal[:, None]).sum(axis=-1, keepdims=True) * normal[:, None]
    heading /= np.linalg.norm(heading, axis=-1, keepdims=True)
    height = 4.0 * t * (1.0 - 0.75 * t) * brows.lift[:, None]
    centres = root[:, None] + brows.length_m[:, None, None] * (
        t[:, None] * heading + height[..., None] * normal[:, None]
    )
    taper = ROOT_RADIUS_M + (TIP_RADIUS_M - ROOT_RADIUS_M) * t**1.5
    return strand_tubes(centres, brows.thickness[:, None] * taper)

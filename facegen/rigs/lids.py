"""Lids that close on the eye and stop where they touch: the rig's one part that is not linear.

Along the upper lid's margin most vertices are *columns*. In each column the vertical gap between the margins
has a goal: the gap without the blink, less the blink's share of the gap with nothing closing, and never below
``-overlap``. So a weight of 1 closes every identity, whatever its blink shape overshoots, and blink,
look-down and squint stop together. The blink's displacement is scaled per column to reach the goal, the lid
is pushed out of the eye's true surface (which makes a straight path follow the ball), what is left of the gap
is made good, and the upper margin is laid in front of the lower one where they touch.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, Part
from facegen.rigs.eyes import CORNEA_RADIUS_M, cornea_center_offset
from facegen.rigs.rig import Rig

OVERLAP_M = 0.9e-3
"""How far the upper margin lies below the lower one in the closed eye, mid-lid; 0 to 2 mm are allowed."""
THICKNESS_M = (0.35e-3, 2.0e-3)
"""Lids keep their clearance of the open eye within these: at 0.15 mm a cornea came through large lids."""
BEHIND_M = 0.3e-3
"""Linings of the lids that lie inside the eyeball when open stay this deep in it, out of the skin's way."""
FRONT_M = 0.5e-3
"""The upper margin's distance in front of the lower one in the closed eye."""
STEADY_TRAVEL_M = 1.5e-3
"""Columns whose blink travels less than this take the weight as it is: their ratio would be noise."""
CANTHUS_SHARE, COLUMN_SPACING_M = 0.10, 1.0e-3
"""Least distance along x of a column from the canthi, as a share of the eye's width, and from the next."""
CONTACT_LANDMARKS = ((43, 47), (44, 46), (37, 41), (38, 40))
"""Upper and lower lid landmarks that face each other."""


@dataclass(frozen=True, kw_only=True, eq=False)
class _Eye:
    """What one eye's lids need that does not depend on the face. M lid vertices, U columns.

    ``before``, ``after`` (M,) columns on either side of each vertex and ``share`` (M,) of the latter;
    ``blink`` (M, 3) and ``closing`` (2, M, 3) displacements; ``follow`` (M,) from 1 on the upper margin to 0
    away from it; ``skin`` (M,) whether a vertex can be seen; ``travel`` (U,) of the blink; ``overlap`` (U,);
    weights' indices; the margins as positions among the M; ``partner`` (L, U) interpolates the lower margin
    at the columns; ``flip`` turns x so that it grows from the inner to the outer canthus.
    """

    vertices: np.ndarray
    before: np.ndarray
    after: np.ndarray
    share: np.ndarray
    blink: np.ndarray
    closing: np.ndarray
    follow: np.ndarray
    skin: np.ndarray
    travel: np.ndarray
    overlap: np.ndarray
    blink_index: int
    closing_index: tuple[int, int]
    upper: np.ndarray
    lower: np.ndarray
    partner: np.ndarray
    flip: float


def close_lids(
    rig: Rig,
    vertices: np.ndarray,
    *,
    weights: np.ndarray,
    eye_center: np.ndarray,
    eye_radius: np.ndarray,
    gaze: np.ndarray,
) -> None:
    """Close the lids of linearly evaluated faces, in place.

    Every operation is elementwise over vertices, so that the cage's vertices come out the same with and
    without the rest.

    Parameters
    ----------
    rig
        The rig.
    vertices
        (n, V, 3) or (n, cage_vertices, 3), head frame, metres.
    weights
        (n, 52) as given to `facegen.rigs.evaluate`.
    eye_center, eye_radius, gaze
        (n, 2, 3), (n, 2) and (n, 2, 3) unit optical axes.
    """
    for side, eye in enumerate(_eyes(rig, vertices.shape[1] == rig.cage_vertices)):
        lid = vertices[:, eye.vertices] - eye_center[:, None, side]
        lid = _closed(eye, lid, weights, eye_radius[:, side], gaze[:, side])
        vertices[:, eye.vertices] = lid + eye_center[:, None, side]


def clamp_contact(landmarks: np.ndarray) -> None:
    """Lift upper lid landmarks (n, 68, 3) to their lower partners where lids overlap, in place."""
    for upper, lower in CONTACT_LANDMARKS:
        landmarks[:, upper, 1] = np.maximum(landmarks[:, upper, 1], landmarks[:, lower, 1])


def _closed(
    eye: _Eye, lid: np.ndarray, weights: np.ndarray, radius: np.ndarray, gaze: np.ndarray
) -> np.ndarray:
    blink = weights[:, eye.blink_index, None, None]
    down, squint = (weights[:, index, None, None] for index in eye.closing_index)
    without_blink = lid - blink * eye.blink
    opened = without_blink - down * eye.closing[0] - squint * eye.closing[1]
    thickness = _length(opened) - radius[:, None]

    blink = blink[..., 0]
    gap_without = _gap(eye, without_blink)
    goal = gap_without - blink * (np.maximum(_gap(eye, opened), 0.0) + eye.overlap)
    goal = np.maximum(goal, -eye.overlap)
    travel = gap_without - goal
    steady = STEADY_TRAVEL_M**2
    scale = (travel * eye.travel + blink * steady) / (np.square(eye.travel) + steady)
    lid = without_blink + _along(eye, scale)[..., None] * eye.blink
    lid = _rest_on_eye(eye, lid, thickness, radius, gaze)
    for _ in range(2):
        lid[..., 1] += eye.follow * _along(eye, goal - _gap(eye, lid))
        lid = _lay_in_front(eye, lid)
    return _rest_on_eye(eye, lid, np.minimum(thickness, THICKNESS_M[0]), radius, gaze)


def _length(v: np.ndarray) -> np.ndarray:
    return np.sqrt(v[..., 0] * v[..., 0] + v[..., 1] * v[..., 1] + v[..., 2] * v[..., 2])


def _along(eye: _Eye, columns: np.ndarray) -> np.ndarray:
    """Values (n, M) at the lid vertices of values (n, U) at the columns."""
    return columns[:, eye.before] * (1.0 - eye.share) + columns[:, eye.after] * eye.share


def _lower_at_columns(eye: _Eye, lid: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (n, L) along the lower margin, interpolated at the x of the upper margin's vertices: (n, U)."""
    upper, lower = eye.flip * lid[:, eye.upper, 0], eye.flip * lid[:, eye.lower, 0]
    after = np.clip((upper[:, :, None] >= lower[:, None, :]).sum(axis=-1), 1, lower.shape[1] - 1)
    x0, x1 = np.take_along_axis(lower, after - 1, 1), np.take_along_axis(lower, after, 1)
    v0, v1 = np.take_along_axis(values, after - 1, 1), np.take_along_axis(values, after, 1)
    share = np.clip((upper - x0) / np.maximum(x1 - x0, 1e-6), 0.0, 1.0)
    return v0 + share * (v1 - v0)


def _gap(eye: _Eye, lid: np.ndarray) -> np.ndarray:
    """Height (n, U) of the upper margin over the lower one in each column."""
    return lid[:, eye.upper, 1] - _lower_at_columns(eye, lid, lid[:, eye.lower, 1])


def _rest_on_eye(
    eye: _Eye, lid: np.ndarray, thickness: np.ndarray, radius: np.ndarray, gaze: np.ndarray
) -> np.ndarray:
    """Push skin out of the eye's surface, and linings that lie in it back in, along rays from the centre."""
    length = _length(lid)
    support = _support(lid, length, radius, gaze)
    skin = np.maximum(length, support + np.clip(thickness, *THICKNESS_M))
    lining = np.minimum(length, support + np.maximum(thickness, -BEHIND_M))
    wanted = np.where(eye.skin, skin, lining)
    return lid * (wanted / length)[..., None]


def _support(lid: np.ndarray, length: np.ndarray, radius: np.ndarray, gaze: np.ndarray) -> np.ndarray:
    """`facegen.rigs.eyes.lid_support_radius`, written out so that every element is computed alone."""
    along = lid[..., 0] * gaze[:, None, 0] + lid[..., 1] * gaze[:, None, 1] + lid[..., 2] * gaze[:, None, 2]
    cosine = along / length
    offset = cornea_center_offset(radius)[:, None]
    root = CORNEA_RADIUS_M**2 - offset * offset * (1.0 - cosine * cosine)
    cornea = cosine * offset + np.sqrt(np.maximum(root, 0.0))
    return np.where(root > 0.0, np.maximum(radius[:, None], cornea), radius[:, None])


def _lay_in_front(eye: _Eye, lid: np.ndarray) -> np.ndarray:
    """Bring the upper margin to `FRONT_M` before the lower one where they touch, from behind or afar."""
    length = _length(lid)
    # the lower margin where it faces the column in the open eye: at the inner canthus it is steep, and a
    # partner found anew after each move would run away from the column
    below = np.zeros((len(lid), len(eye.upper)))
    for vertex, share in zip(eye.lower, eye.partner, strict=True):
        below += length[:, vertex, None] * share  # not a matrix product, whose bits depend on its shape
    nearness = np.clip(
        (0.5e-3 - _gap(eye, lid)) / 1e-3, 0.0, 1.0
    )  # from nothing at 0.5 mm apart to all at contact
    outwards = (
        (below + FRONT_M * eye.overlap / OVERLAP_M - length[:, eye.upper])
        * nearness
        * nearness
        * (3.0 - 2.0 * nearness)
    )
    wanted = length + eye.follow * _along(eye, outwards)
    return lid * (wanted / length)[..., None]


@lru_cache(maxsize=8)
def _eyes(rig: Rig, cage_only: bool) -> tuple[_Eye, _Eye]:
    return _prepared(rig, 0, "Left", 1.0, cage_only), _prepared(rig, 1, "Right", -1.0, cage_only)


def _prepared(rig: Rig, side: int, name: str, flip: float, cage_only: bool) -> _Eye:
    vertices = rig.lid_vertices[side]
    vertices = vertices[vertices >= 0]
    if cage_only:
        vertices = vertices[vertices < rig.cage_vertices]
    position = {int(vertex): i for i, vertex in enumerate(vertices)}
    lower = np.array([position[int(vertex)] for vertex in rig.lower_lid[side]])
    x = flip * rig.vertices[vertices, 0]
    upper = _columns(np.array([position[int(vertex)] for vertex in rig.upper_lid[side]]), x)
    after = np.clip(np.searchsorted(x[upper], x), 1, len(upper) - 1)
    share = np.clip((x - x[upper][after - 1]) / (x[upper][after] - x[upper][after - 1]), 0.0, 1.0)
    shapes = {kind: BLENDSHAPE_INDEX[f"eye{kind}{name}"] for kind in ("Blink", "LookDown", "Squint")}
    blink = rig.expression[shapes["Blink"]][vertices]
    descent = np.maximum(-blink[:, 1], 0.0)
    margin = descent[upper][after - 1] * (1.0 - share) + descent[upper][after] * share
    middle = (x[upper] - x[lower[0]]) / (x[lower[-1]] - x[lower[0]])
    eye = _Eye(
        vertices=vertices,
        before=after - 1,
        after=after,
        share=share,
        blink=blink,
        closing=rig.expression[[shapes["LookDown"], shapes["Squint"]]][:, vertices],
        follow=np.clip(descent / np.maximum(margin, 1e-3), 0.0, 1.0),
        skin=np.isin(vertices, rig.faces[np.isin(rig.part, (Part.SKIN, Part.BROWS, Part.LASHES, Part.LIPS))]),
        travel=np.zeros(len(upper)),
        overlap=OVERLAP_M * np.clip(12.0 * middle * (1.0 - middle), 0.0, 1.0),
        blink_index=shapes["Blink"],
        closing_index=(shapes["LookDown"], shapes["Squint"]),
        upper=upper,
        lower=lower,
        partner=np.array(
            [np.interp(x[upper], np.maximum.accumulate(x[lower]), row) for row in np.eye(len(lower))]
        ),
        flip=flip,
    )
    mean_lid = (rig.vertices[vertices] - rig.eye_center[side])[None]
    eye.travel[:] = (_gap(eye, mean_lid) - _gap(eye, mean_lid + 0.7 * blink))[0] / 0.7
    return eye


def _columns(margin: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Vertices of the upper margin, away from the canthi and from each other, where its gap is controlled.

    Near the canthi the margins crowd and turn back: goals there would make the skin beside them jump.
    """
    chosen: list[int] = []
    reach = CANTHUS_SHARE * (x[margin[-1]] - x[margin[0]])
    for vertex in margin:
        from_canthi = min(x[vertex] - x[margin[0]], x[margin[-1]] - x[vertex])
        if from_canthi > reach and (not chosen or x[vertex] - x[chosen[-1]] > COLUMN_SPACING_M):
            chosen.append(int(vertex))
    return np.array(chosen)

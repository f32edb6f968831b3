"""Closes lids on the eye and stops them where they touch: the rig's one part that is not linear.

Along the upper lid's margin most vertices are *columns*. In each column the vertical gap between the margins
has a goal: the gap without the blink, less the blink's share of the gap with nothing closing, and never below
``-overlap``. So a weight of 1 closes every identity, whatever its blink shape overshoots, and blink,
look-down and squint stop together. The blink's displacement is scaled per column to reach the goal, the lid
is pushed out of the eye's true surface (which makes a straight path follow the ball), what is left of the gap
is made good, and the upper margin is laid in front of the lower one where they touch.
"""

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, Part
from facegen.rigs.eyes import CORNEA_RADIUS_M, GLOBE_AHEAD_M, IRIS_RADIUS_M, cornea_center_offset
from facegen.rigs.rig import Rig

if TYPE_CHECKING:
    from facegen.rigs.lid_closing import Lids

CANTHUS_SHARE, COLUMN_SPACING_M = 0.10, 1.0e-3
"""Least distance along x of a column from the canthi, as a share of the eye's width, and from the next."""
LEAST_COLUMNS = 2
"""Between neighbouring ones everything else of a lid is interpolated."""
CONTACT_LANDMARKS = ((43, 47), (44, 46), (37, 41), (38, 40))
"""Upper and lower lid landmarks that face each other."""
LIP_LANDMARKS = ((61, 67), (62, 66), (63, 65))
"""Landmarks of the upper and lower inner lip that face each other."""


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

    Every vertex is moved by itself, so that the cage's vertices come out the same with and without the rest.

    Parameters
    ----------
    rig
        The rig.
    vertices
        (n, V, 3), or fewer, the cage's first and none of a lid beyond them; head frame, metres.
    weights
        (n, 52) as given to `facegen.rigs.evaluate`.
    eye_center, eye_radius, gaze
        (n, 2, 3), (n, 2) and (n, 2, 3) unit optical axes.
    """
    from facegen.rigs.lid_closing import close_eye  # imports Numba

    cornea_offset = cornea_center_offset(eye_radius)
    for side, lids in enumerate(_lids(rig, vertices.shape[1] < len(rig.vertices))):
        close_eye(
            lids,
            vertices,
            np.ascontiguousarray(weights),
            np.ascontiguousarray(eye_center[:, side]),
            np.ascontiguousarray(eye_radius[:, side]),
            np.ascontiguousarray(cornea_offset[:, side]),
            np.ascontiguousarray(gaze[:, side]),
        )


def clamp_contact(landmarks: np.ndarray) -> None:
    """Bring landmarks (n, 68, 3) of lids and lips that passed each other to where they touch, in place.

    Upper lids rest on the lower ones. Lips meet halfway: shapes of both press them through each other, and a
    detector sees the line between them.
    """
    for upper, lower in CONTACT_LANDMARKS:
        landmarks[:, upper, 1] = np.maximum(landmarks[:, upper, 1], landmarks[:, lower, 1])
    for upper, lower in LIP_LANDMARKS:
        crossed = 0.5 * np.maximum(landmarks[:, lower, 1] - landmarks[:, upper, 1], 0.0)
        landmarks[:, upper, 1] += crossed
        landmarks[:, lower, 1] -= crossed


def columns(margin: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Vertices of the upper margin, away from the canthi and from each other, where its gap is controlled.

    Near the canthi the margins crowd and turn back: goals there would make the skin beside them jump.

    Parameters
    ----------
    margin
        (U,) vertices from the inner to the outer canthus; the last may be repeated.
    x
        (V,) distances of the vertices from the middle of the face, metres, positive on the eye's side.

    Returns
    -------
    numpy.ndarray
        Those of ``margin`` that are columns; closing needs `LEAST_COLUMNS`.
    """
    chosen: list[int] = []
    reach = CANTHUS_SHARE * (x[margin[-1]] - x[margin[0]])
    for vertex in margin:
        from_canthi = min(x[vertex] - x[margin[0]], x[margin[-1]] - x[vertex])
        if from_canthi > reach and (not chosen or x[vertex] - x[chosen[-1]] > COLUMN_SPACING_M):
            chosen.append(int(vertex))
    return np.array(chosen)


@lru_cache(maxsize=16)  # cage or all
def _lids(rig: Rig, cage_only: bool) -> tuple["Lids", "Lids"]:
    return _prepared(rig, 0, "Left", 1.0, cage_only), _prepared(rig, 1, "Right", -1.0, cage_only)


def _prepared(rig: Rig, side: int, name: str, flip: float, cage_only: bool) -> "Lids":
    from facegen.rigs.lid_closing import OVERLAP_M, Lids, measure_gap

    vertices = rig.lid_vertices[side]
    vertices = vertices[vertices >= 0]
    if cage_only:
        vertices = vertices[vertices < rig.cage_vertices]
    position = {int(vertex): i for i, vertex in enumerate(vertices)}
    lower = np.array([position[int(vertex)] for vertex in rig.lower_lid[side]])
    x = flip * rig.vertices[vertices, 0]
    upper = columns(np.array([position[int(vertex)] for vertex in rig.upper_lid[side]]), x)
    after = np.clip(np.searchsorted(x[upper], x), 1, len(upper) - 1)
    share = np.clip((x - x[upper][after - 1]) / (x[upper][after] - x[upper][after - 1]), 0.0, 1.0)
    shapes = {kind: BLENDSHAPE_INDEX[f"eye{kind}{name}"] for kind in ("Blink", "LookDown", "Squint")}
    blink = rig.expression[shapes["Blink"]][vertices]
    descent = np.maximum(-blink[:, 1], 0.0)
    margin = descent[upper][after - 1] * (1.0 - share) + descent[upper][after] * share
    middle = (x[upper] - x[lower[0]]) / (x[lower[-1]] - x[lower[0]])
    skin = np.isin(vertices, rig.faces[np.isin(rig.part, (Part.SKIN, Part.BROWS, Part.LASHES, Part.LIPS))])
    lids = Lids(
        vertices=vertices,
        before=after - 1,
        after=after,
        share=share,
        blink=blink,
        closing=np.ascontiguousarray(rig.expression[[shapes["LookDown"], shapes["Squint"]]][:, vertices]),
        follow=np.clip(descent / np.maximum(margin, 1e-3), 0.0, 1.0),
        skin=skin,
        travel=np.zeros(len(upper)),
        overlap=OVERLAP_M * np.clip(12.0 * middle * (1.0 - middle), 0.0, 1.0),
        blink_index=shapes["Blink"],
        closing_index=np.array([shapes["LookDown"], shapes["Squint"]]),
        upper=upper,
        lower=lower,
        partner=np.array(
            [np.interp(x[upper], np.maximum.accumulate(x[lower]), row) for row in np.eye(len(lower))]
        ),
        flip=flip,
        lining=_first_linings(rig, vertices, skin),
        globe_ahead=GLOBE_AHEAD_M,
        cornea_radius=CORNEA_RADIUS_M,
        iris_radius=IRIS_RADIUS_M,
    )
    mean_lid = rig.vertices[vertices] - rig.eye_center[side]
    blinking = np.empty(len(upper))
    measure_gap(lids, mean_lid, lids.travel)
    measure_gap(lids, mean_lid + 0.7 * blink, blinking)
    lids.travel[:] = (lids.travel - blinking) / 0.7
    return lids


def _first_linings(rig: Rig, vertices: np.ndarray, skin: np.ndarray) -> np.ndarray:
    """Which of ``vertices`` (M,) line the lids next to their margins, as positions (C,)."""
    cavity = rig.faces[rig.part == Part.EYE_CAVITY]
    beside = cavity[np.isin(cavity, vertices[skin]).any(axis=1)]
    return np.flatnonzero(~skin & np.isin(vertices, beside))

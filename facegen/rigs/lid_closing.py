"""Closes one eye's lids, face by face, vertex by vertex: the compiled loop of `facegen.rigs.lids`."""

from typing import NamedTuple

import numpy as np

from facegen.compilation import compiled

OVERLAP_M = 0.9e-3
"""How far the upper margin lies below the lower one in the closed eye, mid-lid; 0 to 2 mm are allowed."""
THICKNESS_M = (0.35e-3, 2.0e-3)
"""Lids keep their clearance of the open eye within these: at 0.15 mm a cornea came through large lids."""
BEHIND_M = 0.3e-3
"""Linings of the lids that lie inside the eyeball when open stay this deep in it, out of the skin's way."""
LINING_M, LINING_REACH_M = 0.15e-3, 3.0e-3
"""Near the cornea linings lie this far before the eye, beneath the skin: in it they would show before the iris. They do
so this far beyond the limbus, too: of the faces to linings in the eye the white then hides what is in it."""
CURTAIN_M, PASS_M = 0.3e-3, 1.0e-3
"""In the closed eye linings lie this far before it, and pass the lower margin by this much, from above and from below:
cameras that look in between the margins, or in at their corners, meet them instead of the eye."""
FRONT_M = 0.5e-3
"""The upper margin's distance in front of the lower one in the closed eye."""
AHEAD = np.array([0.0, 0.0, 1.0])
"""Lids fit an eye that looks this way; their clearance of it there is what they keep of every other."""
STEADY_TRAVEL_M = 1.5e-3
"""Columns whose blink travels less than this take the weight as it is: their ratio would be noise."""


class Lids(NamedTuple):
    """What one eye's lids need that does not depend on the face. M lid vertices, U columns, L of the lower margin.

    ``vertices`` (M,) of the rig; ``before``, ``after`` (M,) columns on either side of each and ``share`` (M,) of
    the latter; ``blink`` (M, 3) and ``closing`` (2, M, 3) displacements; ``follow`` (M,) from 1 on the upper margin
    to 0 away from it; ``skin`` (M,) whether a vertex can be seen; ``travel`` (U,) of the blink; ``overlap`` (U,);
    weights' indices; the margins ``upper`` (U,) and ``lower`` (L,) as positions among the M; ``partner`` (L, U)
    interpolates the lower margin at the columns; ``flip`` turns x so that it grows from the inner to the outer
    canthus; ``lining`` (C,) positions of those that line the lids next to their margins; ``globe_ahead``,
    ``cornea_radius`` and ``iris_radius`` the eye's (`facegen.rigs.eyes`), metres.
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
    closing_index: np.ndarray
    upper: np.ndarray
    lower: np.ndarray
    partner: np.ndarray
    flip: float
    lining: np.ndarray
    globe_ahead: float
    cornea_radius: float
    iris_radius: float


@compiled
def close_eye(
    lids: Lids,
    vertices: np.ndarray,
    weights: np.ndarray,
    center: np.ndarray,
    radius: np.ndarray,
    cornea_offset: np.ndarray,
    gaze: np.ndarray,
) -> None:
    """Close one eye's lids in n faces, in place.

    Parameters
    ----------
    lids
        The eye's.
    vertices
        (n, V, 3) linearly evaluated, head frame, metres.
    weights
        (n, 52).
    center, radius, cornea_offset, gaze
        (n, 3), (n,), (n,) and (n, 3): the eyeball's centre and radius, its cornea's centre of curvature along the
        optical axis, and this axis.
    """
    count, columns = len(lids.vertices), len(lids.upper)
    lid, opened, thickness = np.empty((count, 3)), np.empty((count, 3)), np.empty(count)
    goal, gap, scale = np.empty(columns), np.empty(columns), np.empty(columns)
    first, second = lids.closing_index
    steady = STEADY_TRAVEL_M * STEADY_TRAVEL_M
    for face in range(len(vertices)):
        blink, down, squint = weights[face, lids.blink_index], weights[face, first], weights[face, second]
        for i in range(count):
            for axis in range(3):
                at = vertices[face, lids.vertices[i], axis] - center[face, axis] - blink * lids.blink[i, axis]
                lid[i, axis] = at
                opened[i, axis] = at - down * lids.closing[0, i, axis] - squint * lids.closing[1, i, axis]
            length = _length(opened, i)
            thickness[i] = (
                length - _support(lids, opened, i, length, radius[face], cornea_offset[face], AHEAD)[0]
            )
        measure_gap(lids, opened, gap)
        measure_gap(lids, lid, scale)
        for k in range(columns):
            without = scale[k]
            goal[k] = max(without - blink * (max(gap[k], 0.0) + lids.overlap[k]), -lids.overlap[k])
            travel = lids.travel[k]
            scale[k] = ((without - goal[k]) * travel + blink * steady) / (travel * travel + steady)
        for i in range(count):
            along = scale[lids.before[i]] * (1.0 - lids.share[i]) + scale[lids.after[i]] * lids.share[i]
            for axis in range(3):
                lid[i, axis] += along * lids.blink[i, axis]
        _rest_on_eye(lids, lid, thickness, radius[face], cornea_offset[face], gaze[face])
        for _ in range(2):
            measure_gap(lids, lid, gap)
            for k in range(columns):
                scale[k] = goal[k] - gap[k]
            for i in range(count):
                along = scale[lids.before[i]] * (1.0 - lids.share[i]) + scale[lids.after[i]] * lids.share[i]
                lid[i, 1] += lids.follow[i] * along
            _lay_in_front(lids, lid, gap, scale)
        np.minimum(thickness, THICKNESS_M[0], thickness)
        _rest_on_eye(lids, lid, thickness, radius[face], cornea_offset[face], gaze[face])
        _draw_linings(lids, lid, radius[face], cornea_offset[face], gaze[face], gap)
        for i in range(count):
            for axis in range(3):
                vertices[face, lids.vertices[i], axis] = lid[i, axis] + center[face, axis]


@compiled
def measure_gap(lids: Lids, lid: np.ndarray, gap: np.ndarray) -> None:
    """Write the height (U,) of the upper margin over the lower one in each column of lid vertices (M, 3)."""
    for k in range(len(lids.upper)):
        a, b, share = _under(lids, lid, lids.upper[k])
        gap[k] = lid[lids.upper[k], 1] - (lid[a, 1] + share * (lid[b, 1] - lid[a, 1]))


@compiled
def _under(lids: Lids, lid: np.ndarray, i: int) -> tuple[int, int, float]:
    """The vertices of the lower margin on either side of vertex i, and the share of the latter, by x alone."""
    x = lids.flip * lid[i, 0]
    passed = 0
    for vertex in lids.lower:
        passed += x >= lids.flip * lid[vertex, 0]
    after = min(max(passed, 1), len(lids.lower) - 1)
    a, b = lids.lower[after - 1], lids.lower[after]
    x0, x1 = lids.flip * lid[a, 0], lids.flip * lid[b, 0]
    return a, b, min(max((x - x0) / max(x1 - x0, 1e-6), 0.0), 1.0)


@compiled
def _length(lid: np.ndarray, i: int) -> float:
    return np.sqrt(lid[i, 0] * lid[i, 0] + lid[i, 1] * lid[i, 1] + lid[i, 2] * lid[i, 2])


@compiled
def _support(
    lids: Lids,
    lid: np.ndarray,
    i: int,
    length: float,
    radius: float,
    cornea_offset: float,
    gaze: np.ndarray,
) -> tuple[float, float]:
    """The eye's surface (`facegen.rigs.eyes.lid_support_radius`) under vertex i, and the cosine to the axis there."""
    cosine = (lid[i, 0] * gaze[0] + lid[i, 1] * gaze[1] + lid[i, 2] * gaze[2]) / length
    sine_square = 1.0 - cosine * cosine
    ahead, cornea = lids.globe_ahead, lids.cornea_radius
    sclera = cosine * ahead + np.sqrt(radius * radius - ahead * ahead * sine_square)
    root = cornea * cornea - cornea_offset * cornea_offset * sine_square
    if root > 0.0:
        return max(sclera, cosine * cornea_offset + np.sqrt(root)), cosine
    return sclera, cosine


@compiled
def _rest_on_eye(
    lids: Lids, lid: np.ndarray, thickness: np.ndarray, radius: float, cornea_offset: float, gaze: np.ndarray
) -> None:
    """Push skin out of the eye's surface, and linings that lie in it back in, along rays from the centre.

    Near the cornea linings come to lie between the eye and the skin.
    """
    near_cornea = np.cos(np.arcsin(lids.iris_radius / radius) + LINING_REACH_M / radius)
    for i in range(len(lid)):
        length = _length(lid, i)
        support, cosine = _support(lids, lid, i, length, radius, cornea_offset, gaze)
        if lids.skin[i]:
            target = max(length, support + min(max(thickness[i], THICKNESS_M[0]), THICKNESS_M[1]))
        elif cosine > near_cornea:
            target = support + LINING_M
        else:
            target = min(length, support + max(thickness[i], -BEHIND_M))
        for axis in range(3):
            lid[i, axis] *= target / length


@compiled
def _contact(gap: float) -> float:
    """From nothing where the margins are 0.5 mm apart to 1 where they touch."""
    return min(max((0.5e-3 - gap) / 1e-3, 0.0), 1.0)


@compiled
def _lay_in_front(lids: Lids, lid: np.ndarray, gap: np.ndarray, outwards: np.ndarray) -> None:
    """Bring the upper margin to `FRONT_M` before the lower one where they touch, from behind or afar.

    ``gap`` and ``outwards`` (U,) are overwritten.
    """
    measure_gap(lids, lid, gap)
    for k in range(len(lids.upper)):
        # the lower margin where it faces the column in the open eye: at the inner canthus it is steep, and a
        # partner found anew after each move would run away from the column
        below = 0.0
        for j in range(len(lids.lower)):
            below += _length(lid, lids.lower[j]) * lids.partner[j, k]
        front = below + FRONT_M * lids.overlap[k] / OVERLAP_M
        nearness = _contact(gap[k])
        outwards[k] = (front - _length(lid, lids.upper[k])) * nearness * nearness * (3.0 - 2.0 * nearness)
    for i in range(len(lid)):
        along = outwards[lids.before[i]] * (1.0 - lids.share[i]) + outwards[lids.after[i]] * lids.share[i]
        length = _length(lid, i)
        target = length + lids.follow[i] * along
        for axis in range(3):
            lid[i, axis] *= target / length


@compiled
def _draw_linings(
    lids: Lids, lid: np.ndarray, radius: float, cornea_offset: float, gaze: np.ndarray, gap: np.ndarray
) -> None:
    """Draw linings out of the eye and behind the lower margin, from both its sides, where the margins touch.

    ``gap`` (U,) is overwritten.
    """
    if len(lids.lining) == 0:
        return
    measure_gap(lids, lid, gap)
    for k in range(len(lids.upper)):
        gap[k] = _contact(gap[k])
    for i in lids.lining:
        closed = gap[lids.before[i]] * (1.0 - lids.share[i]) + gap[lids.after[i]] * lids.share[i]
        a, b, share = _under(lids, lid, i)
        length, margin = _length(lid, i), _length(lid, a) * (1.0 - share) + _length(lid, b) * share
        goal = (lid[a, 1] + share * (lid[b, 1] - lid[a, 1])) * length / margin
        goal += -PASS_M if lid[i, 1] > goal else PASS_M
        y = lid[i, 1] + closed * (goal - lid[i, 1])
        level = np.sqrt(max(length * length - y * y, 0.0) / (length * length - lid[i, 1] * lid[i, 1]))
        lid[i, 0], lid[i, 1], lid[i, 2] = level * lid[i, 0], y, level * lid[i, 2]
        support, _ = _support(lids, lid, i, length, radius, cornea_offset, gaze)
        target = length + closed * (support + CURTAIN_M - length)
        for axis in range(3):
            lid[i, axis] *= target / length

"""Gums and what they run into: the fold behind lip and cheek on one side, palate or floor of the mouth on the other.

Seen along the arch, the gum's edge is scalloped: it lies at the teeth's necks and comes down between them to fill the
gap below their contacts. The surface is one grid; teeth stand through it.
"""

import numpy as np
import scipy

from facegen.geometry.grids import grid_quads
from facegen.mouth.arch import Course

PER_TOOTH = 6
"""Columns of the grid, at least."""
BEHIND_M = np.array([5e-3, 10e-3, 17e-3, 27e-3])
"""Places beyond the middle of the last tooth where the gum is let run out."""
PAPILLA = {
    "upper": np.array([0.36, 0.36, 0.34, 0.3, 0.28, 0.26]),
    "lower": np.array([0.3, 0.3, 0.3, 0.3, 0.28, 0.26]),
}
"""How far the gum comes down between teeth, relative to the crown's length, from the midline outwards."""
FOLD = ((4.0, 11.5), (2.6, 10.5), (1.6, 8.5), (1.15, 6.0), (0.95, 3.6), (0.75, 1.6), (0.5, 0.5), (0.2, 0.05))
"""Outer profile, from the fold to the edge: millimetres before the neck's surface and above the edge."""
RIM = ((-0.25, 0.05), (-0.9, 0.6))
"""The edge rolls in to the tooth."""
INSIDE = ((0.9, 0.6), (0.2, 0.0), (-0.3, 0.35), (-0.8, 1.5), (-1.4, 3.5))
"""Inner profile, from the tooth on: millimetres outwards from the neck's inner surface, and above the edge."""
ACROSS = 12
"""Rows from there to the middle."""


def gum_surface(
    line: Course, necks: np.ndarray, *, arch: str, size: float, vault_m: float
) -> tuple[np.ndarray, np.ndarray]:
    """Gum, and palate or floor, of one arch in the arch's frame.

    Parameters
    ----------
    line, necks
        The line of contacts, and (14, 4) where teeth leave the gum (`facegen.mouth.arch.necks`).
    arch
        ``"upper"`` or ``"lower"``.
    size
        Factor on the profiles.
    vault_m
        Height of palate (or depth of the floor) beyond the gum's inner edge.

    Returns
    -------
    vertices : numpy.ndarray
        (V, 3) columns x, h, z, metres.
    quads : numpy.ndarray
        (F, 4) int32, outsides out for the upper arch, where h is y.
    """
    mm = 1e-3 * size
    length, outer, inner, edge, inner_edge, plain = _edge(necks, size, arch)
    place, normal = line.at(length)
    rows = []
    for out, up in FOLD:
        # roots show as ridges near the edge, and no more at the fold
        fade = np.clip(up / 9.0, 0.0, 1.0)
        smooth_edge = (1.0 - fade) * edge + fade * plain[1]
        smooth_outer = (1.0 - fade) * outer + fade * plain[0]
        rows.append((smooth_outer + mm * out, smooth_edge + mm * up))
    rows += [(outer + mm * out, edge + mm * up) for out, up in RIM]
    rows.append(((outer + inner) / 2, np.maximum(edge, inner_edge) + mm * 0.9))
    rows += [(inner + mm * out, inner_edge + mm * up) for out, up in INSIDE]
    grid = [_placed(place, normal, out, h) for out, h in rows]
    grid += _middle(grid[-1], vault_m, size, arch)
    vertices = np.stack(grid)  # (rows, columns, 3)
    count, columns = vertices.shape[:2]
    return vertices.reshape(-1, 3), grid_quads(count, columns).astype(np.int32)


def _edge(necks: np.ndarray, size: float, arch: str) -> tuple[np.ndarray, ...]:
    """Columns: arc length, outer and inner distance, outer and inner edge, and the first two without scallops."""
    mm = 1e-3 * size
    s, outer, inner, h = necks.T
    teeth = len(s) // 2
    share = np.concatenate([PAPILLA[arch][::-1], PAPILLA[arch][:1], PAPILLA[arch]])
    between = (s[1:] + s[:-1]) / 2
    crown = (h[1:] + h[:-1]) / 2
    papilla_h = crown - share * crown
    papilla_out = (outer[1:] + outer[:-1]) / 2 - 0.7 * mm
    papilla_in = (inner[1:] + inner[:-1]) / 2 + 0.5 * mm
    # beyond the last tooth the ridge sinks and narrows
    sink = mm * np.array([0.0, 3.5, 9.0, 13.0])
    close = mm * np.array([1.0, 2.5, 4.0, 4.5])
    beyond = s[-1] + BEHIND_M
    knots = [s, between, beyond, -beyond]
    outers = [outer - 0.15 * mm, papilla_out, outer[-1] - close, outer[0] - close]
    inners = [inner, papilla_in, inner[-1] + close, inner[0] + close]
    edges = [h - 0.5 * mm, papilla_h, h[-1] + sink, h[0] + sink]
    inner_edges = [h - 0.3 * mm, papilla_h + 1.0 * mm, h[-1] + sink, h[0] + sink]
    knots = np.concatenate(knots)
    order = np.argsort(knots)
    columns = np.unique(np.linspace(knots[order][:-1], knots[order][1:], PER_TOOTH // 2 + 1))

    def along(values: list[np.ndarray]) -> np.ndarray:
        return scipy.interpolate.pchip_interpolate(knots[order], np.concatenate(values)[order], columns)

    def plain(values: np.ndarray, far: np.ndarray, near: np.ndarray) -> np.ndarray:
        stations = np.concatenate([s, knots[len(s) + len(between) :]])
        sort = np.argsort(stations)
        return scipy.interpolate.pchip_interpolate(
            stations[sort], np.concatenate([values, far, near])[sort], columns
        )

    smooth_outer = plain(outer - 0.4 * mm, outers[2], outers[3])
    smooth_edge = plain(np.full(2 * teeth, h.mean()), edges[2], edges[3])
    return (
        columns,
        along(outers),
        along(inners),
        along(edges),
        along(inner_edges),
        np.stack([smooth_outer, smooth_edge]),
    )


def _placed(place: np.ndarray, normal: np.ndarray, outwards: np.ndarray, h: np.ndarray) -> np.ndarray:
    flat = place + outwards[:, None] * normal
    return np.stack([flat[:, 0], h, flat[:, 1]], axis=-1)


def _middle(side: np.ndarray, vault_m: float, size: float, arch: str) -> list[np.ndarray]:
    """Rows from the gum's inner side (n, 3) to the middle line; both halves meet there."""
    x, h, z = side.T
    mm = 1e-3 * size
    front = z.max()
    behind = front - z
    ramp = np.clip(behind / (20.0 * mm), 0.0, 1.0)
    top = h[len(h) // 2] + vault_m * ramp**2 * (3.0 - 2.0 * ramp)
    # the soft palate hangs down again
    soft = np.clip((behind - 38.0 * mm) / (24.0 * mm), 0.0, 1.0)
    top = top - 0.5 * vault_m * soft**2 * (3.0 - 2.0 * soft)
    top = np.maximum(top, h) if arch == "lower" else top
    rows = []
    for share in np.linspace(0.0, 1.0, ACROSS + 1)[1:]:
        rise = np.sin(0.5 * np.pi * share) ** 0.9
        height = h + (top - h) * rise
        if arch == "upper":
            # rugae: faint ridges across the front of the palate
            height -= (
                0.35
                * mm
                * np.sin(behind / (1.3 * mm))
                * np.exp(-(((behind - 9.0 * mm) / (5.0 * mm)) ** 2))
                * share
            )
        rows.append(np.stack([x * (1.0 - share), height, z], axis=-1))
    return rows

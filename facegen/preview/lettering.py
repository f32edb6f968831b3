"""Writes labels beside points so that no label covers another one, a point, or what else is to be seen."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patheffects import withStroke
from matplotlib.text import Text

GAP_PX = 2.0
"""Between a label's box and its point, and between two boxes."""
RINGS_PX = tuple(range(0, 200, 3))
"""How much further off a label is tried, one ring after another."""
DIRECTIONS = 24
"""Places tried on a ring."""
NEIGHBOURS = 5
"""A label is tried first away from the middle of so many points next to its own."""
LEADER_PX = 5.0
"""A label further off than this has a line that leads to it."""


def label_places(
    points_px: np.ndarray,
    sizes_px: np.ndarray,
    window_px: tuple[float, float, float, float],
    keep_off_px: np.ndarray,
) -> np.ndarray:
    """Middles of labels, each as near to its point as is free.

    Points in a crowd choose first. Where nothing is free any more, a label lies beside its point all the same.

    Parameters
    ----------
    points_px : (n, 2) float64
    sizes_px : (n, 2) float64
        Width and height of each label.
    window_px
        Left, right, low and high end of where labels may be.
    keep_off_px : (k, 2) float64
        Other points that no label may cover.

    Returns
    -------
    (n, 2) float64
    """
    places, kept = np.empty_like(points_px), np.concatenate([points_px, keep_off_px])
    taken: list[tuple[np.ndarray, np.ndarray]] = []
    distances = np.linalg.norm(points_px[:, None] - points_px, axis=-1)
    near = np.argsort(distances, axis=1, kind="stable")[:, 1 : NEIGHBOURS + 1]
    crowd = np.take_along_axis(distances, near, axis=1).sum(axis=1)
    for number in np.argsort(crowd, kind="stable"):
        away = points_px[number] - points_px[near[number]].mean(axis=0) if len(points_px) > 1 else np.ones(2)
        tried = _tried(points_px[number], sizes_px[number] / 2 + GAP_PX, np.arctan2(away[1], away[0]))
        free = _free(tried, sizes_px[number] / 2 + GAP_PX / 2, window_px, kept, taken)
        places[number] = tried[np.argmax(free)]
        taken.append((places[number], sizes_px[number] / 2 + GAP_PX / 2))
    return places


def _tried(point: np.ndarray, half: np.ndarray, first_rad: float) -> np.ndarray:
    """Middles of boxes round a point, in the order of trying, (k, 2)."""
    steps = np.arange(DIRECTIONS)
    turns = 2 * np.pi / DIRECTIONS * ((steps + 1) // 2) * np.where(steps % 2, 1, -1)
    toward = np.stack([np.cos(first_rad + turns), np.sin(first_rad + turns)], axis=-1)
    touching = np.min(half / np.maximum(np.abs(toward), 1e-9), axis=1)  # where the box's edge meets the point
    return (point + toward * (touching + np.array(RINGS_PX)[:, None])[..., None]).reshape(-1, 2)


def _free(
    middles: np.ndarray,
    half: np.ndarray,
    window: tuple[float, float, float, float],
    points: np.ndarray,
    taken: Sequence[tuple[np.ndarray, np.ndarray]],
) -> np.ndarray:
    """Which boxes cover neither a point nor a box, and lie inside the window, (k,) bool."""
    low, high = middles - half, middles + half
    free = (low >= [window[0], window[2]]).all(1) & (high <= [window[1], window[3]]).all(1)
    free &= ~((points > low[:, None]) & (points < high[:, None])).all(-1).any(1)
    for middle, size in taken:
        free &= (np.abs(middles - middle) >= half + size).any(1)
    return free


def write_labels(
    canvas: FigureCanvasAgg,
    axes: Axes,
    points: np.ndarray,
    texts: Sequence[str],
    colors: Sequence[str],
    *,
    fontsize: float,
    keep_off: np.ndarray | None = None,
) -> list[Text]:
    """Write texts beside points of a plot whose place in its figure, and whose ends, are settled.

    Parameters
    ----------
    points : (n, 2) float64
        In the plot's units.
    keep_off : (k, 2) float64, optional
        Other points of the plot that no label may cover.

    Returns
    -------
    list of Text
        In the order of the points.
    """
    drawn = [
        axes.text(0, 0, text, fontsize=fontsize, color=color, ha="center", va="center", zorder=5)
        for text, color in zip(texts, colors, strict=True)
    ]
    if not drawn:
        return []
    renderer = canvas.get_renderer()
    axes.apply_aspect()  # else the plot moves in its place when it is drawn
    sizes = np.array(
        [[box.width, box.height] for box in (text.get_window_extent(renderer) for text in drawn)]
    )
    window = axes.get_window_extent(renderer)
    points_px = axes.transData.transform(points)
    kept_px = axes.transData.transform(np.zeros((0, 2)) if keep_off is None else keep_off)
    places_px = label_places(points_px, sizes, (window.x0, window.x1, window.y0, window.y1), kept_px)
    back = axes.transData.inverted()
    for text, point, place, color, size in zip(drawn, points_px, places_px, colors, sizes, strict=True):
        text.set_position(back.transform(place))
        text.set_path_effects([withStroke(linewidth=1.8, foreground="#ffffff")])
        end = np.clip(point, place - size / 2, place + size / 2)
        if np.linalg.norm(end - point) > LEADER_PX:
            axes.plot(*back.transform([point, end]).T, color=color, lw=0.8, zorder=4)
    return drawn

"""Draws contact sheets: pictures of each sample, its landmarks over them, its largest weights as bars."""

from collections.abc import Sequence

import matplotlib.style
import numpy as np
import pyarrow as pa
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from facegen.conventions import BLENDSHAPES, LANDMARK_GROUPS, Visibility
from facegen.store import Dataset, column_array, read_png

SHEETS = (".png", ".jpg", ".jpeg", ".pdf", ".svg", ".webp")
"""Suffixes of files that a sheet can be saved to."""
BARS = 7
"""Weights shown of each sample, the largest ones."""
_CLOSED = ("right_eye", "left_eye", "outer_lip", "inner_lip")
_VISIBLE, _HIDDEN, _INK, _PAPER = "#39d98a", "#ff6b6b", "#e8e8e8", "#141414"
_OUTLINES = {
    "pupil_ellipse": "#ffd166",
    "iris_ellipse": "#4c9be8",
    "upper_lid_2d": "#c792ea",
    "lower_lid_2d": "#c792ea",
}
_CELL_INCHES = 1.7


def contact_sheet(
    dataset: Dataset, numbers: Sequence[int], *, columns: int = 2, landmarks: bool = True
) -> Figure:
    """Sheet of samples.

    Parameters
    ----------
    dataset
        An open dataset.
    numbers
        Samples to show; those that were rendered show their views, all show their keypoints and weights.
    columns
        Samples side by side.
    landmarks
        Draw landmarks over the views, pupils, irises and the edges of lids.
    """
    rendered = set(dataset.folder.rendered())
    views = dataset.headset.camera_names if rendered.intersection(numbers) else ()
    shown = ("sample", "points_2d", "visibility", "weights", "person")
    table = pa.concat_tables(dataset.rows(sorted(set(numbers)), shown))
    keypoints = {name: column_array(table, name) for name in shown}
    row_of = {int(sample): row for row, sample in enumerate(keypoints["sample"])}
    columns = max(1, min(columns, len(numbers)))
    cells = len(views) + 2
    lines = -(-len(numbers) // columns)
    size = cells * columns * _CELL_INCHES, lines * _CELL_INCHES
    with matplotlib.style.context({"font.size": 6.5, "text.color": _INK, "axes.labelcolor": _INK}):
        figure = Figure(figsize=size, facecolor=_PAPER, dpi=150)
        FigureCanvasAgg(figure)
        grid = figure.subplots(lines, cells * columns, squeeze=False)
        figure.subplots_adjust(left=0, right=0.995, bottom=0.01, top=0.99, wspace=0.03, hspace=0.04)
        for axes in grid.ravel():
            axes.axis("off")
        for place, number in enumerate(numbers):
            row = row_of[number]
            first = place % columns * cells
            axes = grid[place // columns, first : first + cells]
            if number in rendered:
                record = dataset.sample(number)
                for axis, view in zip(axes, _subject_order(views), strict=False):
                    path = dataset.folder.render(number) / f"{view}.png"
                    _draw_view(axis, read_png(path), record["views"][view] if landmarks else None)
            _draw_keypoints(axes[-2], keypoints["points_2d"][row], keypoints["visibility"][row])
            _draw_weights(
                axes[-1], keypoints["weights"][row], f"sample {number}, person {keypoints['person'][row]}"
            )
    return figure


def _subject_order(views: Sequence[str]) -> list[str]:
    """The subject's right eye first: it is at the left of a picture of the face."""
    order = {"right_eye": 0, "left_eye": 1}
    return sorted(views, key=lambda view: order.get(view, 2))


def _draw_view(axis: Axes, grey: np.ndarray, labels: dict | None) -> None:
    axis.imshow(grey, cmap="gray", vmin=0, vmax=255, interpolation="lanczos")
    if labels is None:
        return
    visibility = np.array(labels["visibility"])
    for name, color in _OUTLINES.items():
        for side, outline in labels.get(name, {}).items():
            # behind the housing an eye's outlines would only clutter the picture
            if np.mean(visibility[list(LANDMARK_GROUPS[f"{side}_eye"])] == Visibility.VISIBLE) < 0.5:
                continue
            line = _ellipse(**outline) if isinstance(outline, dict) else np.array(outline, np.float64)
            axis.plot(line[:, 0], line[:, 1], color=color, linewidth=0.4)
    points = np.array(labels["points_2d"], np.float64)
    for value, color in ((Visibility.HIDDEN, _HIDDEN), (Visibility.VISIBLE, _VISIBLE)):
        chosen = points[visibility == value]
        axis.scatter(chosen[:, 0], chosen[:, 1], s=2.0, c=color, linewidths=0)
    axis.set_xlim(-0.5, grey.shape[1] - 0.5)
    axis.set_ylim(grey.shape[0] - 0.5, -0.5)


def _ellipse(center: list, semi_axes: list, angle_rad: float) -> np.ndarray:
    """An ellipse of a sample's record as a closed line (n, 2); NaN where it has none."""
    turn, angle = np.linspace(0.0, 2.0 * np.pi, 61), np.array(angle_rad, np.float64)
    axes = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    return np.array(center, np.float64) + circle * np.array(semi_axes, np.float64) @ axes


def _draw_keypoints(axis: Axes, points: np.ndarray, visibility: np.ndarray) -> None:
    for name, group in LANDMARK_GROUPS.items():
        line = points[list(group)]
        line = np.concatenate([line, line[:1]]) if name in _CLOSED else line
        axis.plot(line[:, 0], line[:, 1], color="#7a7a7a", linewidth=0.6)
    colors = np.where(visibility == Visibility.VISIBLE, _VISIBLE, _HIDDEN)
    axis.scatter(points[:, 0], points[:, 1], s=2.5, c=colors, linewidths=0, zorder=3)
    center, half = (points.min(axis=0) + points.max(axis=0)) / 2, np.ptp(points, axis=0).max() * 0.56
    axis.set_xlim(center[0] - half, center[0] + half)
    axis.set_ylim(center[1] + half, center[1] - half)
    axis.set_aspect("equal")


def _draw_weights(axis: Axes, weights: np.ndarray, title: str) -> None:
    largest = [index for index in np.argsort(-weights, kind="stable")[:BARS] if weights[index] > 0.005]
    axis.set_xlim(0, 1)
    axis.set_ylim(BARS + 0.4, -1.3)
    axis.text(0.02, -0.85, title, color="#9a9a9a", va="center")
    for line, index in enumerate(largest):
        axis.barh(line + 0.32, weights[index], height=0.22, color="#4c9be8")
        axis.text(0.02, line - 0.12, BLENDSHAPES[index], va="center")
        axis.text(0.99, line - 0.12, f"{weights[index]:.2f}", va="center", ha="right", color="#9a9a9a")
    if not largest:
        axis.text(0.02, 0.1, "neutral" if not weights.any() else "almost neutral", va="center")

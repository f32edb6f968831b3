"""Draws docs/pictures/track-axes.png: one head as a camera sees it, in the frames of what leaves `track`.

    python docs/figures/track_axes.py

The head is the reference shape of `regress`, 0.6 m away and turned by 30 degrees to its own left; grey is the same head
straight ahead. Numbers under each frame are what `track.sinks.axes` makes of it.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from facegen.conventions import LANDMARK_GROUPS
from facegen.geometry import rotation_from_angles
from regress.runtime.features.reference_shape import load_reference_shape
from track.sinks.axes import head_pose, unity_euler_deg, unity_position, unity_quaternion

OUT = Path(__file__).resolve().parents[1] / "pictures" / "track-axes.png"
CLOSED = ("right_eye", "left_eye", "outer_lip", "inner_lip")
HEAD = np.array([0.1, -0.05, 0.6, np.radians(30), 0.0, 0.0])
RED, GREEN, BLUE = "#c0392b", "#2e8b57", "#2c5fa8"


def main() -> None:
    """Three frames side by side."""
    pose = head_pose(HEAD)
    turn, unity = pose.rotation, unity_quaternion(pose.rotation)
    panels = [
        (
            "The camera's (OpenCV): what is seen",
            {"x": (1, 0), "y": (0, -1), "z": "away"},
            f"head at {_numbers(HEAD[:3])} m\nyaw 30° (to its left), pitch 0° (upwards)\n"
            "roll 0° (to its left shoulder)",
        ),
        (
            "glTF's: recordings, the room",
            {"x": (1, 0), "y": (0, 1), "z": "towards"},
            f"head at {_numbers(pose.position)} m\nquaternion {_numbers(turn)}",
        ),
        (
            "Unity's: VMC, iFacialMocap",
            {"x": (-1, 0), "y": (0, 1), "z": "towards"},
            f"head at {_numbers(unity_position(pose.position))} m\nquaternion {_numbers(unity)}\n"
            f"Euler {_numbers(unity_euler_deg(HEAD[3:]))}°",
        ),
    ]
    figure = Figure(figsize=(10.5, 4.0), dpi=120)
    FigureCanvasAgg(figure)
    figure.subplots_adjust(left=0.01, right=0.99, top=0.92, bottom=0.19, wspace=0.04)
    for axes, (title, directions, numbers) in zip(figure.subplots(1, 3), panels, strict=True):
        _draw_face(axes, np.eye(3), "#c9c9c9", 1.0)
        _draw_face(axes, rotation_from_angles(*HEAD[3:]), "#222222", 1.4)
        _draw_axes(axes, directions)
        axes.set_title(title, fontsize=11)
        axes.text(0.5, -0.03, numbers, transform=axes.transAxes, ha="center", va="top", fontsize=9)
        axes.text(0.073, 0.035, "its left", ha="center", fontsize=8, color="#777777")
        axes.text(-0.083, 0.035, "its right", ha="center", fontsize=8, color="#777777")
        axes.set_xlim(-0.125, 0.115)
        axes.set_ylim(-0.135, 0.055)
        axes.set_aspect("equal")
        axes.set_axis_off()
    figure.savefig(OUT)


def _numbers(values: np.ndarray) -> str:
    return "(" + ", ".join(f"{value + 0.0:.3g}" for value in values) + ")"


def _draw_face(axes: Axes, turn: np.ndarray, colour: str, width: float) -> None:
    points = load_reference_shape().points @ turn.T
    for name, group in LANDMARK_GROUPS.items():
        order = [*group, *(group[:1] if name in CLOSED else ())]
        if name == "jaw":  # its far end lies behind the cheek
            order = [index for index in order if points[index, 2] > -0.06]
        axes.plot(points[order, 0], points[order, 1], color=colour, linewidth=width, solid_capstyle="round")


def _draw_axes(axes: Axes, directions: dict[str, tuple[int, int] | str]) -> None:
    """Arrows of x and y, and z as the point or the feathers of one."""
    start, length = np.array([-0.092, -0.105]), 0.028
    for name, colour in (("x", RED), ("y", GREEN)):
        end = start + length * np.array(directions[name])
        axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 2})
        axes.text(*(start + 1.3 * (end - start)), name, color=colour, ha="center", va="center", fontsize=11)
    axes.plot(*start, "o", color="white", markeredgecolor=BLUE, markersize=11, markeredgewidth=1.8)
    axes.plot(
        *start, "x" if directions["z"] == "away" else ".", color=BLUE, markersize=6, markeredgewidth=1.8
    )
    aside = -0.018 if directions["x"][0] > 0 else 0.018
    above = 0.012 if directions["y"][1] < 0 else -0.012
    beside = (start[0] + aside, start[1] + above)
    axes.text(*beside, "z", color=BLUE, ha="center", va="center", fontsize=11)


if __name__ == "__main__":
    main()

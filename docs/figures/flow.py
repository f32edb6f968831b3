"""Draws docs/pictures/flow.png: how data flows from a spec to an avatar.

python docs/figures/flow.py
"""

from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

OUT = Path(__file__).resolve().parents[1] / "pictures" / "flow.png"
FACEGEN, REGRESS, LIVE, FILES = "#dceaf7", "#e3f3df", "#f6e0ea", "#f5f1e3"
# name: (x, y, width, title, text, colour)
BOXES = {
    "spec": (0.0, 2.2, 1.5, "spec.toml", "people, expressions,\ngaze, camera, seed", FILES),
    "sampling": (2.0, 2.2, 1.7, "sampling", "(spec, i) decides\neverything of sample i", FACEGEN),
    "rig": (2.0, 3.6, 1.7, "rig", "52 ARKit shapes, 60\nidentities, eyes, lids", FACEGEN),
    "labels": (4.3, 2.2, 1.8, "labels", "68 points in 2D and 3D,\nvisibility, gaze", FACEGEN),
    "blender": (4.3, 3.6, 1.8, "Blender, sensor", "headset views under\ninfra-red light", FACEGEN),
    "dataset": (6.7, 2.9, 1.8, "dataset folder", "Parquet keypoints,\nPNG, EXR, sample.json", FILES),
    "training": (9.1, 2.9, 1.9, "regress train", "178 distances, 31 nets,\nLevenberg-Marquardt", REGRESS),
    "points": (6.7, 0.9, 1.8, "your landmarks", ".pts, OpenFace, py-feat,\n.npy", FILES),
    "model": (11.6, 2.9, 1.6, "model folder", "model.json,\nweights.npz, report", FILES),
    "predict": (9.1, 0.9, 1.9, "regress predict", "CSV of 52 weights\na frame", REGRESS),
    "export": (13.8, 2.9, 1.7, "regress export", "ONNX, C99, JavaScript,\nJSON, NPZ", REGRESS),
    "cameras": (9.1, -0.6, 1.9, "your cameras", "webcam, film, headset,\nnetwork address", FILES),
    "track": (11.6, 0.9, 1.6, "track", "page, VMC, Live Link,\nVRChat, recordings", LIVE),
    "room": (13.8, 0.9, 1.7, "room", "avatars, voices,\nin the browser", LIVE),
}
ARROWS = [
    ("spec", "sampling"),
    ("rig", "sampling"),
    ("sampling", "labels"),
    ("rig", "blender"),
    ("sampling", "blender"),
    ("labels", "dataset"),
    ("blender", "dataset"),
    ("dataset", "training"),
    ("training", "model"),
    ("model", "predict"),
    ("model", "export"),
    ("points", "predict"),
    ("model", "track"),
    ("cameras", "track"),
    ("track", "room"),
]
HEIGHT = 0.95


def main() -> None:
    """Draw the figure."""
    figure = Figure(figsize=(15.7, 5.8), dpi=110)
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0.005, 0.01, 0.99, 0.98))
    for x, y, width, title, text, color in BOXES.values():
        axis.add_patch(
            FancyBboxPatch(
                (x, y), width, HEIGHT, boxstyle="round,pad=0.03", facecolor=color, edgecolor="#555555"
            )
        )
        axis.text(x + width / 2, y + 0.77, title, ha="center", va="center", fontsize=11, weight="bold")
        axis.text(x + width / 2, y + 0.31, text, ha="center", va="center", fontsize=9)
    for start, end in ARROWS:
        axis.annotate("", *_ends(start, end), arrowprops={"arrowstyle": "-|>", "color": "#333333", "lw": 1.4})
    colors = (("facegen", FACEGEN), ("regress", REGRESS), ("track, room", LIVE), ("files", FILES))
    for x, (label, color) in zip((0.0, 1.5, 3.0, 4.8), colors, strict=True):
        axis.add_patch(
            FancyBboxPatch(
                (x, -0.6), 0.3, 0.2, boxstyle="round,pad=0.02", facecolor=color, edgecolor="#555555"
            )
        )
        axis.text(x + 0.42, -0.5, label, fontsize=10, va="center")
    axis.set_xlim(-0.1, 15.6)
    axis.set_ylim(-0.75, 4.75)
    axis.axis("off")
    figure.savefig(OUT)


def _ends(start: str, end: str) -> tuple[tuple[float, float], tuple[float, float]]:
    """Tip and tail of an arrow: from side to side between columns, from edge to edge within one."""
    ax, ay, aw = BOXES[start][:3]
    bx, by, bw = BOXES[end][:3]
    if ax < bx - 0.5:
        return (bx - 0.05, by + HEIGHT / 2), (ax + aw + 0.05, ay + HEIGHT / 2)
    if ax > bx + 0.5:
        return (bx + bw - 0.3, by + HEIGHT + 0.05), (ax + 0.3, ay - 0.05)
    if ay > by:
        return (bx + bw / 2, by + HEIGHT + 0.05), (ax + aw / 2, ay - 0.05)
    return (bx + bw / 2, by - 0.05), (ax + aw / 2, ay + HEIGHT + 0.05)


if __name__ == "__main__":
    main()

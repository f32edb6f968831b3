"""Draws docs/pictures/speech-clip.png: weights, gaze and head of one clip of a dataset over time.

facegen generate datasets/protocol.toml --out datasets/out/protocol
python docs/figures/motion.py datasets/out/protocol 77
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import facegen
from facegen.conventions import BLENDSHAPE_INDEX
from facegen.geometry import angles_from_direction
from facegen.preview import clip_of_dataset

OUT = Path(__file__).resolve().parents[1] / "pictures" / "speech-clip.png"
MOUTH = ("jawOpen", "mouthClose", "mouthLowerDownLeft", "mouthStretchLeft", "mouthFunnel", "mouthPressLeft")
LIDS = ("eyeBlinkLeft", "eyeBlinkRight", "browInnerUp")
COLOURS = ("#1f6feb", "#c4872f", "#2a9d5c", "#a371f7", "#d1495b", "#6b7680")


def main() -> None:
    """Three panels: the mouth, lids and brows, where eyes and head turn."""
    clip = clip_of_dataset(facegen.open_dataset(sys.argv[1]), int(sys.argv[2]))
    figure = Figure(figsize=(10, 6), layout="constrained", dpi=110)
    FigureCanvasAgg(figure)
    mouth, lids, turns = figure.subplots(3, 1, sharex=True, height_ratios=(2, 1, 1))
    for axes, names in ((mouth, MOUTH), (lids, LIDS)):
        for name, colour in zip(names, COLOURS, strict=False):
            weights = clip.weights[:, BLENDSHAPE_INDEX[name]]
            axes.plot(clip.time_s, weights, color=colour, label=name, linewidth=1.4)
        axes.set_ylabel("weight")
        axes.set_ylim(-0.02, None if axes is mouth else 1.02)
    gaze_yaw, gaze_pitch = angles_from_direction(clip.gaze.mean(axis=1))
    head_yaw, head_pitch = angles_from_direction(clip.rotation[:, :, 2])
    for label, angle, colour, style in (
        ("eyes, sideways", gaze_yaw, COLOURS[0], "-"),
        ("eyes, upwards", gaze_pitch, COLOURS[1], "-"),
        ("head, sideways", head_yaw, COLOURS[0], "--"),
        ("head, upwards", head_pitch, COLOURS[1], "--"),
    ):
        turns.plot(clip.time_s, np.degrees(angle), style, color=colour, label=label, linewidth=1.4)
    turns.set_ylabel("degrees")
    turns.set_xlabel("seconds")
    for axes in (mouth, lids, turns):
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
        axes.spines[["top", "right"]].set_visible(False)
    mouth.set_title(clip.title, loc="left", fontsize=10)
    figure.savefig(OUT)


if __name__ == "__main__":
    main()

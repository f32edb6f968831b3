"""Draws docs/pictures/real-sequence.png: weights of real recordings over time, calibrated and not.

    cd RECORDINGS; python .../docs/figures/real_sequence.py .../models/default \\
        openface_sequence.csv pyfeat_clip_007.csv pyfeat_clip_001.csv

The first recording is OpenFace's, whose AU45_r (blink, 0 to 5) is drawn as a share of 5; the others are
py-feat's, with MediaPipe's estimates of the same shapes in the same rows.
"""

import csv
import io
import sys
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from facegen.conventions import BLENDSHAPE_INDEX
from regress import load_model
from regress.runtime.inputs import read_frames

OUT = Path(__file__).resolve().parents[1] / "pictures" / "real-sequence.png"
STILL = ("noseSneerLeft", "mouthRollLower", "browOuterUpLeft", "eyeBlinkLeft")
MOVING = ("jawOpen", "mouthSmileLeft", "mouthUpperUpRight")
BLINKING = ("eyeBlinkLeft",)
ALONE, CALIBRATED, OTHER = "#c4872f", "#1f6feb", "#6b7680"


def main() -> None:
    """Draw the first recording in the upper row, the others in the lower one."""
    model = load_model(sys.argv[1])
    figure = Figure(figsize=(11, 5.4), layout="constrained")
    FigureCanvasAgg(figure)
    rows = figure.subplots(2, 4, sharey=True)
    _row(rows[0], model, Path(sys.argv[2]), STILL, neutral=slice(0, 10))
    _row(rows[1, :3], model, Path(sys.argv[3]), MOVING, neutral=slice(0, 3))
    _row(rows[1, 3:], model, Path(sys.argv[4]), BLINKING, neutral=slice(0, 3))
    rows[1, 3].set_title("eyeBlinkLeft (another talk)", fontsize=10)
    rows[0, 0].set_ylabel("still face, OpenFace\nweight")
    rows[1, 0].set_ylabel("talking faces, py-feat\nweight")
    for axis in rows[1]:
        axis.set_xlabel("frame")
    handles = {line.get_label(): line for axis in rows.flat for line in axis.get_lines()}
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=4, frameon=False)
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=110)
    Image.open(buffer).convert("RGB").quantize(64).save(OUT, optimize=True)


def _row(axes, model, path: Path, shapes: tuple[str, ...], *, neutral: slice) -> None:
    frames = read_frames(path)
    alone = model.predict(frames.points)
    calibrated = model.calibrate(frames.points[neutral]).predict(frames.points)
    with open(path, newline="", encoding="utf-8") as file:
        header, *cells = csv.reader(file)
    columns = [name.strip() for name in header]
    for axis, shape in zip(axes, shapes, strict=True):
        index = BLENDSHAPE_INDEX[shape]
        axis.axvspan(neutral.start, neutral.stop - 1, color="#e8ecef", lw=0)
        if shape in columns:
            estimate = np.array([float(row[columns.index(shape)]) for row in cells])
            axis.plot(estimate, color=OTHER, ls="--", lw=1.4, label="MediaPipe's estimate")
        elif "AU45_r" in columns and shape.startswith("eyeBlink"):
            estimate = np.array([float(row[columns.index("AU45_r")]) for row in cells]) / 5
            axis.plot(estimate, color=OTHER, ls=":", lw=1.6, label="OpenFace's AU45 / 5")
        axis.plot(alone[:, index], color=ALONE, lw=1.6, label="each frame alone")
        axis.plot(calibrated[:, index], color=CALIBRATED, lw=1.8, label="with neutral frames (shaded)")
        axis.set_title(shape, fontsize=10)
        axis.set_ylim(-0.03, 1.03)
        axis.grid(color="#eceff1")
        axis.spines[["top", "right"]].set_visible(False)


if __name__ == "__main__":
    main()

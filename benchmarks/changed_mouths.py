"""Judges what `regress headset check` makes of mouths in pictures of other cameras: rendered ones, changed.

    facegen generate people.toml --out datasets/out/people
    python -m benchmarks.changed_mouths headset-tracking3 --dataset datasets/out/people --each 10

Each person's pictures come nearer and farther, moved, turned by any angle, and in other shapes. Weights of the lower
face are held against those of the pictures as they were rendered: without a placement, as `predict` sees them, and
with the one that `check` writes. The dataset has so many samples of each person, one person after the other. Prints
Markdown, which stands in docs/measurements/headset-networks.md.
"""

import argparse
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from regress.runtime.headset.fitness.fitness import FEWEST_FRAMES, judge
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.placing.levels import levels_in

CAMERA = "mouth"
OF_PLACES = ("UPSIDE_DOWN", "SIDEWAYS", "PLACED", "NOSE", "LOST", "TURNED")

Change = Callable[[np.ndarray], np.ndarray]


def moved(scale: float, *, across: float = 0.0, down: float = 0.0, turn_deg: float = 0.0) -> Change:
    """Pictures from another place; what lies beyond their edges repeats them."""

    def change(pictures: np.ndarray) -> np.ndarray:
        height, width = pictures.shape[1:]
        matrix = cv2.getRotationMatrix2D((width / 2, height / 2), turn_deg, scale)
        matrix[:, 2] += across * width, down * height
        flags = {"borderMode": cv2.BORDER_REPLICATE}
        return np.stack([cv2.warpAffine(one, matrix, (width, height), **flags) for one in pictures])

    return change


CHANGES: dict[str, Change] = {
    "none": lambda pictures: pictures,
    "0.75 times as near": moved(0.75),
    "0.6 times as near": moved(0.6),
    "0.8, moved by .1 and -.08": moved(0.8, across=0.1, down=-0.08),
    "moved aside by a quarter": moved(1.0, across=0.25),
    "moved up by a fifth": moved(1.0, down=-0.2),
    "moved down by a fifth": moved(1.0, down=0.2),
    "turned by 15°": moved(1.0, turn_deg=15),
    "turned by -25°": moved(1.0, turn_deg=-25),
    "1.2 times as near": moved(1.2),
    "1.35 times as near": moved(1.35),
    "1.7 times as near": moved(1.7),
    "upside down": lambda pictures: pictures[:, ::-1, ::-1],
    "on its side": lambda pictures: np.rot90(pictures, axes=(1, 2)),
    "4:3": lambda pictures: pictures[:, 12:84],
    "3:4": lambda pictures: pictures[:, :, 12:84],
    "4:3, upside down": lambda pictures: pictures[:, 12:84][:, ::-1, ::-1],
    "3:4, on its side": lambda pictures: np.rot90(pictures[:, 12:84], axes=(1, 2)),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--dataset", required=True, type=Path)
    parser.add_argument("--each", type=int, required=True, help="Samples of each person.")
    arguments = parser.parse_args()
    files = sorted(arguments.dataset.glob(f"renders/*/*/{CAMERA}.png"))
    pictures = np.stack([cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files])
    people = np.split(pictures, range(arguments.each, len(pictures), arguments.each))
    print(
        f"| network | change | error of {len(people)} people: not placed, by check | placed, worse | said |"
    )
    print("|---|---|---|---|---|")
    for model in arguments.models:
        predictor = load_headset_predictor(model)
        for what, change in CHANGES.items():
            print(f"| {model} | {what} | {row(predictor, people, change)} |", flush=True)


def row(predictor: HeadsetPredictor, people: list[np.ndarray], change: Change) -> str:
    """Cells of a change."""
    errors, said, placed = [], Counter(), 0
    for person in people:
        plain = weights(predictor, person, CameraPlacement())
        seen = np.ascontiguousarray(change(person))
        whole = whole_view((seen.shape[2], seen.shape[1]), predictor.sizes[CAMERA])
        (one,) = judge(predictor, {CAMERA: np.repeat(seen, -(-FEWEST_FRAMES // len(seen)), axis=0)})
        said.update(found.misfit.value for found in one.findings if found.misfit.name in OF_PLACES)
        at = replace(one.placement, low=None, high=None)
        placed += at != replace(whole, aspect=None)
        errors.append([np.abs(weights(predictor, seen, view) - plain).mean() for view in (whole, at)])
    before, after = np.mean(errors, axis=0)
    worse = sum(mine > theirs + 1e-4 for theirs, mine in errors)
    told = ", ".join(f"{what} {count}" for what, count in said.most_common())
    return f"{before:.4f}, {after:.4f} | {placed}, {worse} | {told}"


def weights(predictor: HeadsetPredictor, pictures: np.ndarray, placement: CameraPlacement) -> np.ndarray:
    """Of the camera's own shapes (n, shapes), levels as `predict` makes them."""
    width, height = predictor.sizes[CAMERA]
    views = np.stack([placement.view(one, width=width, height=height) for one in pictures])
    levelled = levels_in([views], predictor.model.looks[CAMERA]).apply(views)
    columns = [predictor.model.weights.index(name) for name in predictor.model.parts[CAMERA]]
    return predictor.graph.run({CAMERA: levelled}).weights[:, columns]


if __name__ == "__main__":
    main()

"""Trains headset networks that lack one part of the default training each, and evaluates them.

    python -m benchmarks.experiments.headset_ablation datasets/out/headset-arrays \
        --test datasets/out/headset-test-arrays [--test light=... ...] [--out models/ablation] [--people 270] \
        [--epochs 16] [--jobs 2]

A network is some three processor minutes at these defaults; those that lie under `--out` are not trained again, and one
that was stopped goes on. Errors of unseen people, and on combinations that training seldom shows. Prints Markdown,
which stands in docs/measurements/headset-networks.md.
"""

import argparse
import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.evaluation import evaluate
from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training import train_headset
from regress.runtime.headset.network.figures import evaluation_to_json
from regress.runtime.headset.network.predictor import load_headset_predictor

HOLISTIC = {"architecture": "holistic"}
NARROW = {"randomise": 0, "shift": 0.03, "scale": 0.04, "rotation_deg": 3, "plain": 0}
VARIANTS: dict[str, dict[str, object]] = {
    "default": {},
    "holistic": HOLISTIC,
    "no camera ever absent": {"camera_dropout": 0},
    "holistic, no camera ever absent": {**HOLISTIC, "camera_dropout": 0},
    "cameras absent twice as often": {"camera_dropout": 0.4},
    "no part loss": {"part_loss": 0, "part_loss_elsewhere": 0},
    "no skips between cameras": {"skip": 0},
    "no modulation": {"modulation": 1},
    "each camera its part alone": {"modulation": 0, "skip": 0},
    "no geometry loss": {"geometry_loss": 0},
    "no second look": {"second_look": False},
    "no points traced": {"points_loss": 0},
    "no neutral pictures": {"calibration": False},
    "as rendered, little displaced": NARROW,
    "pictures as they are": {"shift": 0, "scale": 0, "rotation_deg": 0, "jitter_neutral": 0},
    "combinations withheld": {"withhold": "combined"},
    "holistic, combinations withheld": {**HOLISTIC, "withhold": "combined"},
}
"""What differs from the default recipe, by what the table calls it."""

FIGURES = (
    ("mm", "uncalibrated", "geometry_mm", 3),
    ("R²", "uncalibrated", "r2", 3),
    ("blink R²", "uncalibrated", "blink_r2", 3),
    ("gaze °", "uncalibrated", "gaze_deg", 2),
    ("calibrated mm", "same_seat", "geometry_mm", 3),
    ("calibrated R²", "same_seat", "r2", 3),
    ("left eye lost mm", "without_left_eye", "geometry_mm", 3),
    ("right eye lost mm", "without_right_eye", "geometry_mm", 3),
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("arrays", type=Path)
    parser.add_argument("--test", action="append", required=True, metavar="[NAME=]ARRAYS")
    parser.add_argument("--out", type=Path, default=Path("models/ablation"))
    parser.add_argument("--people", type=int, default=270)
    parser.add_argument("--epochs", type=int, default=16)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    places = {name: arguments.out / name.replace(", ", "-").replace(" ", "-") for name in VARIANTS}
    size = {"people": arguments.people, "epochs": arguments.epochs}
    with ProcessPoolExecutor(arguments.jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        trained = {
            pool.submit(train, arguments.arrays, HeadsetRecipe(**size, **VARIANTS[name]), place): name
            for name, place in places.items()
        }
        for done in as_completed(trained):
            done.result()
            print(f"trained: {trained[done]}", file=sys.stderr, flush=True)
    main_test, *others = (pair.rpartition("=")[::2] for pair in arguments.test)
    print_table(places, read_arrays(main_test[1]))
    if others:
        print_others(places, {name: read_arrays(path) for name, path in others})


def train(arrays: Path, recipe: HeadsetRecipe, place: Path) -> None:
    """Train a variant, unless it lies there."""
    if not (place / "model.json").is_file():
        train_headset(read_arrays(arrays), recipe, place)


def print_table(places: dict[str, Path], arrays: HeadsetArrays) -> None:
    """Every variant on the main test people."""
    head = ["network", *(title for title, *_ in FIGURES), "rare combinations mm", "calibrated"]
    print(f"\n| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for name, place in places.items():
        found = figures(place, arrays)
        cells = [cell(found["conditions"], *column) for _, *column in FIGURES]
        cells += [
            cell(found["combined"], condition, "geometry_mm", 3)
            for condition in ("uncalibrated", "same_seat")
        ]
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


def print_others(places: dict[str, Path], tests: dict[str, HeadsetArrays]) -> None:
    """Every variant on pictures of another kind."""
    head = [
        "network",
        *(title for name in tests for title in (f"{name} mm", "R²", "gaze °", "calibrated mm")),
    ]
    print(f"\n| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for name, place in places.items():
        cells = []
        for arrays in tests.values():
            found = figures(place, arrays)["conditions"]
            cells += [cell(found, "uncalibrated", "geometry_mm", 3), cell(found, "uncalibrated", "r2", 3)]
            cells += [cell(found, "uncalibrated", "gaze_deg", 2), cell(found, "same_seat", "geometry_mm", 3)]
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


def figures(place: Path, arrays: HeadsetArrays) -> dict[str, Any]:
    one = load_headset_predictor(place)
    return evaluation_to_json(evaluate(one.graph, one.model, arrays))


def cell(found: dict[str, Any], condition: str, figure: str, digits: int) -> str:
    return f"{found[condition][figure]:.{digits}f}" if condition in found else ""


if __name__ == "__main__":
    main()

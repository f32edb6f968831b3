"""What each part of a recipe is worth: test R2 of recipes that differ by one thing, at several levels of noise.

    python benchmarks/bench_recipes.py DATASET [--faces 20000] [--only "NAME;NAME"] [--json]

DATASET is a folder that `facegen generate` made. Networks train on its detected points; people of the test split
are judged on exact points with normal noise on every coordinate, in per cent of the distance between the outer
eye corners, and with a detector's bias (regress.training.record.DETECTOR). With a neutral frame, that frame has noise
of the same size. `below ridge` counts shapes whose R2 is more than 0.01 below that of ridge regression on the same
features and the same training rows, strength chosen per shape. docs/training.md has a run's table.
"""

import argparse
import json
import os
import time
from dataclasses import replace

os.environ.setdefault("OMP_NUM_THREADS", "1")  # the fit has threads of its own

import numpy as np

from regress.model import Model
from regress.targets import OUTPUTS, VISIBLE_SHAPES
from regress.training import RECIPES, Recipe, read_dataset, train
from regress.training.baseline import fit_baseline
from regress.training.dataset import KeypointDataset
from regress.training.noise import displace
from regress.training.preparation import OUTPUT_COLUMNS, Faces, as_detected, faces_of
from regress.training.record import DETECTOR
from regress.training.scores import score, score_faces

NOISE_PERCENT = (0.0, 0.1, 0.5, 1.0, 2.0)
PAPER, EXACT, DEFAULT = (RECIPES[name] for name in ("paper", "exact", "default"))
VARIANTS: dict[str, Recipe] = {
    "paper": PAPER,
    "paper, strengths by evidence": replace(PAPER, strengths="evidence"),
    "paper, starts at ridge knots": replace(PAPER, start="ridge_knots"),
    "exact": EXACT,
    "exact, no mirrored faces": replace(EXACT, mirror=False),
    "exact, 40 hidden units": replace(EXACT, hidden=40),
    "default": DEFAULT,
    "default, random starts": replace(DEFAULT, start="nguyen_widrow"),
    "default, 40 hidden units": replace(DEFAULT, hidden=40),
    "default, strengths by evidence": replace(DEFAULT, strengths="evidence"),
}


def noisy(faces: Faces, percent: float) -> Faces:
    """Faces, and their neutral frames, with noise of so many per cent of the outer-eye distance."""
    rng = np.random.default_rng(11)

    def moved(points: np.ndarray) -> np.ndarray:
        return displace(points, percent / 100 * rng.standard_normal(points.shape))

    return replace(
        faces, points=moved(faces.points), neutral=None if faces.neutral is None else moved(faces.neutral)
    )


def figures(
    model: Model, trained: KeypointDataset, exact: KeypointDataset, recipe: Recipe, *, calibrated: bool
) -> dict[str, dict[str, float]]:
    """Mean R2 at each level of noise, of networks and of ridge, and how many shapes lie below ridge."""
    ridge = fit_baseline(
        trained,
        model.features,
        mirror=recipe.mirror,
        noise=recipe.calibrated_noise if calibrated else recipe.noise,
        calibrated=calibrated,
    )
    faces = faces_of(exact, "test", calibrated=calibrated)
    levels = {f"{percent:g} %": noisy(faces, percent) for percent in NOISE_PERCENT}
    levels["detector"] = as_detected(faces, DETECTOR, np.random.default_rng(68))
    rows = {}
    for level, shown in levels.items():
        networks = score_faces(model, shown)
        predicted = ridge.predict(shown.features(model.features))
        linear = dict(zip(OUTPUTS, score(predicted, shown.weights[:, OUTPUT_COLUMNS]), strict=True))
        known = [name for name in OUTPUTS if networks[name].r2 is not None]
        rows[level] = {
            "r2": float(np.mean([networks[name].r2 for name in known])),
            "r2_visible": float(np.mean([networks[name].r2 for name in known if name in VISIBLE_SHAPES])),
            "ridge_r2": float(np.mean([linear[name].r2 for name in known])),
            "below_ridge": sum(networks[name].r2 < linear[name].r2 - 0.01 for name in known),
        }
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset")
    parser.add_argument("--faces", type=int, default=20000, help="of all splits together")
    parser.add_argument("--only", default=";".join(VARIANTS), help="variants, joined by semicolons")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    trained = read_dataset(arguments.dataset)
    exact = read_dataset(arguments.dataset, points="points_2d")
    share = min(1.0, arguments.faces / len(trained.split))
    rows = {name: trained.rows(name) for name in ("train", "validation", "test")}
    kept = np.sort(np.concatenate([numbers[: round(share * len(numbers))] for numbers in rows.values()]))
    trained, exact = trained.take(kept), exact.take(kept)
    found = {}
    for name in map(str.strip, arguments.only.split(";")):
        recipe = VARIANTS[name]
        began = time.process_time()
        model = train(trained, recipe)
        seconds = time.process_time() - began
        for calibrated in (False, True) if model.calibrated is not None else (False,):
            label = f"{name} + neutral frame" if calibrated else name
            found[label] = figures(model, trained, exact, recipe, calibrated=calibrated)
            if not arguments.json:
                cells = " ".join(
                    f"{row['r2']:.3f}/{row['r2_visible']:.3f}({row['below_ridge']})"
                    for row in found[label].values()
                )
                print(f"{label:<48} {seconds:6.0f} s  {cells}", flush=True)
    if arguments.json:
        print(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()

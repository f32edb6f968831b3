"""Compares ways to train the networks that compare with a neutral face, by heads of a rig that they never saw.

    python benchmarks/calibrated_ablation.py datasets/out/default --real RECORDINGS --seeds 3 --only "default;edges"

Each row changes one thing of the default recipe; only networks that compare are trained. Two takes of an iPhone's 52
weights are played by people of another rig (`facegen rig build ict --path CLONE`), with a detector's bias and jitter of
1 px at 100 px between the outer eye corners, and given a neutral face. In-rig figures mislead here (docs/training.md).
"""

import argparse
import json
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from real_recordings import mean_mae, median_r, replay
from small_movements import small_movements

from facegen.rigs import load_rig
from regress import Model
from regress.learning.training import read_dataset
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.gain import stretched
from regress.learning.training.recipes import RECIPES, Recipe
from regress.learning.training.run import beside_neutral, fit_set
from regress.runtime.features import (
    Features,
    closed_under_mirror,
    depths_of,
    load_reference_shape,
    mean_shape,
)
from regress.runtime.model import Calibrated, symmetrised
from regress.targets import NETWORKS, VISIBLE_SHAPES

DEFAULT = RECIPES["default"]
NOISE = DEFAULT.calibrated_noise
ROWS: dict[str, Recipe] = {
    "default": DEFAULT,
    "edges": replace(DEFAULT, calibrated_alignment="affine"),
    "edges, with the filter of the noise": replace(
        DEFAULT, calibrated_alignment="affine", calibrated_denoise=True, calibrated_whitening=0.0
    ),
    "not whitened": replace(DEFAULT, calibrated_whitening=0.0),
    "whitened": replace(DEFAULT, calibrated_whitening=1.0),
    "not stretched": replace(DEFAULT, calibrated_gain=False),
    "40 hidden units": replace(DEFAULT, hidden=40),
    "jitter of 1 %": replace(DEFAULT, calibrated_noise=replace(NOISE, jitter=0.01)),
    "jitter of 3 %": replace(DEFAULT, calibrated_noise=replace(NOISE, jitter=0.03)),
    "jitter of 0.5 to 3 %": replace(DEFAULT, calibrated_noise=replace(NOISE, jitter=0.005, jitter_most=0.03)),
    "eyes as the rest": replace(DEFAULT, calibrated_noise=replace(NOISE, eyes=1.0)),
    "eyes half": replace(DEFAULT, calibrated_noise=replace(NOISE, eyes=0.5)),
    "a third clean": replace(DEFAULT, calibrated_noise=replace(NOISE, clean=0.35)),
    "no bias": replace(DEFAULT, calibrated_noise=replace(NOISE, bias=0.0)),
}


def train_calibrated(dataset: KeypointDataset, recipe: Recipe, seed: int) -> Model:
    """A model of which only the networks that compare are trained."""
    reference = load_reference_shape()
    features = Features(
        alignment=recipe.alignment,
        mean_shape=mean_shape(dataset.points[dataset.rows("train")]),
        edges=closed_under_mirror(reference.edges),
        reference_name=reference.name,
        reference_sha256=reference.sha256,
        depth=depths_of(reference),
    )
    beside = beside_neutral(features, recipe)
    fitted = fit_set(dataset, beside, recipe, calibrated=True, seed=seed, progress=None)
    seen = {"features": beside, "normalisation": fitted.prepared.normalisation, "networks": fitted.networks}
    model = symmetrised(Model(recipe=recipe.name, table=NETWORKS, calibrated=Calibrated(**seen), **seen))
    return stretched(model, dataset) if recipe.calibrated_gain else model


def figures_of(model: Model, arguments: argparse.Namespace) -> dict[str, float]:
    """What stands in a row of the table."""
    rig = load_rig(arguments.rig)
    rows = [
        row["model"]
        for row in replay(model, {}, arguments.real, rig, arguments.people, arguments.step)
        if row["noise_px"] == 1.0 and row["bias"]
    ]
    small = small_movements(model, rig, people=arguments.people)
    return {
        "mae": float(np.mean([mean_mae(row) for row in rows])),
        "r": float(np.mean([median_r(row) for row in rows])),
        "lowest r": float(min(shape["r"] for row in rows for shape in row.values())),
        "own eye": small["wink"]["own"],
        "other eye": small["wink"]["other"],
        "still": float(np.mean([small["still"][name] for name in VISIBLE_SHAPES])),
        "slope": float(np.median([row["slope"] for row in small["slight"].values()])),
    }


def main() -> None:
    """Train and judge every row, seed by seed; a row is printed as soon as it is done."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path)
    parser.add_argument("--real", type=Path, required=True, help="folder with livelink/")
    parser.add_argument("--rig", default="ict", help="rig of those who play the takes")
    parser.add_argument("--people", type=int, default=4)
    parser.add_argument("--step", type=int, default=2, help="take every so many frames of a take")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", help="rows, separated by ;")
    parser.add_argument("--json", type=Path, help="write all figures here")
    arguments = parser.parse_args()
    names = arguments.only.split(";") if arguments.only else list(ROWS)
    unknown = set(names) - ROWS.keys()
    if unknown:
        parser.error(f"no row is called {min(unknown)!r}; there are {'; '.join(ROWS)}")
    dataset, figures = read_dataset(arguments.dataset), {}
    print("| row | MAE | median r | lowest r | wink: own / other eye | still, a px | slight: slope | s |")
    print("|---|---|---|---|---|---|---|---|")
    for name in names:
        began = time.process_time()
        figures[name] = [
            figures_of(train_calibrated(dataset, ROWS[name], seed), arguments)
            for seed in range(arguments.seeds)
        ]
        seconds = (time.process_time() - began) / arguments.seeds
        mean = {key: np.mean([row[key] for row in figures[name]]) for key in figures[name][0]}
        spread = {key: np.ptp([row[key] for row in figures[name]]) / 2 for key in mean}
        print(
            f"| {name} | {mean['mae']:.4f} ± {spread['mae']:.4f} | {mean['r']:.3f} ± {spread['r']:.3f} "
            f"| {mean['lowest r']:.2f} | {mean['own eye']:.2f} / {mean['other eye']:.2f} | {mean['still']:.4f} "
            f"| {mean['slope']:.2f} | {seconds:.0f} |",
            flush=True,
        )
    if arguments.json:
        arguments.json.write_text(json.dumps(figures))


if __name__ == "__main__":
    main()

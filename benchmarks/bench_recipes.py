"""Measures what each part of a recipe adds: test R2 of recipes that differ by one thing, at several noise levels.

    python benchmarks/bench_recipes.py DATASET [--faces 20000] [--only "NAME;NAME"] [--bound 0.1 1] [--features]

DATASET is a folder that `facegen generate` made. Networks train on its detected points; people of the test split
are judged on exact points with normal noise on every coordinate, in per cent of the distance between the outer
eye corners, and with a detector's bias (training.record.DETECTOR). With a neutral frame, that frame has noise
of the same size. `below ridge` counts shapes whose R2 is more than 0.01 below that of ridge regression on the same
features and the same training rows, strength chosen per shape. --bound prints what one large network reaches that
learns one level of noise alone, from aligned coordinates of the frame and of the neutral frame: it need not be small,
know other noise, or be shipped. --features prints what ridge regression reaches from distances, from aligned
coordinates and from both, with a neutral frame, on exact rows and on the default recipe's.
docs/measurements/landmark-networks.md has a run's tables.
"""

import argparse
import json
import os
import time
from collections.abc import Callable
from dataclasses import replace

os.environ.setdefault("OMP_NUM_THREADS", "1")  # the fit has threads of its own

import numpy as np
from sklearn.neural_network import MLPRegressor

from regress.learning.networks import fit_ridge
from regress.learning.training import RECIPES, Recipe, read_dataset, train
from regress.learning.training.baseline import fit_baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.noise import DetectorNoise, displace
from regress.learning.training.preparation import OUTPUT_COLUMNS, Faces, draw_detected, faces_of
from regress.learning.training.record import DETECTOR
from regress.learning.training.scores import score, score_faces
from regress.runtime.features import (
    Features,
    align_affine,
    depths_of,
    extract,
    load_reference_shape,
    mean_shape,
    undo_turn,
)
from regress.runtime.model import Model
from regress.targets import OUTPUTS, VISIBLE_SHAPES

NOISE_PERCENT = (0.0, 0.1, 0.5, 1.0, 2.0)
PAPER, EXACT, DEFAULT = (RECIPES[name] for name in ("paper", "exact", "default"))
LARGE = (256, 256)
"""Hidden units of the bound."""


def _like(noise: DetectorNoise, jitter_most: float) -> DetectorNoise:
    return replace(noise, jitter=0.0005, jitter_most=jitter_most, clean=noise.clean + 0.1, unbiased=0.2)


VARIANTS: dict[str, Recipe] = {
    "paper": PAPER,
    "paper, strengths by evidence": replace(PAPER, strengths="evidence"),
    "paper, starts at ridge knots": replace(PAPER, start="ridge_knots"),
    "exact": EXACT,
    "exact, no mirrored faces": replace(EXACT, mirror=False),
    "exact, 40 hidden units": replace(EXACT, hidden=40),
    "exact, turn left as it is": replace(EXACT, undo_turn=False),
    "default": DEFAULT,
    "default, turn left as it is": replace(DEFAULT, undo_turn=False),
    "default, not symmetric": replace(DEFAULT, symmetric=False),
    "default, less jitter": replace(
        DEFAULT, noise=_like(DEFAULT.noise, 0.02), calibrated_noise=_like(DEFAULT.calibrated_noise, 0.02)
    ),
    "default, not denoised": replace(DEFAULT, denoise=False),
    "default, random starts": replace(DEFAULT, start="nguyen_widrow"),
    "default, 40 hidden units": replace(DEFAULT, hidden=40),
    "default, strengths by evidence": replace(DEFAULT, strengths="evidence"),
}


def noisy(faces: Faces, percent: float, seed: int = 11) -> Faces:
    """Faces, and their neutral frames, with noise of so many per cent of the outer-eye distance."""
    rng = np.random.default_rng(seed)

    def moved(points: np.ndarray) -> np.ndarray:
        return displace(points, percent / 100 * rng.standard_normal(points.shape))

    return replace(
        faces, points=moved(faces.points), neutral=None if faces.neutral is None else moved(faces.neutral)
    )


def figures(
    model: Model, trained: KeypointDataset, exact: KeypointDataset, recipe: Recipe, *, calibrated: bool
) -> dict[str, dict[str, float]]:
    """Mean R2 at each level of noise, of networks and of ridge, and how many shapes lie below ridge."""
    features = model.calibrated.features if calibrated else model.features
    ridge = fit_baseline(
        trained,
        features,
        mirror=recipe.mirror,
        noise=recipe.calibrated_noise if calibrated else recipe.noise,
        calibrated=calibrated,
        seed=model.record.seed,
    )
    faces = faces_of(exact, "test", calibrated=calibrated)
    levels = {f"{percent:g} %": noisy(faces, percent) for percent in NOISE_PERCENT}
    levels["detector"] = draw_detected(faces, DETECTOR, np.random.default_rng(68))
    rows = {}
    for level, shown in levels.items():
        networks = score_faces(model, shown)
        predicted = ridge.predict(shown.features(features))
        linear = dict(zip(OUTPUTS, score(predicted, shown.weights[:, OUTPUT_COLUMNS]), strict=True))
        known = [name for name in OUTPUTS if networks[name].r2 is not None]
        rows[level] = {
            "r2": float(np.mean([networks[name].r2 for name in known])),
            "r2_visible": float(np.mean([networks[name].r2 for name in known if name in VISIBLE_SHAPES])),
            "ridge_r2": float(np.mean([linear[name].r2 for name in known])),
            "below_ridge": sum(networks[name].r2 < linear[name].r2 - 0.01 for name in known),
        }
    return rows


def bound(exact: KeypointDataset, percent: float) -> tuple[float, float]:
    """Mean test R2 of a large network at one level of noise, over all shapes and over the visible ones."""
    shape = mean_shape(exact.points[exact.rows("train")])
    sets = []
    for seed, split in enumerate(("train", "test")):
        faces = noisy(faces_of(exact, split, calibrated=True), percent, 11 if split == "test" else seed)
        frame, neutral = (
            align_affine(points, shape).reshape(len(points), -1) for points in (faces.points, faces.neutral)
        )
        sets.append((np.hstack([frame, neutral, frame - neutral]), faces.weights[:, OUTPUT_COLUMNS]))
    (inputs, targets), (given, true) = sets
    mean, spread, scale = inputs.mean(axis=0), inputs.std(axis=0), targets.std(axis=0)
    network = MLPRegressor(
        hidden_layer_sizes=LARGE,
        early_stopping=True,
        n_iter_no_change=5,
        learning_rate_init=5e-4,
        alpha=1e-2,
        random_state=0,
    )
    network.fit(((inputs - mean) / spread).astype(np.float32), (targets / scale).astype(np.float32))
    found = score(np.clip(network.predict((given - mean) / spread) * scale, 0, 1), true)
    r2 = {name: row.r2 for name, row in zip(OUTPUTS, found, strict=True) if row.r2 is not None}
    return float(np.mean(list(r2.values()))), float(np.mean([r2[name] for name in VISIBLE_SHAPES]))


def feature_kinds(trained: KeypointDataset, exact: KeypointDataset) -> dict[str, list[float]]:
    """Mean test R2 of ridge regression at each level of noise, by kind of features and rows."""
    reference = load_reference_shape()
    features = Features(
        alignment="affine",
        mean_shape=mean_shape(trained.points[trained.rows("train")]),
        edges=reference.edges,
        reference_name=reference.name,
        reference_sha256=reference.sha256,
        depth=depths_of(reference),
    )

    def coordinates(points: np.ndarray) -> np.ndarray:
        undone = undo_turn(points, features.mean_shape, features.depth)
        return align_affine(undone, features.mean_shape).reshape(len(points), -1)

    kinds: dict[str, Callable[[np.ndarray], np.ndarray]] = {
        "distances": lambda points: extract(features, points),
        "coordinates": coordinates,
        "both": lambda points: np.hstack([extract(features, points), coordinates(points)]),
    }
    found = {}
    for rows, noise in (("exact", None), ("default", DEFAULT.calibrated_noise)):
        given = {name: faces_of(trained, name, calibrated=True) for name in ("train", "validation")}
        if noise is not None:
            given = {
                name: draw_detected(faces, noise, np.random.default_rng(number))
                for number, (name, faces) in enumerate(given.items())
            }
        for kind, measure in kinds.items():
            inputs = {name: measure(faces.points) - measure(faces.neutral) for name, faces in given.items()}
            mean, spread = inputs["train"].mean(axis=0), inputs["train"].std(axis=0)
            standard = {name: (values - mean) / np.maximum(spread, 1e-12) for name, values in inputs.items()}
            _, axes = np.linalg.eigh(standard["train"].T @ standard["train"])
            targets = {name: faces.weights[:, OUTPUT_COLUMNS] for name, faces in given.items()}
            centre, scale = targets["train"].mean(axis=0), targets["train"].std(axis=0)
            ridge = fit_ridge(
                standard["train"] @ axes,
                (targets["train"] - centre) / scale,
                standard["validation"] @ axes,
                (targets["validation"] - centre) / scale,
            )
            r2 = []
            for percent in NOISE_PERCENT:
                shown = noisy(faces_of(exact, "test", calibrated=True), percent)
                asked = (measure(shown.points) - measure(shown.neutral) - mean) / np.maximum(spread, 1e-12)
                said = np.clip(asked @ axes @ ridge.coefficients * scale + centre, 0, 1)
                r2.append(float(np.mean([row.r2 for row in score(said, shown.weights[:, OUTPUT_COLUMNS])])))
            found[f"ridge on {kind}, {rows} rows"] = r2
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset")
    parser.add_argument("--faces", type=int, default=20000, help="of all splits together")
    parser.add_argument("--only", default=";".join(VARIANTS), help="variants, joined by semicolons")
    parser.add_argument("--bound", type=float, nargs="*", default=[], help="levels of noise, per cent")
    parser.add_argument(
        "--features", action="store_true", help="compare kinds of features by ridge regression"
    )
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    trained = read_dataset(arguments.dataset)
    exact = read_dataset(arguments.dataset, points="points_2d")
    share = min(1.0, arguments.faces / len(trained.split))
    rows = {name: trained.rows(name) for name in ("train", "validation", "test")}
    kept = np.sort(np.concatenate([numbers[: round(share * len(numbers))] for numbers in rows.values()]))
    trained, exact = trained.take(kept), exact.take(kept)
    found = {}
    if arguments.features:
        for name, r2 in feature_kinds(trained, exact).items():
            found[name] = {
                f"{percent:g} %": {"r2": value} for percent, value in zip(NOISE_PERCENT, r2, strict=True)
            }
            if not arguments.json:
                print(f"{name:<48}", *(f"{value:.3f}" for value in r2), flush=True)
    for percent in arguments.bound:
        everywhere, visible = bound(exact, percent)
        found[f"bound, {percent:g} %"] = {"r2": everywhere, "r2_visible": visible}
        if not arguments.json:
            print(f"bound at {percent:g} %: {everywhere:.3f}/{visible:.3f}", flush=True)
    for name in filter(None, map(str.strip, arguments.only.split(";"))):
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

"""What networks would gain from the noise of the landmarks before them: a trial of inputs that no recipe takes yet.

    python benchmarks/bench_noise_level.py DATASET [--faces 8000] [--networks "eyes.blink;jaw.open"] [--hidden 20]

A displaced face has features that no face has: along axes in which noise moves features by far more than expressions
do, the mean square is the noise itself. Some of the 31 networks are trained beside a neutral frame on the default
recipe's faces, at one L2 strength, with three kinds of inputs:

distances     as the default recipe has them;
noise level   the same and one number, the logarithm of the noise along such axes;
denoised      distances shrunk along each axis as a Wiener filter does for that noise, and the number.

Printed: test R2 on exact points at five levels of noise and with a detector's bias, beside ridge regression on the
first kind's rows; of the blink also what is said of a wink: shut eye, open eye, and either where both are shut.
docs/training.md has a run's table.
"""

import argparse
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from bench_recipes import NOISE_PERCENT, noisy
from threadpoolctl import threadpool_limits

from facegen.conventions import LANDMARK_GROUPS, mirrored_name
from regress.features import Features, depths_of, load_reference_shape, mean_shape
from regress.levenberg_marquardt import Settings, minimise
from regress.networks import Layout, NetworkProblem, Rows, fit_ridge, ridge_directions, ridge_knots
from regress.probes.faces import frontal, read_faces
from regress.probes.winks import SHUT
from regress.targets import NETWORKS, OUTPUTS
from regress.training import RECIPES, read_dataset
from regress.training.noise import displace
from regress.training.preparation import (
    OUTPUT_COLUMNS,
    WIDEST,
    Faces,
    as_detected,
    faces_of,
    mirrored,
    network_columns,
    used_outputs,
)
from regress.training.record import DETECTOR

KEYS = [network.key for network in NETWORKS]
SOME = (
    "eyes.blink",
    "eyes.look_out",
    "mouth.close",
    "mouth.frown",
    "lips.dimple",
    "jaw.sideways",
    "brows.down",
)
ALPHA = 10.0
PROBE = 0.002
"""Noise, outer-eye distances, that shows how noise moves features."""
NOISE_AXES = 32
"""Axes whose mean square is the noise."""
LEAST = 0.0014
"""Noise, outer-eye distances, below which levels are told apart no more: the dataset's own."""


@dataclass(frozen=True, kw_only=True)
class Axes:
    """Directions of features in which noise of unit size has unit variance, from most expression to most noise.

    Parameters
    ----------
    origin : (E,) float64
    there, back : (E, A), (A, E) float64
    signal : (A,) float64
        Variance of undisturbed faces.
    """

    origin: np.ndarray
    there: np.ndarray
    back: np.ndarray
    signal: np.ndarray

    def along(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places along the axes (n, A), and the variance (n, 1) of each face's noise."""
        places = (values - self.origin) @ self.there
        square = np.mean(places[:, -NOISE_AXES:] ** 2, axis=1, keepdims=True)
        return places, np.sqrt(square**2 + LEAST**4)


def axes_of(features: Features, faces: Faces) -> Axes:
    """Axes from faces as the dataset has them, whose own noise is taken off."""
    rng = np.random.default_rng(5)

    def moved(points: np.ndarray) -> np.ndarray:
        return displace(points, PROBE * rng.standard_normal(points.shape))

    clean = faces.features(features)
    disturbed = replace(faces, points=moved(faces.points), neutral=moved(faces.neutral)).features(features)
    values, vectors = np.linalg.eigh(np.cov((disturbed - clean).T) / PROBE**2)
    kept = values > 1e-9 * values[-1]
    white = vectors[:, kept] / np.sqrt(values[kept])
    signal, turned = np.linalg.eigh(white.T @ np.cov(clean.T) @ white)
    there, signal = (white @ turned)[:, ::-1], signal[::-1]
    signal = np.maximum(signal - signal[-NOISE_AXES:].mean(), 0)
    return Axes(origin=clean.mean(axis=0), there=there, back=np.linalg.pinv(there), signal=signal)


def kinds_of(features: Features, axes: Axes) -> dict[str, Callable[[Faces], np.ndarray]]:
    """Inputs (n, D) of faces, by name."""

    def distances(faces: Faces) -> np.ndarray:
        return faces.features(features)

    def levelled(faces: Faces) -> np.ndarray:
        values = distances(faces)
        return np.hstack([values, np.log(axes.along(values)[1])])

    def denoised(faces: Faces) -> np.ndarray:
        places, noise = axes.along(distances(faces))
        return np.hstack([(places * (axes.signal / (axes.signal + noise))) @ axes.back, np.log(noise)])

    return {"distances": distances, "noise level": levelled, "denoised": denoised}


@dataclass(frozen=True, kw_only=True)
class Standard:
    """Inputs and targets z-scored by the training rows, inputs in their principal axes."""

    mean: np.ndarray
    spread: np.ndarray
    rotation: np.ndarray
    target_mean: np.ndarray
    target_spread: np.ndarray

    @classmethod
    def of(cls, inputs: np.ndarray, targets: np.ndarray) -> "Standard":
        mean, spread = inputs.mean(axis=0), np.maximum(inputs.std(axis=0), 1e-12)
        scores = (inputs - mean) / spread
        _, rotation = np.linalg.eigh(scores.T @ scores)
        target_spread = np.maximum(targets.std(axis=0), 1e-12)
        return cls(
            mean=mean,
            spread=spread,
            rotation=rotation[:, ::-1],
            target_mean=targets.mean(axis=0),
            target_spread=target_spread,
        )

    def inputs(self, values: np.ndarray) -> np.ndarray:
        return ((values - self.mean) / self.spread) @ self.rotation

    def targets(self, weights: np.ndarray) -> np.ndarray:
        return (weights - self.target_mean) / self.target_spread

    def weights(self, said: np.ndarray, columns: list[int]) -> np.ndarray:
        return np.clip(said * self.target_spread[columns] + self.target_mean[columns], 0, 1)


def fitted(
    train: tuple[np.ndarray, np.ndarray, np.ndarray],
    held: tuple[np.ndarray, np.ndarray],
    picked: list[int],
    hidden: int,
) -> Callable[[np.ndarray], np.ndarray]:
    """Networks ``picked`` of standardised inputs: what they say (n, O), shape by shape."""
    inputs, targets, exact = train
    layout, columns = Layout(inputs=inputs.shape[1], hidden=hidden, outputs=WIDEST), network_columns()
    few = slice(3000)
    sources = [(inputs[few], targets[few]), (inputs[few][exact[few]], targets[few][exact[few]])]
    directions = [ridge_directions(*source, 3 * ALPHA) for source in sources]
    start = []
    for number in picked:
        shapes = columns[number]
        w1, w2 = ridge_knots(
            layout=layout,
            inputs=inputs[few],
            targets=targets[few][:, shapes],
            directions=np.concatenate([found[:, shapes] for found in directions], axis=1),
            alpha=ALPHA,
            rng=np.random.default_rng([0, number]),
        )
        start.append(layout.join(w1[None], w2[None])[0])

    def rows(values: np.ndarray, wanted: np.ndarray) -> Rows:
        padded = np.zeros((len(picked), WIDEST, len(wanted)), np.float32)
        for row, number in enumerate(picked):
            padded[row, : len(columns[number])] = wanted[:, columns[number]].T
        ones = np.ones((1, len(values)), np.float32)
        return Rows(inputs=np.concatenate([values.T.astype(np.float32), ones]), targets=padded)

    problem = NetworkProblem(
        layout=layout,
        used=used_outputs()[picked],
        train=rows(inputs, targets),
        held_out=(rows(*held),),
    )
    settings = Settings(steps=30, patience=6, improvement=1e-3)
    result = minimise(problem, np.array(start, np.float32), np.full(len(picked), ALPHA), settings)

    def predict(values: np.ndarray) -> np.ndarray:
        given = np.concatenate([values.T.astype(np.float32), np.ones((1, len(values)), np.float32)])
        _, said = problem.forward(result.parameters, np.arange(len(picked)), given)
        return np.concatenate(
            [said[row, : len(columns[number])].T for row, number in enumerate(picked)], axis=1
        )

    return predict


def r2(said: np.ndarray, true: np.ndarray) -> np.ndarray:
    """R2 of each column."""
    return 1 - np.mean((said - true) ** 2, axis=0) / true.var(axis=0)


def mirror_image(faces: Faces) -> Faces:
    points, weights = mirrored(faces.points, faces.weights)
    return Faces(points=points, neutral=mirrored(faces.neutral, weights)[0], weights=weights)


def winking(folder: str) -> dict[str, Faces]:
    """Neutral faces of test people with the lids of one eye, or of both, from a face that shuts both."""
    faces, neutral = read_faces(folder).beside_neutral("test")
    blinks = [OUTPUT_COLUMNS[OUTPUTS.index(f"eyeBlink{side}")] for side in ("Left", "Right")]
    rows = np.flatnonzero(faces.weights[:, blinks].min(axis=1) >= SHUT)
    faces, neutral = faces.take(rows), neutral.take(rows)
    shown = {}
    for name, sides in (("left", ("left",)), ("both", ("left", "right"))):
        points_m = neutral.points_m.copy()
        lids = [landmark for side in sides for landmark in LANDMARK_GROUPS[f"{side}_eye"]]
        points_m[:, lids] = faces.points_m[:, lids]
        shown[name] = Faces(
            points=frontal(points_m, neutral),
            neutral=frontal(neutral.points_m, neutral),
            weights=faces.weights,
        )
    return shown


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset")
    parser.add_argument("--faces", type=int, default=8000, help="of all splits together")
    parser.add_argument("--networks", default=";".join(SOME), help="joined by semicolons")
    parser.add_argument("--hidden", type=int, default=20)
    parser.add_argument("--kinds", default="distances;noise level;denoised", help="joined by semicolons")
    arguments = parser.parse_args()
    picked = [KEYS.index(key.strip()) for key in arguments.networks.split(";")]
    columns = [column for number in picked for column in network_columns()[number]]
    partners = [columns.index(OUTPUTS.index(mirrored_name(OUTPUTS[column]))) for column in columns]
    trained, exact = (read_dataset(arguments.dataset, points=name) for name in ("detected_2d", "points_2d"))
    share = min(1.0, arguments.faces / len(trained.split))
    rows = [trained.rows(split) for split in ("train", "validation", "test")]
    kept = np.sort(np.concatenate([numbers[: round(share * len(numbers))] for numbers in rows]))
    trained, exact = trained.take(kept), exact.take(kept)
    reference = load_reference_shape()
    features = Features(
        alignment="affine",
        mean_shape=mean_shape(trained.points[trained.rows("train")]),
        edges=reference.edges,
        reference_name=reference.name,
        reference_sha256=reference.sha256,
        depth=depths_of(reference),
    )
    noise = RECIPES["default"].calibrated_noise
    clean = faces_of(trained, "train", calibrated=True)
    images = mirror_image(clean)
    clean = Faces(
        points=np.concatenate([clean.points, images.points]),
        neutral=np.concatenate([clean.neutral, images.neutral]),
        weights=np.concatenate([clean.weights, images.weights]),
    )
    train = as_detected(clean, noise, np.random.default_rng([0, 0]))
    held = as_detected(faces_of(trained, "validation", calibrated=True), noise, np.random.default_rng([0, 1]))
    test = faces_of(exact, "test", calibrated=True)
    levels = {f"{percent:g} %": noisy(test, percent) for percent in NOISE_PERCENT}
    levels["detector"] = as_detected(test, DETECTOR, np.random.default_rng(68))
    untouched = (train.points == clean.points).all(axis=(1, 2))
    true = test.weights[:, OUTPUT_COLUMNS][:, columns]
    winks = winking(arguments.dataset) if "eyes.blink" in arguments.networks else {}
    kinds = kinds_of(features, axes_of(features, clean))
    print("| inputs | shape | " + " | ".join(levels) + " |\n|" + "---|" * (len(levels) + 2), flush=True)

    def show(name: str, found: np.ndarray) -> None:
        """Lines of a table of R2 (levels, columns)."""
        for place, column in enumerate(columns):
            if not OUTPUTS[column].endswith("Right"):
                print(
                    f"| {name} | {OUTPUTS[column]} | "
                    + " | ".join(f"{v:.3f}" for v in found[:, place])
                    + " |"
                )
        print(f"| {name} | mean | " + " | ".join(f"{v:.3f}" for v in found.mean(axis=1)) + " |", flush=True)

    for name in map(str.strip, arguments.kinds.split(";")):
        began = time.process_time()
        measure = kinds[name]
        given = measure(train)
        standard = Standard.of(given, train.weights[:, OUTPUT_COLUMNS])
        inputs, targets = standard.inputs(given), standard.targets(train.weights[:, OUTPUT_COLUMNS])
        held_rows = (
            standard.inputs(measure(held)),
            standard.targets(held.weights[:, OUTPUT_COLUMNS]),
        )

        def said(faces: Faces, call: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
            """Weights (n, columns), the mean with the mirrored answer to the mirrored face."""
            own, other = (call(standard.inputs(measure(each))) for each in (faces, mirror_image(faces)))  # noqa: B023
            return standard.weights((own + other[:, partners]) / 2, columns)  # noqa: B023

        with threadpool_limits(limits=1, user_api="blas"):
            if name == "distances":
                ridge = fit_ridge(inputs, targets, *held_rows).coefficients[:, columns]
                found = [r2(said(faces, lambda values: values @ ridge), true) for faces in levels.values()]  # noqa: B023
                show("ridge on distances", np.array(found))
            predict = fitted((inputs, targets, untouched), held_rows, picked, arguments.hidden)
            show(name, np.array([r2(said(faces, predict), true) for faces in levels.values()]))
            if winks:
                blinks = [columns.index(OUTPUTS.index(f"eyeBlink{side}")) for side in ("Left", "Right")]
                shut, leak = said(winks["left"], predict)[:, blinks].mean(axis=0)
                both = said(winks["both"], predict)[:, blinks].mean()
                print(f"{name}: wink, shut eye {shut:.2f}, open eye {leak:.2f}; both shut {both:.2f}")
        print(f"{name}: {time.process_time() - began:.0f} CPU s", flush=True)


if __name__ == "__main__":
    main()

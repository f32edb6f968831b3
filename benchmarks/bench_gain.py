"""Says how far gains of single shapes, found in several ways, bring networks on heads that they never saw.

    python benchmarks/bench_gain.py datasets/out/default --real RECORDINGS --rig ict --seeds 3

Networks that compare with a neutral face learn from each dataset (`calibrated_ablation.py`'s default row). Two takes of
an iPhone's weights are played by people of the rig, with a detector's bias and 1 px of jitter (`replay.py`). Rows are
ways to finish the networks' answers, shape by shape: as they are; stretched as the recipe stretches them; with the gain
and the threshold of the least absolute error on validation people; the mean of all seeds' networks, stretched; and with
the gain and the threshold of the least absolute error *on the takes themselves*, which nobody knows beforehand. That
row is no bound: each shape's error is the least over the frames of both takes together, then both sides get their mean,
and takes and shapes are weighed otherwise where they are judged. Prints Markdown, which stands in
docs/measurements/real-recordings.md.
"""

import argparse
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from calibrated import train_calibrated
from replay import Played, correlation, play

from facegen.conventions import mirrored_name
from facegen.rigs import load_rig
from regress import Model
from regress.learning.training import read_dataset
from regress.learning.training.gain import SEEN, gain_of
from regress.learning.training.preparation import OUTPUT_COLUMNS, Faces, draw_detected, faces_of
from regress.learning.training.recipes import RECIPES
from regress.runtime.features import extract
from regress.runtime.networks import evaluate
from regress.targets import OUTPUTS

GAINS, THRESHOLDS = np.linspace(0, 2.5, 51), np.linspace(0, 0.2, 21)
"""That are tried for each shape."""

NOISE_PX, NOISE_SEED = 1.0, 27
PARTNERS = [OUTPUTS.index(mirrored_name(name)) for name in OUTPUTS]

Finish = Callable[[np.ndarray], np.ndarray]
"""Takes answers (..., 51) about a neutral face's to weights; those beyond 0 and 1 are cut afterwards."""


def main() -> None:
    """Train, judge and print a row for each way to finish."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("datasets", nargs="+", type=Path)
    parser.add_argument("--real", type=Path, required=True, help="folder with livelink/")
    parser.add_argument("--rig", default="ict", help="of those who play the takes")
    parser.add_argument("--people", type=int, default=4)
    parser.add_argument("--step", type=int, default=2, help="take every so many frames of a take")
    parser.add_argument("--seeds", type=int, default=1)
    arguments = parser.parse_args()
    played = play(arguments.real, load_rig(arguments.rig), arguments.people, arguments.step)
    print(
        "| learned from | answers | MAE, shapes that move | MAE, all 51 | median r |\n|---|---|---|---|---|"
    )
    for path in arguments.datasets:
        dataset = read_dataset(path)
        # a share of ridge regression came later, and moves answers by more than any gain
        recipe = replace(RECIPES["default"], calibrated_gain=False, calibrated_linear=0.0)
        models = [train_calibrated(dataset, recipe, seed) for seed in range(arguments.seeds)]
        people = draw_detected(
            faces_of(dataset, "validation", calibrated=True), SEEN, np.random.default_rng(NOISE_SEED)
        )
        for name, cells in rows(models, people, played):
            print(f"| {path.name} | {name} | {' | '.join(cells)} |", flush=True)


def rows(models: list[Model], people: Faces, played: Sequence[Played]) -> list[tuple[str, tuple[str, ...]]]:
    """Every way to finish the first model's answers, and the mean of all models' answers."""
    known = people.weights[:, OUTPUT_COLUMNS]
    validated = [
        about_neutral(model, people.points, extract(model.calibrated.features, people.neutral))
        for model in models
    ]
    answers = [takes_of(models[:1], played), takes_of(models, played)]
    stretch, mean_stretch = (
        gain_of(np.clip(each, 0, 1), known, OUTPUTS) for each in (validated[0], np.mean(validated, axis=0))
    )
    ways: list[tuple[str, list[np.ndarray], Finish]] = [
        ("as they are", answers[0], lambda given: given),
        ("stretched (default)", answers[0], lambda given: given * stretch),
        ("gain and threshold of validation people", answers[0], least_error(validated[0], known)),
        (f"mean of {len(models)} seeds, stretched", answers[1], lambda given: given * mean_stretch),
    ]
    flat = np.concatenate([each.reshape(-1, len(OUTPUTS)) for each in answers[0]])
    true = np.concatenate([np.tile(take.weights[:, OUTPUT_COLUMNS], (len(take.exact), 1)) for take in played])
    ways.append(("gain and threshold of the takes themselves", answers[0], least_error(flat, true)))
    return [(name, judged(given, finish, played)) for name, given, finish in ways]


def about_neutral(model: Model, points: np.ndarray, origin: np.ndarray) -> np.ndarray:
    """Answers (n, 51) to points (n, 68, 2) beside neutral features (E,) or (n, E), less those to neutral itself."""
    features, networks = model.calibrated.features, model.calibrated.networks
    rest = evaluate(networks, np.zeros((1, features.count)))
    return evaluate(networks, extract(features, points) - origin) - rest


def takes_of(models: Sequence[Model], played: Sequence[Played]) -> list[np.ndarray]:
    """Mean answers of models to every take, (people, frames, 51)."""

    def said(model: Model, neutral: np.ndarray, frames: np.ndarray) -> np.ndarray:
        return about_neutral(model, frames, np.median(extract(model.calibrated.features, neutral), axis=0))

    seen = [list(take.seen(NOISE_PX, biased=True)) for take in played]
    return [np.mean([[said(model, *one) for one in people] for model in models], axis=0) for people in seen]


def least_error(answers: np.ndarray, true: np.ndarray) -> Finish:
    """The gain and threshold of each shape with the least absolute error; both sides have the same."""
    best = np.empty((len(OUTPUTS), 2))
    for column in range(len(OUTPUTS)):
        given, wanted = answers[:, column], true[:, column]
        errors = [
            [
                np.abs(np.clip(gain * np.maximum(given - least, 0), 0, 1) - wanted).mean()
                for least in THRESHOLDS
            ]
            for gain in GAINS
        ]
        row, place = np.unravel_index(np.argmin(errors), (len(GAINS), len(THRESHOLDS)))
        best[column] = GAINS[row], THRESHOLDS[place]
    gain, least = ((best + best[PARTNERS]) / 2).T
    return lambda given: gain * np.maximum(given - least, 0)


def judged(answers: Sequence[np.ndarray], finish: Finish, played: Sequence[Played]) -> tuple[str, ...]:
    """Cells, means of the takes: mean absolute errors over shapes that move and over all, and median r."""
    figures = []
    for take, given in zip(played, answers, strict=True):
        said, true = np.clip(finish(given), 0, 1), take.weights[:, OUTPUT_COLUMNS]
        errors = np.abs(said - true).mean(axis=(0, 1))
        moving = [OUTPUTS.index(name) for name in take.moving]
        r = [np.mean([correlation(one[:, column], true[:, column]) for one in said]) for column in moving]
        figures.append((errors[moving].mean(), errors.mean(), np.median(r)))
    moving, everything, r = np.mean(figures, axis=0)
    return f"{moving:.4f}", f"{everything:.4f}", f"{r:.3f}"


if __name__ == "__main__":
    main()

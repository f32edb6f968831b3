"""Scores weights on a benchmark set by its name, with confidence intervals over people.

    python benchmarks/score.py landmarks-2 --data datasets/out/default                      # the set's own rows again
    python benchmarks/score.py landmarks-2 --data datasets/out/default --predictions mine.npy --title mine
    python benchmarks/score.py headset-4 --data datasets/out/headset-arrays --model models/mine

A set is a file of ``benchmarks/sets``: spec, hashes of the data, split, and rows. Data with another hash are refused,
and so are arrays of a headset that hold other frames of the same data. ``--check`` compares the set's own rows with
what is measured, and ends with 1 where a figure differs by more than 0.0015. Some figures have no interval.
Predictions are a NumPy file (n, 52) in `BLENDSHAPES` order, a row for each of the split's faces with an expression, in
the dataset's order. docs/benchmarks.md has the rows.
"""

import argparse
import hashlib
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.documents import load_toml
from regress.errors import InputError
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.evaluation import Condition, estimate
from regress.learning.probes.methods import networks_of, ridges_of
from regress.learning.training import read_dataset
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.noise import displace, draw_displacements
from regress.learning.training.record import DETECTOR
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.model import Model, load_model
from regress.runtime.ready_made import ready_made_models
from regress.targets import OUTPUTS, VISIBLE_SHAPES

SETS = Path(__file__).parent / "sets"
VISIBLE = [BLENDSHAPE_INDEX[name] for name in VISIBLE_SHAPES]
PREDICTED = [BLENDSHAPE_INDEX[name] for name in OUTPUTS]
RESAMPLES = 1000
TOLERANCE = 1.5e-3
"""Of a checked figure: rows have three decimals, and another processor other last bits."""
_NOISE_SEED = 68
_RIDGES = {
    "ridge, undisplaced rows": "ridge regression",
    "ridge, same rows": "ridge regression, the networks' rows",
}
"""What rows call the floors of `ridges_of`."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One method's figures: each a mean and the ends of its 95 % interval.

    Parameters
    ----------
    method, given
        Who says what of which input.
    figures
        By name; three numbers each.
    """

    method: str
    given: str
    figures: dict[str, tuple[float, float, float]]


def interval(per_person: np.ndarray, weight: np.ndarray) -> tuple[float, float, float]:
    """A mean over frames and its 95 % interval, people drawn again with replacement.

    Parameters
    ----------
    per_person, weight
        (p,) mean of each person's frames, and how many they are.
    """
    counts = _draws(len(weight)) * weight
    means = counts @ per_person / counts.sum(axis=1)
    return float(per_person @ weight / weight.sum()), *map(float, np.percentile(means, (2.5, 97.5)))


def r2_interval(predicted: np.ndarray, true: np.ndarray, person: np.ndarray) -> tuple[float, float, float]:
    """Mean R2 of the columns (n, s) that move, and its 95 % interval over people.

    Every draw of people is held against the variance of all: one whose members move little is no worse for it.
    """
    moves = true.var(axis=0) > 0
    predicted, true = predicted[:, moves], true[:, moves]
    _, member = np.unique(person, return_inverse=True)
    groups = member.max() + 1

    def summed(values: np.ndarray) -> np.ndarray:
        total = np.zeros((groups, values.shape[1]))
        np.add.at(total, member, values)
        return total

    frames = np.bincount(member).astype(float)
    error, variance = summed((predicted - true) ** 2), true.var(axis=0)

    def r2(counts: np.ndarray) -> np.ndarray:
        return (1.0 - counts @ error / (counts @ frames)[:, None] / variance).mean(axis=1)

    low, high = np.percentile(r2(_draws(groups)), (2.5, 97.5))
    return float(r2(np.ones((1, groups)))[0]), float(low), float(high)


def _draws(people: int) -> np.ndarray:
    """How often each person is in each of `RESAMPLES` draws (`RESAMPLES`, people)."""
    rng = np.random.Generator(np.random.PCG64(1))
    return rng.multinomial(people, np.full(people, 1.0 / people), RESAMPLES).astype(float)


def by_person(values: np.ndarray, person: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean of each person's values (n,), and how many they are."""
    _, member = np.unique(person, return_inverse=True)
    frames = np.bincount(member).astype(float)
    return np.bincount(member, values) / frames, frames


def score_weights(
    predicted: np.ndarray, true: np.ndarray, person: np.ndarray, columns: list[int] = VISIBLE
) -> dict[str, tuple[float, float, float]]:
    """R2 and mean absolute error of some shapes, of weights (n, 52)."""
    predicted, true = np.clip(predicted, 0, 1)[:, columns], true[:, columns]
    return {
        "r2": r2_interval(predicted, true, person),
        "mae": interval(*by_person(np.abs(predicted - true).mean(axis=1), person)),
    }


def landmark_rows(dataset: KeypointDataset, model: Model, name: str, split: str) -> Iterator[Row]:
    """Rows of a model, of ridge regression and of the mean, on nearly exact points and as a detector puts them.

    Nearly exact are the dataset's own detected points, which its spec jitters by 0.1 % of the face's width.
    """
    neutral = dataset.neutral_rows()
    rows = np.flatnonzero((dataset.split == split) & ~dataset.neutral & (neutral >= 0))
    points, still = dataset.points[rows], dataset.points[neutral[rows]]
    true, person = dataset.weights[rows], dataset.person[rows]
    frame, beside = draw_displacements(DETECTOR, np.random.default_rng(_NOISE_SEED), len(rows))
    seen = {
        "nearly exact points": (points, still),
        "detected points": (displace(points, frame), displace(still, beside)),
    }
    methods = [(name, method) for method in networks_of(model)]
    methods += [(_RIDGES[method.name], method) for method in ridges_of(model, dataset)]
    for title, method in methods:
        for kind, (given, neutral_points) in seen.items():
            predicted = np.zeros((len(rows), len(BLENDSHAPES)))
            predicted[:, PREDICTED] = method.predict(given, neutral_points)
            sees = f"{kind}, with a neutral face" if method.calibrated else kind
            yield Row(method=title, given=sees, figures=score_weights(predicted, true, person))
    mean = dataset.weights[dataset.split == "train"].mean(axis=0)
    yield Row(
        method="training mean",
        given="nothing",
        figures=score_weights(np.broadcast_to(mean, true.shape), true, person),
    )


def headset_rows(folder: Path, model: Path, name: str, split: str) -> Iterator[Row]:
    """Rows of a headset network, of the training mean and of the resting face: millimetres on the face."""
    arrays, predictor = read_arrays(folder), load_headset_predictor(model)
    rows = scored_rows(arrays, split)
    true, person = arrays.weights[rows], arrays.person[rows]

    def row(method: str, given: str, predicted: np.ndarray) -> Row:
        error_mm = arrays.face.error_mm(predicted, true)
        return Row(
            method=method,
            given=given,
            figures={
                "mm": interval(*by_person(error_mm, person)),
                **score_weights(predicted, true, person, PREDICTED),
            },
        )

    for given, calibration in (("pictures", "none"), ("pictures, with a neutral one", "same_seat")):
        said = estimate(predictor.graph, predictor.model, arrays, rows, Condition(calibration=calibration))
        yield row(name, given, said.weights)
    mean = arrays.weights[arrays.split == "train"].mean(axis=0)
    yield row("training mean", "nothing", np.tile(mean, (len(rows), 1)))
    yield row("resting face", "nothing", np.zeros_like(true))


def scored_rows(arrays: HeadsetArrays, split: str) -> np.ndarray:
    """Numbers of a split's rows with an expression."""
    return np.flatnonzero((arrays.split == split) & ~arrays.neutral)


def scored(arrays: HeadsetArrays, split: str) -> dict[str, int | str]:
    """What is scored: its rows, its people, and the SHA-256 of its samples' numbers, people and true weights.

    The dataset's hash is that of all samples which a spec gives, and says nothing of those that were packed.
    """
    rows = scored_rows(arrays, split)
    rows = rows[np.argsort(arrays.sample[rows], kind="stable")]
    digest = hashlib.sha256()
    for values, kind in ((arrays.sample, "<i8"), (arrays.person, "<i8"), (arrays.weights, "<f4")):
        digest.update(np.ascontiguousarray(values[rows], dtype=kind).tobytes())
    return {
        "rows": len(rows),
        "people": len(np.unique(arrays.person[rows])),
        "scored_sha256": digest.hexdigest(),
    }


def measured(name: str, data: Path, model: Path | None, predictions: Path | None, title: str) -> list[Row]:
    """Rows of a set by its name.

    Raises
    ------
    InputError
        The set is unknown, or the data are not the set's.
    """
    benchmark = load_set(name)
    known, called = ready_made_models().get(benchmark["model"]), title if model else benchmark["model"]
    if benchmark["kind"] == "headset":
        arrays = read_arrays(data)
        found = arrays.description.get("dataset_hash", "")
        _check_hash(name, "dataset hash", found, benchmark["dataset_hash"])
        check_scored(name, scored(arrays, benchmark["split"]), benchmark)
        return list(headset_rows(data, model or known, called, benchmark["split"]))
    dataset = read_dataset(data)
    _check_hash(name, "keypoints' SHA-256", dataset.sha256, benchmark["keypoints_sha256"])
    if predictions is None:
        return list(landmark_rows(dataset, load_model(model or known), called, benchmark["split"]))
    rows = np.flatnonzero(
        (dataset.split == benchmark["split"]) & ~dataset.neutral & (dataset.neutral_rows() >= 0)
    )
    weights = np.load(predictions, allow_pickle=False)
    if weights.shape != (len(rows), len(BLENDSHAPES)):
        raise InputError(
            f"{predictions} has the shape {weights.shape}, but must have {(len(rows), len(BLENDSHAPES))}"
        )
    return [
        Row(
            method=title,
            given="",
            figures=score_weights(weights, dataset.weights[rows], dataset.person[rows]),
        )
    ]


def load_set(name: str) -> dict:
    """A set's file; an `InputError` names the sets there are."""
    names = sorted(path.stem for path in SETS.glob("*.toml"))
    if name not in names:
        raise InputError(f"there is no benchmark set {name!r}; there are {', '.join(names)}")
    return load_toml(SETS / f"{name}.toml")


def _check_hash(name: str, what: str, found: str, expected: str) -> None:
    if found != expected:
        raise InputError(
            f"the data's {what} is {found}, and {name} is {expected}; make them from the set's spec"
        )


def check_scored(name: str, found: dict[str, int | str], benchmark: dict) -> None:
    """Refuse other frames than a set's own, where it says which they are."""
    for what in (key for key in found if key in benchmark and benchmark[key] != found[key]):
        raise InputError(
            f"the data's {what} of the split {benchmark['split']} is {found[what]}, and {name} has {benchmark[what]}; "
            "pack all samples of the set's spec"
        )


def differing(rows: list[Row], recorded: list[dict]) -> list[str]:
    """Sentences about recorded rows that are missing or differ."""
    said = {(row.method, row.given): row.figures for row in rows}
    faults = []
    for one in recorded:
        found = said.get((one["method"], one["given"]))
        if found is None:
            faults.append(f"{one['method']}, {one['given']}: not measured")
            continue
        for figure in (key for key in one if key not in ("method", "given")):
            if not np.allclose(found[figure][: len(one[figure])], one[figure], atol=TOLERANCE, rtol=0):
                values = ", ".join(f"{value:.3f}" for value in found[figure])
                faults.append(
                    f"{one['method']}, {one['given']}: {figure} is {values}, recorded {one[figure]}"
                )
    return faults


def main() -> None:
    """Print a table of Markdown; with ``--toml`` rows for the set's file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name", help="benchmark set, a file of benchmarks/sets")
    parser.add_argument("--data", type=Path, required=True, help="dataset, or arrays of a headset's pictures")
    parser.add_argument("--model", type=Path, help="model folder in place of the set's own")
    parser.add_argument("--predictions", type=Path, help=".npy of weights (n, 52), of anybody's method")
    parser.add_argument("--title", default="yours", help="what to call the model or the predictions")
    parser.add_argument("--check", action="store_true", help="compare with the set's own rows")
    parser.add_argument("--toml", action="store_true", help="print rows for the set's file")
    options = parser.parse_args()
    try:
        rows = measured(options.name, options.data, options.model, options.predictions, options.title)
    except InputError as error:
        sys.exit(f"score: {error}")
    figures = list(rows[0].figures)
    if not options.toml:
        print(f"| method | given | {' | '.join(figures)} |\n|---|---|{'---|' * len(figures)}")
    for row in rows:
        if options.toml:
            print(f'[[row]]\nmethod = "{row.method}"\ngiven = "{row.given}"')
            for figure, values in row.figures.items():
                print(f"{figure} = [{', '.join(f'{value:.3f}' for value in values)}]")
        else:
            cells = (f"{mean:.3f} ({low:.3f} to {high:.3f})" for mean, low, high in row.figures.values())
            print(f"| {row.method} | {row.given} | {' | '.join(cells)} |")
    if options.check:
        faults = differing(rows, load_set(options.name)["row"])
        print("\n".join(faults) or "every recorded row is measured again", file=sys.stderr)
        sys.exit(bool(faults))


if __name__ == "__main__":
    main()

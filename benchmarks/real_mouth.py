"""Judges what headset networks tell of a mouth: a tongue from an open jaw, rolled from pressed and from resting lips.

    python benchmarks/real_mouth.py headset-tracking3 --data ARRAYS --real RECORDINGS

On arrays with exact labels: AUC of tongueOut on frames with a tongue against open jaws without one, over all pairs of
frames (with an interval of 95 % over people, drawn anew 500 times) and over pairs of one person's; and AUC of the roll
and of the press, on lips that are rolled, pressed or at rest. Each without and with a neutral picture. A tongue is
parted by how far it is out and by whether the lips let it be seen: a jaw that mouthClose shuts shows nothing.
On real pictures (RECORDINGS/mouth/*.png), which nobody has labelled: what the network says of each, squeezed into its
square and as the largest square of the picture, levelled as `regress headset predict` does. Prints Markdown.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.learning.headset.accuracy import r2_of
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.evaluation import Condition, estimate
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.levels import levels_in

CAMERA = "mouth"
TONGUE, FULLY = 0.3, 0.7
"""tongueOut from which there is a tongue; from the second on it lies on the lower lip, below it stays in the mouth."""
OPEN, GAP, NONE = 0.4, 0.25, 0.02
"""jawOpen of an open mouth (no tongue comes out below it), jawOpen less mouthClose from which lips stand apart, and
tongueOut up to which there is no tongue."""
MOVED, STILL = 0.4, 0.15
"""Weight from which lips are rolled or pressed, and up to which they are not."""
SHOWN = (
    "jawOpen",
    "tongueOut",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthPressLeft",
    "mouthPressRight",
    "mouthClose",
)
SMILES = ("mouthSmileLeft", "mouthSmileRight")
DRAWN = 500


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Two kinds of frames (n,) bool, and the value (n,) that should be higher in the first."""

    what: str
    first: np.ndarray
    second: np.ndarray
    said: np.ndarray


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--data", type=Path, help="Arrays with labels; their test rows count.")
    parser.add_argument("--real", type=Path, help="Folder with mouth/*.png.")
    arguments = parser.parse_args()
    if arguments.data is None and arguments.real is None:
        parser.error("give --data, --real or both")
    predictors = {name: load_headset_predictor(name) for name in arguments.models}
    if arguments.data is not None:
        arrays = read_arrays(arguments.data)
        for name, predictor in predictors.items():
            print(f"\n{name} on {arguments.data.name}\n")
            for line in judged(predictor, arrays):
                print(line)
    if arguments.real is not None:
        print(f"\n| picture | network | view | {' | '.join(SHOWN)} | smile |")
        print("|---" * (len(SHOWN) + 4) + "|")
        for file in sorted((arguments.real / "mouth").glob("*.png")):
            for name, predictor in predictors.items():
                for line in real_rows(name, predictor, file):
                    print(line)


def judged(predictor: HeadsetPredictor, arrays: HeadsetArrays) -> Iterator[str]:
    """A table of a network's AUC, without a neutral picture and with one."""
    rows = np.flatnonzero((arrays.split == "test") & ~arrays.neutral)
    true, person = arrays.weights[rows], arrays.person[rows]
    answers = {"alone": estimate(predictor.graph, predictor.model, arrays, rows, Condition()).weights}
    if predictor.model.calibration != "none":
        compared = Condition(calibration="same_seat")
        answers["calibrated"] = estimate(predictor.graph, predictor.model, arrays, rows, compared).weights
    yield "| given | first against second | frames | people | AUC, 95 % | of one person | said of first, second |"
    yield "|---|---|---|---|---|---|---|"
    for given, said in answers.items():
        for pair in pairs(true, said):
            yield pair_row(given, pair, person)
        for name in ("tongueOut", "mouthRollLower", "mouthRollUpper", "mouthPressLeft", "mouthPressRight"):
            column = BLENDSHAPE_INDEX[name]
            r2 = r2_of(said[:, [column]], true[:, [column]])[0]
            yield f"| {given} | R² of {name} | {len(rows)} | {len(np.unique(person))} | {r2:.3f} | | |"


def pairs(true: np.ndarray, said: np.ndarray) -> Iterator[Pair]:
    """What is told apart, of true and predicted weights (n, 52)."""

    def column(weights: np.ndarray, *names: str) -> np.ndarray:
        return weights[:, [BLENDSHAPE_INDEX[name] for name in names]].max(axis=1)

    tongue, jaw = column(true, "tongueOut"), column(true, "jawOpen")
    apart = jaw - column(true, "mouthClose") >= GAP
    without = (jaw >= OPEN) & (tongue <= NONE) & apart
    out = column(said, "tongueOut")
    for what, first in (
        ("a tongue", tongue >= TONGUE),
        ("a tongue on the lip, lips apart", (tongue >= FULLY) & apart),
        ("a tongue in the mouth, lips apart", (tongue >= TONGUE) & (tongue < FULLY) & apart),
        ("a tongue behind shut lips", (tongue >= TONGUE) & ~apart),
    ):
        yield Pair(what=f"{what} : an open mouth", first=first, second=without, said=out)
    rolls, presses = ("mouthRollLower", "mouthRollUpper"), ("mouthPressLeft", "mouthPressRight")
    roll, press = column(true, *rolls), column(true, *presses)
    rolled, pressed = (roll >= MOVED) & (press <= STILL), (press >= MOVED) & (roll <= STILL)
    neither = (roll <= STILL) & (press <= STILL) & (jaw <= STILL)
    said_roll, said_press = column(said, *rolls), column(said, *presses)
    yield Pair(what="rolled : at rest, by the roll", first=rolled, second=neither, said=said_roll)
    yield Pair(what="pressed : at rest, by the press", first=pressed, second=neither, said=said_press)
    yield Pair(
        what="rolled : pressed, by roll less press", first=rolled, second=pressed, said=said_roll - said_press
    )


def pair_row(given: str, pair: Pair, person: np.ndarray) -> str:
    """A line of the table."""
    first, second = (np.flatnonzero(kind) for kind in (pair.first, pair.second))
    people = np.unique(person[np.concatenate([first, second])])
    cells = [given, pair.what, f"{len(first)}, {len(second)}", str(len(people))]
    if not len(first) or not len(second):
        return f"| {' | '.join([*cells, '', '', ''])} |"
    order = (pair.said[first][:, None] > pair.said[second]) + 0.5 * (
        pair.said[first][:, None] == pair.said[second]
    )
    of_first, of_second = (np.searchsorted(people, person[rows]) for rows in (first, second))
    random = np.random.default_rng(0)
    drawn = []
    for _ in range(DRAWN):
        times = np.bincount(random.integers(0, len(people), len(people)), minlength=len(people))
        weights = times[of_first][:, None] * times[of_second]
        if weights.any():
            drawn.append((order * weights).sum() / weights.sum())
    low, high = np.percentile(drawn, (2.5, 97.5))
    own = of_first[:, None] == of_second
    own_people = len(np.intersect1d(of_first, of_second))
    cells += [
        f"{order.mean():.3f} ({low:.3f}-{high:.3f})",
        "" if not own.any() else f"{order[own].mean():.3f} ({own.sum()} pairs, {own_people} people)",
        f"{np.median(pair.said[first]):.2f}, {np.median(pair.said[second]):.2f}",
    ]
    return f"| {' | '.join(cells)} |"


def real_rows(name: str, predictor: HeadsetPredictor, file: Path) -> Iterator[str]:
    """What a network says of a real picture, in two views of it."""
    picture = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE)
    width, height = predictor.sizes[CAMERA]
    square = CameraPlacement(size=min(1.0, picture.shape[0] / picture.shape[1]))
    for view, seen in (
        ("squeezed", cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA)),
        ("largest square", square.view(picture, width=width, height=height)),
    ):
        if CAMERA in predictor.model.looks:
            seen = levels_in([seen[None]], predictor.model.looks[CAMERA]).apply(seen)
        weights = predictor.predict({CAMERA: seen[None]}).weights[0]
        smile = weights[[BLENDSHAPE_INDEX[one] for one in SMILES]].mean()
        cells = [f"{weights[BLENDSHAPE_INDEX[one]]:.2f}" for one in SHOWN]
        yield f"| {file.stem} | {name} | {view} | {' | '.join(cells)} | {smile:.2f} |"


if __name__ == "__main__":
    main()

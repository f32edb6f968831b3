"""Judges headset networks on headsets that none of them has learned from.

    facegen generate datasets/headset-any-test.toml --out datasets/out/headset-any-test
    facegen pack datasets/out/headset-any-test --format arrays --out datasets/out/headset-any-test-arrays
    python benchmarks/any_headset.py headset-any headset-tracking3 --data datasets/out/headset-any-test-arrays

The data's people wear one of a few drawn headsets (`layout.count` of the spec). A network of drawn headsets is judged
twice: told where each headset's cameras are, and not. Shut eyes are those with a true eyeBlink of .8 and more, resting
ones of .05 and less while the gaze is within 10 degrees of straight ahead; medians, and how many. Openness is the
distance of the lids' middles over the iris's width, in the picture: its r is of traced against true points, over all
frames' eyes. Prints Markdown, which stands in docs/measurements/headset-networks.md.
"""

import argparse
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, VIEW_POINTS
from regress.learning.headset.accuracy import summary
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.evaluation import Condition, estimate
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor

_BLINKS = [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]
SHUT, RESTING = 0.8, 0.05
AHEAD_RAD = np.radians(10.0)
COLUMNS = (
    *("network", "told where cameras are", "mm", "R²", "gaze °", "calibrated mm", "calibrated gaze °"),
    *("eyeBlink, shut eyes", "eyeBlink, resting eyes", "openness r"),
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--data", required=True, type=Path, help="Arrays; their rows of every split count.")
    arguments = parser.parse_args()
    arrays = read_arrays(arguments.data)
    rows = np.flatnonzero(~arrays.neutral)
    layouts = headset_of_rows(arrays, rows)
    print(
        f"{len(rows)} frames of {len(np.unique(arrays.person[rows]))} people, {layouts.max() + 1} headsets\n"
    )
    print(line(COLUMNS) + line(["---"] * len(COLUMNS)), end="")
    errors = {}
    for name in arguments.models:
        predictor = load_headset_predictor(name)
        for told in (False, True) if predictor.model.camera_terms and arrays.camera_terms else (False,):
            said, cells = judged(predictor, arrays, rows, told=told)
            errors[f"{name}, {'told' if told else 'not told'}"] = arrays.face.error_mm(
                said.weights, arrays.weights[rows]
            )
            print(line([name, "yes" if told else "no", *cells]), end="")
    rest = arrays.face.error_mm(np.zeros_like(arrays.weights[rows]), arrays.weights[rows])
    print(line(["resting face", "", f"{rest.mean():.3f}", *[""] * 7]))
    print(line(["headset", "frames", *errors]) + line(["---"] * (2 + len(errors))), end="")
    for layout in range(layouts.max() + 1):
        chosen = layouts == layout
        print(
            line([str(layout), str(chosen.sum()), *(f"{one[chosen].mean():.3f}" for one in errors.values())]),
            end="",
        )


def judged(
    predictor: HeadsetPredictor, arrays: HeadsetArrays, rows: np.ndarray, *, told: bool
) -> tuple[Estimates, list[str]]:
    """What a network says of rows without neutral pictures, and the figures of a line."""
    model, graph = predictor.model, predictor.graph
    true, gaze = arrays.weights[rows], arrays.gaze[rows].reshape(-1, 2, 2)
    said = estimate(graph, model, arrays, rows, Condition(told=told))
    plain = summary(arrays.face, said.weights, said.gaze, true, gaze)
    cells = [f"{plain.geometry_mm:.3f}", f"{plain.r2:.3f}", f"{plain.gaze_deg:.2f}"]
    if model.calibration == "none" or (arrays.neutral_rows()[rows] < 0).any():
        cells += ["", ""]
    else:
        compared = estimate(graph, model, arrays, rows, Condition(calibration="same_seat", told=told))
        near = summary(arrays.face, compared.weights, compared.gaze, true, gaze)
        cells += [f"{near.geometry_mm:.3f}", f"{near.gaze_deg:.2f}"]
    blink, ahead = true[:, _BLINKS], np.abs(gaze).max(axis=2) < AHEAD_RAD
    for eyes in (blink >= SHUT, (blink <= RESTING) & ahead):
        values = said.weights[:, _BLINKS][eyes]
        cells.append(f"{np.median(values):.2f} ({len(values)})" if len(values) else "")
    return said, [*cells, f"{openness_r(predictor, arrays, rows):.3f}"]


def openness_r(predictor: HeadsetPredictor, arrays: HeadsetArrays, rows: np.ndarray) -> float:
    """Correlation of traced openness with the true one, over both eyes of all frames that show it."""
    pairs = []
    for camera in ("left_eye", "right_eye"):
        names = predictor.model.points[camera]
        points = EyePoints.of(predictor, camera)
        traced = predictor.graph.trace({camera: arrays.pictures[camera][rows]})[camera]
        shown = arrays.points[camera][rows][:, [VIEW_POINTS.index(name) for name in names]]
        pairs += [np.stack([openness(traced, points), openness(shown.astype(np.float64), points)])]
    found, true = np.concatenate(pairs, axis=1)
    there = np.isfinite(true) & np.isfinite(found)
    return float(np.corrcoef(found[there], true[there])[0, 1])


def openness(points: np.ndarray, eye: EyePoints) -> np.ndarray:
    """(n,) distance of the lids' middles over the iris's width, of points (n, P, 2)."""
    apart = np.linalg.norm(points[:, eye.upper].mean(axis=1) - points[:, eye.lower].mean(axis=1), axis=1)
    iris = points[:, eye.iris]
    opposite = np.linalg.norm(iris - np.roll(iris, iris.shape[1] // 2, axis=1), axis=2)
    return apart / opposite.max(axis=1)


def headset_of_rows(arrays: HeadsetArrays, rows: np.ndarray) -> np.ndarray:
    """(n,) number of each row's headset: those of one layout differ by a unit's tolerances alone."""
    terms = np.concatenate([terms[rows] for terms in arrays.camera_terms.values()], axis=1)
    middles: list[np.ndarray] = []
    numbers = []
    for one in terms:
        near = [np.abs(one - middle).max() < 0.05 for middle in middles]
        if not any(near):
            middles.append(one)
            near.append(True)
        numbers.append(near.index(True))
    return np.array(numbers)


def line(cells: list[str] | tuple[str, ...]) -> str:
    return f"| {' | '.join(cells)} |\n"


if __name__ == "__main__":
    main()

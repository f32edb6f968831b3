"""Measures the gaze that an eye's traced points give, beside the network's direct answer, on clips of unseen people.

    python benchmarks/traced_gaze.py headset-tracking3 --data datasets/out/headset-clips-arrays

Each person's clip counts by itself. Targets are frames of it, evenly spread over the order of their yaw, with their
true gaze. Errors are angles between directions, of all its frames with an eye less than half shut which are a target of
no column: those were fitted. The last row is what `predict --eyes` gives.
Prints Markdown, which stands in docs/measurements/headset-networks.md.
"""

import argparse
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.learning.headset.accuracy import gaze_error_deg
from regress.learning.headset.arrays import read_arrays
from regress.runtime.headset.answers.traced_eyes import eye_features
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.eyes.own_gaze import corrected, fused
from regress.runtime.headset.network.predictor import load_headset_predictor

TARGETS = (0, 1, 5, 9)
FEWEST_JUDGED = 9
"""Frames of an eye that are no targets."""


def targets_of(open_rows: np.ndarray, yaw: np.ndarray) -> tuple[dict[int, np.ndarray], np.ndarray]:
    """By their count the rows of targets, spread over the order of yaw (k,) of ``open_rows`` (k,); all other rows."""
    order = open_rows[np.argsort(yaw)]
    seen = {
        count: order[np.linspace(0, len(order) - 1, count + 2).round().astype(int)[1:-1]] for count in TARGETS
    }
    return seen, np.setdiff1d(open_rows, np.concatenate(list(seen.values())))


def off_deg(said_deg: np.ndarray, true_deg: np.ndarray) -> float:
    """Mean angle between directions of one eye (n, 2), yaw and pitch in degrees."""
    return float(gaze_error_deg(np.radians(said_deg)[:, None], np.radians(true_deg)[:, None]).mean())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model")
    parser.add_argument("--data", required=True, type=Path)
    arguments = parser.parse_args()
    predictor, arrays = load_headset_predictor(arguments.model), read_arrays(arguments.data)
    errors: dict[tuple[str, int], list[float]] = {}
    for person in np.unique(arrays.person):
        rows = np.flatnonzero(arrays.person == person)
        estimates, traced = predictor.graph.see(
            {name: arrays.pictures[name][rows] for name in predictor.sizes}
        )
        for side, (camera, blink) in enumerate(
            (("left_eye", "eyeBlinkLeft"), ("right_eye", "eyeBlinkRight"))
        ):
            eye, looks = EyePoints.of(predictor, camera), predictor.model.looks[camera]
            pupil, _ = eye_features(traced[camera].astype(np.float64), eye)
            says = {
                "traced points": np.column_stack([pupil, np.ones(len(pupil))]) @ np.array(looks.gaze).T,
                "direct answer": np.degrees(estimates.gaze[:, side]).astype(np.float64),
            }
            true = np.degrees(arrays.gaze[rows, 2 * side : 2 * side + 2]).astype(np.float64)
            open_ = arrays.weights[rows, BLENDSHAPE_INDEX[blink]] < 0.5
            targets, judged = targets_of(np.flatnonzero(open_), true[open_, 0])
            if len(judged) < FEWEST_JUDGED:
                continue
            for count, seen in targets.items():
                answers = {
                    what: corrected(gaze, gaze[seen], true[seen]) if count else gaze
                    for what, gaze in says.items()
                }
                answers["both, fused"] = fused(list(says.values()), seen.tolist(), true[seen])
                for what, gaze in answers.items():
                    errors.setdefault((what, count), []).append(off_deg(gaze[judged], true[judged]))
    print("| gaze from | " + " | ".join(f"{count} targets" for count in TARGETS) + " |")
    print("|---|" + "---|" * len(TARGETS))
    for what in ("traced points", "direct answer", "both, fused"):
        print(f"| {what} | " + " | ".join(f"{np.mean(errors[what, count]):.2f}°" for count in TARGETS) + " |")
    print(f"\n{len(errors['traced points', 0])} eyes of {len(np.unique(arrays.person))} people.")


if __name__ == "__main__":
    main()

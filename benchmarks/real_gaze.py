"""Compares where a network says that film b's eye looks with where a dark blob says its pupil is.

    python -m benchmarks.real_gaze headset-tracking3 headset-any --real RECORDINGS

Nobody has said where the eye of `benchmarks/real_eyes.py`'s film b looks. OpenCV's dark blob finds its pupil without
having learned any; 62 degrees an iris about the blobs' median is where it looks, but for an affine map. Frames count in
which blob and traced pupil lie within .3 of an iris. The film's frames are shown as live ones at 30 a second, four
times over, and the last time counts: what leads is known then. As `predict` has them they are shown twice. Errors are
median and root mean square, in degrees, of each answer through the affine map by all other frames; slopes are those of
yaw and pitch against the blob as they come. Film a tells nothing here: its pictures are cut out anew by each frame.
Prints Markdown, which stands in docs/measurements/headset-networks.md.
"""

import argparse
from pathlib import Path

import numpy as np

from benchmarks.real_eyes import CAMERA, Film, dark_blob, fitted_without, read_film
from regress.runtime.headset.answers.eye_reader import EyeReader
from regress.runtime.headset.answers.traced_eyes import eye_features, iris_diameter
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.eyes.gaze_map import DEGREES_AN_IRIS, gaze_map
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.placing.levels import levels_in
from regress.runtime.headset.placing.placement_search import find_placement
from regress.runtime.stages.frame_clock import USUAL_FPS

ROUNDS = 4
NEAR_IRISES = 0.3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--real", required=True, type=Path, help="Folder with eyes/film_b.")
    arguments = parser.parse_args()
    film = read_film(arguments.real / "eyes" / "film_b")
    print("| network | gaze by | frames | error (median, rms) | slopes (yaw, pitch) |\n|---|---|---|---|---|")
    for model in arguments.models:
        for line in rows(load_headset_predictor(model), film):
            print(f"| {model} | {line} |")


def rows(predictor: HeadsetPredictor, film: Film) -> list[str]:
    """A line of the table for each answer."""
    placed = find_placement(predictor, CAMERA, film.pictures).placement
    width, height = predictor.sizes[CAMERA]
    views = np.stack([placed.view(one, width=width, height=height) for one in film.pictures])
    views = levels_in([views], predictor.model.looks[CAMERA]).apply(views)
    estimates, traced = predictor.see({CAMERA: views})
    points, eye = traced[CAMERA].astype(np.float64), EyePoints.of(predictor, CAMERA)
    matrix = placed.picture_from_view((film.pictures.shape[2], film.pictures.shape[1]), (width, height))
    blobs = np.array([dark_blob(one) for one in film.pictures])
    blobs = (blobs - matrix[:, 2]) @ np.linalg.inv(matrix[:, :2]).T
    iris = iris_diameter(points, eye)
    near = np.linalg.norm(blobs - points[:, eye.pupil], axis=1) < NEAR_IRISES * iris
    true = (blobs - np.median(blobs[near], axis=0)) / iris * [DEGREES_AN_IRIS, -DEGREES_AN_IRIS]
    pupil, _ = eye_features(points, eye)
    answers = {
        "its own answer": np.degrees(estimates.gaze[:, 0].astype(np.float64)),
        "traced points, corners of each frame": np.column_stack([pupil, np.ones(len(pupil))])
        @ gaze_map(predictor, CAMERA).T,
        "what leads, as `predict` says it": led(predictor, points, estimates.gaze, rounds=2),
        "what leads, as `track` says it": led(predictor, points, estimates.gaze, rounds=ROUNDS),
    }
    lines = []
    for what, answer in answers.items():
        off = np.linalg.norm(fitted_without(answer[near], true[near]) - true[near], axis=1)
        slopes = [np.polyfit(true[near, axis], answer[near, axis], 1)[0] for axis in (0, 1)]
        lines.append(
            f"{what} | {near.sum()} | {np.median(off):.1f}°, {np.sqrt((off**2).mean()):.1f}° | "
            f"{slopes[0]:.2f}, {slopes[1]:.2f}"
        )
    return lines


def led(predictor: HeadsetPredictor, points: np.ndarray, gaze_rad: np.ndarray, *, rounds: int) -> np.ndarray:
    """Gaze (n, 2) of the left eye in degrees as live frames have it, the last time round.

    A take's frames are seen twice: what leads over all of them is learnt before the first one counts.
    """
    reader = EyeReader(predictor)
    for _ in range(rounds):
        found = [
            reader.led(1 / USUAL_FPS, {CAMERA: one}, direct.astype(np.float64).ravel())[0]
            for one, direct in zip(points, gaze_rad, strict=True)
        ]
    return np.degrees(np.array(found)[:, :2])


if __name__ == "__main__":
    main()

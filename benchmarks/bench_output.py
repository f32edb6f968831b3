"""Measures the options of `regress predict`: smoothing, averaging with the mirror image, confidence, filling.

    python benchmarks/bench_output.py MODEL DATASET

MODEL is a trained model folder, DATASET the folder it was trained on; test people are judged, by networks that know
their neutral frame unless a table says otherwise. The tables are in docs/measurements/using-a-model.md.

Smoothing: clips of 3 s at 30 frames a second that lead from a person's neutral face to an expression: held still, moved
to in 0.2 s, or come and gone in 0.3 s as a blink is, with normal noise on every coordinate. "Lag" is to 80 % of a
weight above 0.3, "peak" the height of a short one over the undisturbed height.
Filling: points go missing and are put back from the model's mean shape by the affine map that fits the others.
"""

import argparse
import dataclasses
import os
from collections.abc import Callable, Iterator
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, LANDMARK_GROUPS, MIRRORED_BLENDSHAPES, MIRRORED_LANDMARKS
from regress.learning.training import read_dataset
from regress.learning.training.noise import DetectorNoise
from regress.learning.training.preparation import Faces, draw_detected, faces_of
from regress.learning.training.record import DETECTOR
from regress.learning.training.scores import score_faces
from regress.runtime.features import align_similarity
from regress.runtime.inputs import Frames
from regress.runtime.model import Model, load_model, symmetrised
from regress.runtime.networks import evaluate
from regress.runtime.predict import predict_frames
from regress.runtime.stages import confidence
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import Output
from regress.targets import VISIBLE_SHAPES

VISIBLE = [BLENDSHAPE_INDEX[name] for name in VISIBLE_SHAPES]
FPS, FRAMES, CLIPS = 30, 90, 60
TIME_S = np.arange(FRAMES) / FPS
PATHS = {
    "still": np.ones(FRAMES),
    "step": np.clip((TIME_S - 1) / 0.2, 0, 1),
    "short": np.interp(TIME_S, [1.0, 1.1, 1.15, 1.3], [0, 1, 1, 0]),
}


def smoothing(model: Model, faces: Faces) -> Iterator[str]:
    """Jitter of a still face, and what is left of quick moves."""
    rng = np.random.default_rng(0)
    picked = rng.choice(len(faces.points), CLIPS, replace=False)
    mean = model.features.mean_shape
    eyes = np.linalg.norm(mean[45] - mean[36])  # between the outer corners, in face widths
    rest, act = (align_similarity(each[picked], mean) for each in (faces.neutral, faces.points))
    models = [model.calibrate(face[None]) for face in faces.neutral[picked]]
    clips = {
        name: rest[:, None] + path[:, None, None] * (act - rest)[:, None] for name, path in PATHS.items()
    }
    noise = rng.standard_normal(clips["still"].shape) * eyes

    def weights(points: np.ndarray, output: Output) -> np.ndarray:
        takes = [
            Frames(points=clip, labels=tuple(map(str, range(FRAMES))), time_s=TIME_S, source="clip")
            for clip in points
        ]
        return np.array(
            [
                predict_frames(each, take, output=output).weights
                for each, take in zip(models, takes, strict=True)
            ]
        )

    ways = {
        "none": Output(),
        "`--smooth 10` (the paper)": Output(smooth=10),
        "`--one-euro 1`": Output(one_euro=OneEuro()),
        "`--smooth-landmarks 1`": Output(smooth_landmarks_hz=1.0),
        "`--smooth-landmarks 2`": Output(smooth_landmarks_hz=2.0),
        "`--smooth-landmarks 1 --one-euro 1`": Output(smooth_landmarks_hz=1.0, one_euro=OneEuro()),
    }
    true = {name: weights(clip, Output())[..., VISIBLE] for name, clip in clips.items()}
    moved = np.argwhere(true["step"][:, -1] > 0.3)
    yield "| smoothing | jitter at 0.5 % | at 1 % | lag | peak | error of a step | of a short move |"
    yield "|---|---|---|---|---|---|---|"
    for name, output in ways.items():
        still = [
            weights(clips["still"] + share * noise, output)[:, 30:, VISIBLE].std(axis=1).mean()
            for share in (0.005, 0.01)
        ]
        step, short = (
            weights(clips[kind] + 0.005 * noise, output)[..., VISIBLE] for kind in ("step", "short")
        )
        peak = [
            short[clip, 30:45, k].max() / true["short"][clip, :, k].max()
            for clip, k in np.argwhere(true["short"].max(axis=1) > 0.3)
        ]
        lag = [
            _reached(step[clip, :, k], end) - _reached(true["step"][clip, :, k], end)
            for (clip, k), end in zip(moved, true["step"][:, -1][tuple(moved.T)], strict=True)
        ]
        errors = [np.abs(step - true["step"]).mean(), np.abs(short - true["short"]).mean()]
        yield (
            f"| {name} | {still[0]:.4f} | {still[1]:.4f} | {1000 * np.nanmedian(lag):.0f} ms | {np.median(peak):.2f} "
            f"| {errors[0]:.4f} | {errors[1]:.4f} |"
        )


def _reached(curve: np.ndarray, end: float) -> float:
    """Seconds at which a move that starts at 1 s is at 80 % of its end; NaN if never."""
    late = np.flatnonzero((curve >= 0.8 * end) & (TIME_S >= 1 - 1e-9))
    return float(TIME_S[late[0]]) if len(late) else np.nan


def symmetry(model: Model, alone: Faces, faces: Faces) -> Iterator[str]:
    """What averaging with the mirror image brings; nothing to a model that does so by itself."""
    both = symmetrised(model)
    if both is model:
        return
    yield "| points | networks | R² alone | R² averaged | faces mirrored to 0.05, alone | averaged |"
    yield "|---|---|---|---|---|---|"
    for name, detector in (("exact", None), ("as detected", DETECTOR)):
        for kind, given in (("frame alone", alone), ("neutral frame", faces)):
            rng = np.random.default_rng(68)
            judged = given if detector is None else draw_detected(given, detector, rng)
            r2 = [
                np.mean([score_faces(each, judged)[s].r2 for s in VISIBLE_SHAPES]) for each in (model, both)
            ]
            swapped = [np.mean(_unmirrored(each, judged) <= 0.05) for each in (model, both)]
            yield (
                f"| {name} | {kind} | {r2[0]:.3f} | {r2[1]:.3f} | {100 * swapped[0]:.0f} % | {100 * swapped[1]:.0f} % |"
            )


def _unmirrored(model: Model, faces: Faces) -> np.ndarray:
    """Largest difference (n,) over visible shapes between a face's weights and its image's, mirrored back."""

    def image(points: np.ndarray) -> np.ndarray:
        return points[:, list(MIRRORED_LANDMARKS)] * [-1, 1]

    seen = dataclasses.replace(
        faces, points=image(faces.points), neutral=None if faces.neutral is None else image(faces.neutral)
    )
    change = _weights(model, faces) - _weights(model, seen)[:, list(MIRRORED_BLENDSHAPES)]
    return np.abs(change[:, VISIBLE]).max(axis=1)


def _weights(model: Model, faces: Faces) -> np.ndarray:
    networks = model.networks if faces.neutral is None else model.calibrated.networks
    weights = np.zeros((len(faces.points), 52))
    columns = [BLENDSHAPE_INDEX[name] for name in model.outputs]
    weights[:, columns] = np.clip(evaluate(networks, faces.features(model.features)), 0, 1)
    return weights


def trust(model: Model, faces: Faces) -> Iterator[str]:
    """Share of the variance explained against how far features lie from those of the training."""
    calibrated = faces.neutral is not None
    normalisation = model.calibrated.normalisation if calibrated else model.normalisation
    distances, errors = [], []
    for size in (0.0, 0.5, 1.0, 2.0, 3.0):
        noise = DetectorNoise(bias=size, drift=0.3 * size * calibrated, jitter=0.001 * size, clean=0.0)
        judged = draw_detected(faces, noise, np.random.default_rng(1)) if size else faces
        z = (judged.features(model.features) - normalisation.feature_mean) / normalisation.feature_std
        distances.append(np.sqrt(np.mean(z**2, axis=1)))
        missed = (_weights(model, judged) - judged.weights)[:, VISIBLE] ** 2
        errors.append(np.mean(missed / judged.weights[:, VISIBLE].var(axis=0), axis=1))
    distance, error = np.concatenate(distances), np.concatenate(errors)
    best = 1 - error[distance <= 0.75].mean()
    yield f"| distance, {'neutral frame' if calibrated else 'frame alone'} | faces | R² over its best | trust |"
    yield "|---|---|---|---|"
    for low, high in ((0, 0.75), (0.75, 1), (1, 1.25), (1.25, 1.5), (1.5, 1.9), (1.9, 2.5)):
        inside = (distance > low) & (distance <= high)
        expected = confidence.trust(distance[inside], calibrated=calibrated).mean()
        share = (1 - error[inside].mean()) / best
        yield f"| {low} to {high} | {inside.sum()} | {share:.2f} | {expected:.2f} |"


def filling(model: Model, faces: Faces) -> Iterator[str]:
    """R² where missing points are put back from the mean shape."""
    rng = np.random.default_rng(0)
    picked = rng.choice(len(faces.points), 600, replace=False)
    faces = Faces(points=faces.points[picked], neutral=faces.neutral[picked], weights=faces.weights[picked])
    groups: dict[str, Callable[[], list[int]]] = {"none": list}
    for count in (1, 3, 6):
        groups[f"{count} at random"] = lambda count=count: rng.choice(68, count, replace=False).tolist()
    for name in ("right_brow", "right_eye"):
        groups[name.replace("_", " ")] = lambda name=name: list(LANDMARK_GROUPS[name])
    yield "| missing | R² |"
    yield "|---|---|"
    for name, draw in groups.items():
        points = np.array([_filled(face, draw(), model.features.mean_shape) for face in faces.points])
        scores = score_faces(model, dataclasses.replace(faces, points=points))
        yield f"| {name} | {np.mean([scores[shape].r2 for shape in VISIBLE_SHAPES]):.3f} |"


def _filled(face: np.ndarray, missing: list[int], mean_shape: np.ndarray) -> np.ndarray:
    known = np.setdiff1d(np.arange(68), missing)
    mean = np.column_stack([mean_shape, np.ones(68)])
    placed = mean @ np.linalg.lstsq(mean[known], face[known], rcond=None)[0]
    placed[known] = face[known]
    return placed


def main() -> None:
    """Print all tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("dataset", type=Path)
    arguments = parser.parse_args()
    model, dataset = load_model(arguments.model), read_dataset(arguments.dataset)
    alone, faces = (faces_of(dataset, "test", calibrated=calibrated) for calibrated in (False, True))
    for table in (
        smoothing(model, faces),
        symmetry(model, alone, faces),
        trust(model, alone),
        trust(model, faces),
        filling(model, faces),
    ):
        print(*table, "", sep="\n", flush=True)


if __name__ == "__main__":
    main()

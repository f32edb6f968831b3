"""Scores predictions shape by shape."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.errors import InputError
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.noise import DetectorNoise
from regress.learning.training.preparation import Faces, draw_detected, faces_of
from regress.runtime.features import extract
from regress.runtime.model import Model, Scores
from regress.runtime.networks import evaluate

_NOISE_SEED = 68
"""Of displaced test faces."""

_BLOCK_ROWS = 4096
"""Rows predicted at a time: 4096 x 620 hidden units are 20 MB."""


def score(predicted: np.ndarray, true: np.ndarray) -> tuple[Scores, ...]:
    """Scores of every column of two (n, O) arrays of weights."""
    error = predicted - true
    variance = true.var(axis=0)
    spread = predicted.std(axis=0)
    covariance = np.mean((predicted - predicted.mean(axis=0)) * (true - true.mean(axis=0)), axis=0)
    scores = []
    for column in range(true.shape[1]):
        moves = variance[column] > 0
        # A constant prediction has rounding for a spread: below 1e-9 there is nothing to correlate.
        follows = moves and spread[column] > 1e-9
        scores.append(
            Scores(
                r2=float(1 - np.mean(error[:, column] ** 2) / variance[column]) if moves else None,
                mae=float(np.abs(error[:, column]).mean()),
                pearson=float(covariance[column] / (spread[column] * np.sqrt(variance[column])))
                if follows
                else None,
            )
        )
    return tuple(scores)


def evaluate_model(
    model: Model,
    dataset: KeypointDataset,
    *,
    split: str = "test",
    calibrated: bool = False,
    noise: DetectorNoise | None = None,
) -> dict[str, Scores]:
    """Scores of a model's outputs on one split of a dataset, where asked with each person's neutral frame.

    Points are displaced by ``noise``, the same ones for every model, or lie where the dataset has them.

    Raises
    ------
    InputError
        Where no face of the split can be scored, or neutral frames are given to a model without calibrated networks.
    """
    faces = faces_of(dataset, split, calibrated=calibrated)
    if not len(faces.points):
        beside = " beside a neutral frame of its person" if calibrated else ""
        raise InputError(
            f"{dataset.name} has no face in the {split} split{beside}, so there is nothing to score"
        )
    return score_faces(model, faces if noise is None else detected(faces, noise))


def detected(faces: Faces, noise: DetectorNoise) -> Faces:
    """Faces as a detector gives them: every model is judged on the same ones."""
    return draw_detected(faces, noise, np.random.default_rng(_NOISE_SEED))


def score_faces(model: Model, faces: Faces) -> dict[str, Scores]:
    """Scores of a model's outputs on faces, by its calibrated networks where they have neutral frames."""
    columns = [BLENDSHAPE_INDEX[name] for name in model.outputs]
    predicted = predicted_outputs(model, faces.points, faces.neutral)
    return dict(zip(model.outputs, score(predicted, faces.weights[:, columns]), strict=True))


def predicted_outputs(model: Model, points: np.ndarray, neutral: np.ndarray | None = None) -> np.ndarray:
    """A model's weights (n, O) in [0, 1], in its own order, for faces that may each have a neutral frame.

    Parameters
    ----------
    points : (n, 68, 2) float64
    neutral : (n, 68, 2) float64 or None
        A neutral frame of each face's person; where given, the calibrated networks answer.

    Raises
    ------
    InputError
        Where neutral frames are given to a model without calibrated networks.
    """
    if neutral is None:
        return np.clip(model.predict_raw(points), 0, 1)
    if model.calibrated is None:
        raise InputError("the model has no calibrated networks, so neutral frames are of no use to it")
    weights = np.empty((len(points), len(model.outputs)))
    for start in range(0, len(points), _BLOCK_ROWS):
        block = slice(start, start + _BLOCK_ROWS)
        compared = model.calibrated.features
        features = extract(compared, points[block]) - extract(compared, neutral[block])
        weights[block] = np.clip(evaluate(model.calibrated.networks, features), 0, 1)
    return weights


def mean_r2(scores: dict[str, Scores], shapes: tuple[str, ...]) -> float | None:
    """Mean R2 of those shapes that have one."""
    values = [scores[name].r2 for name in shapes if scores[name].r2 is not None]
    return float(np.mean(values)) if values else None

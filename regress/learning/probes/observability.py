"""Measures how much of each shape the 68 points determine at several levels of noise."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regress.learning.probes.faces import ProbeFaces
from regress.learning.probes.methods import Method
from regress.learning.training.noise import displace
from regress.learning.training.preparation import OUTPUT_COLUMNS
from regress.learning.training.scores import score

NOISE_PERCENT = (0.0, 0.1, 0.5, 1.0, 2.0)
"""Standard deviations of normal noise on each coordinate, in per cent of the outer-eye distance."""

_NOISE_SEED = 68


@dataclass(frozen=True, kw_only=True)
class Observability:
    """Test R2 of one method.

    Parameters
    ----------
    method : str
    calibrated : bool
        The neutral frame then has as much noise as the face.
    r2 : (L, O) float64
        By level of noise (``NOISE_PERCENT``) and shape (``OUTPUTS``); NaN where a shape never moves.
    """

    method: str
    calibrated: bool
    r2: np.ndarray


def observability(
    methods: Sequence[Method], faces: ProbeFaces, neutral: ProbeFaces
) -> tuple[Observability, ...]:
    """Ask every method about the same displaced faces, of which ``neutral`` are the people's neutral ones."""
    true = faces.weights[:, OUTPUT_COLUMNS]
    r2: list[list[np.ndarray]] = [[] for _ in methods]
    for level in NOISE_PERCENT:
        # the same directions at each level: curves without chance steps
        rng = np.random.default_rng(_NOISE_SEED)
        shown, beside = (
            displace(points, level / 100 * rng.standard_normal(points.shape))
            for points in (faces.points_px, neutral.points_px)
        )
        for by_level, method in zip(r2, methods, strict=True):
            by_level.append(r2_of(method.predict(shown, beside), true))
    return tuple(
        Observability(method=method.name, calibrated=method.calibrated, r2=np.array(by_level))
        for method, by_level in zip(methods, r2, strict=True)
    )


def r2_of(predicted: np.ndarray, true: np.ndarray) -> np.ndarray:
    """R2 of every column (O,), NaN where the truth does not move."""
    return np.array([np.nan if scores.r2 is None else scores.r2 for scores in score(predicted, true)])

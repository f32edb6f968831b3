"""Picks test faces from well read to badly read, with what networks make of their exact and detected points."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regress.learning.probes.faces import ProbeFaces
from regress.learning.probes.methods import Method
from regress.learning.probes.people import all_weights
from regress.learning.training.noise import displace, draw_displacements
from regress.learning.training.preparation import OUTPUT_COLUMNS
from regress.learning.training.record import DETECTOR
from regress.targets import OUTPUTS, VISIBLE_SHAPES

RANKS = (0.25, 0.5, 0.75, 0.95)
"""Shares of the faces that are read better than the example."""
_SEED = 68
_VISIBLE = [OUTPUTS.index(name) for name in VISIBLE_SHAPES]


@dataclass(frozen=True, kw_only=True, eq=False)
class Reading:
    """What networks say of one face.

    Parameters
    ----------
    detected
        Whether they saw the points as a detector puts them, or exact ones.
    calibrated
        Whether they saw the person's neutral face, put in the same way.
    weights : (52,) float64
        ``BLENDSHAPES`` order.
    mae
        Mean absolute error over the visible shapes.
    """

    detected: bool
    calibrated: bool
    weights: np.ndarray
    mae: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Example:
    """A face and its readings.

    Parameters
    ----------
    person : int
    better : float
        Share of the faces that the networks read better, exact points and a frame alone.
    points : (68, 2) float64
        Exact, pixels, y down.
    true : (52,) float64
    readings : tuple of Reading
    """

    person: int
    better: float
    points: np.ndarray
    true: np.ndarray
    readings: tuple[Reading, ...]


def examples(methods: Sequence[Method], faces: ProbeFaces, neutral: ProbeFaces) -> tuple[Example, ...]:
    """Faces at `RANKS` of the error that the first of the methods makes on exact points."""
    frame, still = draw_displacements(DETECTOR, np.random.default_rng(_SEED), len(faces.person))
    seen = {
        False: (faces.points_px, neutral.points_px),
        True: (displace(faces.points_px, frame), displace(neutral.points_px, still)),
    }
    said = {
        (detected, method.calibrated): method.predict(*points)
        for detected, points in seen.items()
        for method in methods
    }
    true = faces.weights[:, OUTPUT_COLUMNS][:, _VISIBLE]
    errors = {key: np.abs(outputs[:, _VISIBLE] - true).mean(axis=1) for key, outputs in said.items()}
    order = np.argsort(errors[False, methods[0].calibrated], kind="stable")
    rows = [int(order[min(int(rank * len(order)), len(order) - 1)]) for rank in RANKS]
    return tuple(
        Example(
            person=int(faces.person[row]),
            better=rank,
            points=faces.points_px[row],
            true=faces.weights[row],
            readings=tuple(
                Reading(
                    detected=detected,
                    calibrated=calibrated,
                    weights=all_weights(outputs[row]),
                    mae=float(errors[detected, calibrated][row]),
                )
                for (detected, calibrated), outputs in said.items()
            ),
        )
        for rank, row in zip(RANKS, rows, strict=True)
    )

"""Compares two networks on the same frames: which is nearer the truth, how often, and in what."""

from dataclasses import dataclass

import numpy as np

from regress.errors import InputError
from regress.learning.headset.accuracy import share_better
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.evaluation import COMBINED, conditions, estimate
from regress.runtime.headset.network.predictor import HeadsetPredictor


@dataclass(frozen=True, kw_only=True)
class Rivalry:
    """Errors of a network and of a rival on the same frames.

    Parameters
    ----------
    rows
        Frames.
    geometry_mm, rival_mm
        Mean geometry errors.
    better, people
        Shares of frames and of people in which the network is nearer than the rival; ties count half.
    """

    rows: int
    geometry_mm: float
    rival_mm: float
    better: float
    people: float


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """Errors of a network and of a rival.

    Parameters
    ----------
    conditions, combined
        Under each condition that both can be given: of ordinary frames, and of those of the component ``combined``.
    components
        Without calibration, by component.
    """

    conditions: dict[str, Rivalry]
    combined: dict[str, Rivalry]
    components: dict[str, Rivalry]


def compare(
    predictor: HeadsetPredictor, rival: HeadsetPredictor, arrays: HeadsetArrays, *, split: str = "test"
) -> Comparison:
    """Geometry errors of a network and of a rival on a split's frames with an expression.

    Raises
    ------
    InputError
        Where the split has no such frame, or the arrays are of other cameras.
    """
    rows = np.flatnonzero((arrays.split == split) & ~arrays.neutral)
    if not len(rows):
        raise InputError(f"{arrays.folder} has no {split} row with an expression; choose another split")
    shared = conditions(rival.model, arrays, rows)
    both = {name: how for name, how in conditions(predictor.model, arrays, rows).items() if name in shared}
    errors = {
        name: tuple(
            arrays.face.error_mm(
                estimate(one.graph, one.model, arrays, rows, how).weights, arrays.weights[rows]
            )
            for one in (predictor, rival)
        )
        for name, how in both.items()
    }
    component, person = arrays.component[rows], arrays.person[rows]
    combined = component == COMBINED

    def entries(chosen: np.ndarray) -> dict[str, Rivalry]:
        if not chosen.any():
            return {}
        return {
            name: _rivalry(own[chosen], other[chosen], person[chosen])
            for name, (own, other) in errors.items()
        }

    own, other = errors["uncalibrated"]
    return Comparison(
        conditions=entries(~combined),
        combined=entries(combined),
        components={
            str(name): _rivalry(own[component == name], other[component == name], person[component == name])
            for name in np.unique(component)
        },
    )


def _rivalry(own: np.ndarray, other: np.ndarray, person: np.ndarray) -> Rivalry:
    everyone = np.unique(person)
    means = np.array([[error[person == one].mean() for one in everyone] for error in (own, other)])
    return Rivalry(
        rows=len(own),
        geometry_mm=float(own.mean()),
        rival_mm=float(other.mean()),
        better=share_better(own, other),
        people=share_better(*means),
    )

"""Two networks on the same frames: which is nearer the truth, how often, and in what."""

from typing import Any

import numpy as np

from regress.errors import InputError
from regress.learning.headset.accuracy import share_better
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.evaluation import COMBINED, conditions, estimate
from regress.runtime.headset.predictor import HeadsetPredictor


def compare(
    predictor: HeadsetPredictor, rival: HeadsetPredictor, arrays: HeadsetArrays, *, split: str = "test"
) -> dict[str, Any]:
    """Geometry errors of a network and of a rival on a split's frames with an expression, as JSON data.

    Returns
    -------
    dict
        ``conditions``, of ordinary frames, and ``combined``: under each condition that both can be given;
        ``components``: without calibration, by component. Each entry has ``rows``, ``geometry_mm`` and ``rival_mm``,
        ``better``, the share of frames in which the first is nearer (ties count half), and ``people``, the share of
        people for whom it is.

    Raises
    ------
    InputError
        Where the split has no such frame, or the arrays are of other cameras.
    """
    rows = np.flatnonzero((arrays.split == split) & ~arrays.neutral)
    if not len(rows):
        raise InputError(f"the arrays have no {split} row with an expression; choose another split")
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

    def entries(chosen: np.ndarray) -> dict[str, Any]:
        if not chosen.any():
            return {}
        return {
            name: _entry(own[chosen], other[chosen], person[chosen]) for name, (own, other) in errors.items()
        }

    own, other = errors["uncalibrated"]
    return {
        "conditions": entries(~combined),
        "combined": entries(combined),
        "components": {
            str(name): _entry(own[component == name], other[component == name], person[component == name])
            for name in np.unique(component)
        },
    }


def _entry(own: np.ndarray, other: np.ndarray, person: np.ndarray) -> dict[str, Any]:
    everyone = np.unique(person)
    means = np.array([[error[person == one].mean() for one in everyone] for error in (own, other)])
    return {
        "rows": len(own),
        "geometry_mm": float(own.mean()),
        "rival_mm": float(other.mean()),
        "better": share_better(own, other),
        "people": share_better(*means),
    }

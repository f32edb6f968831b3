"""Collects the frames of unseen people with the largest errors, with their pictures."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.evaluation import Condition, estimate
from regress.runtime.headset.network.predictor import HeadsetPredictor

_SHAPES = 3
"""Told of each frame: those whose error moves the face most."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WorstFrame:
    """One frame.

    Parameters
    ----------
    sample, person, component
        Which frame it is.
    geometry_mm
        Mean distance of the face's vertices from their true places.
    pictures
        (h, w) uint8 by camera.
    shapes
        Name, true weight and predicted one of those that err most, by how far they move the face.
    true, predicted
        (52,) all weights, ``BLENDSHAPES`` order.
    """

    sample: int
    person: int
    component: str
    geometry_mm: float
    pictures: dict[str, np.ndarray]
    shapes: tuple[tuple[str, float, float], ...]
    true: np.ndarray
    predicted: np.ndarray


def worst_frames(
    predictor: HeadsetPredictor, arrays: HeadsetArrays, *, split: str = "test", count: int = 8
) -> tuple[WorstFrame, ...]:
    """The frames with the largest error without calibration, one a person, worst first."""
    rows = np.flatnonzero((arrays.split == split) & ~arrays.neutral)
    estimates = estimate(predictor.graph, predictor.model, arrays, rows, Condition())
    errors = arrays.face.error_mm(estimates.weights, arrays.weights[rows])
    reach = np.sqrt(np.diag(arrays.face.gram_mm2()))
    worst: list[WorstFrame] = []
    seen: set[int] = set()
    for place in np.argsort(-errors, kind="stable"):
        row = int(rows[place])
        person = int(arrays.person[row])
        if person in seen or len(worst) == count:
            continue
        seen.add(person)
        true, predicted = arrays.weights[row], estimates.weights[place]
        largest = np.argsort(-np.abs(predicted - true) * reach, kind="stable")[:_SHAPES]
        worst.append(
            WorstFrame(
                sample=int(arrays.sample[row]),
                person=person,
                component=str(arrays.component[row]),
                geometry_mm=float(errors[place]),
                pictures={name: np.array(arrays.pictures[name][row]) for name in predictor.sizes},
                shapes=tuple((BLENDSHAPES[one], float(true[one]), float(predicted[one])) for one in largest),
                true=np.array(true),
                predicted=np.array(predicted),
            )
        )
    return tuple(worst)

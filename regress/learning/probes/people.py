"""Measures error by person, and finds the faces with the largest errors."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.learning.probes.faces import ProbeFaces
from regress.learning.probes.methods import Method
from regress.learning.training.preparation import OUTPUT_COLUMNS
from regress.targets import OUTPUTS, VISIBLE_SHAPES

WORST_FACES = 6
_VISIBLE = [OUTPUTS.index(name) for name in VISIBLE_SHAPES]


@dataclass(frozen=True, kw_only=True)
class WorstFace:
    """A face that a method misreads.

    Parameters
    ----------
    person : int
    mae : float
        Mean absolute error over the visible shapes.
    points : (68, 2) float64
        As the camera sees it, pixels, y down.
    shapes : tuple of (str, float, float)
        The three visible shapes with the largest errors: name, true weight, predicted weight.
    true, predicted : (52,) float64
        All weights, ``BLENDSHAPES`` order; no network predicts ``tongueOut``.
    """

    person: int
    mae: float
    points: np.ndarray
    shapes: tuple[tuple[str, float, float], ...]
    true: np.ndarray
    predicted: np.ndarray


@dataclass(frozen=True, kw_only=True)
class PersonErrors:
    """Errors of one method on exact points, person by person.

    Parameters
    ----------
    method : str
    calibrated : bool
    person : (n,) int64
        People of the test split, the worst first.
    mae : (n,) float64
        Mean absolute error over the visible shapes of the person's faces with an expression.
    worst : tuple of WorstFace
        The worst first, one face a person at most: a face at odds with a network would fill the list.
    """

    method: str
    calibrated: bool
    person: np.ndarray
    mae: np.ndarray
    worst: tuple[WorstFace, ...]


def person_errors(method: Method, faces: ProbeFaces, neutral: ProbeFaces) -> PersonErrors:
    """Errors of a method on faces, of which ``neutral`` are the people's neutral ones."""
    outputs = method.predict(faces.points_px, neutral.points_px)
    predicted = outputs[:, _VISIBLE]
    true = faces.weights[:, OUTPUT_COLUMNS][:, _VISIBLE]
    errors = np.abs(predicted - true)
    of_face = errors.mean(axis=1)
    people, member = np.unique(faces.person, return_inverse=True)
    of_person = np.bincount(member, weights=of_face) / np.bincount(member)
    order = np.argsort(-of_person, kind="stable")
    ranked = np.argsort(-of_face, kind="stable")
    _, first = np.unique(faces.person[ranked], return_index=True)
    worst = []
    for row in ranked[np.sort(first)][:WORST_FACES]:
        largest = np.argsort(-errors[row], kind="stable")[:3]
        worst.append(
            WorstFace(
                person=int(faces.person[row]),
                mae=float(of_face[row]),
                points=faces.points_px[row],
                shapes=tuple(
                    (VISIBLE_SHAPES[shape], float(true[row, shape]), float(predicted[row, shape]))
                    for shape in largest
                ),
                true=faces.weights[row],
                predicted=all_weights(outputs[row]),
            )
        )
    return PersonErrors(
        method=method.name,
        calibrated=method.calibrated,
        person=people[order],
        mae=of_person[order],
        worst=tuple(worst),
    )


def all_weights(outputs: np.ndarray) -> np.ndarray:
    """Weights (52,) of what networks say (O,) of one face; 0 where none says anything."""
    weights = np.zeros(len(BLENDSHAPES))
    weights[OUTPUT_COLUMNS] = outputs
    return weights

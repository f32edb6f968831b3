"""Measures which shape leaks into which: one shape is moved, and all outputs are watched."""

import re
from dataclasses import dataclass

import numpy as np

from regress.learning.probes.faces import ProbeFaces, frontal
from regress.learning.probes.methods import Method
from regress.learning.probes.movements import Movements
from regress.targets import OUTPUTS

WEIGHT = 0.8
"""How far one shape is moved: as far as people go who mean it."""

_ON_TOP = {"mouthClose": "jawOpen"}
"""Shapes that mean nothing by themselves: lips close over an open jaw, with which both faces are compared."""

_PEOPLE = 100


def moved_with(name: str) -> tuple[str, ...]:
    """What moves when a shape does: the shape, and for gaze the other eye's shape of the same direction.

    Nobody looks up with one eye, and a dataset in which nobody does cannot tell the two eyes' parts apart.
    """
    if not name.startswith("eyeLook"):
        return (name,)
    direction, side = re.fullmatch(r"eyeLook(Up|Down|In|Out)(Left|Right)", name).groups()
    other_direction = {"In": "Out", "Out": "In"}.get(direction, direction)
    return (name, f"eyeLook{other_direction}{'Right' if side == 'Left' else 'Left'}")


@dataclass(frozen=True, kw_only=True)
class CrossTalk:
    """Mean change of every output of one method when a single shape moves on frontal neutral faces.

    Parameters
    ----------
    method : str
    calibrated : bool
    change : (O, O) float64
        A row a moved shape (with what :func:`moved_with` says), a column an output; ``WEIGHT`` for what is moved
        and 0 elsewhere would be perfect.
    """

    method: str
    calibrated: bool
    change: np.ndarray

    def largest(self, count: int) -> tuple[tuple[str, str, float], ...]:
        """The largest leaks: the moved shape, the output, its mean change."""
        meant = np.array([[column in moved_with(row) for column in OUTPUTS] for row in OUTPUTS])
        leaks = np.where(meant, 0.0, self.change)
        order = np.argsort(-np.abs(leaks), axis=None, kind="stable")[:count]
        return tuple(
            (OUTPUTS[row], OUTPUTS[column], float(leaks[row, column]))
            for row, column in zip(*np.unravel_index(order, leaks.shape), strict=True)
        )


def cross_talk(method: Method, neutral: ProbeFaces, moves: Movements) -> CrossTalk:
    """Move every shape in turn on at most 100 people, of whom ``neutral`` has one row each."""
    neutral = neutral.some(_PEOPLE)

    def outputs(**weights: float) -> np.ndarray:
        shown = frontal(moves.moved(neutral, **weights), neutral)
        return method.predict(shown, frontal(neutral.points_m, neutral)).mean(axis=0)

    change = []
    for name in OUTPUTS:
        below = {_ON_TOP[name]: WEIGHT} if name in _ON_TOP else {}
        moved = dict.fromkeys(moved_with(name), WEIGHT)
        change.append(outputs(**below, **moved) - outputs(**below))
    return CrossTalk(
        method=method.name,
        calibrated=method.calibrated,
        change=np.array(change),
    )

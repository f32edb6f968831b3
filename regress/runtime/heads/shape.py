"""The shape of heads: the mean face in three dimensions, how faces differ from it, and one person's own."""

import json
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

import numpy as np

from facegen.conventions import DETECTOR_DISAGREEMENT, LANDMARK_GROUPS

_GROUP = {index: group for group, numbers in LANDMARK_GROUPS.items() for index in numbers}

_OUTER_EYES = (36, 45)
"""Their distance is the unit of detectors' disagreement."""

JITTER = 0.01
"""Of a point from frame to frame, in outer-eye distances. Of .003, .01 and .03 all leave the same .45 to .5 degrees."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadShape:
    """Points of a head that hardly move with expressions, and how they vary.

    Parameters
    ----------
    landmarks : (p,) int64
        Which of the 68 they are.
    points : (p, 3) float64
        Head frame, metres.
    modes : (k, p, 3) float64
        Directions in which heads differ, metres a standard deviation: people and expressions, or expressions alone
        where a person's own shape is known.
    uncertainty_m : (p,) float64
        How far each point is seen beside the one that is meant: the standard deviation along x or y.
    """

    landmarks: np.ndarray
    points: np.ndarray
    modes: np.ndarray
    uncertainty_m: np.ndarray

    def laid_upon(self, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The shape seen from the front, moved, rolled and scaled to lie on faces (n, 68, 2).

        Returns
        -------
        middle, scale : (n,) complex128
            Where the head's origin comes to lie, x + iy in pixels; and pixels a metre, times the turn.
        """
        flat = self.points[:, 0] - 1j * self.points[:, 1]  # y of pictures points down
        seen = faces[:, self.landmarks, 0] + 1j * faces[:, self.landmarks, 1]
        about = flat - flat.mean()
        scale = (seen * about.conj()).sum(axis=1) / np.sum(np.abs(about) ** 2)
        return seen.mean(axis=1) - scale * flat.mean(), scale


@cache
def load_head_shape() -> HeadShape:
    """The mean face that comes with the package; points are uncertain by what detectors disagree about.

    Two detectors differ by the root of 2 times what each is beside the point that is meant.
    """
    shipped = _shipped()
    disagreement = [DETECTOR_DISAGREEMENT[_GROUP[index]] for index in shipped["landmarks"]]
    points = np.array(shipped["points"])
    return HeadShape(
        landmarks=np.array(shipped["landmarks"]),
        points=points,
        modes=np.array(shipped["modes"]),
        uncertainty_m=np.array(disagreement) / np.sqrt(2) * _eye_distance_m(points),
    )


def shape_of_person(points: np.ndarray) -> HeadShape:
    """A person's own points (p, 3) as a detector gives them, whose bias is in them: what is left is jitter."""
    shipped = _shipped()
    return HeadShape(
        landmarks=np.array(shipped["landmarks"]),
        points=points,
        modes=np.array(shipped["movements"]),
        uncertainty_m=np.full(len(points), JITTER * _eye_distance_m(points)),
    )


@cache
def _shipped() -> dict[str, Any]:
    return json.loads(resources.files("regress").joinpath("data/head_modes.json").read_text())


def _eye_distance_m(points: np.ndarray) -> float:
    right, left = (points[_shipped()["landmarks"].index(corner)] for corner in _OUTER_EYES)
    return float(np.linalg.norm(left - right))

"""Says what a further label of every sample is: columns of the keypoint shards beside those that all have."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facegen.rigs import EvaluatedFaces, Rig
from facegen.sampling import Samples
from facegen.spec import Spec

KEYPOINT_TOLERANCE_M = 2e-3
"""A face must be this much nearer to hide a landmark. The cage cuts up to 1 mm off the smooth surface between its
vertices (measured on the default rig), and lips and lids that touch lie within another millimetre."""


@dataclass(frozen=True, kw_only=True)
class KeypointColumn:
    """A column of float32: its name, what it says, the shape of a row, and the unit."""

    name: str
    description: str
    shape: tuple[int, ...]
    unit: str


@dataclass(frozen=True, kw_only=True, eq=False)
class FacesInView:
    """n faces before their keypoint cameras: what labels are made from.

    Attributes
    ----------
    rig, samples, faces
        The rig, the drawn rows and the evaluated faces.
    cage
        (n, m, 3) vertices that hide landmarks (`facegen.rigs.occluder`), head frame, metres.
    points_2d
        (n, 68, 2) pixels of the landmarks.
    hidden
        (n, 68) whether the face hides a landmark.
    """

    rig: Rig
    samples: Samples
    faces: EvaluatedFaces
    cage: np.ndarray
    points_2d: np.ndarray
    hidden: np.ndarray


@dataclass(frozen=True, kw_only=True)
class KeypointLabel:
    """A further label: one module, and a line in `facegen.labels.keypoints.KEYPOINT_LABELS`.

    Attributes
    ----------
    columns
        What it adds to a row of the shards and, under the same names, to ``keypoints`` in ``sample.json``.
    asked_for
        Whether a spec asks for it.
    make
        Values (n, ...) by column name.
    """

    columns: tuple[KeypointColumn, ...]
    asked_for: Callable[[Spec], bool]
    make: Callable[[FacesInView], dict[str, np.ndarray]]

"""The outputs of a headset network's graph: one table of names, shapes and meanings, which is also their record.

A new output is one field of `Estimates` and what computes it in ``regress.learning.headset.training.export``. A field
with the default None is an output that older graphs lack.
"""

from dataclasses import dataclass
from typing import Annotated, get_type_hints

import numpy as np

from facegen.conventions import CAMERA_TERMS

CAMERA_INPUT = "cameras"
"""Input of graphs that are told of their cameras: (cameras, 15) float32, zeros by default, the same for all frames."""
TERMS_TOLD = len(CAMERA_TERMS) + 1
"""``CAMERA_TERMS`` of a camera, and 1; zeros where nothing is known."""


@dataclass(frozen=True, kw_only=True)
class GraphOutput:
    """What an output of network.onnx is.

    Parameters
    ----------
    shape
        Of float32 numbers; words stand for the model's own counts: ``n`` frames, cameras, shapes, points.
    meaning
        For people who run the graph by themselves.
    uncalibrated
        Its meaning where the network was trained without neutral pictures; the same by default.
    """

    shape: tuple[str | int, ...]
    meaning: str
    uncalibrated: str | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Estimates:
    """What a network says of n frames, in the graph's order; float32 arrays.

    Parameters
    ----------
    weights : (n, 52)
        In [0, 1], in ``BLENDSHAPES`` order.
    deviation : (n, 52)
        Predicted standard deviation of each weight.
    gaze : (n, 2, 2)
        Yaw and pitch of the left and the right eye's optical axis, radians, head frame.
    shares : (n, cameras, 52)
        How much each camera had to say; they add up to 1 over the cameras.
    same_seat : (n,)
        Probability that the neutral pictures come from the frame's own seat of the headset.
    """

    weights: Annotated[
        np.ndarray,
        GraphOutput(shape=("n", "shapes"), meaning="blendshape weights, 0 to 1, named by shapes"),
    ]
    deviation: Annotated[
        np.ndarray,
        GraphOutput(shape=("n", "shapes"), meaning="predicted standard deviation of each weight"),
    ]
    gaze: Annotated[
        np.ndarray,
        GraphOutput(
            shape=("n", 2, 2),
            meaning="yaw and pitch in radians, left eye first; yaw to the subject's left, pitch upwards",
        ),
    ]
    shares: Annotated[
        np.ndarray,
        GraphOutput(shape=("n", "cameras", "shapes"), meaning="how much each camera had to say"),
    ]
    same_seat: Annotated[
        np.ndarray,
        GraphOutput(
            shape=("n",),
            meaning="probability that picture and neutral picture are of one seat of the headset",
            uncalibrated="means nothing: the network was trained without neutral pictures",
        ),
    ]


GRAPH_OUTPUTS: dict[str, GraphOutput] = {
    name: hint.__metadata__[0] for name, hint in get_type_hints(Estimates, include_extras=True).items()
}
"""By name, in the graph's order; behind them ``points_<camera>`` of each camera that traces points."""

POINTS = GraphOutput(
    shape=("n", "points", 2),
    meaning="pixels of the points named by points, x to the right and y down, 0 in the middle of the first pixel",
)


def points_output(camera: str) -> str:
    """Name of the graph's output that holds a camera's traced points."""
    return f"points_{camera}"

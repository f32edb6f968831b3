"""Says what goes into a headset network's graph and what comes out, and holds graphs and their answers against it."""

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.errors import ModelError
from regress.runtime.headset.network.estimates import (
    CAMERA_INPUT,
    GRAPH_OUTPUTS,
    POINTS,
    TERMS_TOLD,
    points_output,
)
from regress.runtime.headset.network.model import CameraInput

_FRAMES = "n"
"""Stands for the frames in the tables of shapes; a graph may call them otherwise."""

_FLOAT, _BYTE = "tensor(float)", "tensor(uint8)"
"""Types in onnxruntime's words."""


class Value(Protocol):
    """An input or output, as onnxruntime tells of it."""

    name: str
    type: str
    shape: Sequence[int | str | None]


class GraphInterface:
    """Inputs and outputs of a graph, as model.json speaks of them.

    Parameters
    ----------
    cameras
        The model's cameras, in its order.
    points
        By camera what it traces, where the model says so; without, any number of points.
    """

    def __init__(self, cameras: tuple[CameraInput, ...], points: Mapping[str, Sequence[str]]) -> None:
        self._terms = [len(cameras), TERMS_TOLD]
        self._inputs = _input_shapes(cameras)
        self._outputs = _output_shapes(cameras, points)

    def check(self, inputs: Sequence[Value], defaults: Sequence[Value], outputs: Sequence[Value]) -> None:
        """Refuse a graph with other inputs, inputs that have a default, or outputs.

        Raises
        ------
        ModelError
            Names the first that differs, what it is and what it should be.
        """
        self._check_inputs(inputs, defaults)
        for value in outputs:
            shape = self._outputs.get(value.name)
            if shape is not None and (value.type != _FLOAT or not _fits(value.shape, shape)):
                raise ModelError(
                    f"network.onnx has an output {value.name} of {value.type} {value.shape}; model.json makes it "
                    f"{_FLOAT} {shape}"
                )
        given = {value.name for value in outputs}
        lacking = [name for name in GRAPH_OUTPUTS if name not in given]
        if lacking:
            raise ModelError(f"network.onnx has no output {lacking[0]}; a headset network gives it")

    def check_answers(self, answers: Mapping[str, np.ndarray], *, rows: int) -> None:
        """Refuse answers of other shapes than model.json's: what a graph declares it need not keep.

        Raises
        ------
        ModelError
            Names the first that differs.
        """
        for name, answer in answers.items():
            if name not in self._outputs:  # a graph that learning reads has more
                continue
            shape = [rows if side == _FRAMES else side for side in self._outputs[name]]
            if not _fits(answer.shape, shape) or answer.dtype != np.float32:
                raise ModelError(
                    f"network.onnx answers with {name} of {answer.dtype} {list(answer.shape)}; model.json makes it "
                    f"float32 {shape}"
                )

    def _check_inputs(self, inputs: Sequence[Value], defaults: Sequence[Value]) -> None:
        given = {value.name: (value.type, tuple(value.shape)) for value in inputs}
        lost = sorted(self._inputs.keys() - given.keys())
        if lost:
            raise ModelError(f"network.onnx has no input {', '.join(lost)}; model.json names them")
        more = sorted(given.keys() - self._inputs.keys())
        if more:
            raise ModelError(f"network.onnx has an input {more[0][:60]!r}, which model.json does not name")
        for name, (kind, shape) in given.items():
            if kind != self._inputs[name][0] or not _fits(shape, self._inputs[name][1]):
                raise ModelError(
                    f"network.onnx has an input {name} of {kind} {list(shape)}; model.json makes it "
                    f"{' '.join(map(str, self._inputs[name]))}"
                )
        for value in defaults:
            if value.name != CAMERA_INPUT or value.type != _FLOAT or list(value.shape) != self._terms:
                raise ModelError(
                    f"network.onnx has an input {value.name[:60]!r} of {value.type} {value.shape} with a default; "
                    f"{CAMERA_INPUT} of {_FLOAT} {self._terms} alone may have one"
                )


def _input_shapes(cameras: Sequence[CameraInput]) -> dict[str, tuple[str, list[str | int]]]:
    """Type and shape of each input."""
    pictures = {
        f"{kind}_{camera.name}": (_BYTE, [_FRAMES, camera.height, camera.width])
        for camera in cameras
        for kind in ("pictures", "neutral")
    }
    return {**pictures, "present": (_FLOAT, [_FRAMES, len(cameras)]), "calibrated": (_FLOAT, [_FRAMES])}


def _output_shapes(
    cameras: Sequence[CameraInput], points: Mapping[str, Sequence[str]]
) -> dict[str, list[str | int]]:
    """Shape of each output that there may be; words stand for any number."""
    counts = {"cameras": len(cameras), "shapes": len(BLENDSHAPES)}
    shapes = {name: [counts.get(side, side) for side in one.shape] for name, one in GRAPH_OUTPUTS.items()}
    for camera in cameras:
        count = len(points[camera.name]) if camera.name in points else "points"
        shapes[points_output(camera.name)] = [count if side == "points" else side for side in POINTS.shape]
    return shapes


def _fits(shape: Sequence[str | int | None], needed: Sequence[str | int]) -> bool:
    """Whether sides that both know are equal; a graph may leave open how many frames, or how long a side is."""
    return len(shape) == len(needed) and all(
        given == side
        for given, side in zip(shape, needed, strict=True)
        if isinstance(given, int) and isinstance(side, int)
    )

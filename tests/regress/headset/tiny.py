"""A headset model small enough to know what it says: brightness in, weights out; made with onnx alone."""

from functools import cache
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

from facegen.conventions import BLENDSHAPES
from regress.runtime.headset.network.estimates import GRAPH_OUTPUTS
from regress.runtime.headset.network.figures import DeviationFigures, Evaluation, ShapeFigures
from regress.runtime.headset.network.folder import save_headset_model
from regress.runtime.headset.network.model import CameraInput, HeadsetModel, HeadsetTraining
from regress.runtime.headset.network.parts import part_of

NAMES = ("left_eye", "right_eye", "mouth")
OWNER = {shape: next(name for name in NAMES if shape in part_of(name)) for shape in BLENDSHAPES}
"""Camera whose mean brightness, 0 to 1, is the weight."""

COMPUTED = ("weights", "deviation", "gaze", "shares", "same_seat")
"""Outputs of the graph: not all of the table, as in a model that is older than one of them."""

PLAIN, BLIND = 0.1, 0.4
"""Predicted deviation of a shape whose camera is there, and is not."""

R2, RMSE = 0.75, 0.12
"""Of every shape in the test split that the scores speak of; a deviation of PLAIN is below the usual."""


@cache
def tiny_graph(width: int, height: int, gain: float) -> bytes:
    """Weight = gain times the mean of its camera's picture / 255, less the neutral picture's where calibrated.

    Gaze is 0.1, 0.2, 0.3, 0.4 times the left eye's mean; the seat changes where the left eye's mean is a quarter from
    the neutral picture's.
    """
    owners = np.array([[OWNER[shape] == name for shape in BLENDSHAPES] for name in NAMES], dtype=np.float32)
    constants = {
        "scale": np.float32(gain / 255),
        "owners": owners,
        "one": np.float32(1),
        "plain": np.float32(PLAIN),
        "blind": owners * np.float32(BLIND - PLAIN),
        "directions": np.array([[0.1, 0.2, 0.3, 0.4], [0] * 4, [0] * 4], dtype=np.float32),
        "eyes": np.array([-1, 2, 2], dtype=np.int64),
        "each": np.full((1, 1, 52), 1 / 3, dtype=np.float32),
        "last": np.array([2], dtype=np.int64),
        "second": np.array([1], dtype=np.int64),
        "first_column": np.array([0], dtype=np.int64),
        "steep": np.float32(-40),
        "far": np.float32(10),
        "all": np.array([-1], dtype=np.int64),
    }
    nodes = []
    for kind in ("pictures", "neutral"):
        for name in NAMES:
            nodes += [
                helper.make_node("Cast", [f"{kind}_{name}"], [f"{kind}_{name}_f"], to=TensorProto.FLOAT),
                helper.make_node(
                    "ReduceMean", [f"{kind}_{name}_f"], [f"{kind}_{name}_m"], axes=[1, 2], keepdims=0
                ),
                helper.make_node("Unsqueeze", [f"{kind}_{name}_m", "second"], [f"{kind}_{name}_c"]),
            ]
        columns = [f"{kind}_{name}_c" for name in NAMES]
        nodes += [
            helper.make_node("Concat", columns, [f"{kind}_sum"], axis=1),
            helper.make_node("Mul", [f"{kind}_sum", "scale"], [f"{kind}_mean"]),
        ]
    nodes += [
        helper.make_node("Unsqueeze", ["calibrated", "second"], ["calibrated_c"]),
        helper.make_node("Mul", ["neutral_mean", "calibrated_c"], ["origin"]),
        helper.make_node("Sub", ["pictures_mean", "origin"], ["moved"]),
        helper.make_node("Mul", ["moved", "present"], ["seen"]),
        helper.make_node("MatMul", ["seen", "owners"], ["raw"]),
        helper.make_node("Relu", ["raw"], ["weights"]),
        helper.make_node("Sub", ["one", "present"], ["absent"]),
        helper.make_node("MatMul", ["absent", "blind"], ["more"]),
        helper.make_node("Add", ["more", "plain"], ["deviation"]),
        helper.make_node("MatMul", ["seen", "directions"], ["angles"]),
        helper.make_node("Reshape", ["angles", "eyes"], ["gaze"]),
        helper.make_node("Unsqueeze", ["present", "last"], ["present_c"]),
        helper.make_node("Mul", ["present_c", "each"], ["shares"]),
        helper.make_node("Sub", ["pictures_mean", "neutral_mean"], ["change"]),
        helper.make_node("Abs", ["change"], ["size"]),
        helper.make_node("Gather", ["size", "first_column"], ["left"], axis=1),
        helper.make_node("Mul", ["left", "steep"], ["slope"]),
        helper.make_node("Add", ["slope", "far"], ["logit"]),
        helper.make_node("Sigmoid", ["logit"], ["same"]),
        helper.make_node("Reshape", ["same", "all"], ["same_seat"]),
    ]
    pictures = [
        helper.make_tensor_value_info(f"{kind}_{name}", TensorProto.UINT8, ["n", height, width])
        for kind in ("pictures", "neutral")
        for name in NAMES
    ]
    flags = [
        helper.make_tensor_value_info("present", TensorProto.FLOAT, ["n", 3]),
        helper.make_tensor_value_info("calibrated", TensorProto.FLOAT, ["n"]),
    ]
    counts = {"shapes": len(BLENDSHAPES), "cameras": len(NAMES)}
    outputs = [
        helper.make_tensor_value_info(
            name, TensorProto.FLOAT, [counts.get(size, size) for size in output.shape]
        )
        for name, output in GRAPH_OUTPUTS.items()
        if name in COMPUTED
    ]
    initializers = [numpy_helper.from_array(np.asarray(value), name) for name, value in constants.items()]
    graph = helper.make_graph(nodes, "tiny", [*pictures, *flags], outputs, initializers)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 15)], ir_version=8)
    onnx.checker.check_model(model)
    return model.SerializeToString()


def write_tiny_model(
    folder: Path, *, width: int = 16, height: int = 12, gain: float = 1.0, **changes: object
) -> Path:
    """Write the model's folder."""
    cameras = [CameraInput(name=name, width=width, height=height) for name in NAMES]
    alone = {name: {shape: 0.8 if OWNER[shape] == name else 0.1 for shape in BLENDSHAPES} for name in NAMES}
    settings = {
        "headset": "tracking3",
        "cameras": tuple(cameras),
        "parts": {name: part_of(name) for name in NAMES},
        "modulation": 0.3,
        "architecture": "modular",
        "calibration": "optional",
        "outputs": COMPUTED,
        "scores": Evaluation(
            split="test",
            rows=100,
            people=20,
            conditions={},
            combined={},
            floors={},
            shapes={
                shape: {"uncalibrated": ShapeFigures(r2=R2, mae=0.1, rmse=RMSE)} for shape in BLENDSHAPES
            },
            cameras=alone,
            components={},
            people_mm={},
            deviation=DeviationFigures(squared_error_over_variance=1.0, correlation=None),
            seat={},
        ),
        "training": HeadsetTraining(people=20, rows=100, recipe={"epochs": 0}),
        "rig": "anny",
        "dataset_hash": "0" * 64,
        "licences": ("CC0-1.0",),
        **changes,
    }
    save_headset_model(HeadsetModel(**settings), tiny_graph(width, height, gain), folder)
    return folder

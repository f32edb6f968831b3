"""ONNX graphs for onnxruntime, browsers, Unity and Unreal: points in, or features in, avatar weights out.

Opset 15 and IR version 8 are old enough for every runtime named above, and the operators used are plain
ones (`OPERATORS`): small inverses are written out, nothing is scattered, no shape is computed.

float32 stands points far from the origin: the anchors' mean is taken off before anything is multiplied, and
their spread is divided out before anything is squared.
"""

import json

import numpy as np
import onnx
from onnx import TensorProto, helper

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from regress.exporters.formula import Formula
from regress.exporters.onnx_nodes import Nodes, append_features, append_networks
from regress.exporters.onnx_outline import append_face_check

OPSET = 15
IR_VERSION = 8
OPERATORS = frozenset(
    {
        "Add",
        "Clip",
        "Div",
        "Gather",
        "MatMul",
        "Mul",
        "ReduceMean",
        "ReduceSum",
        "Slice",
        "Sqrt",
        "Sub",
        "Tanh",
    }
    | {"Transpose"}
    | {"Abs", "Equal", "Flatten", "ReduceMax", "Where"}
)
"""What a graph may contain: all are in the tables of onnxruntime-web (WASM, WebGPU) and Unity Sentis."""

Sizes = dict[str, list[str | int]]
"""Of a graph's inputs, by name; words stand for any size."""


def export_onnx(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.onnx``; see `build_graph` for what is inside."""
    return {f"{name}.onnx": build_graph(formula).SerializeToString(deterministic=True)}


def export_onnx_networks(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME-networks.onnx``; see `build_networks_graph` for what is inside."""
    return {f"{name}-networks.onnx": build_networks_graph(formula).SerializeToString(deterministic=True)}


def build_graph(formula: Formula) -> onnx.ModelProto:
    """Build the checked ONNX model.

    Parameters
    ----------
    formula : Formula
        What to compute.

    Returns
    -------
    onnx.ModelProto
        Input ``points`` float32 (n, 68, 2), output ``weights`` float32 (n, 52) in the order of the metadata's
        ``names``. Its metadata also holds the dataset's hash, the recipe and the licence. Where the model compares
        faces with a neutral face, input ``neutral`` float32 (n or 1, 68, 2) as well: a row of zeros is none; one
        with a missing point gives NaN, as does one on one line, in a mirror or with y upward.
    """
    whole, alone, calibrated = Nodes(), formula.alone, formula.calibrated
    about = {"names": list(BLENDSHAPES), **formula.about}
    sizes: Sizes = {"points": ["n", LANDMARK_COUNT, 2]}
    part = whole.part() if calibrated is None else whole.part("alone_")
    features = append_features(part, alone.measures, "points", alone.feature_mean)
    append_networks(part, alone, features)
    if calibrated is None:
        return _checked(whole, sizes, about, _DESCRIPTION)
    measured = whole.part("calibrated_")
    frame = append_features(measured, calibrated.measures, "points", calibrated.feature_mean)
    rest = whole.part("neutral_")
    measured_neutral = append_features(rest, calibrated.measures, "neutral", None)
    check = whole.part("check_")
    is_face = check.full(append_face_check(check, "neutral"))
    neutral = rest.node("Mul", [measured_neutral, is_face], "features_of_face")
    differences = measured.node("Sub", [frame, rest.full(neutral)], "differences")
    append_networks(measured, calibrated, differences)
    part.node("ReduceMean", [part.node("Abs", ["neutral"], "sizes")], "row_sizes", axes=[2], keepdims=0)
    _append_choice(whole, "alone_row_sizes")
    sizes["neutral"] = ["n or 1", LANDMARK_COUNT, 2]
    return _checked(whole, sizes, about, f"{_DESCRIPTION} {_NEUTRAL_DESCRIPTION}")


def build_networks_graph(formula: Formula) -> onnx.ModelProto:
    """Build the checked ONNX model of the networks alone, for programs that measure faces themselves.

    Returns
    -------
    onnx.ModelProto
        Input ``features`` float32 (n, E): lengths of the edges after the alignment, over the face's width, or the
        points after it. Output as in `build_graph`. Its metadata also holds, as JSON, what it takes to measure them:
        ``depth``, ``turn``, ``alignment``, ``anchors``, ``reference``, ``edges`` and ``width_landmarks``, as
        `json_text` says. Where the model compares faces with a neutral face, ``calibrated`` there says what it
        takes for that, and the frame's features of this kind are the input ``calibrated_features`` (n, F), the
        neutral face's ``neutral_features`` (n or 1, F), zeros for none.
    """
    whole, alone, calibrated = Nodes(), formula.alone, formula.calibrated
    about = {"names": list(BLENDSHAPES), **formula.about, **alone.measures.as_json()}
    sizes: Sizes = {"features": ["n", alone.measures.count]}
    part = whole.part() if calibrated is None else whole.part("alone_")
    part.constant("feature_mean", alone.feature_mean)
    append_networks(part, alone, part.node("Sub", ["features", "feature_mean"], "features_centred"))
    description = _POINT_NETWORKS_DESCRIPTION if alone.measures.of_points else _NETWORKS_DESCRIPTION
    if calibrated is None:
        return _checked(whole, sizes, about, description)
    measured = whole.part("calibrated_")
    measured.constant("feature_mean", calibrated.feature_mean)
    measured.node("Sub", ["calibrated_features", "neutral_features"], "changes")
    append_networks(measured, calibrated, measured.node("Sub", ["changes", "feature_mean"], "differences"))
    _append_choice(whole, part.full(part.node("Abs", ["neutral_features"], "row_sizes")))
    sizes["calibrated_features"] = ["n", calibrated.measures.count]
    sizes["neutral_features"] = ["n or 1", calibrated.measures.count]
    about["calibrated"] = calibrated.measures.as_json()
    return _checked(whole, sizes, about, f"{description} {_NEUTRAL_DESCRIPTION}")


_DESCRIPTION = "68 iBUG landmarks (x right, y down, any unit) to 52 ARKit blendshape weights."
_NETWORKS_DESCRIPTION = "Edge lengths of an aligned face over its width to 52 ARKit blendshape weights."
_POINT_NETWORKS_DESCRIPTION = "Points of an aligned face to 52 ARKit blendshape weights."
_NEUTRAL_DESCRIPTION = (
    "The neutral face is the same person's by the same detector; zeros where it is not known."
)


def _append_choice(whole: Nodes, sizes: str) -> None:
    """Append the nodes from ``alone_weights`` and ``calibrated_weights`` to ``weights``, by sizes (n or 1, k).

    Where all of a row's are 0 there is no neutral face. NaN is not 0: a missing point gives NaN weights.
    """
    part = whole.part()
    part.constant("no_size", np.array(0.0))
    part.node("ReduceMean", [sizes], "neutral_size", axes=[1], keepdims=1)
    part.node("Equal", ["neutral_size", "no_size"], "without_neutral")
    part.node("Where", ["without_neutral", "alone_weights", "calibrated_weights"], "weights")


def _checked(whole: Nodes, sizes: Sizes, about: dict[str, object], description: str) -> onnx.ModelProto:
    model = helper.make_model(
        helper.make_graph(
            whole.nodes,
            "regress",
            [helper.make_tensor_value_info(name, TensorProto.FLOAT, size) for name, size in sizes.items()],
            [helper.make_tensor_value_info("weights", TensorProto.FLOAT, ["n", len(BLENDSHAPES)])],
            initializer=whole.constants,
        ),
        opset_imports=[helper.make_opsetid("", OPSET)],
        ir_version=IR_VERSION,
        producer_name="regress",
        doc_string=description,
    )
    text = {key: value if isinstance(value, str) else json.dumps(value) for key, value in about.items()}
    helper.set_model_props(model, dict(sorted(text.items())))
    onnx.checker.check_model(model, full_check=True)
    return model

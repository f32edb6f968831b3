"""ONNX graphs for onnxruntime, browsers, Unity and Unreal: points in, or features in, avatar weights out.

Opset 15 and IR version 8 are old enough for every runtime named above, and the dozen operators used are plain
ones (`OPERATORS`): small inverses are written out, nothing is scattered, no shape is computed.

float32 stands points far from the origin: the anchors' mean is taken off before anything is multiplied, and
their spread is divided out before anything is squared.
"""

import json

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from regress.exporters.formula import Formula

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
)
"""What a graph may contain: all are in the tables of onnxruntime-web (WASM, WebGPU) and Unity Sentis."""


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
        ``names``. Its metadata also holds the dataset's hash, the recipe and the licence.
    """
    graph = _Graph()
    _features(graph, formula)
    _networks(graph, formula)
    about = {"names": list(BLENDSHAPES), **formula.about}
    return _checked(graph, ("points", ["n", LANDMARK_COUNT, 2]), about, _DESCRIPTION)


def build_networks_graph(formula: Formula) -> onnx.ModelProto:
    """Build the checked ONNX model of the networks alone, for programs that measure faces themselves.

    Returns
    -------
    onnx.ModelProto
        Input ``features`` float32 (n, E): lengths of the edges after the alignment, over the face's width.
        Output as in `build_graph`. Its metadata also holds, as JSON, what it takes to measure them:
        ``depth``, ``turn``, ``alignment``, ``anchors``, ``reference``, ``edges`` and ``width_landmarks``, as
        `json_text` says.
    """
    graph = _Graph()
    graph.constant("feature_mean", formula.feature_mean)
    graph.node("Sub", ["features", "feature_mean"], "features_centred")
    _networks(graph, formula, features="features_centred")
    about = {"names": list(BLENDSHAPES), **formula.about, **formula.measuring()}
    return _checked(graph, ("features", ["n", len(formula.edges)]), about, _NETWORKS_DESCRIPTION)


_DESCRIPTION = "68 iBUG landmarks (x right, y down, any unit) to 52 ARKit blendshape weights."
_NETWORKS_DESCRIPTION = "Edge lengths of an aligned face over its width to 52 ARKit blendshape weights."


def _checked(
    graph: "_Graph", entry: tuple[str, list[str | int]], about: dict[str, object], description: str
) -> onnx.ModelProto:
    model = helper.make_model(
        helper.make_graph(
            graph.nodes,
            "regress",
            [helper.make_tensor_value_info(entry[0], TensorProto.FLOAT, entry[1])],
            [helper.make_tensor_value_info("weights", TensorProto.FLOAT, ["n", len(BLENDSHAPES)])],
            initializer=graph.constants,
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


class _Graph:
    """Nodes and constants in the order they were asked for, so that equal models are equal bytes."""

    def __init__(self):
        self.nodes: list[onnx.NodeProto] = []
        self.constants: list[onnx.TensorProto] = []

    def constant(self, name: str, value, *, dtype=np.float32) -> str:
        self.constants.append(numpy_helper.from_array(np.ascontiguousarray(value, dtype=dtype), name))
        return name

    def node(self, operator: str, inputs: list[str], output: str, **attributes) -> str:
        self.nodes.append(helper.make_node(operator, inputs, [output], name=output, **attributes))
        return output


def _features(graph: _Graph, formula: Formula) -> None:
    """Append the nodes from ``points`` to ``features`` (n, features)."""
    spans = np.vstack([formula.edges, formula.width_landmarks])
    graph.constant("starts", spans[:, 0], dtype=np.int64)
    graph.constant("ends", spans[:, 1], dtype=np.int64)
    graph.constant("feature_mean", formula.feature_mean)
    for key, value in {
        "zero": 0,
        "edge_count": len(formula.edges),
        "span_count": len(spans),
        "one": 1,
    }.items():
        graph.constant(key, [value], dtype=np.int64)

    points = _undone(graph, formula) if formula.depth.any() else "points"
    graph.node("Gather", [points, "starts"], "start_points", axis=1)
    graph.node("Gather", [points, "ends"], "end_points", axis=1)
    graph.node("Sub", ["end_points", "start_points"], "edges")
    measured = "edges"
    if formula.alignment == "affine":
        _alignment(graph, formula, points)
        graph.node("Div", ["edges", "spread"], "edges_unit")
        measured = graph.node("MatMul", ["edges_unit", "map"], "edges_aligned")
    graph.node("Mul", [measured, measured], "edges_squared")
    graph.constant("last_axis", [2], dtype=np.int64)
    graph.node("ReduceSum", ["edges_squared", "last_axis"], "lengths_squared", keepdims=0)
    graph.node("Sqrt", ["lengths_squared"], "lengths")
    graph.node("Slice", ["lengths", "zero", "edge_count", "one"], "edge_lengths")
    graph.node("Slice", ["lengths", "edge_count", "span_count", "one"], "face_width")
    graph.node("Div", ["edge_lengths", "face_width"], "ratios")
    graph.node("Sub", ["ratios", "feature_mean"], "features")


def _denoised(graph: _Graph, formula: Formula, features: str) -> str:
    """Append the nodes from centred features to what denoising leaves of them; give their name."""
    denoising = formula.denoising
    graph.constant("noise_axes", denoising.noise_axes.T)
    graph.constant("axes", denoising.axes.T)
    graph.constant("surplus", denoising.surplus[:, None])
    for key in ("offset", "signal", "usual", "least"):
        graph.constant(key, getattr(denoising, key))
    graph.node("MatMul", [features, "noise_axes"], "noise_places")
    graph.node("Mul", ["noise_places", "noise_places"], "noise_squares")
    graph.node("ReduceMean", ["noise_squares"], "noise_square", axes=[1], keepdims=1)
    graph.node("MatMul", [features, "axes"], "places")
    graph.node("Mul", ["places", "places"], "squares")
    graph.node("MatMul", ["squares", "surplus"], "surplus_squares")
    graph.node("Sub", ["surplus_squares", "usual"], "surplus_noise")
    # the larger of the two without Max, which not every runtime has
    graph.constant("no_less", np.array(0.0))
    graph.node("Sub", ["noise_square", "surplus_noise"], "noise_beyond")
    graph.node("Clip", ["noise_beyond", "no_less"], "noise_beyond_surplus")
    graph.node("Add", ["surplus_noise", "noise_beyond_surplus"], "larger_noise")
    graph.node("Add", ["larger_noise", "least"], "noise")
    graph.node("Add", ["noise", "signal"], "signal_and_noise")
    graph.node("Div", ["signal", "signal_and_noise"], "gain")
    graph.node("Add", ["places", "offset"], "places_offset")
    return graph.node("Mul", ["places_offset", "gain"], "places_shrunk")


def _undone(graph: _Graph, formula: Formula) -> str:
    """Append the nodes from ``points`` to points without the turn of the head; give their name."""
    graph.constant("depth", formula.depth[:, None])
    graph.constant("turn", formula.turn[None])
    graph.node("ReduceMean", ["points"], "middle", axes=[1], keepdims=1)
    graph.node("Sub", ["points", "middle"], "points_centred")
    graph.node("MatMul", ["turn", "points_centred"], "turned")
    graph.node("Mul", ["depth", "turned"], "moved")
    return graph.node("Sub", ["points_centred", "moved"], "points_put_back")


def _alignment(graph: _Graph, formula: Formula, points: str) -> None:
    """Append the nodes from points (their name) to ``map`` (n, 2, 2) and ``spread`` (n, 1, 1).

    With anchors P and reference R, both about their means, the best linear map is inverse(P'P) P'R. Lengths
    are divided by another length, so adjugate(P'P) P'R does as well, and no determinant is divided by.
    """
    graph.constant("anchors", formula.anchors, dtype=np.int64)
    graph.constant("reference", formula.reference)
    graph.constant("quarter_turn", [[0.0, 1.0], [-1.0, 0.0]])  # J: adjugate(M) = J M J' for symmetric M
    graph.constant("quarter_turn_back", [[0.0, -1.0], [1.0, 0.0]])
    graph.node("Gather", [points, "anchors"], "anchor_points", axis=1)
    graph.node("ReduceMean", ["anchor_points"], "centre", axes=[1], keepdims=1)
    graph.node("Sub", ["anchor_points", "centre"], "centred")
    graph.node("Mul", ["centred", "centred"], "centred_squared")
    graph.node("ReduceMean", ["centred_squared"], "variance", axes=[1, 2], keepdims=1)
    graph.node("Sqrt", ["variance"], "spread")
    graph.node("Div", ["centred", "spread"], "anchors_unit")
    graph.node("Transpose", ["anchors_unit"], "anchors_unit_t", perm=[0, 2, 1])
    graph.node("MatMul", ["anchors_unit_t", "anchors_unit"], "moment")
    graph.node("MatMul", ["anchors_unit_t", "reference"], "cross")
    graph.node("MatMul", ["quarter_turn", "moment"], "moment_turned")
    graph.node("MatMul", ["moment_turned", "quarter_turn_back"], "adjugate")
    graph.node("MatMul", ["adjugate", "cross"], "map")


def _networks(graph: _Graph, formula: Formula, *, features: str = "features") -> None:
    """Append the nodes from centred features to ``weights``: all networks as two matrix products."""
    stacked = formula.stacked()
    graph.constant("hidden_weights", stacked.hidden_weights.T)
    graph.constant("hidden_bias", stacked.hidden_bias)
    graph.constant("output_weights", stacked.output_weights.T)
    graph.constant("output_bias", stacked.output_bias)
    graph.constant("low", np.array(0.0))
    graph.constant("high", np.array(1.0))
    inputs = features if formula.denoising is None else _denoised(graph, formula, features)
    graph.node("MatMul", [inputs, "hidden_weights"], "hidden_sums")
    graph.node("Add", ["hidden_sums", "hidden_bias"], "hidden_biased")
    graph.node("Tanh", ["hidden_biased"], "hidden")
    graph.node("MatMul", ["hidden", "output_weights"], "output_sums")
    graph.node("Add", ["output_sums", "output_bias"], "outputs")
    graph.node("Clip", ["outputs", "low", "high"], "clipped")
    # Runtimes clip NaN as they like. Features are lengths of edges that touch every point, so this is NaN as
    # soon as one point is not finite, and 0 otherwise.
    graph.constant("nothing", np.array(0.0))
    graph.constant("feature_axis", [1], dtype=np.int64)
    graph.node("Mul", [features, "nothing"], "features_unmeasured")
    graph.node("ReduceSum", ["features_unmeasured", "feature_axis"], "missing", keepdims=1)
    graph.node("Add", ["clipped", "missing"], "weights")

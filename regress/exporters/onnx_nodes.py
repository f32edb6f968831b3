"""ONNX nodes from points to features, and from features to weights, written once for each set of networks."""

import numpy as np
import onnx
from onnx import helper, numpy_helper

from regress.exporters.answering import Answering
from regress.exporters.measures import Measures
from regress.runtime.networks import Denoising

_FLAT = 1e-5
"""Determinant of anchors' squares over their trace squared, up to which float32 knows no line from a face: real faces
have 0.1 and more."""


class Nodes:
    """Nodes and constants in the order they were asked for, so that equal models are equal bytes."""

    def __init__(self):
        self.nodes: list[onnx.NodeProto] = []
        self.constants: list[onnx.TensorProto] = []

    def part(self, prefix: str = "") -> "Part":
        """Nodes whose names all begin so."""
        return Part(self, prefix)


class Part:
    """Nodes and constants of one part of a graph; names that it did not make are the graph's own, its inputs."""

    def __init__(self, whole: Nodes, prefix: str):
        self._whole, self._prefix = whole, prefix
        self._own: set[str] = set()

    def constant(self, name: str, value, *, dtype=np.float32) -> str:
        array = np.ascontiguousarray(value, dtype=dtype)
        self._whole.constants.append(numpy_helper.from_array(array, self._prefix + name))
        return self._named(name)

    def node(self, operator: str, inputs: list[str], output: str, **attributes) -> str:
        inputs = [self.full(name) for name in inputs]
        output_name = self._prefix + output
        node = helper.make_node(operator, inputs, [output_name], name=output_name, **attributes)
        self._whole.nodes.append(node)
        return self._named(output)

    def full(self, name: str) -> str:
        """What the graph calls it."""
        return self._prefix + name if name in self._own else name

    def _named(self, name: str) -> str:
        self._own.add(name)
        return name


def append_features(part: Part, measures: Measures, points: str, mean: np.ndarray | None) -> str:
    """Append the nodes from points (their name) to features (n, E) less a mean, if there is one; give their name."""
    if measures.of_points:
        return _laid(part, measures, points, mean)
    spans = np.vstack([measures.edges, measures.width_landmarks])
    part.constant("starts", spans[:, 0], dtype=np.int64)
    part.constant("ends", spans[:, 1], dtype=np.int64)
    if mean is not None:
        part.constant("feature_mean", mean)
    for key, value in {
        "zero": 0,
        "edge_count": len(measures.edges),
        "span_count": len(spans),
        "one": 1,
    }.items():
        part.constant(key, [value], dtype=np.int64)

    points = _undone(part, measures, points) if measures.depth.any() else points
    part.node("Gather", [points, "starts"], "start_points", axis=1)
    part.node("Gather", [points, "ends"], "end_points", axis=1)
    part.node("Sub", ["end_points", "start_points"], "edges")
    measured = "edges"
    if measures.alignment == "affine":
        _alignment(part, measures, points)
        part.node("Div", ["edges", "spread"], "edges_unit")
        measured = part.node("MatMul", ["edges_unit", "map"], "edges_aligned")
    part.node("Mul", [measured, measured], "edges_squared")
    part.constant("last_axis", [2], dtype=np.int64)
    part.node("ReduceSum", ["edges_squared", "last_axis"], "lengths_squared", keepdims=0)
    part.node("Sqrt", ["lengths_squared"], "lengths")
    part.node("Slice", ["lengths", "zero", "edge_count", "one"], "edge_lengths")
    part.node("Slice", ["lengths", "edge_count", "span_count", "one"], "face_width")
    part.node("Div", ["edge_lengths", "face_width"], "ratios")
    return "ratios" if mean is None else part.node("Sub", ["ratios", "feature_mean"], "features")


def _undone(part: Part, measures: Measures, points: str) -> str:
    """Append the nodes from points to points without the turn of the head, about their mean; give their name."""
    part.constant("depth", measures.depth[:, None])
    part.constant("turn", measures.turn[None])
    _about_mean(part, points)
    part.node("MatMul", ["turn", "points_centred"], "turned")
    part.node("Mul", ["depth", "turned"], "moved")
    return part.node("Sub", ["points_centred", "moved"], "points_put_back")


def _about_mean(part: Part, points: str) -> str:
    part.node("ReduceMean", [points], "middle", axes=[1], keepdims=1)
    return part.node("Sub", [points, "middle"], "points_centred")


def _spread(part: Part, measures: Measures, points: str) -> None:
    """Append the nodes from points to ``centre`` of the anchors, their ``spread`` and ``anchors_unit``."""
    part.node("Gather", [points, "anchors"], "anchor_points", axis=1)
    part.node("ReduceMean", ["anchor_points"], "centre", axes=[1], keepdims=1)
    part.node("Sub", ["anchor_points", "centre"], "centred")
    part.node("Mul", ["centred", "centred"], "centred_squared")
    part.node("ReduceMean", ["centred_squared"], "variance", axes=[1, 2], keepdims=1)
    part.node("Sqrt", ["variance"], "spread")
    part.node("Div", ["centred", "spread"], "anchors_unit")


def _alignment(part: Part, measures: Measures, points: str) -> None:
    """Append the nodes from points (their name) to ``map`` (n, 2, 2) and ``spread`` (n, 1, 1).

    With anchors P and reference R, both about their means, the best linear map is inverse(P'P) P'R. Lengths
    are divided by another length, so adjugate(P'P) P'R does as well. Anchors on one line have no such map: 0 / 0
    makes it NaN.
    """
    trace = 2 * len(measures.anchors)  # of P'P, as anchors are divided by their spread
    part.constant("anchors", measures.anchors, dtype=np.int64)
    part.constant("reference", measures.reference)
    part.constant("quarter_turn", [[0.0, 1.0], [-1.0, 0.0]])  # J: adjugate(M) = J M J' for symmetric M
    part.constant("quarter_turn_back", [[0.0, -1.0], [1.0, 0.0]])
    _spread(part, measures, points)
    part.node("Transpose", ["anchors_unit"], "anchors_unit_t", perm=[0, 2, 1])
    part.node("MatMul", ["anchors_unit_t", "anchors_unit"], "moment")
    part.node("MatMul", ["anchors_unit_t", "reference"], "cross")
    part.node("MatMul", ["quarter_turn", "moment"], "moment_turned")
    part.node("MatMul", ["moment_turned", "quarter_turn_back"], "adjugate")
    part.node("MatMul", ["adjugate", "cross"], "map_of_any")
    part.constant("both_axes", [1, 2], dtype=np.int64)
    part.constant("flat", 2 * _FLAT * trace**2)
    part.constant("none", 0.0)
    part.node("Mul", ["moment", "adjugate"], "determinant_parts")
    part.node("ReduceSum", ["determinant_parts", "both_axes"], "determinant_twice", keepdims=1)
    part.node("Sub", ["determinant_twice", "flat"], "determinant_beyond")
    part.node("Clip", ["determinant_beyond", "none"], "width")
    part.node("Div", ["width", "width"], "has_width")
    part.node("Mul", ["map_of_any", "has_width"], "map")


def _laid(part: Part, measures: Measures, points: str, mean: np.ndarray | None) -> str:
    """Append the nodes from points to points (n, 136) turned and scaled, as the anchors say, about their mean.

    Anchors over their spread have squares whose sum is twice their number: the targets are divided by it here.
    """
    squares = 2 * len(measures.anchors)
    part.constant("anchors", measures.anchors, dtype=np.int64)
    part.constant("along", measures.reference / squares)
    part.constant("across", measures.reference[:, ::-1] * [1, -1] / squares)
    part.constant("quarter_turn", [[0.0, 1.0], [-1.0, 0.0]])
    part.constant("both_axes", [1, 2], dtype=np.int64)
    # twice about a mean: the first leaves small numbers, of which float32 knows the second to a digit more
    points = _undone(part, measures, points) if measures.depth.any() else _about_mean(part, points)
    _spread(part, measures, points)
    part.node("Sub", [points, "centre"], "points_about_anchors")
    part.node("Div", ["points_about_anchors", "spread"], "points_unit")
    for factor, target in (("cosine", "along"), ("sine", "across")):
        part.node("Mul", ["anchors_unit", target], f"{factor}_products")
        part.node("ReduceSum", [f"{factor}_products", "both_axes"], factor, keepdims=1)
    part.node("MatMul", ["points_unit", "quarter_turn"], "points_turned")
    part.node("Mul", ["points_unit", "cosine"], "points_by_cosine")
    part.node("Mul", ["points_turned", "sine"], "points_by_sine")
    part.node("Add", ["points_by_cosine", "points_by_sine"], "points_laid")
    laid = part.node("Flatten", ["points_laid"], "places_laid", axis=1)
    if mean is None:
        return laid
    part.constant("feature_mean", mean)
    return part.node("Sub", [laid, "feature_mean"], "features")


def append_networks(part: Part, answering: Answering, features: str) -> str:
    """Append the nodes from centred features to weights, all networks as two matrix products; give their name."""
    stacked = answering.stacked()
    part.constant("hidden_weights", stacked.hidden_weights.T)
    part.constant("hidden_bias", stacked.hidden_bias)
    part.constant("output_weights", stacked.output_weights.T)
    part.constant("output_bias", stacked.output_bias)
    part.constant("low", np.array(0.0))
    part.constant("high", np.array(1.0))
    inputs = features if answering.denoising is None else _denoised(part, answering.denoising, features)
    part.node("MatMul", [inputs, "hidden_weights"], "hidden_sums")
    part.node("Add", ["hidden_sums", "hidden_bias"], "hidden_biased")
    part.node("Tanh", ["hidden_biased"], "hidden")
    part.node("MatMul", ["hidden", "output_weights"], "output_sums")
    part.node("Add", ["output_sums", "output_bias"], "outputs")
    part.node("Clip", ["outputs", "low", "high"], "clipped")
    # Runtimes clip NaN as they like. Features touch every point, so this is NaN as soon as one point is not finite,
    # and 0 otherwise.
    part.constant("nothing", np.array(0.0))
    part.constant("feature_axis", [1], dtype=np.int64)
    part.node("Mul", [features, "nothing"], "features_unmeasured")
    part.node("ReduceSum", ["features_unmeasured", "feature_axis"], "missing", keepdims=1)
    return part.node("Add", ["clipped", "missing"], "weights")


def _denoised(part: Part, denoising: Denoising, features: str) -> str:
    """Append the nodes from centred features to what denoising leaves of them; give their name."""
    part.constant("noise_axes", denoising.noise_axes.T)
    part.constant("axes", denoising.axes.T)
    part.constant("surplus", denoising.surplus[:, None])
    for key in ("offset", "signal", "usual", "least"):
        part.constant(key, getattr(denoising, key))
    part.node("MatMul", [features, "noise_axes"], "noise_places")
    part.node("Mul", ["noise_places", "noise_places"], "noise_squares")
    part.node("ReduceMean", ["noise_squares"], "noise_square", axes=[1], keepdims=1)
    part.node("MatMul", [features, "axes"], "places")
    part.node("Mul", ["places", "places"], "squares")
    part.node("MatMul", ["squares", "surplus"], "surplus_squares")
    part.node("Sub", ["surplus_squares", "usual"], "surplus_noise")
    # the larger of the two without Max, which not every runtime has
    part.constant("no_less", np.array(0.0))
    part.node("Sub", ["noise_square", "surplus_noise"], "noise_beyond")
    part.node("Clip", ["noise_beyond", "no_less"], "noise_beyond_surplus")
    part.node("Add", ["surplus_noise", "noise_beyond_surplus"], "larger_noise")
    part.node("Add", ["larger_noise", "least"], "noise")
    part.node("Add", ["noise", "signal"], "signal_and_noise")
    part.node("Div", ["signal", "signal_and_noise"], "gain")
    part.node("Add", ["places", "offset"], "places_offset")
    return part.node("Mul", ["places_offset", "gain"], "places_shrunk")

"""Evaluates other blends of the cameras: a trained network's modulation and variances, changed in its graph.

    python -m benchmarks.experiments.headset_blend models/headset ARRAYS

The second paper's equation 6 weighs each camera by its inverse variance, and multiplies what lies outside its part by a
factor. Training knows one factor; this evaluates others, and equal variances, without training again. Prints Markdown;
the result stands in docs/measurements/headset-networks.md.
"""

import sys
from pathlib import Path

import numpy as np
import onnx
from onnx import numpy_helper

from regress.learning.headset.accuracy import summary
from regress.learning.headset.arrays import read_arrays
from regress.learning.headset.evaluation import COMBINED, conditions, estimate
from regress.runtime.headset import HeadsetGraph, read_headset_model

FACTORS = (1e-4, 0.03, 0.1, 0.3, 1.0)


def main() -> None:
    """Print the sweep of the model in the first argument on the arrays in the second."""
    folder, arrays = Path(sys.argv[1]), read_arrays(sys.argv[2])
    model = read_headset_model(folder)
    rows = np.flatnonzero((arrays.split == "test") & ~arrays.neutral)
    combined = arrays.component[rows] == COMBINED
    ways, true, gaze = (
        conditions(model, arrays, rows),
        arrays.weights[rows],
        arrays.gaze[rows].reshape(-1, 2, 2),
    )
    columns = (
        ("uncalibrated", ~combined),
        ("same_seat", ~combined),
        ("without_left_eye", ~combined),
        ("uncalibrated", combined),
    )
    graph = onnx.load(str(folder / "network.onnx"))
    place = modulation_of(graph, len(model.cameras), model.modulation)
    trained = numpy_helper.to_array(place)
    print(
        "| variances | modulation | ordinary mm | calibrated mm | left eye lost mm | rare combinations mm "
        "| mean R² | gaze ° |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for variances in ("predicted", "equal"):
        if variances == "equal":
            make_variances_equal(graph)
        for factor in FACTORS:
            changed = np.where(trained == 1, 1, factor).astype(np.float32)
            place.CopyFrom(numpy_helper.from_array(changed, place.name))
            run = HeadsetGraph(graph.SerializeToString(), model.cameras)
            said = {name: estimate(run, model, arrays, rows, ways[name]) for name, _ in columns[:3]}
            shown = [
                summary(arrays.face, said[name].weights[of], said[name].gaze[of], true[of], gaze[of])
                for name, of in columns
            ]
            errors = " | ".join(f"{one.geometry_mm:.3f}" for one in shown)
            print(f"| {variances} | {factor} | {errors} | {shown[0].r2:.3f} | {shown[0].gaze_deg:.2f} |")


def modulation_of(graph: onnx.ModelProto, cameras: int, modulation: float) -> onnx.TensorProto:
    """The graph's tensor of factors: a row a camera, 1 within its part and the trained modulation without."""
    for tensor in graph.graph.initializer:
        values = numpy_helper.to_array(tensor)
        if (
            values.ndim == 2
            and len(values) == cameras
            and set(np.unique(values)) == {1, np.float32(modulation)}
        ):
            return tensor
    raise SystemExit(f"the graph holds no modulation of {modulation}: it is not modular")


def make_variances_equal(graph: onnx.ModelProto) -> None:
    """Let every camera predict the same variance of every output: what is left is the modulation."""
    layers = [tensor for tensor in graph.graph.initializer if ".log_variances." in tensor.name]
    if not layers:
        raise SystemExit("the graph holds no layer of log variances by that name")
    for tensor in layers:
        tensor.CopyFrom(numpy_helper.from_array(np.zeros_like(numpy_helper.to_array(tensor)), tensor.name))


if __name__ == "__main__":
    main()

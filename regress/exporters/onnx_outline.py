"""ONNX nodes that tell a face from points on one line, from a face in a mirror, and from one with y upward."""

import numpy as np

from regress.exporters.onnx_nodes import Part
from regress.exporters.outline import FLAT, LARGEST_AREA, OUTLINE


def append_face_check(part: Part, points: str) -> str:
    """Append the nodes from points (n, 68, 2) to (n, 1): 1 where they are a face, NaN where not; give their name."""
    for key, value in {"outline": OUTLINE, "outline_next": np.roll(OUTLINE, -1)}.items():
        part.constant(key, value, dtype=np.int64)
    for key, value in {"each": [1], "each_axis": [2], "all_axes": [1, 2]}.items():
        part.constant(key, value, dtype=np.int64)
    for key, value in {"least": 0.0, "most_area": LARGEST_AREA, "flatness": FLAT}.items():
        part.constant(key, np.array(value))
    part.constant("exchange", [[0.0, 1.0], [1.0, 0.0]])
    part.constant("quarter", [[0.0, -1.0], [1.0, 0.0]])
    part.node("ReduceMean", [points], "face_middle", axes=[1], keepdims=1)
    part.node("Sub", [points, "face_middle"], "about_middle")
    part.node("ReduceMax", [part.node("Abs", ["about_middle"], "away")], "extent", axes=[1, 2], keepdims=1)
    unit = part.node("Div", ["about_middle", "extent"], "face_unit")
    # twice the area: the sum of x_i y_next - y_i x_next
    part.node("Gather", [unit, "outline"], "corners", axis=1)
    part.node(
        "MatMul", [part.node("Gather", [unit, "outline_next"], "next_corners", axis=1), "quarter"], "across"
    )
    part.node("ReduceSum", [part.node("Mul", ["corners", "across"], "areas"), "all_axes"], "area", keepdims=1)
    upright = _known(part, part.node("Sub", ["most_area", "area"], "area_left"), "upright")
    # xx yy - xy^2 over (xx + yy)^2
    part.node("ReduceSum", [part.node("Mul", [unit, unit], "squares_unit"), "each"], "squares", keepdims=1)
    part.node("Mul", [unit, part.node("MatMul", [unit, "exchange"], "exchanged")], "products_unit")
    part.node("ReduceSum", ["products_unit", "each"], "products", keepdims=1)
    part.node("Mul", ["squares", part.node("MatMul", ["squares", "exchange"], "squares_exchanged")], "both")
    part.node("Sub", ["both", part.node("Mul", ["products", "products"], "products_squared")], "determinants")
    part.node("ReduceSum", ["squares", "each_axis"], "size", keepdims=1)
    part.node("Mul", [part.node("Mul", ["size", "size"], "size_squared"), "flatness"], "flat_determinant")
    part.node("ReduceMean", ["determinants"], "determinant", axes=[2], keepdims=1)
    wide = _known(part, part.node("Sub", ["determinant", "flat_determinant"], "determinant_left"), "wide")
    return part.node("Flatten", [part.node("Mul", [upright, wide], "is_face")], "is_face_row", axis=1)


def _known(part: Part, number: str, output: str) -> str:
    """Append the nodes from a number to 1 where it is above 0, and NaN elsewhere."""
    positive = part.node("Clip", [number, "least"], f"{output}_left")
    return part.node("Div", [positive, positive], output)

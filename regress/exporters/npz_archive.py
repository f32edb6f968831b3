"""A NumPy archive: the formula arrays, for readers who have NumPy and want nothing else.

Points to weights, for ``points`` (n, 68, 2), with ``z = numpy.load(path)``::

    points = points - z["depth"][:, None] * (z["turn"] @ points)[:, None]    # a turn of the head is undone
    a = points[:, z["anchors"]] - points[:, z["anchors"]].mean(1, keepdims=True)
    map = numpy.linalg.inv(a.mT @ a) @ (a.mT @ z["reference"])    # (n, 2, 2); a.mT swaps the last two axes
    map = map if z["alignment"] == "affine" else numpy.eye(2)
    length = lambda i, j: numpy.linalg.norm((points[:, j] - points[:, i]) @ map, axis=-1)
    ratio = length(*z["edges"].T) / length(*z["width_landmarks"])[:, None]
    x = ratio - z["feature_mean"]
    if "axes" in z:    # a model that denoises
        place = x @ z["axes"].T
        measured, surplus = ((x @ z["noise_axes"].T) ** 2).mean(1), place**2 @ z["surplus"] - z["usual"]
        noise = numpy.maximum(measured, surplus)[:, None] + z["least"]
        x = (place + z["offset"]) * (z["signal"] / (z["signal"] + noise))
    hidden = numpy.tanh(x @ z["hidden_weights"].T + z["hidden_bias"])
    weights = numpy.clip(hidden @ z["output_weights"].T + z["output_bias"], *z["weight_range"])  # (n, 52)

``names`` says what the 52 columns are; ``about`` is one JSON text: format version, recipe, dataset hash,
licence. Nothing is pickled.
"""

import io
import json

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.exporters.formula import DENOISING, FORMAT_VERSION, WEIGHT_RANGE, Formula


def export_npz(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.npz``; this module's first lines are its documentation."""
    stacked = formula.stacked()
    content = io.BytesIO()
    kept = () if formula.denoising is None else DENOISING
    np.savez(  # not compressed: weights do not shrink, and zlib's versions differ in bytes
        content,
        about=np.array(json.dumps({"format_version": FORMAT_VERSION, **formula.about}, sort_keys=True)),
        depth=formula.depth.astype(np.float64),
        turn=formula.turn.astype(np.float64),
        alignment=np.array(formula.alignment),
        names=np.array(BLENDSHAPES),
        anchors=formula.anchors.astype(np.int64),
        reference=formula.reference.astype(np.float64),
        edges=formula.edges.astype(np.int64),
        width_landmarks=formula.width_landmarks.astype(np.int64),
        feature_mean=formula.feature_mean.astype(np.float64),
        **{key: np.float64(getattr(formula.denoising, key)) for key in kept},
        hidden_weights=stacked.hidden_weights.astype(np.float32),
        hidden_bias=stacked.hidden_bias.astype(np.float32),
        output_weights=stacked.output_weights.astype(np.float32),
        output_bias=stacked.output_bias.astype(np.float32),
        weight_range=np.array(WEIGHT_RANGE),
    )
    return {f"{name}.npz": content.getvalue()}

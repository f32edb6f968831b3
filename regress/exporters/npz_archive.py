"""A NumPy archive: the formula arrays, for readers who have NumPy and want nothing else.

Points to weights, for ``points`` (n, 68, 2), with ``z = numpy.load(path)``::

    def features(points, of=""):    # (n, E)
        points = points - z[of + "depth"][:, None] * (z[of + "turn"] @ points)[:, None]  # a turn of the head is undone
        middle, r = points[:, z[of + "anchors"]].mean(1, keepdims=True), z[of + "reference"]
        a = points[:, z[of + "anchors"]] - middle
        if z[of + "alignment"] == "stable":    # turned, scaled and shifted: the features are points
            c, s = (a * r).sum((1, 2)), (a * (r[:, ::-1] * [1, -1])).sum((1, 2))
            map = numpy.array([[c, s], [-s, c]]).transpose(2, 0, 1) / (a * a).sum((1, 2))[:, None, None]
            return ((points - middle) @ map).reshape(len(points), -1)
        map = numpy.linalg.solve(a.swapaxes(1, 2) @ a, a.swapaxes(1, 2) @ r)    # (n, 2, 2)
        map = map if z[of + "alignment"] == "affine" else numpy.eye(2)
        length = lambda pairs: numpy.linalg.norm((points[:, pairs[:, 1]] - points[:, pairs[:, 0]]) @ map, axis=-1)
        return length(z[of + "edges"]) / length(z[of + "width_landmarks"][None])

    def answer(x, of=""):    # of features less their mean
        if of + "axes" in z:    # networks that denoise
            place = x @ z[of + "axes"].T
            measured = ((x @ z[of + "noise_axes"].T) ** 2).mean(1)
            surplus = place**2 @ z[of + "surplus"] - z[of + "usual"]
            noise = numpy.maximum(measured, surplus)[:, None] + z[of + "least"]
            x = (place + z[of + "offset"]) * (z[of + "signal"] / (z[of + "signal"] + noise))
        hidden = numpy.tanh(x @ z[of + "hidden_weights"].T + z[of + "hidden_bias"])
        return numpy.clip(hidden @ z[of + "output_weights"].T + z[of + "output_bias"], *z["weight_range"])

    weights = answer(features(points) - z["feature_mean"])    # (n, 52)

Where there are arrays whose names begin with ``calibrated_``, the model can compare a face with the person's neutral
face by the same detector, ``neutral`` (1 or n, 68, 2), without missing points; keep ``rest`` for each person::

    rest = features(neutral, "calibrated_")
    weights = answer(features(points, "calibrated_") - rest - z["calibrated_feature_mean"], "calibrated_")

``names`` says what the 52 columns are; ``about`` is one JSON text: format version, recipe, dataset hash,
licence. Nothing is pickled.
"""

import io
import json

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.exporters.answering import DENOISING, Answering
from regress.exporters.formula import FORMAT_VERSION, WEIGHT_RANGE, Formula


def export_npz(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.npz``; this module's first lines are its documentation."""
    content = io.BytesIO()
    about = {"format_version": FORMAT_VERSION, **formula.about}
    alone = _arrays(formula.alone)
    calibrated = {} if formula.calibrated is None else _arrays(formula.calibrated)
    arrays = {
        "about": np.array(json.dumps(about, sort_keys=True)),
        **{key: alone.pop(key) for key in ("depth", "turn", "alignment")},
        "names": np.array(BLENDSHAPES),
        **alone,
        "weight_range": np.array(WEIGHT_RANGE),
        **{f"calibrated_{key}": array for key, array in calibrated.items()},
    }
    np.savez(content, **arrays)  # not compressed: weights do not shrink, and zlib's versions differ in bytes
    return {f"{name}.npz": content.getvalue()}


def _arrays(answering: Answering) -> dict[str, np.ndarray]:
    """One set of networks and what it sees, by name."""
    measures, denoising, stacked = answering.measures, answering.denoising, answering.stacked()
    kept = () if denoising is None else DENOISING
    return {
        "depth": measures.depth.astype(np.float64),
        "turn": measures.turn.astype(np.float64),
        "alignment": np.array(measures.alignment),
        "anchors": measures.anchors.astype(np.int64),
        "reference": measures.reference.astype(np.float64),
        "edges": measures.edges.astype(np.int64),
        "width_landmarks": measures.width_landmarks.astype(np.int64),
        "feature_mean": answering.feature_mean.astype(np.float64),
        **{key: np.float64(getattr(denoising, key)) for key in kept},
        "hidden_weights": stacked.hidden_weights.astype(np.float32),
        "hidden_bias": stacked.hidden_bias.astype(np.float32),
        "output_weights": stacked.output_weights.astype(np.float32),
        "output_bias": stacked.output_bias.astype(np.float32),
    }

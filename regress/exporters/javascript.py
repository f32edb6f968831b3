"""One ECMAScript module, ``NAME.js``, with its types, ``NAME.d.ts``: no dependency, for browsers and Node.

The code is a template beside this module (``templates/predict.js``); here the numbers are put in, tables of
weights as base64 of little-endian float32. Computed in double throughout.
"""

import base64
import json
from importlib.resources import files
from string import Template

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from regress.exporters.c_source import comment, run_of
from regress.exporters.formula import Formula

LINE_WIDTH = 110


def export_javascript(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.js`` and ``NAME.d.ts``, exporting ``predict`` and ``names``."""
    values = _values(formula, name)
    templates = files("regress.exporters") / "templates"
    return {
        f"{name}{suffix}": Template((templates / f"predict{suffix}").read_text(encoding="utf-8"))
        .substitute(values)
        .encode()
        for suffix in (".js", ".d.ts")
    }


def _values(formula: Formula, name: str) -> dict[str, str]:
    stacked, denoising = formula.stacked(), formula.denoising
    runs = [run_of(row) for row in stacked.output_weights]
    return {
        "name": name,
        "title": comment(f"{name}: {LANDMARK_COUNT} facial landmarks to {len(BLENDSHAPES)} avatar weights."),
        "licence": comment(formula.about["licence"]),
        "dataset": comment(f"{formula.about['dataset']} (SHA-256 {formula.about['dataset_sha256']})"),
        "recipe": comment(formula.about["recipe"]),
        "depth": _listed(formula.depth.tolist()),
        "turn": _listed(formula.turn.tolist()),
        "aligned": json.dumps(formula.alignment == "affine"),
        "names": _listed(BLENDSHAPES),
        "name_types": "\n".join(f"  {json.dumps(blendshape)}," for blendshape in BLENDSHAPES),
        "anchors": _listed(formula.anchors.tolist()),
        "reference": _listed(formula.reference.ravel().tolist()),
        "edges": _listed(np.vstack([formula.edges, formula.width_landmarks]).ravel().tolist()),
        "feature_mean": _listed(formula.feature_mean.tolist()),
        "axes": "" if denoising is None else _floats(np.concatenate([denoising.axes, denoising.noise_axes])),
        "noise_count": str(0 if denoising is None else len(denoising.noise_axes)),
        "offset": "[]" if denoising is None else _listed(denoising.offset.tolist()),
        "signal": "[]" if denoising is None else _listed(denoising.signal.tolist()),
        "surplus": "[]" if denoising is None else _listed(denoising.surplus.tolist()),
        "usual": "0" if denoising is None else json.dumps(float(denoising.usual)),
        "least": "0" if denoising is None else json.dumps(float(denoising.least)),
        "hidden_weights": _floats(stacked.hidden_weights.T),
        "hidden_bias": _floats(stacked.hidden_bias),
        "first_hidden": _listed([first for first, _ in runs]),
        "first_connection": _listed(np.cumsum([0, *(len(weights) for _, weights in runs)]).tolist()),
        "output_weights": _floats(np.concatenate([weights for _, weights in runs])),
        "output_bias": _floats(stacked.output_bias),
    }


def _floats(values: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode()


def _listed(values) -> str:
    """An array literal, as few lines as fit `LINE_WIDTH`."""
    lines, line = [], ""
    for item in map(json.dumps, values):
        if line and len(line) + len(item) + 2 > LINE_WIDTH:
            lines.append(line + ",")
            line = item
        else:
            line = f"{line}, {item}" if line else item
    body = "\n".join([*lines, line])
    return f"[\n{body},\n]"

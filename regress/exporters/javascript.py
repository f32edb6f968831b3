"""One ECMAScript module, ``NAME.js``, with its types, ``NAME.d.ts``: no dependency, for browsers and Node.

The code is made of templates beside this module (``templates/javascript``); here they are put together, each set of
networks in a scope of its own where there are two, and the numbers are put in, tables of weights as base64 of
little-endian float32. Computed in double throughout.
"""

import base64
import json
from importlib.resources import files
from string import Template
from textwrap import indent

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from regress.exporters.answering import Answering, runs_of
from regress.exporters.c_source import comment
from regress.exporters.formula import Formula
from regress.exporters.halves import Halves, halves_of
from regress.exporters.outline import FLAT, LARGEST_AREA, OUTLINE

LINE_WIDTH = 110

_UNITS = """
 *
 * x and y have one unit: multiply shares of a picture by its width and height first. A face in a mirror, or with y
 * upward, is not told from others: its weights are wrong."""

_PREDICT = "export function predict(points, weights = new Float32Array(names.length))"
_DENOISED = "signal.length + noiseCount"
_FOLDED = "share.length"
_SUMS = "const left = new Float64Array(unitCount);\nconst turned = new Float64Array(unitCount);\n"


def export_javascript(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.js`` and ``NAME.d.ts``, exporting ``predict`` and ``names``.

    Where the model compares faces with a neutral face: ``player`` as well.
    """
    words = {
        "name": name,
        "units": "" if formula.as_paper else _UNITS,
        "title": comment(f"{name}: {LANDMARK_COUNT} facial landmarks to {len(BLENDSHAPES)} avatar weights."),
        "licence": comment(formula.about["licence"]),
        "dataset": comment(f"{formula.about['dataset']} (SHA-256 {formula.about['dataset_sha256']})"),
        "recipe": comment(formula.about["recipe"]),
        "names": _listed(BLENDSHAPES),
        "name_types": "\n".join(f"  {json.dumps(blendshape)}," for blendshape in BLENDSHAPES),
    }
    if formula.calibrated is None:
        tables, functions = _set_of(formula.alone, _PREDICT)
        words["usage"] = _filled("usage_predict.js", words)
        words["networks"] = _filled("predict.js", words | {"tables": tables, "functions": functions})
        words["players"] = ""
    else:
        sets = {
            "alone": _set_of(formula.alone, "function answer(points, weights)"),
            "calibrated": _set_of(
                formula.calibrated, "function answer(points, weights, neutral)", "neutral[i] + "
            ),
        }
        scopes = {key: indent("".join(texts), "  ").rstrip("\n") for key, texts in sets.items()}
        words["usage"] = _filled("usage_players.js", words)
        limits = {"outline": _listed(OUTLINE.tolist()), "flat": f"{FLAT:g}", "turned": f"{LARGEST_AREA:g}"}
        words["networks"] = _filled("players.js", scopes | limits)
        words["players"] = _filled("players.d.ts", words)
    return {f"{name}{suffix}": _filled(f"file{suffix}", words).encode() for suffix in (".js", ".d.ts")}


def _set_of(answering: Answering, signature: str, neutral: str | None = None) -> tuple[str, str]:
    """Tables and functions of one set of networks."""
    measures, halves = answering.measures, halves_of(answering)
    words = _numbers(answering, halves)
    words |= {"signature": signature, "neutral": neutral or "", "aligned": "", "edge_table": ""}
    if measures.of_points:
        measuring = ["points.js"]
    else:
        words["aligned"] = f"const aligned = {json.dumps(measures.alignment == 'affine')};\n\n"
        words["edge_table"] = _filled("edges.js", words)
        measuring = ["lengths.js"] if neutral is None else ["lengths.js", "measured_lengths.js"]
    inline = not measures.of_points and neutral is None
    words["measured"] = _filled("from_lengths.js" if inline else "from_measured.js", words)
    folded = halves is not None and halves.fold is not None
    words["input_tables"] = _filled("fold.js" if folded else "denoising.js", words)
    words["inputs"] = _filled("folded.js" if folded else "denoised.js", words)
    words["prepare"] = "folded" if folded else "denoised"
    words["places"] = f"const places = new Float64Array({_FOLDED if folded else _DENOISED});\n"
    words["sums"] = "" if halves is None else _SUMS
    words["hidden"] = _filled("hidden.js" if halves is None else "hidden_halves.js", words)
    words["layers"] = _filled("layers.js" if halves is None else "layers_halves.js", words)
    return _filled("tables.js", words), "".join(_filled(text, words) for text in ("answer.js", *measuring))


def _filled(template: str, words: dict[str, str]) -> str:
    text = (files("regress.exporters") / "templates" / "javascript" / template).read_text(encoding="utf-8")
    return Template(text).substitute(words)


def _numbers(answering: Answering, halves: Halves | None) -> dict[str, str]:
    """What templates say of one set of networks and of what it sees, by name."""
    measures, denoising = answering.measures, answering.denoising if halves is None else halves.denoising
    layers = answering.stacked() if halves is None else halves
    runs = runs_of(layers.output_weights, sides=1 if halves is None else 2)
    fold = None if halves is None else halves.fold
    return {
        "depth": _listed(measures.depth.tolist()),
        "turn": _listed(measures.turn.tolist()),
        "anchors": _listed(measures.anchors.tolist()),
        "reference": _listed(measures.reference.ravel().tolist()),
        "edges": _listed(np.vstack([measures.edges, measures.width_landmarks]).ravel().tolist()),
        "feature_mean": _listed(answering.feature_mean.tolist()),
        "axes": "" if denoising is None else _floats(np.concatenate([denoising.axes, denoising.noise_axes])),
        "noise_count": str(0 if denoising is None else len(denoising.noise_axes)),
        "offset": "[]" if denoising is None else _listed(denoising.offset.tolist()),
        "signal": "[]" if denoising is None else _listed(denoising.signal.tolist()),
        "surplus": "[]" if denoising is None else _listed(denoising.surplus.tolist()),
        "usual": "0" if denoising is None else json.dumps(float(denoising.usual)),
        "least": "0" if denoising is None else json.dumps(float(denoising.least)),
        "even_count": str(0 if halves is None else halves.even),
        "fold_first": "[]" if fold is None else _listed(fold.first.tolist()),
        "fold_second": "[]" if fold is None else _listed(fold.second.tolist()),
        "fold_share": "[]" if fold is None else _listed(fold.share.tolist()),
        "hidden_weights": _floats(layers.hidden_weights.T),
        "hidden_bias": _floats(layers.hidden_bias),
        "first_hidden": _listed([first for first, _ in runs]),
        "first_connection": _listed(np.cumsum([0, *(weights.size for _, weights in runs)]).tolist()),
        "output_weights": _floats(np.concatenate([weights.ravel() for _, weights in runs])),
        "output_bias": _floats(layers.output_bias),
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

"""One C99 pair, ``NAME.h`` and ``NAME.c``: no allocation, no state, no dependency but ``math.h``.

The code is a template beside this module (``templates/predict.c``) that a C person can read as it stands;
here the numbers are put in. Geometry is computed in double, the networks in float.
"""

import re
from importlib.resources import files
from string import Template

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError
from regress.exporters.formula import Formula

LINE_WIDTH = 110
C_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def export_c(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.h`` and ``NAME.c``, declaring ``NAME_predict`` and ``NAME_names``.

    Raises
    ------
    InputError
        The name cannot begin a C identifier.
    """
    if not C_IDENTIFIER.fullmatch(name):
        raise InputError(
            f"--name {name!r} becomes part of C names such as {name}_predict: use letters, digits and "
            f"underscores, a letter first"
        )
    values = _values(formula, name)
    templates = files("regress.exporters") / "templates"
    texts = {
        suffix: Template((templates / f"predict{suffix}").read_text(encoding="utf-8"))
        for suffix in (".h", ".c")
    }
    return {f"{name}{suffix}": text.substitute(values).encode() for suffix, text in texts.items()}


def _values(formula: Formula, name: str) -> dict[str, object]:
    stacked, denoising = formula.stacked(), formula.denoising
    runs = [run_of(row) for row in stacked.output_weights]  # (first hidden unit, weights) of each of the 52
    connection_counts = [len(weights) for _, weights in runs]
    connections = np.concatenate([weights for _, weights in runs])
    return {
        "name": name,
        "GUARD": name.upper(),
        "title": f"{name}: {LANDMARK_COUNT} facial landmarks to {len(BLENDSHAPES)} avatar weights.",
        "licence": comment(formula.about["licence"]),
        "dataset": comment(f"{formula.about['dataset']} (SHA-256 {formula.about['dataset_sha256']})"),
        "recipe": comment(formula.about["recipe"]),
        "depth": _wrapped(f"{value:.17g}" for value in formula.depth),
        "turn": _wrapped(f"{value:.17g}" for value in formula.turn),
        "aligned": int(formula.alignment == "affine"),
        "point_count": LANDMARK_COUNT,
        "weight_count": len(BLENDSHAPES),
        "anchor_count": len(formula.anchors),
        "feature_count": len(formula.edges),
        "input_count": len(formula.edges if denoising is None else denoising.axes),
        "noise_count": 0 if denoising is None else len(denoising.noise_axes),
        "axes": "" if denoising is None else _rows(np.concatenate([denoising.axes, denoising.noise_axes]).T),
        "offset": "" if denoising is None else _floats(denoising.offset),
        "signal": "" if denoising is None else _floats(denoising.signal),
        "surplus": "" if denoising is None else _floats(denoising.surplus),
        "usual": "0" if denoising is None else f"{float(denoising.usual):.17g}",
        "least": "0" if denoising is None else f"{float(denoising.least):.17g}",
        "hidden_count": len(stacked.hidden_bias),
        "connection_count": len(connections),
        "names": _wrapped(f'"{name}"' for name in BLENDSHAPES),
        "anchors": _wrapped(map(str, formula.anchors)),
        "reference": _wrapped(f"{{{x:.17g}, {y:.17g}}}" for x, y in formula.reference),
        "edges": _wrapped(f"{{{i}, {j}}}" for i, j in [*formula.edges, formula.width_landmarks]),
        "feature_mean": _wrapped(f"{value:.17g}" for value in formula.feature_mean),
        "hidden_weights": _rows(stacked.hidden_weights.T),
        "hidden_bias": _floats(stacked.hidden_bias),
        "first_hidden": _wrapped(str(first) for first, _ in runs),
        "first_connection": _wrapped(map(str, np.cumsum([0, *connection_counts]))),
        "output_weights": _floats(connections),
        "output_bias": _floats(stacked.output_bias),
    }


def run_of(row: np.ndarray) -> tuple[int, np.ndarray]:
    """First index and values of the shortest run that holds all of a row that is not zero."""
    used = np.flatnonzero(row)
    if len(used) == 0:
        return 0, row[:0]
    return int(used[0]), row[used[0] : used[-1] + 1]


def _floats(values: np.ndarray) -> str:
    """C literals of type float: nine significant digits bring back the same float32."""
    return _wrapped(_float(value) for value in np.asarray(values, dtype=np.float32))


def _rows(table: np.ndarray) -> str:
    return ",\n".join(f"{{{_floats(row)}}}" for row in table)


def _float(value: np.float32) -> str:
    digits = f"{value:.9g}"
    return (digits if re.search(r"[.e]", digits) else f"{digits}.0") + "f"


def _wrapped(items) -> str:
    """Items with commas between them, as few lines as fit `LINE_WIDTH`."""
    lines, line = [], ""
    for item in items:
        if line and len(line) + len(item) + 2 > LINE_WIDTH:
            lines.append(line + ",")
            line = item
        else:
            line = f"{line}, {item}" if line else item
    return "\n".join([*lines, line])


def comment(text: str) -> str:
    """A text that cannot end the comment it stands in."""
    return " ".join(text.replace("*/", "* /").split())

"""One C99 pair, ``NAME.h`` and ``NAME.c``: no allocation, no state, no dependency but ``math.h``.

The code is made of templates beside this module (``templates/c``) that a C person can read as they stand; here they
are put together, once for each set of networks, and the numbers are put in. Geometry is computed in double, the
networks in float.
"""

import math
import re
from importlib.resources import files
from string import Template

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError
from regress.exporters.answering import Answering, runs_of
from regress.exporters.formula import Formula
from regress.exporters.halves import Halves, halves_of
from regress.exporters.outline import FLAT, LARGEST_AREA, OUTLINE

LINE_WIDTH = 110
C_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")

_TAKEN = frozenset(
    "assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg "
    "stdbool stddef stdint stdio stdlib string tgmath time wchar wctype features".split()
)
"""A header of such a name hides C's own from ``#include <math.h>``."""

_OF_CALLS = 2048
"""Bytes of stack of the functions that measure a face, and take noise off, while an answer is computed."""

_MOST_OF_SHORT = 65_535

_UNITS = """
 *     x and y have one unit: multiply shares of a picture by its width and height first. A face in a mirror, or with
 *     y upward, is not told from others: its weights are wrong."""

_PREDICT = "void ${name}_predict(const float points[${GUARD}_POINTS][2], float weights[${GUARD}_WEIGHTS])"
_ALONE = "static void ${of}predict(const float points[${GUARD}_POINTS][2], float weights[${GUARD}_WEIGHTS])"
_CALIBRATED = """\
static void ${of}predict(const float points[${GUARD}_POINTS][2], const double neutral[${OF}FEATURES],
                         float weights[${GUARD}_WEIGHTS])"""


def export_c(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.h`` and ``NAME.c``, declaring ``NAME_predict`` and ``NAME_names``.

    Where the model compares faces with a neutral face: ``NAME_player`` and ``NAME_neutral`` as well.

    Raises
    ------
    InputError
        The name cannot begin a C identifier, or hides what C has.
    """
    if not C_IDENTIFIER.fullmatch(name):
        raise InputError(
            f"--name {name!r} becomes part of C names such as {name}_predict: use letters, digits and "
            f"underscores, a letter first"
        )
    if name.lower() in _TAKEN:
        raise InputError(f"--name {name!r} is taken by a header of C; name another, as face")
    own = "" if formula.as_paper else f"{name}_"
    words = {
        "name": name,
        # what the file keeps to itself is called by the name too: builds may put files of several models together
        "own": own,
        "OWN": own.upper(),
        "finite": "" if formula.as_paper else _filled("finite.c", {}),
        "units": "" if formula.as_paper else _UNITS,
        "GUARD": name.upper(),
        "title": f"{name}: {LANDMARK_COUNT} facial landmarks to {len(BLENDSHAPES)} avatar weights.",
        "licence": comment(formula.about["licence"]),
        "dataset": comment(f"{formula.about['dataset']} (SHA-256 {formula.about['dataset_sha256']})"),
        "recipe": comment(formula.about["recipe"]),
        "point_count": LANDMARK_COUNT,
        "weight_count": len(BLENDSHAPES),
        "names": _wrapped(f'"{name}"' for name in BLENDSHAPES),
    }
    if formula.calibrated is None:
        sets = [_set_of(formula.alone, _PREDICT, words, of=own)]
        functions, player = "predict.h", ""
    else:
        words["neutral_count"] = formula.calibrated.measures.count
        words |= {"outline": _wrapped(map(str, OUTLINE)), "flat": f"{FLAT:g}", "turned": f"{LARGEST_AREA:g}"}
        words["stack_kb"] = max(map(_stack_kb, (formula.alone, formula.calibrated)))
        sets = [
            _set_of(formula.alone, _ALONE, words, of=f"{own}alone_"),
            _set_of(formula.calibrated, _CALIBRATED, words, of=f"{own}calibrated_", neutral="neutral[i] - "),
        ]
        functions, player = "player.h", _filled("player.c", words)
    whole = {key: "".join(texts[key] for texts in sets) for key in sets[0]}
    whole["answering"] = "\n".join(texts["answering"] for texts in sets) + player
    header = _filled("file.h", words | {"functions": _filled(functions, words)})
    return {f"{name}.h": header.encode(), f"{name}.c": _filled("file.c", words | whole).encode()}


def _set_of(
    answering: Answering,
    signature: str,
    words: dict[str, object],
    *,
    of: str = "",
    neutral: str | None = None,
) -> dict[str, str]:
    """Code and numbers of one set of networks, its names beginning with ``of``; by their places in ``file.c``."""
    measures, halves = answering.measures, halves_of(answering)
    words = words | {"of": of, "OF": of.upper()} | _numbers(answering, halves)
    words["signature"] = Template(signature).substitute(words)
    words["aligned"] = words["edge_table"] = ""
    measuring = ["undo_turn.c"]
    if measures.of_points:
        measuring.append("points.c")
    else:
        words["aligned"] = f"#define {of.upper()}ALIGNED {int(measures.alignment == 'affine')}\n"
        words["edge_table"] = _filled("edges.c", words)
        measuring += ["lengths.c"] if neutral is None else ["lengths.c", "measured_lengths.c"]
    inline = not measures.of_points and neutral is None
    words["scratch"] = Template(
        "face[${GUARD}_POINTS][2], map[2][2], width" if inline else "measured[${OF}FEATURES]"
    ).substitute(words)
    words["neutral"] = neutral or ""
    words["measured"] = _filled("from_lengths.c" if inline else "from_measured.c", words).removesuffix("\n")
    folded = halves is not None and halves.fold is not None
    words["inputs"] = _filled("fold.c" if folded else "denoise.c", words)
    words["prepare"] = "fold" if folded else "denoise"
    words["hidden"] = _filled("hidden.c" if halves is None else "hidden_halves.c", words)
    words["layers"] = _filled("layers.c" if halves is None else "layers_halves.c", words)
    sums = ";\n    float left[${OF}UNITS] = {0}, turned[${OF}UNITS] = {0}"
    words["sums"] = "" if halves is None else Template(sums).substitute(words)
    return {
        "sizes": _filled("sizes.c", words),
        "tables": _filled("tables.c", words),
        "measuring": "".join(_filled(template, words) for template in measuring),
        "answering": _filled("answer.c", words),
    }


def _stack_kb(answering: Answering) -> int:
    """Of what one answer holds while it is computed: points or features in double, and all layers in float."""
    halves = halves_of(answering)
    layers = answering.stacked() if halves is None else halves
    hidden = len(layers.hidden_bias) * (1 if halves is None else 2)  # sums of both halves beside them
    features = answering.measures.count
    numbers = 2 * max(features, 2 * LANDMARK_COUNT) + features + layers.hidden_weights.shape[1] + hidden
    return math.ceil((4 * numbers + _OF_CALLS) / 1024)


def _filled(template: str, words: dict[str, object]) -> str:
    text = (files("regress.exporters") / "templates" / "c" / template).read_text(encoding="utf-8")
    return Template(text).substitute(words)


def _numbers(answering: Answering, halves: Halves | None) -> dict[str, object]:
    """What templates say of one set of networks and of what it sees, by name."""
    measures, denoising = answering.measures, answering.denoising if halves is None else halves.denoising
    layers = answering.stacked() if halves is None else halves
    runs = runs_of(layers.output_weights, sides=1 if halves is None else 2)
    fold = None if halves is None else halves.fold
    hidden, connections = len(layers.hidden_bias), sum(weights.size for _, weights in runs)
    return {
        "depth": _wrapped(f"{value:.17g}" for value in measures.depth),
        "turn": _wrapped(f"{value:.17g}" for value in measures.turn),
        "anchor_count": len(measures.anchors),
        "feature_count": measures.count,
        "input_count": layers.hidden_weights.shape[1],
        "noise_count": 0 if denoising is None else len(denoising.noise_axes),
        "axes": "" if denoising is None else _rows(np.concatenate([denoising.axes, denoising.noise_axes]).T),
        "offset": "" if denoising is None else _floats(denoising.offset),
        "signal": "" if denoising is None else _floats(denoising.signal),
        "surplus": "" if denoising is None else _floats(denoising.surplus),
        "usual": "0" if denoising is None else f"{float(denoising.usual):.17g}",
        "least": "0" if denoising is None else f"{float(denoising.least):.17g}",
        "even_count": 0 if halves is None else halves.even,
        "fold_first": "" if fold is None else _wrapped(map(str, fold.first)),
        "fold_second": "" if fold is None else _wrapped(map(str, fold.second)),
        "fold_share": "" if fold is None else _floats(fold.share),
        "hidden_count": hidden,
        "connection_count": connections,
        "place": "unsigned short" if max(hidden, connections) <= _MOST_OF_SHORT else "int",
        "anchors": _wrapped(map(str, measures.anchors)),
        "reference": _wrapped(f"{{{x:.17g}, {y:.17g}}}" for x, y in measures.reference),
        "edges": _wrapped(f"{{{i}, {j}}}" for i, j in [*measures.edges, measures.width_landmarks]),
        "feature_mean": _wrapped(f"{value:.17g}" for value in answering.feature_mean),
        "hidden_weights": _rows(layers.hidden_weights.T),
        "hidden_bias": _floats(layers.hidden_bias),
        "first_hidden": _wrapped(str(first) for first, _ in runs),
        "first_connection": _wrapped(map(str, np.cumsum([0, *(weights.size for _, weights in runs)]))),
        "output_weights": _floats(np.concatenate([weights.ravel() for _, weights in runs])),
        "output_bias": _floats(layers.output_bias),
    }


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

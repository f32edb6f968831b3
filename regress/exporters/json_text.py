"""JSON that explains itself: what a reader of any language needs, network by network.

===================  =====================================================================================
key                  what
===================  =====================================================================================
format, version      ``"regress-networks"`` and 5; a change that breaks readers raises the version
about                recipe, dataset and its SHA-256, licence, program version
names                the 52 blendshapes in the order of the result
depth, turn          68 numbers each, all 0 where a model does not undo the head's turn
alignment            ``"affine"``, or ``"none"``: then A below is the identity; ``"stable"``: see step 1
anchors              indices (0-67) of the landmarks that are aligned
reference            where each anchor is in the mean face, about their own mean
edges                178 pairs of landmark indices; none where ``alignment`` is ``"stable"``
width_landmarks      the pair whose distance is the face's width
feature_mean         178 numbers; 136 where ``alignment`` is ``"stable"``
denoising            null, or ``axes`` (A x 178), ``offset``, ``signal`` and ``surplus`` (A numbers each),
                     ``noise_axes`` (32 x 178), ``usual`` and ``least``; networks then have A inputs
networks             list of ``name``, ``outputs`` (names), ``hidden_weights`` (20 x 178), ``hidden_bias``,
                     ``output_weights`` (one row an output), ``output_bias``
constant             names that no network gives, and their value (``tongueOut``: 68 points do not show it)
weight_range         [0, 1]: what results are clipped to
calibrated           where a model compares faces with a person's neutral face, and only there: the keys from
                     ``depth`` to ``networks`` once more, for faces of a person whose neutral face is known
===================  =====================================================================================

To evaluate:
0. put back what a turn of the head moves, x and y alike: m = sum of ``turn[k]`` point k, then point k = point k -
   ``depth[k]`` m;
and with P the 31 anchor points of the face less their mean (rows) and R ``reference``:
1. A = inverse(P'P) P'R, a 2 x 2 matrix (the identity where ``alignment`` is ``"none"``; where it is ``"stable"``
   A = [[c, s], [-s, c]] / sum of (px px + py py), c = sum of (px rx + py ry), s = sum of (px ry - py rx));
2. length of a pair (i, j) = | (point j - point i) A |, points being rows;
3. feature e = length of edge e / length of ``width_landmarks`` - ``feature_mean[e]``; where ``alignment`` is
   ``"stable"`` features 2k and 2k + 1 are x and y of (point k - mean of the anchors) A, less ``feature_mean``;
   where ``denoising`` is not null: place = ``axes`` feature; noise = mean of the squares of ``noise_axes``
   feature, or the sum of ``surplus`` place place, less ``usual``, where that is larger, plus ``least``; then
   feature = (place + ``offset``) ``signal`` / (``signal`` + noise), number by number;
4. in each network hidden = tanh(``hidden_weights`` feature + ``hidden_bias``), and
   result = ``output_weights`` hidden + ``output_bias``, clipped.

To calibrate, where there is ``calibrated``: take the points of the person's face at rest, by the detector in use,
through steps 0 to 3 with the numbers under ``calibrated``, but subtract no ``feature_mean``. For a frame of that person
take the same steps with the numbers under ``calibrated`` and, beside ``feature_mean``, subtract the neutral face's
features before what ``denoising`` does. These are kept for each person, and nothing else is. A neutral face with a
missing point calibrates nothing: refuse it.
"""

import json

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.exporters.answering import DENOISING, Answering
from regress.exporters.formula import FORMAT_VERSION, WEIGHT_RANGE, Formula


def export_json(formula: Formula, name: str) -> dict[str, bytes]:
    """Make ``NAME.json``; this module's first lines are its documentation."""
    given = {blendshape for network in formula.alone.networks for blendshape in network.outputs}
    document = {
        "format": "regress-networks",
        "version": FORMAT_VERSION,
        "about": formula.about,
        "names": list(BLENDSHAPES),
        **_as_json(formula.alone),
        "constant": {blendshape: 0.0 for blendshape in BLENDSHAPES if blendshape not in given},
        "weight_range": list(WEIGHT_RANGE),
    }
    if formula.calibrated is not None:
        document["calibrated"] = _as_json(formula.calibrated)
    text = json.dumps(document, separators=(",", ":"), allow_nan=False)
    return {f"{name}.json": (text + "\n").encode()}


def _as_json(answering: Answering) -> dict[str, object]:
    """JSON data of one set of networks and of what it sees."""
    denoising = answering.denoising
    return {
        **answering.measures.as_json(),
        "feature_mean": answering.feature_mean.tolist(),
        "denoising": None
        if denoising is None
        else {key: _nine_digits(getattr(denoising, key)) for key in DENOISING},
        "networks": [
            {
                "name": network.name,
                "outputs": list(network.outputs),
                "hidden_weights": _nine_digits(network.hidden_weights),
                "hidden_bias": _nine_digits(network.hidden_bias),
                "output_weights": _nine_digits(network.output_weights),
                "output_bias": _nine_digits(network.output_bias),
            }
            for network in answering.networks
        ],
    }


def _nine_digits(values: np.ndarray) -> list:
    """Nested lists of numbers short enough to read, long enough to bring back every float32."""
    if values.ndim > 1:
        return [_nine_digits(row) for row in values]
    return [float(f"{value:.9g}") for value in values] if values.ndim else float(f"{values:.9g}")

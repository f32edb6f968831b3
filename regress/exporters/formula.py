"""What every exported file computes, as plain arrays: the form between a model and the exporters.

A face's 68 points become 52 weights in five steps; an exporter only writes them down in its language:

0. ``points = points - depth (turn points)``, depth a column and turn a row of 68: the turn of the head is undone. Both
   are 0 where a model leaves it;
1. ``map``: with P the anchor points less their mean and R the reference, ``inverse(P'P) P'R`` (2 x 2), or
   the identity where ``alignment`` is ``"none"``;
2. ``features``: lengths of the edges under the map, over the face's width under the map, less
   ``feature_mean``;
   and where a model denoises: ``(places + offset) signal / (signal + noise)`` with ``places = axes features`` and
   ``noise`` the mean square of ``noise_axes features``, or ``surplus places^2 - usual`` where that is larger, plus
   ``least``, are its features from here on;
3. ``hidden = tanh(hidden_weights features + hidden_bias)``, network by network;
4. ``weights = output_weights hidden + output_bias``, clipped to `WEIGHT_RANGE`; shapes without a network
   are 0.

A face with a missing point gives NaN throughout, as in ``Model.predict``.
"""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, FACE_WIDTH_LANDMARKS, LANDMARK_COUNT
from regress import __version__
from regress.runtime.features import ANCHORS, turn_weights
from regress.runtime.model import Model
from regress.runtime.networks import Denoising

DENOISING = ("axes", "offset", "signal", "noise_axes", "surplus", "usual", "least")
"""Arrays of a formula that denoises."""

FORMAT_VERSION = 4
"""Of the JSON and NPZ files; raised by any change that breaks a reader."""

WEIGHT_RANGE = (0.0, 1.0)


@dataclass(frozen=True, kw_only=True)
class FormulaNetwork:
    """One small network that acts on centred features, or on what denoising leaves of them.

    Parameters
    ----------
    name
        For example ``"eyes.blink"``.
    outputs
        Blendshapes it gives.
    hidden_weights : (H, E) float64, or (H, A) behind denoising
    hidden_bias : (H,) float64
    output_weights : (len(outputs), H) float64
    output_bias : (len(outputs),) float64
    """

    name: str
    outputs: tuple[str, ...]
    hidden_weights: np.ndarray
    hidden_bias: np.ndarray
    output_weights: np.ndarray
    output_bias: np.ndarray


@dataclass(frozen=True, kw_only=True)
class StackedNetworks:
    """All networks as two matrix products.

    Parameters
    ----------
    hidden_weights : (M, E) float64
        Hidden units of all networks, one below the other.
    hidden_bias : (M,) float64
    output_weights : (52, M) float64
        In `BLENDSHAPES` order; zero outside the network that gives a shape, and for shapes without a network.
    output_bias : (52,) float64
    """

    hidden_weights: np.ndarray
    hidden_bias: np.ndarray
    output_weights: np.ndarray
    output_bias: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Formula:
    """Everything between points and weights, and the words that go with it.

    Parameters
    ----------
    depth, turn : (68,) float64
        What undoes a turn of the head; zeros where it is left.
    alignment
        ``"affine"`` or ``"none"``.
    anchors : (A,) int64
        Landmarks that are aligned.
    reference : (A, 2) float64
        Where the anchors are in the mean shape, about their own mean.
    edges : (E, 2) int64
        Pairs of landmarks.
    width_landmarks : (2,) int64
    feature_mean : (E,) float64
        Kept apart: folded into the bias it would cost float32 readers two digits. Denoising has its own, its origin.
    denoising
        What the networks see instead of features; None where they see those.
    networks
        In the model's order.
    about
        Words for people and tools: ``recipe``, ``dataset``, ``dataset_sha256``, ``licence``, ``program``.
    """

    depth: np.ndarray
    turn: np.ndarray
    alignment: str
    anchors: np.ndarray
    reference: np.ndarray
    edges: np.ndarray
    width_landmarks: np.ndarray
    feature_mean: np.ndarray
    denoising: Denoising | None
    networks: tuple[FormulaNetwork, ...]
    about: dict[str, str]

    def measuring(self) -> dict[str, list | str]:
        """JSON data of what it takes to measure features: all but their mean."""
        return {
            "depth": self.depth.tolist(),
            "turn": self.turn.tolist(),
            "alignment": self.alignment,
            "anchors": self.anchors.tolist(),
            "reference": self.reference.tolist(),
            "edges": self.edges.tolist(),
            "width_landmarks": self.width_landmarks.tolist(),
        }

    def stacked(self) -> StackedNetworks:
        """The networks side by side."""
        hidden_counts = [len(network.hidden_bias) for network in self.networks]
        ends = np.cumsum(hidden_counts)
        output_weights = np.zeros((len(BLENDSHAPES), ends[-1]))
        output_bias = np.zeros(len(BLENDSHAPES))
        for network, end, count in zip(self.networks, ends, hidden_counts, strict=True):
            rows = [BLENDSHAPE_INDEX[name] for name in network.outputs]
            output_weights[rows, end - count : end] = network.output_weights
            output_bias[rows] = network.output_bias
        return StackedNetworks(
            hidden_weights=np.concatenate([network.hidden_weights for network in self.networks]),
            hidden_bias=np.concatenate([network.hidden_bias for network in self.networks]),
            output_weights=output_weights,
            output_bias=output_bias,
        )


def formula_of(model: Model) -> Formula:
    """Write a model down as a formula."""
    features = model.features
    reference = features.mean_shape[list(ANCHORS)]
    depth = np.zeros(LANDMARK_COUNT) if features.depth is None else features.depth
    return Formula(
        depth=depth,
        turn=turn_weights(features.mean_shape, depth) if depth.any() else depth,
        alignment=model.features.alignment,
        anchors=np.array(ANCHORS, dtype=np.int64),
        reference=reference - reference.mean(axis=0),
        edges=model.features.edges,
        width_landmarks=np.array(FACE_WIDTH_LANDMARKS, dtype=np.int64),
        feature_mean=_feature_mean(model),
        denoising=model.networks.denoising,
        networks=tuple(_network(model, index) for index in range(len(model.table))),
        about=_about(model),
    )


def _network(model: Model, index: int) -> FormulaNetwork:
    folded, described = model.networks, model.table[index]
    hidden = slice(index * folded.hidden, (index + 1) * folded.hidden)
    outputs = folded.network_of_output == index
    weights = folded.w1[hidden]
    return FormulaNetwork(
        name=described.key,
        outputs=described.outputs,
        hidden_weights=weights,
        hidden_bias=folded.b1[hidden] + (0 if folded.denoising else weights @ _feature_mean(model)),
        output_weights=folded.w2[outputs],
        output_bias=folded.b2[outputs],
    )


def _feature_mean(model: Model) -> np.ndarray:
    denoising = model.networks.denoising
    return model.normalisation.feature_mean if denoising is None else denoising.origin


def _about(model: Model) -> dict[str, str]:
    record = model.record
    name, sha256, data_licence, licence = "unknown", "unknown", "licence of the data unknown", "unknown"
    if record is not None:
        name, sha256 = record.dataset.name, record.dataset.keypoints_sha256
        data_licence, licence = record.dataset.licence, record.licence
    return {
        "recipe": model.recipe,
        "dataset": name,
        "dataset_sha256": sha256,
        # what the numbers derive from comes first: a rig's terms may bind whoever ships them
        "licence": f"{data_licence}; weights: {licence}",
        "program": f"regress {__version__}",
    }

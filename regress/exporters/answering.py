"""One set of networks and what it sees, as plain arrays: all that is between a face's features and its weights."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.exporters.measures import Measures
from regress.runtime.networks import Denoising

DENOISING = ("axes", "offset", "signal", "noise_axes", "surplus", "usual", "least")
"""Arrays of a set that denoises."""


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
class Answering:
    """A set of networks and what it sees.

    Parameters
    ----------
    measures
        What it takes to measure a face.
    feature_mean : (E,) float64
        Of the features, or of their differences from the neutral face's. Kept apart: folded into the bias it would
        cost float32 readers two digits. Denoising has its own, its origin.
    denoising
        What the networks see instead of features; None where they see those.
    networks
        In the model's order.
    """

    measures: Measures
    feature_mean: np.ndarray
    denoising: Denoising | None
    networks: tuple[FormulaNetwork, ...]

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


def runs_of(output_weights: np.ndarray, *, sides: int) -> list[tuple[int, np.ndarray]]:
    """First hidden unit and weights (sides, k) of each of the 52 shapes: the shortest runs that hold all not zero.

    Parameters
    ----------
    output_weights : (52, sides M) float64
        Of all units of one side, then of the next one's; the runs of all sides begin alike.
    sides
    """
    runs = []
    for row in output_weights.reshape(len(output_weights), sides, -1):
        used = np.flatnonzero(row.any(axis=0))
        first, end = (int(used[0]), int(used[-1]) + 1) if len(used) else (0, 0)
        runs.append((first, row[:, first:end]))
    return runs

"""Fits ridge regressions of all strengths at once: the baseline, and the start of networks."""

from dataclasses import dataclass

import numpy as np

STRENGTHS = 10.0 ** np.arange(-3, 5.01, 0.25)
"""The 33 strengths tried; a tenth step finer changes test errors in the fourth digit."""


@dataclass(frozen=True, kw_only=True)
class Ridge:
    """A fitted ridge regression without intercept, for centred data.

    Parameters
    ----------
    coefficients : (E, O) float64
    strengths : (O,) float64
        Of each target, in units of the sum of squares.
    """

    coefficients: np.ndarray
    strengths: np.ndarray


_LEAST = 1e-10
"""Of a strength, as a share of all inputs' sum of squares: without any, inputs that hang together have no answer."""


def ridge_coefficients(inputs: np.ndarray, targets: np.ndarray, strength: float) -> np.ndarray:
    """Coefficients (E, O) of one strength for inputs (n, E) and targets (n, O)."""
    gram = inputs.T @ inputs
    gram[np.diag_indices_from(gram)] += max(strength, _LEAST * np.trace(gram))
    return np.linalg.solve(gram, inputs.T @ targets)


def fit_ridge(
    inputs: np.ndarray, targets: np.ndarray, held_inputs: np.ndarray, held_targets: np.ndarray
) -> Ridge:
    """Ridge regression whose strength is chosen for each target on held-out rows.

    Parameters
    ----------
    inputs, targets : (n, E), (n, O) float64
        Z-scored.
    held_inputs, held_targets
        The same of the validation split.
    """
    values, vectors = np.linalg.eigh(inputs.T @ inputs)
    projected = vectors.T @ (inputs.T @ targets)
    best = np.full(targets.shape[1], np.inf)
    coefficients = np.zeros((inputs.shape[1], targets.shape[1]))
    strengths = np.zeros(targets.shape[1])
    for strength in STRENGTHS:
        trial = vectors @ (projected / (np.maximum(values, 0) + strength)[:, None])
        error = np.mean((held_inputs @ trial - held_targets) ** 2, axis=0)
        better = error < best
        best[better], strengths[better] = error[better], strength
        coefficients[:, better] = trial[:, better]
    return Ridge(coefficients=coefficients, strengths=strengths)

"""L2 strengths from the training rows alone: those that make the targets most probable.

D. MacKay, Bayesian Interpolation (1992); F. D. Foresee, M. Hagan, Gauss-Newton Approximation to Bayesian
Learning (1997). With noise of variance s^2 on the targets and a normal prior on the parameters, the most probable
strength satisfies ``alpha = s^2 gamma / |theta|^2`` and ``s^2 = |r|^2 / (N - gamma)``, gamma the number of parameters
that the data determine.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from regress.learning.levenberg_marquardt.minimise import Result, Settings, minimise
from regress.learning.levenberg_marquardt.problem import LeastSquares, State
from regress.learning.levenberg_marquardt.steps import inner

EVIDENCE_ROUNDS, EVIDENCE_STEPS = 4, 6
"""Updates of alpha, which then has settled to a few per cent, and steps before each."""

_RANGE = (1e-3, 1e4)
"""Of alpha: outside it the targets, whose variance is 1, are fitted exactly or not at all."""


def minimise_with_evidence(
    problem: LeastSquares,
    start: np.ndarray,
    alpha: np.ndarray,
    settings: Settings,
    *,
    on_step: Callable[[int, int], None] | None = None,
) -> Result:
    """Minimise as :func:`minimise` does, each problem at the strength that its evidence gives.

    Parameters
    ----------
    problem, start, settings, on_step
        See :func:`minimise`.
    alpha : (M,) float
        Strengths of the first round.

    Returns
    -------
    Result
        Of the last, full minimisation; ``alpha`` are the strengths it had.
    """
    members = np.arange(len(start))
    few = replace(settings, steps=min(EVIDENCE_STEPS, settings.steps))
    alpha = np.asarray(alpha, dtype=np.float64)
    parameters = start
    for _ in range(EVIDENCE_ROUNDS):
        parameters = minimise(problem, parameters, alpha, few, on_step=on_step).parameters
        state = problem.at(parameters, members)
        determined = _determined(state, alpha, settings)
        free = np.maximum(problem.observations(members) - determined, 1.0)
        noise_variance = inner(state.residual, state.residual) / free
        size = np.maximum(inner(parameters, parameters), np.finfo(np.float64).tiny)
        alpha = np.clip(noise_variance * determined / size, *_RANGE)
    return minimise(problem, parameters, alpha, settings, on_step=on_step)


def _determined(state: State, alpha: np.ndarray, settings: Settings) -> np.ndarray:
    if not settings.solves_exactly(state):
        return state.effective_parameters(alpha)
    short = state.gram() if state.parameters.shape[1] <= state.residual.shape[1] else state.kernel()
    values = np.maximum(np.linalg.eigvalsh(short.astype(np.float64)), 0)
    return (values / (values + alpha[:, None])).sum(axis=1)

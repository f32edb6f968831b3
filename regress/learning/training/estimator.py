"""Offers one network as a scikit-learn estimator, for any data."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils import Tags, check_random_state
from sklearn.utils.validation import check_is_fitted, validate_data

from regress.learning.levenberg_marquardt import Result, Settings, minimise, minimise_with_evidence
from regress.learning.networks import Layout, NetworkProblem, Rows, draw_ridge_knots, fold, ridge_directions
from regress.runtime.networks import evaluate

_RIDGE_FACTOR = 3.0
"""A start's ridge strength in units of alpha, as in ``training.fitting``."""


class LevenbergMarquardtRegressor(RegressorMixin, BaseEstimator):
    """A network with one hidden layer of sigmoids, trained by Levenberg-Marquardt from ridge knots.

    For smooth functions of up to a few hundred inputs and any number of rows. Inputs and targets are z-scored
    inside. The same data and ``random_state`` give the same network.

    Parameters
    ----------
    hidden
        Sigmoid units.
    alpha
        L2 strength in units of half the sum of squares of z-scored targets: one number; several, of which the
        one with the least error on held-out rows is kept; or ``"evidence"`` (see
        ``levenberg_marquardt.evidence``), which holds no rows out.
    steps, patience
        Of the iterations; patience counts steps without a better held-out error.
    validation_fraction
        Share of the rows held out for early stopping and for choosing alpha; of no use to ``"evidence"``.
    random_state : int, numpy RandomState or None
        Seed of the start and of the held-out rows; None: another one each time.

    Attributes
    ----------
    alpha_ : float
        The strength of the network that was kept.
    error_ : float
        Its mean squared error in z-scored targets, on held-out rows (``"evidence"``: on all).
    result_ : regress.learning.levenberg_marquardt.Result
        Of all strengths that were tried; ``outcomes`` says why each one's iterations ended.
    networks_ : regress.runtime.networks.FoldedNetworks
        The network; acts on raw inputs.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.linspace(-2, 2, 200)[:, None]
    >>> network = LevenbergMarquardtRegressor(hidden=8).fit(x, np.sin(2 * x[:, 0]))
    >>> bool(network.score(x, np.sin(2 * x[:, 0])) > 0.99)
    True
    """

    def __init__(
        self,
        *,
        hidden: int = 20,
        alpha: float | Sequence[float] | str = (0.03, 0.3, 3.0, 30.0),
        steps: int = 60,
        patience: int = 6,
        validation_fraction: float = 0.15,
        random_state: Any = 0,
    ) -> None:
        self.hidden = hidden
        self.alpha = alpha
        self.steps = steps
        self.patience = patience
        self.validation_fraction = validation_fraction
        self.random_state = random_state

    def fit(self, X: np.ndarray, y: np.ndarray) -> "LevenbergMarquardtRegressor":
        """Fit to inputs (n, E) and targets (n,) or (n, k).

        Raises
        ------
        ValueError
            Where a parameter, or the data, cannot be used.
        """
        inputs, targets = validate_data(
            self, X, y, multi_output=True, y_numeric=True, dtype=np.float64, ensure_min_samples=2
        )
        alphas = self._strengths()
        self._flat = targets.ndim == 1
        targets = np.asarray(targets, dtype=np.float64).reshape(len(targets), -1)
        rng = np.random.default_rng(check_random_state(self.random_state).randint(2**31))
        kept, held_out = self._split(rng.permutation(len(inputs)))
        input_mean, input_std = inputs[kept].mean(axis=0), _spread(inputs[kept])
        target_mean, target_std = targets[kept].mean(axis=0), _spread(targets[kept])
        standard = (inputs - input_mean) / input_std
        _, rotation = np.linalg.eigh(standard[kept].T @ standard[kept])
        axes, scaled = standard @ rotation, (targets - target_mean) / target_std
        layout = Layout(inputs=inputs.shape[1], hidden=self.hidden, outputs=targets.shape[1])
        shape = (len(alphas), layout.outputs)

        def rows(numbers: np.ndarray) -> Rows:
            columns = np.concatenate([axes[numbers].T, np.ones((1, len(numbers)))])
            return Rows(inputs=columns, targets=np.broadcast_to(scaled[numbers].T, (*shape, len(numbers))))

        problem = NetworkProblem(
            layout=layout, used=np.ones(shape), train=rows(kept), held_out=(rows(held_out),)
        )
        starts = []
        for alpha in alphas:
            w1, w2 = draw_ridge_knots(
                layout=layout,
                inputs=axes[kept],
                targets=scaled[kept],
                directions=ridge_directions(axes[kept], scaled[kept], _RIDGE_FACTOR * alpha),
                alpha=alpha,
                rng=rng,
            )
            starts.append(layout.join(w1[None], w2[None])[0])
        settings = Settings(steps=int(self.steps), patience=int(self.patience))
        solve = minimise_with_evidence if isinstance(self.alpha, str) else minimise
        self.result_: Result = solve(problem, np.array(starts), alphas, settings)
        best = int(np.argmin(self.result_.error))
        self.alpha_, self.error_ = float(self.result_.alpha[best]), float(self.result_.error[best])
        self.networks_ = fold(
            layout,
            self.result_.parameters[best : best + 1],
            outputs=(layout.outputs,),
            rotation=rotation,
            input_mean=input_mean,
            input_std=input_std,
            target_mean=target_mean,
            target_std=target_std,
        )
        return self

    def predict(self, X: np.ndarray) -> np.ndarray:
        """Targets (n,) or (n, k) for inputs (n, E)."""
        check_is_fitted(self)
        outputs = evaluate(self.networks_, validate_data(self, X, reset=False, dtype=np.float64))
        return outputs[:, 0] if self._flat else outputs

    def __sklearn_tags__(self) -> Tags:
        tags = super().__sklearn_tags__()
        tags.target_tags.multi_output = True
        return tags

    def _strengths(self) -> np.ndarray:
        """Strengths to start with, after a look at all parameters."""
        for name, least in (("hidden", 1), ("steps", 1), ("patience", 1)):
            value = getattr(self, name)
            if not isinstance(value, int | np.integer) or value < least:
                raise ValueError(f"{name} is {value!r}; a whole number of {least} or more is needed")
        if not 0 < self.validation_fraction < 1:
            raise ValueError(f"validation_fraction is {self.validation_fraction!r}; it must lie in (0, 1)")
        if isinstance(self.alpha, str):
            if self.alpha != "evidence":
                raise ValueError(
                    f"alpha is {self.alpha!r}; a number, several numbers or 'evidence' are allowed"
                )
            return np.array([1.0])
        alphas = np.atleast_1d(np.asarray(self.alpha, dtype=np.float64))
        if not len(alphas) or not (alphas >= 0).all():
            raise ValueError(f"alpha is {self.alpha!r}; numbers of 0 or more are needed")
        return alphas

    def _split(self, order: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows to train on and rows to hold out, in that order; the evidence needs none held out."""
        if isinstance(self.alpha, str):
            return order, order
        held = min(max(1, round(self.validation_fraction * len(order))), len(order) - 1)
        return order[held:], order[:held]


def _spread(values: np.ndarray) -> np.ndarray:
    spread = values.std(axis=0)
    # of equal values it is rounding, and what is divided by that is huge
    rounding = len(values) * np.finfo(np.float64).eps * np.abs(values).max(axis=0, initial=0.0)
    return np.where(spread > rounding, spread, 1.0)

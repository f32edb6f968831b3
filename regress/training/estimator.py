"""One network as a scikit-learn estimator, for anyone's data."""

import numpy as np
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_is_fitted, validate_data

from regress.levenberg_marquardt import Settings, minimise
from regress.networks import Layout, NetworkProblem, Rows, evaluate, fold, ridge_coefficients, ridge_knots


class LevenbergMarquardtRegressor(RegressorMixin, BaseEstimator):
    """A network with one hidden layer, trained by Levenberg-Marquardt from ridge knots.

    Parameters
    ----------
    hidden
        Sigmoid units.
    alpha
        L2 strength in units of half the sum of squares of z-scored targets.
    steps, patience
        Of the iterations; patience counts steps without a better validation error.
    validation_fraction
        Share of the rows held out for early stopping.
    random_state
        Seed of the start and of the held-out rows.
    """

    def __init__(
        self,
        *,
        hidden: int = 20,
        alpha: float = 1.0,
        steps: int = 40,
        patience: int = 6,
        validation_fraction: float = 0.15,
        random_state: int = 0,
    ) -> None:
        self.hidden = hidden
        self.alpha = alpha
        self.steps = steps
        self.patience = patience
        self.validation_fraction = validation_fraction
        self.random_state = random_state

    def fit(self, X: np.ndarray, y: np.ndarray) -> "LevenbergMarquardtRegressor":
        """Fit to inputs (n, E) and targets (n,) or (n, k)."""
        inputs, targets = validate_data(self, X, y, multi_output=True, y_numeric=True, dtype=np.float64)
        self._flat = targets.ndim == 1
        targets = np.asarray(targets, dtype=np.float64).reshape(len(targets), -1)
        rng = np.random.default_rng(self.random_state)
        order = rng.permutation(len(inputs))
        held = max(1, round(self.validation_fraction * len(inputs)))
        kept, held_out = order[held:], order[:held]
        input_mean, input_std = inputs[kept].mean(axis=0), _spread(inputs[kept])
        target_mean, target_std = targets[kept].mean(axis=0), _spread(targets[kept])
        standard = (inputs - input_mean) / input_std
        _, rotation = np.linalg.eigh(standard[kept].T @ standard[kept])
        axes, scaled = standard @ rotation, (targets - target_mean) / target_std
        layout = Layout(inputs=inputs.shape[1], hidden=self.hidden, outputs=targets.shape[1])

        def rows(numbers: np.ndarray) -> Rows:
            ones = np.ones((1, len(numbers)))
            return Rows(
                inputs=np.concatenate([axes[numbers].T, ones]), targets=scaled[numbers].T[None].copy()
            )

        problem = NetworkProblem(
            layout=layout, used=np.ones((1, layout.outputs)), train=rows(kept), held_out=(rows(held_out),)
        )
        w1, w2 = ridge_knots(
            layout=layout,
            inputs=axes[kept],
            targets=scaled[kept],
            coefficients=ridge_coefficients(axes[kept], scaled[kept], 3 * self.alpha),
            alpha=self.alpha,
            rng=rng,
        )
        settings = Settings(steps=self.steps, patience=self.patience)
        self.result_ = minimise(problem, layout.join(w1[None], w2[None]), np.array([self.alpha]), settings)
        self.networks_ = fold(
            layout,
            self.result_.parameters,
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


def _spread(values: np.ndarray) -> np.ndarray:
    spread = values.std(axis=0)
    return np.where(spread > 0, spread, 1.0)

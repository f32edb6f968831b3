"""From 68 facial landmarks to avatar blendshape weights, learnt from synthetic people."""

from typing import Any

from regress.runtime.model import Model, load_model

__version__ = "0.1.0"

__all__ = ["LevenbergMarquardtRegressor", "Model", "__version__", "load_model"]


def __getattr__(name: str) -> Any:
    if (
        name == "LevenbergMarquardtRegressor"
    ):  # scikit-learn takes a second to import, which predicting need not wait
        from regress.learning.training.estimator import LevenbergMarquardtRegressor

        return LevenbergMarquardtRegressor
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

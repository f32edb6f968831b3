"""From 68 facial landmarks to avatar blendshape weights, learnt from synthetic people."""

import importlib
from typing import TYPE_CHECKING, Any

from facegen.version import __version__

if TYPE_CHECKING:
    from regress.learning.training.estimator import LevenbergMarquardtRegressor
    from regress.runtime.model import Model, load_model

__all__ = ["LevenbergMarquardtRegressor", "Model", "__version__", "load_model"]

_HOMES = {
    "LevenbergMarquardtRegressor": "regress.learning.training.estimator",
    "Model": "regress.runtime.model",
    "load_model": "regress.runtime.model",
}
"""Imported when asked for: scikit-learn takes a second, and NumPy more than all of `regress --help`."""


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(_HOMES[name]), name)

"""From 68 facial landmarks to avatar blendshape weights, learnt from synthetic people."""

from regress.model import Model, load_model

__version__ = "0.1.0"

__all__ = ["Model", "__version__", "load_model"]

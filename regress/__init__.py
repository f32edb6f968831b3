"""From 68 facial landmarks to avatar blendshape weights, learnt from synthetic people."""

__version__ = "0.1.0"

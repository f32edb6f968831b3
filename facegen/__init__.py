"""A factory of synthetic people: labelled face keypoints by the million, and what cameras inside a VR headset see."""

__version__ = "0.1.0"

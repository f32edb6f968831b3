"""What a person's profile says of the answers: own full movements read as 1, and eyes that look ahead read as 0."""

from dataclasses import replace

import numpy as np

from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import LOOKS, look_weights
from regress.runtime.stages.stage import Stage


class Ranges(Stage):
    """Stretches each weight by its factor.

    Attributes
    ----------
    factors : (52,) float64
        May be changed between two frames.
    """

    def __init__(self, factors: np.ndarray) -> None:
        self.factors = factors

    def step(self, sample: Sample) -> Sample:
        """The sample with weights in [0, 1]; NaN stays."""
        return replace(sample, weights=np.clip(sample.weights * self.factors, 0.0, 1.0))


class GazeCentre(Stage):
    """Takes away what the eyes read when they look straight ahead.

    Attributes
    ----------
    centre : (4,) float64
        Radians; zeros where nobody has looked yet.
    """

    def __init__(self, centre: np.ndarray) -> None:
        self.centre = centre

    def step(self, sample: Sample) -> Sample:
        """The sample with its gaze about the centre, and the looks that follow; one without a gaze as it is."""
        if sample.gaze is None or not self.centre.any() or np.isnan(sample.gaze).any():
            return sample
        gaze = sample.gaze - self.centre
        weights = sample.weights.copy()
        weights[LOOKS] = look_weights(gaze)
        return replace(sample, gaze=gaze, weights=weights)

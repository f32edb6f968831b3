"""Passes points through that somebody else's detector found."""

from dataclasses import replace

from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage
from track.detectors.mediapipe_head import NO_POINTS


class PointsDetector(Stage):
    """The detector of lines on standard input: samples come with their points."""

    def step(self, sample: Sample) -> Sample:
        """The sample as it is; one in which nothing came has no face."""
        return sample if sample.points is not None else replace(sample, points=NO_POINTS)

    def close(self) -> None:
        """Nothing is held."""

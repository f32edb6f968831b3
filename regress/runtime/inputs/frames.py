"""Frames of landmarks, whatever file they came from."""

from dataclasses import dataclass

import numpy as np

from regress.runtime.sample import Sample


@dataclass(frozen=True, kw_only=True)
class Frames:
    """Landmarks of n frames.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Pixels, y down, iBUG order; NaN where a frame has no face.
    labels
        What each frame is called: a frame number or a file's name.
    time_s : (n,) float64 or None
        Seconds, where the file tells.
    source
        The file or folder.
    """

    points: np.ndarray
    labels: tuple[str, ...]
    time_s: np.ndarray | None
    source: str

    @property
    def usable(self) -> np.ndarray:
        """(n,) bool: frames whose every point is a number."""
        return np.isfinite(self.points).all(axis=(1, 2))

    def samples(self) -> list[Sample]:
        """The frames one by one, as the stages take them."""
        times = [None] * len(self.labels) if self.time_s is None else self.time_s.tolist()
        return [
            Sample(label=label, time_s=time, points=points)
            for label, time, points in zip(self.labels, times, self.points, strict=True)
        ]

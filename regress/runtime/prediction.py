"""The one record in which answers travel to every writer."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.formats.weight_table import filled_times
from regress.errors import InputError
from regress.runtime.sample import Sample


@dataclass(frozen=True, kw_only=True, eq=False)
class Prediction:
    """A take's samples as they left the last stage.

    Parameters
    ----------
    samples
        Frame by frame.
    names
        Of the k weights.
    source
        File or folder that the frames came from.
    """

    samples: Sequence[Sample]
    names: tuple[str, ...] = BLENDSHAPES
    source: str = ""

    @property
    def weights(self) -> np.ndarray:
        """(n, k) float64; rows of NaN where nothing could be said."""
        return np.array([sample.weights for sample in self.samples])

    @property
    def gaze(self) -> np.ndarray | None:
        """(n, 4) float64 radians, as a sample has it; None where frames have no gaze."""
        return self._stacked("gaze")

    @property
    def head(self) -> np.ndarray | None:
        """(n, 6) float64, as a sample has it; None where nobody asked, rows of NaN where there is no face."""
        return self._stacked("head")

    @property
    def confidence(self) -> np.ndarray | None:
        """(n, 52) float64; None where nobody asked, or the model has no scores."""
        return self._stacked("confidence")

    @property
    def known_times_s(self) -> np.ndarray:
        """(n,) float64 seconds; a frame without a time, which has no weights either, takes that of the frame before.

        Raises
        ------
        InputError
            Where no frame has a time.
        """
        if any(sample.time_s is None for sample in self.samples):
            raise InputError(f"{self.source} does not say when its frames were taken; give --fps")
        return filled_times(np.array([sample.time_s for sample in self.samples]))

    def _stacked(self, field: str) -> np.ndarray | None:
        rows = [getattr(sample, field) for sample in self.samples]
        return None if any(row is None for row in rows) else np.array(rows)

"""Judges what a person showed of one face while it was recorded: whether it is of use, why not, and what it gives."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.sample import Sample
from track.session.faces import FACES
from track.session.steadiness import steadiness

SEEN_SHARE = 0.7
"""Of a recording's frames that must have a face."""

FEWEST_FRAMES = 12
"""With a face: of fewer nothing can be judged. Below 8 a second a recording goes on until they are there."""

LONGEST_S = 6.0
"""Of a recording for which pictures come slowly: two a second are enough, and nobody holds a face for longer."""

FAINT = 0.25
"""Reading of a full movement below which it was not made, or the model does not see it: gains end at 2."""

SHUT = 0.4
"""Openness below which traced lids are shut; those of 60 rendered people read below .3."""

_FULL = 0.6
"""Quantile of a recording that is the full movement: people need a third of the time to get there."""


Frame = tuple[Sample, np.ndarray]
"""A sample, and its signature."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What a face gave.

    Parameters
    ----------
    name
        Of the face.
    samples
        The frames.
    ranges
        Of another face than the neutral one: readings of its shapes.
    """

    name: str
    samples: tuple[Sample, ...] = ()
    ranges: Mapping[str, float] | None = None


class Showing:
    """What came of a face, as the cameras saw it that most frames have: without one of them others are read otherwise.

    Parameters
    ----------
    name
        Of the face.
    everything
        Frames with a face.
    missed
        How many came without one.

    Attributes
    ----------
    missing
        Names of cameras of which something is wrong and that gave no picture; empty where there are none.
    unseen
        Whether no camera saw what the face is about.
    """

    def __init__(self, name: str, everything: Sequence[Frame], *, missed: int) -> None:
        self._name, self._everything, self._came = name, everything, len(everything) + missed
        counts = Counter(_cameras(frame) for frame in everything)
        most = max(counts, key=lambda names: (counts[names], len(names)), default=frozenset())
        self._frames = [frame for frame in everything if _cameras(frame) == most]
        faulty = {name for sample, _ in self._frames for name in sample.faults if name != "points"}
        self.missing = ", ".join(sorted(faulty - most))
        self.unseen = bool(self._frames) and self._is_unseen()

    def reason(self, least_movement: float) -> str | None:
        """Why the recording is of no use; None where it is.

        Parameters
        ----------
        least_movement
            Of a signature that counts, in its unit (`steadiness`).
        """
        count, came = len(self._frames), self._came
        if came < FEWEST_FRAMES:
            if came == 0:
                return f"No picture came in {LONGEST_S:g} seconds"
            return (
                f"Only {came} pictures came in {LONGEST_S:g} seconds, and {FEWEST_FRAMES} are needed: "
                "camera or machine is too slow"
            )
        least = max(FEWEST_FRAMES, round(SEEN_SHARE * came))
        if count < least <= len(self._everything):
            return (
                f"{self._unsteady()} came and went: the same cameras gave a picture in {count} of {came} frames, and "
                f"{least} are needed"
            )
        if count < least:
            return f"Your face was seen in {count} of {came} frames, and {least} are needed"
        if self._name == "neutral":
            seen = steadiness(np.array([signature for _, signature in self._frames]), least=least_movement)
            return (
                None if seen.still else f"You moved, by {seen.moved / seen.allowed:.1f} times what is allowed"
            )
        if self.unseen:
            why = f", as no picture of {self.missing} is of use" if self.missing else ""
            return f"No camera sees it{why}"
        faint = [name for name, reading in self._readings().items() if reading < FAINT]
        if faint and len(faint) == len(self._readings()) and not self._lids_shut():
            return f"Nothing was seen of it ({', '.join(faint)} {self._readings()[faint[0]]:.2f})"
        return None

    def _lids_shut(self) -> bool:
        """Whether traced lids say that eyes were shut, of which the network's own weight says nothing."""
        eyes = [sample.eyes.openness for sample, _ in self._frames if sample.eyes is not None]
        if self._name != "eyes_shut" or not eyes:
            return False
        seen = np.array(eyes)[:, np.isfinite(eyes).any(axis=0)]
        return bool(seen.size) and bool((np.nanmedian(seen, axis=0) < SHUT).all())

    def _is_unseen(self) -> bool:
        """Whether no camera saw what this face is about."""
        if self._name == "look_around":
            gazes = [sample.gaze for sample, _ in self._frames if sample.gaze is not None]
            return bool(gazes) and not np.isfinite(gazes).any()
        return bool(FACES[self._name].shapes) and not self._readings()

    def _readings(self) -> dict[str, float]:
        weights = np.array([sample.weights for sample, _ in self._frames])
        full = np.quantile(weights, _FULL, axis=0)
        readings = {name: float(full[BLENDSHAPE_INDEX[name]]) for name in FACES[self._name].shapes}
        return {name: reading for name, reading in readings.items() if np.isfinite(reading)}

    def outcome(self) -> Outcome:
        """What it gives, where nothing is wrong with it."""
        samples = tuple(sample for sample, _ in self._frames)
        if self._name == "neutral":
            return Outcome(name=self._name, samples=samples)
        readings = {name: reading for name, reading in self._readings().items() if reading >= FAINT}
        return Outcome(name=self._name, samples=samples, ranges=readings)

    def _unsteady(self) -> str:
        seen = [_cameras(frame) for frame in self._everything]
        return ", ".join(sorted(frozenset().union(*seen) - frozenset.intersection(*seen)))


def _cameras(frame: Frame) -> frozenset[str]:
    return frozenset(frame[0].pictures or ())

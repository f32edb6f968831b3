"""Makes of a pipeline's answers those of one person: by their ranges, their gaze's centre, their mirror, and rest."""

from collections.abc import Sequence

import numpy as np

from regress.runtime.sample import Sample
from regress.runtime.stages.output import Mirror
from regress.runtime.stages.own_blinks import OwnBlinks
from track.profile.profile import Profile
from track.session.fading import Fading
from track.session.ranges import GazeCentre, HeadCentre, Ranges, blinks_known, by_lids


class Person:
    """What goes between the pipeline and the sinks.

    Parameters
    ----------
    profile
        Of the person and camera.
    mirrored
        Whether left and right are exchanged.
    blinks
        Learns how the person's own blinks read; None to leave them as they are read.

    Attributes
    ----------
    mirrored
        May be changed between two frames.
    """

    def __init__(self, profile: Profile, *, mirrored: bool, blinks: OwnBlinks | None = None) -> None:
        self.mirrored = mirrored
        self._blinks, self._neutral = blinks, profile.neutral
        if blinks is not None:
            blinks.known = blinks_known(profile)
        self._ranges = Ranges(profile.factors(), profile.at_rest(), by_lids(profile))
        self._centre, self._ahead = GazeCentre(centre_of(profile.gaze)), HeadCentre(_ahead(profile))
        self._mirror, self._fading = Mirror(), Fading()

    @property
    def settling(self) -> bool:
        """Whether the face still goes to rest, or comes back: it then moves without any picture."""
        return self._fading.under_way

    def use(self, profile: Profile) -> None:
        """Go by another profile from the next frame on."""
        self._ranges.factors, self._ranges.rests = profile.factors(), profile.at_rest()
        self._ranges.by_lids = by_lids(profile)
        if self._blinks is not None:
            self._blinks.known = blinks_known(profile)
            if profile.neutral != self._neutral:
                self._blinks.forget()
        self._neutral = profile.neutral
        self._centre.centre, self._ahead.centre = centre_of(profile.gaze), _ahead(profile)

    def unknown(self) -> np.ndarray:
        """(52,) NaN: the weights of a frame without a face."""
        return np.full(len(self._ranges.factors), np.nan)

    def step(self, sample: Sample, *, unseen: Sequence[bool] = (False, False)) -> Sample:
        """A frame behind the pipeline, as the person and the avatar want it; ``unseen`` as `Pipeline.unseen_eyes`."""
        sample = self._ahead.step(self._centre.step(sample))
        if self._blinks is not None:
            self._blinks.unseen = np.array(unseen)
            sample = self._blinks.step(sample)
        sample = self._ranges.step(sample)
        if self.mirrored:
            sample = self._mirror.step(sample)
        return self._fading.step(sample)


def centre_of(gaze: Sequence[float] | None) -> np.ndarray:
    """What a profile's eyes read (4,) where they look straight ahead; zeros where it does not say."""
    return np.zeros(4) if gaze is None else np.array(gaze)


def other_side(shape: str) -> str:
    """A shape's name on the other side of the face; its own where it has no side."""
    left, right = shape.replace("Left", "Right"), shape.replace("Right", "Left")
    return left if left != shape else right


def _ahead(profile: Profile) -> np.ndarray:
    return np.zeros(3) if profile.head is None else np.array(profile.head)

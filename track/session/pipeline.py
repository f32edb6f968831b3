"""The one interface of what turns a frame into weights: of landmarks, or of a headset's pictures."""

from collections.abc import Mapping, Sequence
from enum import Enum
from pathlib import Path

import numpy as np

from regress.runtime.headset.person.person import OwnEye
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.sample import Sample
from regress.runtime.stages.filters import FILTERS
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import filter_stage
from regress.runtime.stages.smoothing import OneEuroSmoothing
from regress.runtime.stages.stage import Stage
from track.errors import InputError
from track.profile.neutral import NeutralFace
from track.profile.profile import ModelMark
from track.session.faces import OF_ALL

GROUPS = "groups"
"""The filter of live faces: One-Euro, with `FASTER`."""

FASTER: Mapping[str, float] = {"eyes": 3.0, "brows": 0.5}
"""Factor on One-Euro's cutoff at rest by region: a blink is over in a tenth of a second, brows take their time and are
what detectors shake most."""


class Pipeline:
    """Stages from pictures to weights, by name, and what calibration needs to know of them.

    Attributes
    ----------
    stages
        In their order; one may be exchanged between two frames.
    mark
        Of the model.
    least_movement
        Of a signature, in its unit, that counts as a movement (`track.session.steadiness`).
    faces
        Names of `track.session.faces.FACES` that it sees enough of.
    listens
        Whether it can be told where cameras are.
    measures_eyes
        Whether its samples have ``eyes``.
    """

    stages: dict[str, Stage]
    mark: ModelMark
    least_movement: float
    faces: tuple[str, ...] = OF_ALL
    listens: bool = False
    measures_eyes: bool = False

    def signature(self, sample: Sample) -> np.ndarray | None:
        """What of a frame must keep still while a neutral face is recorded; None where there is no face."""
        raise NotImplementedError

    def calibrated_by(self, sample: Sample) -> Sample:
        """What of a frame a calibration has to keep for seconds."""
        return sample

    def unseen_eyes(self, sample: Sample) -> tuple[bool, bool]:
        """Which eyes no camera sees in a frame, the left one first: what is said of them is guessed."""
        return False, False

    def neutral_of(self, samples: Sequence[Sample]) -> NeutralFace:
        """The neutral face of frames that show it."""
        raise NotImplementedError

    def rests_of(self, samples: Sequence[Sample]) -> dict[str, float]:
        """What the weights of a neutral face read behind it, by shape; nothing where they are 0."""
        return {}

    def use_eyes(self, eyes: Mapping[str, OwnEye]) -> None:
        """Count with a person's own lids from now on, by camera; without cameras of eyes there is nothing to do."""

    def eyes_with(
        self, eyes: Mapping[str, OwnEye], face: str, samples: Sequence[Sample]
    ) -> dict[str, OwnEye]:
        """A person's own eyes, by camera, with what frames of a face say of them."""
        return dict(eyes)

    def use_straight_ahead(self, gaze: np.ndarray) -> None:
        """Take what eyes read (4,) where they look straight ahead; who does not lead closed eyes there needs it not."""

    def use_neutral(self, neutral: NeutralFace) -> None:
        """Compare frames with this neutral face from now on.

        Raises
        ------
        InputError
            Where it is of another kind of model, other cameras or another detector.
        """
        raise NotImplementedError

    @property
    def own_neutral(self) -> NeutralFace | None:
        """The neutral face that it found by itself, another object with each find; None where none is in use."""
        return None

    def read_placement(self, path: Path) -> dict[str, CameraPlacement]:
        """Placements of the cameras out of a file.

        Raises
        ------
        InputError
            Where it cannot be read or is of another model, or this one takes points.
        """
        raise InputError(f"--placement {path} is for a headset's cameras, and the model takes points")

    def accepts_placement_of(self, mark: ModelMark) -> bool:
        """Whether a placement that was found with another model is right for this one."""
        return mark == self.mark

    def use_placement(self, placement: Mapping[str, CameraPlacement]) -> None:
        """See this of each camera's pictures from now on; a landmark model's detector looks for the face itself."""

    def use_cameras(self, terms: Mapping[str, Sequence[float]]) -> None:
        """Count with cameras at these places from now on: `facegen.conventions.CAMERA_TERMS` (14,) by camera.

        Only a model that `listens` is told.
        """

    def forget_neutral(self) -> None:
        """Take frames by themselves while a neutral face is recorded."""

    def points(self, sample: Sample) -> Mapping[str, np.ndarray]:
        """Points (n, 2) to draw, in pixels of the sample's pictures, by camera."""
        raise NotImplementedError

    def sentences(self, sample: Sample) -> dict[str, str]:
        """What is wrong with a frame, for the person, by what it concerns."""
        return sentences_of(sample.faults)

    def close(self) -> None:
        """Let go what the stages hold."""


def sentences_of(faults: Mapping[str, Enum]) -> dict[str, str]:
    """A sentence of each fault, by what has it; none of those that nobody needs to know."""
    return {name: f"{name} has {words(fault)}" for name, fault in faults.items() if words(fault)}


def words(fault: Enum) -> str:
    """A fault's value, as part of a sentence; empty where there is nothing to tell."""
    return str(fault.value)


def filter_of(name: str) -> Stage | None:
    """A new stage of a filter: `GROUPS`, one of `FILTERS`, or none.

    Raises
    ------
    InputError
        Where no filter has that name.
    """
    if name == "none":
        return None
    if name == GROUPS:
        return OneEuroSmoothing(OneEuro(), FASTER)
    if name not in FILTERS:
        raise InputError(f"there is no filter {name[:40]!r}; {GROUPS}, none, {', '.join(FILTERS)} are known")
    return filter_stage(name)

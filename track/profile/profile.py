"""What is known of a person before a camera: one TOML file, typed both ways.

::

    format = "track-profile"
    version = 1
    person = "anna"
    camera = "camera 0"

    [model]                     # whose readings the ranges are
    kind = "landmarks"
    sha256 = "..."

    [neutral]                   # the resting face as this camera and detector give it
    detector = "mediapipe"
    picture = [640, 480]        # pixels
    points = ["311.20, 240.77, ...", ...]   # a frame a line: x and y of 68 points, pixels
    irises = ["401.05, 233.11, ...", ...]   # of the same frames; the subject's left eye first
    heads = ["0.0112, ...", ...]            # as `regress.runtime.sample.Sample.head`

    [ranges]                    # what the model reads of the person's own full movement
    jawOpen = 0.71

    [blinks.eyeBlinkLeft]       # what it reads of an eye between blinks, and of a full one in passing
    open = 0.1
    full = 0.55
"""

import os
from pathlib import Path
from typing import Annotated, Literal, get_args

import numpy as np
from annotated_types import Len
from pydantic import AfterValidator, Field, FiniteFloat, ValidationError

from facegen.conventions import BLENDSHAPE_INDEX, CAMERA_TERMS
from facegen.documents import load_toml
from facegen.files import output_errors, write_whole
from facegen.refusals import refusal
from regress.runtime.headset.person.person import FULL_GAIN as HEADSET_GAIN
from regress.runtime.headset.person.person import HIGHEST_REST, OwnEye
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.stages.own_blinks import Ends
from track.errors import InputError
from track.profile.neutral import MOST_CAMERAS, Name, NeutralFace, Record

MOST_BYTES = 2**20
"""Of a profile: neutral pictures of eight cameras of 400 x 400 pixels as PNG, and all numbers ten times over."""

LARGEST_GAIN = 4.0
"""A person's own factor on a shape; beyond it noise of half a hundredth shows as movement."""

FULL_GAIN = 2.0
"""Most by which a range stretches a shape: beyond it what is stretched is noise (regress.learning.training.gain). Of
headset networks `regress.runtime.headset.person.person.FULL_GAIN` is, which was measured; blinks are never held to
it."""

SMALLEST_RANGE = 0.05
"""Reading of a full movement below which the model does not see it."""

Hash = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
CameraTerms = Annotated[tuple[FiniteFloat, ...], Len(len(CAMERA_TERMS), len(CAMERA_TERMS))]


def _arkit_name(name: str) -> str:
    if name not in BLENDSHAPE_INDEX:
        raise ValueError("is not one of the 52 ARKit names")
    return name


Shape = Annotated[str, AfterValidator(_arkit_name)]
Blink = Literal["eyeBlinkLeft", "eyeBlinkRight"]
_BLINKS = get_args(Blink)


class ModelMark(Record):
    """Which model the ranges were read by.

    Parameters
    ----------
    kind
        ``"landmarks"`` or ``"headset"``.
    sha256
        Of what the folder holds of the networks.
    """

    kind: Literal["landmarks", "headset"]
    sha256: Hash


class Profile(Record):
    """A person before a camera.

    Parameters
    ----------
    person, camera
        Whose it is, and the title of the camera; of several, all of them.
    model
        None until something was read by one.
    neutral
        None until the person was asked.
    ranges
        Reading of the person's full movement, by shape.
    rests
        Reading of the resting face, by shape; of headsets.
    blinks
        What was read of the person's blinks while nobody asked for them.
    eyes
        Own ends of the lids, by camera; of headsets.
    gains
        The person's own factors, by shape.
    gaze : 4 radians
        What the eyes read when they look straight ahead: yaw and pitch of the left eye, then of the right one.
    head : 3 radians
        How the head reads turned when it looks straight ahead, as where the camera stands beside the screen: yaw,
        pitch and roll.
    mirror
        Whether left and right are exchanged.
    placement
        What of a headset camera's pictures the network is to see, by camera.
    told_cameras
        Where a headset's cameras are, by camera: `facegen.conventions.CAMERA_TERMS`, for networks that are told.
    """

    format: Literal["track-profile"] = "track-profile"
    version: Literal[1] = 1
    person: Name
    camera: Name
    mirror: bool = False
    gaze: Annotated[tuple[FiniteFloat, ...], Len(4, 4)] | None = None
    head: Annotated[tuple[FiniteFloat, ...], Len(3, 3)] | None = None
    model: ModelMark | None = None
    neutral: NeutralFace | None = None
    ranges: dict[Shape, Annotated[FiniteFloat, Field(ge=SMALLEST_RANGE, le=1.0)]] = Field(
        default_factory=dict
    )
    rests: dict[Shape, Annotated[FiniteFloat, Field(ge=0.0, le=HIGHEST_REST)]] = Field(default_factory=dict)
    blinks: dict[Blink, Ends] = Field(default_factory=dict)
    eyes: Annotated[dict[Name, OwnEye], Len(0, MOST_CAMERAS)] = Field(default_factory=dict)
    gains: dict[Shape, Annotated[FiniteFloat, Field(ge=0.0, le=LARGEST_GAIN)]] = Field(default_factory=dict)
    placement: Annotated[dict[Name, CameraPlacement], Len(0, MOST_CAMERAS)] = Field(default_factory=dict)
    told_cameras: Annotated[dict[Name, CameraTerms], Len(0, MOST_CAMERAS)] = Field(default_factory=dict)

    def factors(self) -> np.ndarray:
        """(52,) float64: by what each weight is multiplied, so that a full movement reads 1, times the own gain."""
        rest = self.at_rest()
        factors = 1 / (1 - rest)
        for name, reading in self.ranges.items():
            column = BLENDSHAPE_INDEX[name]
            span = max(reading - rest[column], SMALLEST_RANGE)
            factors[column] = np.clip(1 / span, factors[column], self.most_gain(name) * factors[column])
        for name, gain in self.gains.items():
            factors[BLENDSHAPE_INDEX[name]] *= gain
        return factors

    def most_gain(self, shape: str) -> float:
        """Most by which a shape's range stretches it."""
        guessed = self.model is not None and self.model.kind == "headset" and shape not in _BLINKS
        return HEADSET_GAIN if guessed else FULL_GAIN

    def at_rest(self) -> np.ndarray:
        """(52,) float64: what is taken from each weight before."""
        rest = np.zeros(len(BLENDSHAPE_INDEX))
        for name, reading in self.rests.items():
            rest[BLENDSHAPE_INDEX[name]] = reading
        return rest


def read_profile(path: str | os.PathLike[str]) -> Profile:
    """Read a profile.

    Raises
    ------
    InputError
        Where there is none, or it says something that is not known.
    """
    path = Path(path)
    try:
        return Profile.model_validate(load_toml(path, most_bytes=MOST_BYTES))
    except ValidationError as error:
        raise InputError(f"{path}: {refusal(error, Profile)}") from error


def write_profile(path: str | os.PathLike[str], profile: Profile) -> Path:
    """Write a profile whole, and its folder where there is none; returns the name.

    Raises
    ------
    OutputError
        Where it cannot be written.
    """
    import tomli_w

    path = Path(path)
    with output_errors(path.parent):
        path.parent.mkdir(parents=True, exist_ok=True)
    return write_whole(path, tomli_w.dumps(profile.model_dump(mode="json", exclude_none=True)))

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
"""

import base64
import os
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from annotated_types import Len
from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    FiniteFloat,
    ValidationError,
    model_validator,
)

from facegen.conventions import BLENDSHAPE_INDEX, CAMERA_TERMS, LANDMARK_COUNT
from facegen.documents import load_toml
from facegen.files import output_errors, write_whole
from facegen.refusals import refusal
from regress.runtime.headset.person import HIGHEST_REST, OwnEye
from regress.runtime.headset.placement import CameraPlacement
from track.errors import InputError

MOST_BYTES = 2**20
"""Of a profile: neutral pictures of eight cameras of 400 x 400 pixels as PNG, and all numbers ten times over."""

MOST_FRAMES = 32
"""Of a neutral face: the median of 16 is good to a quarter of the detector's noise."""

MOST_CAMERAS = 64
"""Neutral pictures of a profile, as many as a headset model may have cameras."""

MOST_PICTURE_CHARACTERS = 2**18
"""Of one neutral picture in base64: 400 x 400 grey levels that do not compress take 213,000."""

MOST_NAME_CHARACTERS = 200
"""Of a person, a camera, a detector: what a file's name can hold, with an address as a camera."""

LARGEST_GAIN = 4.0
"""A person's own factor on a shape; beyond it noise of half a hundredth shows as movement."""

FULL_GAIN = 2.0
"""Most by which a range stretches a shape: beyond it what is stretched is noise (regress.learning.training.gain)."""

SMALLEST_RANGE = 0.05
"""Reading of a full movement below which the model does not see it."""

Name = Annotated[str, Field(min_length=1, max_length=MOST_NAME_CHARACTERS)]
Hash = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
Side = Annotated[int, Field(ge=8, le=65535)]
CameraTerms = Annotated[tuple[FiniteFloat, ...], Len(len(CAMERA_TERMS), len(CAMERA_TERMS))]
Picture = Annotated[str, Field(max_length=MOST_PICTURE_CHARACTERS)]


def _arkit_name(name: str) -> str:
    if name not in BLENDSHAPE_INDEX:
        raise ValueError("is not one of the 52 ARKit names")
    return name


Shape = Annotated[str, AfterValidator(_arkit_name)]


def _values(line: str) -> list[float]:
    return [float(word) for word in line.split(",")]


def _numbers(count: int) -> AfterValidator:
    """Lines of so many finite numbers."""

    def check(line: str) -> str:
        try:
            fine = (
                len(line) <= 25 * count
                and np.isfinite(values := _values(line)).all()
                and len(values) == count
            )
        except ValueError:
            fine = False
        if not fine:
            raise ValueError(f"must be {count} finite numbers with commas between them, in a text")
        return line

    return AfterValidator(check)


_Lines = Len(1, MOST_FRAMES)


class _Record(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class ModelMark(_Record):
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


class NeutralFace(_Record):
    """A resting face: points for landmark models, pictures for headsets.

    Parameters
    ----------
    detector
        What found the points; another one puts them elsewhere. None for headsets.
    picture
        Width and height of the pictures in which it found them.
    points, irises, heads
        Of the same frames, 16 or so, looking into the camera; the last two where the detector gives them.
    pictures
        Grey PNG in base64 by camera, at the model's size; none for landmark models.
    """

    detector: Name | None = None
    picture: tuple[Side, Side] | None = None
    points: Annotated[tuple[Annotated[str, _numbers(2 * LANDMARK_COUNT)], ...], _Lines] | None = None
    irises: Annotated[tuple[Annotated[str, _numbers(4)], ...], _Lines] | None = None
    heads: Annotated[tuple[Annotated[str, _numbers(6)], ...], _Lines] | None = None
    pictures: Annotated[dict[Name, Picture], Len(0, MOST_CAMERAS)] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _frames_agree(self) -> "NeutralFace":
        counts = {len(lines) for lines in (self.points, self.irises, self.heads) if lines is not None}
        if len(counts) > 1:
            raise ValueError("points, irises and heads must be of the same frames")
        return self

    def frames(self, name: str) -> np.ndarray | None:
        """``points`` (m, 68, 2), ``irises`` (m, 2, 2) or ``heads`` (m, 6) as numbers."""
        lines = getattr(self, name)
        if lines is None:
            return None
        values = np.array([_values(line) for line in lines])
        return values if name == "heads" else values.reshape(len(values), -1, 2)


def lines_of(frames: np.ndarray, *, places: int) -> tuple[str, ...]:
    """Frames of numbers as a neutral face holds them, a line each."""
    return tuple(", ".join(f"{value:.{places}f}" for value in frame.ravel()) for frame in frames)


class Profile(_Record):
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
    eyes
        Own ends of the lids, by camera; of headsets.
    gains
        The person's own factors, by shape.
    gaze : 4 radians
        What the eyes read when they look straight ahead: yaw and pitch of the left eye, then of the right one.
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
    model: ModelMark | None = None
    neutral: NeutralFace | None = None
    ranges: dict[Shape, Annotated[FiniteFloat, Field(ge=SMALLEST_RANGE, le=1.0)]] = Field(
        default_factory=dict
    )
    rests: dict[Shape, Annotated[FiniteFloat, Field(ge=0.0, le=HIGHEST_REST)]] = Field(default_factory=dict)
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
            factors[column] = np.clip(1 / span, factors[column], FULL_GAIN * factors[column])
        for name, gain in self.gains.items():
            factors[BLENDSHAPE_INDEX[name]] *= gain
        return factors

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


def base64_of(png: bytes) -> str:
    """A neutral picture as the file holds it."""
    return base64.b64encode(png).decode("ascii")

"""A resting face as a profile holds it: lines of numbers, or pictures."""

import base64
from typing import Annotated

import numpy as np
from annotated_types import Len
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from facegen.conventions import LANDMARK_COUNT

MOST_FRAMES = 32
"""Of a neutral face: the median of 16 is good to a quarter of the detector's noise."""

MOST_CAMERAS = 64
"""Neutral pictures of a profile, as many as a headset model may have cameras."""

MOST_PICTURE_CHARACTERS = 2**18
"""Of one neutral picture in base64: 400 x 400 grey levels that do not compress take 213,000."""

MOST_NAME_CHARACTERS = 200
"""Of a person, a camera, a detector: what a file's name can hold, with an address as a camera."""

Name = Annotated[str, Field(min_length=1, max_length=MOST_NAME_CHARACTERS)]
Side = Annotated[int, Field(ge=8, le=65535)]
Picture = Annotated[str, Field(max_length=MOST_PICTURE_CHARACTERS)]


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


class Record(BaseModel):
    """A part of a profile: no key but its own, and nothing of it changes."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class NeutralFace(Record):
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


def base64_of(png: bytes) -> str:
    """A neutral picture as the file holds it."""
    return base64.b64encode(png).decode("ascii")

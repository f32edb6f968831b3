"""Keeps what a guided minute has found of a person: rest, own ends of every range, lids, gaze, neutral pictures.

::

    {"kind": "headset-person", "version": 2, "network_sha256": "...",
     "rest": {"jawOpen": 0.02}, "full": {"jawOpen": 0.71},
     "eyes": {"left_eye": {"shut_mm": 1.2, "rest_mm": 8.9, "wide_mm": 10.8, "lids": 0.4, "gaze": [...]}},
     "neutral": {"left_eye": "<PNG in base64>"}}
"""

import base64
import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import cv2
import numpy as np
from annotated_types import Ge, Interval, Le, Len

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLINK_INDICES
from facegen.files import write_whole
from facegen.formats.picture_size import picture_size
from regress.errors import InputError
from regress.runtime.documents import checked, read_document
from regress.runtime.headset.network.model import MOST_CAMERAS
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.sample import EyeMeasures

MOST_PERSON_BYTES = 2**24
"""Of a person's file: 64 neutral pictures of `MOST_PICTURE_CHARACTERS`."""

MOST_PICTURE_CHARACTERS = 2**18
"""Of one neutral picture in base64: 400 x 400 grey levels that do not compress take 213,000."""

FULL_GAIN = 1.3
"""Most by which a range is stretched: a network reads low what it does not see well, and a stretched guess is still a
guess. On eight rendered people 1.3 gives back the 2.5 % that a rest of 0 gains, and 2 loses 5 % (docs/measurements/
headset-networks.md). Lids are not held to it, for how noisy a blink reads is measured."""

LEAST_SPAN = 0.15
"""Between readings of rest and of a full movement, below which the network does not see it, or it was not made."""

HIGHEST_REST = 0.5
"""Reading at rest; where more than a few shapes are above it, or a blink is, the face was not at rest."""

HIGHEST_KEPT = 0.9
"""Reading at rest that is taken away at most: what is left of the range would be noise."""

_WIDEST_MM = 40.0
"""Between a person's lids: more is an iris that was traced too small, by which millimetres are counted."""

Millimetres = Annotated[float, Interval(ge=0, le=_WIDEST_MM)]
Row = Annotated[tuple[Annotated[float, Interval(ge=-1000, le=1000)], ...], Len(3, 3)]
Affine = Annotated[tuple[Row, ...], Len(2, 2)]
"""Yaw and pitch in degrees from an answer's yaw and pitch and 1."""


@dataclass(frozen=True, kw_only=True)
class OwnEye:
    """One eye of a person, before one camera.

    Parameters
    ----------
    shut_mm, rest_mm, wide_mm
        Mean distance of the lids' margins, traced; what was not recorded is None.
    lids
        How much traced lids count against the network's eyeBlink, by how far each was off.
    traced, direct
        What sets the gaze of traced points and the direct answer right; None where no targets were looked at.
    traced_share
        How much the first counts against the second.
    error_deg
        Of the gaze at the targets.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}

    shut_mm: Millimetres | None = None
    rest_mm: Millimetres | None = None
    wide_mm: Millimetres | None = None
    lids: Annotated[float, Interval(ge=0, le=1)] = 0.0
    traced: Affine | None = None
    direct: Affine | None = None
    traced_share: Annotated[float, Interval(ge=0, le=1)] = 0.0
    error_deg: Annotated[float, Interval(ge=0, le=180)] = 1.0

    def openness(self, openness_mm: float) -> float:
        """Share of the way from shut to rest; NaN where either is not known."""
        if self.shut_mm is None or self.rest_mm is None or self.rest_mm <= self.shut_mm:
            return float("nan")
        return (openness_mm - self.shut_mm) / (self.rest_mm - self.shut_mm)


def kept_openness(openness_mm: float) -> float:
    """A measured distance of the lids as a person's file keeps it and takes it back."""
    return round(float(np.clip(openness_mm, 0, _WIDEST_MM)), 3)


@dataclass(frozen=True, kw_only=True)
class Person:
    """Own ends of a person's ranges, as one network reads them.

    Parameters
    ----------
    kind, version
        Of this kind of file. In those of version 1 the gaze of traced points of a network of many headsets was read by
        another map: `without_gaze` takes it out.
    network_sha256
        Of the network that read them.
    rest, full
        Readings of the resting face and of own full movements, by shape; those left out are 0 and 1.
    eyes
        By camera.
    neutral
        Neutral pictures by camera, as the network sees them before levels are set: grey PNG in base64.
    seen_as
        What `seen_as` gave when the person was read: they are not the same through other views. None where nobody says.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}

    kind: Literal["headset-person"] = "headset-person"
    version: Literal[1, 2] = 2
    network_sha256: Annotated[str, Len(0, 64)] = ""
    rest: dict[str, Annotated[float, Ge(0), Le(HIGHEST_KEPT)]] = field(default_factory=dict)
    full: dict[str, Annotated[float, Ge(LEAST_SPAN), Le(1)]] = field(default_factory=dict)
    eyes: Annotated[dict[str, OwnEye], Len(0, MOST_CAMERAS)] = field(default_factory=dict)
    neutral: Annotated[dict[str, Annotated[str, Len(0, MOST_PICTURE_CHARACTERS)]], Len(0, MOST_CAMERAS)] = (
        field(default_factory=dict)
    )
    seen_as: Annotated[str, Len(0, 64)] | None = None

    def without_gaze(self) -> "Person":
        """The same person, of whose gaze nothing is known."""
        eyes = {
            name: replace(eye, traced=None, direct=None, traced_share=0.0) for name, eye in self.eyes.items()
        }
        return replace(self, eyes=eyes)

    def __post_init__(self) -> None:
        """Refuse shapes that there are not."""
        strangers = [name for name in (*self.rest, *self.full) if name not in BLENDSHAPE_INDEX]
        if strangers:
            raise ValueError(f"{strangers[0][:60]!r} is not one of the 52 ARKit names")


def seen_as(places: Mapping[str, CameraPlacement], told: np.ndarray | None) -> str:
    """A word for the views through which cameras are looked at, and for what the network is told of them.

    Levels are left out: they follow a person's pictures.
    """
    views = {
        # only where they are something, so that files of before there were any still fit
        name: (one.x, one.y, one.size, one.roll_deg, one.mirror)
        + ((one.stretch, list(one.cut)) if one.stretch != 1 or any(one.cut) else ())
        for name, one in places.items()
    }
    terms = None if told is None else np.round(told.astype(np.float64), 6).tolist()
    return hashlib.sha256(json.dumps([views, terms], sort_keys=True).encode()).hexdigest()


class OwnEnds:
    """Stretches weights so that the person's rest reads 0 and own full movements read 1.

    Parameters
    ----------
    rest, full
        Readings by shape.
    lids
        How much traced lids count in eyeBlink, (2,), left first.
    """

    def __init__(self, rest: Mapping[str, float], full: Mapping[str, float], lids: np.ndarray) -> None:
        self._rest = np.array([rest.get(name, 0.0) for name in BLENDSHAPES])
        top = np.array([full.get(name, 1.0) for name in BLENDSHAPES])
        least = np.full(len(BLENDSHAPES), 1 / FULL_GAIN)
        least[BLINK_INDICES] = LEAST_SPAN
        self._span = np.maximum(top - self._rest, least * np.minimum(1.0, 1.0 - self._rest))
        self._lids = lids

    @classmethod
    def of(cls, person: Person, sides: Mapping[str, int]) -> "OwnEnds":
        """Those of a person; ``sides`` says which eye each camera traces, 0 for the left one."""
        lids = np.zeros(2)
        for camera, side in sides.items():
            if camera in person.eyes:
                lids[side] = person.eyes[camera].lids
        return cls(person.rest, person.full, lids)

    def apply(self, weights: np.ndarray, eyes: EyeMeasures | None) -> np.ndarray:
        """Weights (52,) in [0, 1]; NaN stays."""
        moved = np.clip((weights - self._rest) / self._span, 0, 1)
        if eyes is not None:
            shut = np.clip(1 - eyes.openness, 0, 1)
            known = np.isfinite(shut)
            lids = np.where(known, self._lids, 0.0)
            moved[BLINK_INDICES] = (1 - lids) * moved[BLINK_INDICES] + lids * np.where(known, shut, 0.0)
        return moved


def read_person(path: str | os.PathLike[str]) -> Person:
    """Read a person's file.

    Raises
    ------
    InputError
        Where it is missing or too large, or says what is not allowed.
    """
    path = Path(path)
    document = read_document(path, most_bytes=MOST_PERSON_BYTES)
    try:
        return checked(Person, document)
    except InputError as error:
        raise InputError(f"{path} is no person of `regress headset calibrate`: {error}") from error


def write_person(path: str | os.PathLike[str], person: Person) -> None:
    """Write a person's file whole.

    Raises
    ------
    InputError
        Where a neutral picture has more in it than a file may hold.
    OutputError
        Where it cannot be written.
    """
    for name, picture in person.neutral.items():
        if len(picture) > MOST_PICTURE_CHARACTERS:
            raise InputError(
                f"the neutral picture of {name} takes {len(picture):,} characters, and a person's file has "
                f"{MOST_PICTURE_CHARACTERS:,} for each; train a network of smaller pictures"
            )
    write_whole(Path(path), json.dumps(asdict(person), indent=1, allow_nan=False) + "\n")


def packed_picture(picture: np.ndarray) -> str:
    """A neutral picture (h, w) uint8 as the file holds it."""
    return base64.b64encode(cv2.imencode(".png", picture)[1].tobytes()).decode("ascii")


def unpacked_picture(text: str, *, width: int, height: int, of: str) -> np.ndarray:
    """A neutral picture (h, w) uint8 of a file.

    Raises
    ------
    InputError
        Where it is no picture of this size; ``of`` says of what.
    """
    try:
        content = base64.b64decode(text)
    except ValueError:  # no base64
        content = b""
    # by its head, before a decoder allocates what that claims
    claimed, picture = picture_size(content), None
    if claimed == (width, height):
        picture = cv2.imdecode(np.frombuffer(content, dtype=np.uint8), cv2.IMREAD_GRAYSCALE)
    if picture is None or picture.shape != (height, width):
        size = "none" if claimed in (None, (width, height)) else f"{claimed[0]} x {claimed[1]}"
        raise InputError(
            f"the neutral picture of {of} is {size}, and the model takes {width} x {height}; calibrate again"
        )
    return picture

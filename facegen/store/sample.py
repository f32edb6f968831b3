"""Reads ``sample.json``, the labels of a rendered sample, and checks what packs, previews and `develop` rely on."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT, SPLITS
from facegen.errors import InputError, InvalidData
from facegen.refusals import refusal
from facegen.store.folder import read_json

ADVICE = "run facegen validate --repair, then facegen generate"

Number = Annotated[float, Field(allow_inf_nan=False)]
Count = Annotated[int, Field(ge=0, lt=2**63)]
Pixels = Annotated[int, Field(ge=1, le=65_536)]
Sha256 = Annotated[str, Field(pattern="^[0-9a-f]{64}$")]


def _list(kind: Any, length: int) -> Any:
    return Annotated[list[kind], Field(min_length=length, max_length=length)]


Pair = _list(Number | None, 2)
"""A point; null stands for NaN."""
Points = _list(Pair, LANDMARK_COUNT)
Visibility = _list(Annotated[int, Field(ge=0, le=2)], LANDMARK_COUNT)
Transform = _list(_list(Number, 4), 4)
Line = Annotated[list[Pair], Field(min_length=2, max_length=1000)]


class _Open(BaseModel):
    """A table that may hold further labels."""

    model_config = ConfigDict(strict=True, extra="allow")


class _Closed(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid")


class _Ellipse(_Closed):
    center: Pair
    semi_axes: Pair
    angle_rad: Number | None


class _Ellipses(_Closed):
    left: _Ellipse
    right: _Ellipse


class _Lines(_Closed):
    left: Line
    right: Line


class _Centers(_Closed):
    left: Pair
    right: Pair


class _Camera(_Open):
    model: Literal["pinhole", "fisheye"]
    width: Pixels
    height: Pixels
    fx: Annotated[Number, Field(gt=0)]
    fy: Annotated[Number, Field(gt=0)]
    cx: Number
    cy: Number


class _View(_Open):
    camera: _Camera
    camera_from_head: Transform
    points_2d: Points
    visibility: Visibility
    upper_lid_2d: _Lines
    lower_lid_2d: _Lines
    pupil_center_refracted_2d: _Centers
    pupil_ellipse: _Ellipses
    iris_ellipse: _Ellipses


class _Eye(_Open):
    optical_axis: _list(Number, 3)


class _Eyes(_Closed):
    left: _Eye
    right: _Eye


class _Headset(_Open):
    head_from_headset: Transform
    slip: _list(Number, 6)


class _Keypoints(_Open):
    points_2d: Points
    detected_2d: Points
    points_3d: _list(_list(Number | None, 3), LANDMARK_COUNT)
    visibility: Visibility
    camera_from_head: Transform
    intrinsics: _list(Number, 4)


class _Sample(_Open):
    spec_hash: Sha256
    sample: Count
    person: Count
    session: Count
    clip: Count
    frame: Annotated[int, Field(ge=0, lt=2**31)]
    time_s: Number
    split: Literal[SPLITS]
    neutral: bool
    component: str
    sex: Literal["female", "male"]
    age_years: Number
    weights: Annotated[dict[Literal[BLENDSHAPES], Number], Field(min_length=len(BLENDSHAPES))]
    identity: list[Number]
    keypoints: _Keypoints
    eyes: _Eyes
    headset: _Headset
    views: dict[str, _View]
    sha256: dict[str, Sha256]


def read_sample(path: Path, *, number: int, spec_hash: str, views: tuple[str, ...]) -> dict[str, Any]:
    """Labels of a rendered sample, as they stand in the file.

    Parameters
    ----------
    path
        ``sample.json``.
    number
        Of the sample.
    spec_hash
        Of the dataset.
    views
        Names of the headset's cameras, all of which must be there.

    Raises
    ------
    InvalidData
        If it cannot be read, is not what `facegen.store.sample_record` makes, or is another sample's.
    """
    try:
        record = read_json(path)
        if record.get("spec_hash") != spec_hash:
            raise InvalidData(f"{path}: was made from another spec; {ADVICE}")
        _Sample.model_validate(record)
    except InputError as error:
        raise InvalidData(f"{error}; {ADVICE}") from None
    except ValidationError as error:
        raise InvalidData(f"{path}: {refusal(error, _Sample)}; {ADVICE}") from None
    missing = [view for view in views if view not in record["views"]]
    if record["sample"] != number or missing:
        what = f"has no view {missing[0]!r}" if missing else f"is of sample {record['sample']}"
        raise InvalidData(f"{path}: {what}; {ADVICE}")
    return record

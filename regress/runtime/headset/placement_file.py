"""Reads and writes a placement: a TOML file that says where a person's cameras see what a network is to see.

::

    version = 1
    model = "headset-tracking3"            # for people: what it was found with

    [cameras.left_eye]
    x = 0.54                               # middle of the view, as a share of the picture's width
    y = 0.43                               # and height
    size = 1.09                            # width of the view over the picture's
    roll_deg = -5.0
    mirror = true
    low = 95.0                             # grey levels; both may be left out
    high = 254.0
"""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from annotated_types import Len

from facegen.documents import load_toml
from facegen.files import write_whole
from regress.errors import InputError
from regress.runtime.documents import checked
from regress.runtime.headset.model import MOST_CAMERAS
from regress.runtime.headset.placement import CameraPlacement


@dataclass(frozen=True, kw_only=True)
class Placement:
    """Placements of a person's cameras.

    Parameters
    ----------
    version
        Of this kind of file.
    cameras
        By name; what is not named is taken as it is.
    model
        What it was found with, for people.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}

    version: Literal[1] = 1
    cameras: Annotated[dict[str, CameraPlacement], Len(0, MOST_CAMERAS)] = field(default_factory=dict)
    model: Annotated[str, Len(0, 300)] = ""


def read_placement(path: str | os.PathLike[str], cameras: Mapping[str, object]) -> dict[str, CameraPlacement]:
    """Placements by camera.

    Parameters
    ----------
    cameras
        What the model has.

    Raises
    ------
    InputError
        Where the file is missing or too large, is no TOML, or holds a key, a value or a camera that is not allowed.
    """
    path = Path(path)
    document = load_toml(path)
    try:
        placement = checked(Placement, document)
    except InputError as error:
        raise InputError(f"{path} is no placement: {error}") from error
    strangers = [name for name in placement.cameras if name not in cameras]
    if strangers:
        raise InputError(
            f"{path}: the model has no camera {strangers[0][:60]!r}; it has {', '.join(cameras)}"
        )
    return placement.cameras


def write_placement(path: str | os.PathLike[str], placement: Placement) -> None:
    """Write a placement whole; what is not known is left out.

    Raises
    ------
    OutputError
        Where it cannot be written.
    """
    lines = [f"version = {placement.version}"]
    if placement.model:
        lines.append(f"model = {_text(placement.model)}")
    for name, camera in placement.cameras.items():
        lines += ["", f"[cameras.{_text(name)}]"]
        lines += [f"x = {camera.x:.4f}", f"y = {camera.y:.4f}", f"size = {camera.size:.4f}"]
        lines += [f"roll_deg = {camera.roll_deg:.2f}", f"mirror = {str(camera.mirror).lower()}"]
        if camera.low is not None:
            lines += [f"low = {camera.low:.1f}", f"high = {camera.high:.1f}"]
    write_whole(Path(path), "\n".join(lines) + "\n")


def _text(value: str) -> str:
    """A TOML string: what JSON and TOML share, without characters that either escapes otherwise."""
    safe = "".join(letter if letter.isprintable() else " " for letter in value)
    return '"' + safe.replace("\\", "\\\\").replace('"', '\\"') + '"'

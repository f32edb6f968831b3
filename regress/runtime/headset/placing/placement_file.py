"""Reads and writes a placement: a TOML file that says where a person's cameras see what a network is to see.

::

    version = 1
    model = "headset-tracking3"            # what it was found with, for people
    headset = "tracking3"                  # and of which headset's network, which others are not to take
    network_sha256 = "..."                 # that network; both may be left out

    [cameras.left_eye]
    x = 0.54                               # middle of the view, as a share of the picture's width
    y = 0.43                               # and height
    size = 1.09                            # width of the view over the picture's
    roll_deg = -5.0
    mirror = true
    low = 95.0                             # grey levels; both may be left out
    high = 254.0
    aspect = 1.3333                        # width over height of the pictures; others are at fault; may be left out
    stretch = 2.0                          # how many times as wide as high a pixel is; 1 where left out
    cut = [0.0, 0.125, 0.0, 0.125]         # shares left out at left, top, right and bottom; none where left out
"""

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from annotated_types import Len

from facegen.documents import load_toml
from facegen.files import write_whole
from regress.errors import InputError
from regress.runtime.documents import checked
from regress.runtime.headset.network.model import MOST_CAMERAS, HeadsetModel
from regress.runtime.headset.pictures.placement import CameraPlacement


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
    headset, network_sha256
        Of the network that it was found with; empty where it is for any, as one that was written by hand.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}

    version: Literal[1] = 1
    cameras: Annotated[dict[str, CameraPlacement], Len(0, MOST_CAMERAS)] = field(default_factory=dict)
    model: Annotated[str, Len(0, 300)] = ""
    headset: Annotated[str, Len(0, 300)] = ""
    network_sha256: Annotated[str, Len(0, 64)] = ""

    def suits(self, model: HeadsetModel) -> bool:
        """Whether a model sees as the one it was found with: the same, or one that was adapted from it."""
        known = (model.network_sha256, model.training.began_as, *model.training.adapted_from)
        return self.headset in ("", model.headset) and self.network_sha256 in ("", *known)


def read_placement(path: str | os.PathLike[str], model: HeadsetModel) -> dict[str, CameraPlacement]:
    """Placements by camera.

    Raises
    ------
    InputError
        Where the file is missing or too large, is no TOML, was found with another model, or holds a key, a value or a
        camera that is not allowed.
    """
    path = Path(path)
    document = load_toml(path)
    try:
        placement = checked(Placement, document)
    except InputError as error:
        raise InputError(f"{path} is no placement: {error}") from error
    if not placement.suits(model):
        raise InputError(
            f"{path} was found with another network ({placement.model[:60] or placement.headset[:60]}), and networks "
            f"expect the eye in other places; `regress headset check` again with this model, or take headset and "
            f"network_sha256 out of the file to use it nevertheless"
        )
    cameras = [camera.name for camera in model.cameras]
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
    told = {
        "model": placement.model,
        "headset": placement.headset,
        "network_sha256": placement.network_sha256,
    }
    lines += [f"{key} = {_text(value)}" for key, value in told.items() if value]
    for name, camera in placement.cameras.items():
        lines += ["", f"[cameras.{_text(name)}]"]
        lines += [f"x = {camera.x:.4f}", f"y = {camera.y:.4f}", f"size = {camera.size:.4f}"]
        lines += [f"roll_deg = {camera.roll_deg:.2f}", f"mirror = {str(camera.mirror).lower()}"]
        if camera.low is not None:
            lines += [f"low = {camera.low:.1f}", f"high = {camera.high:.1f}"]
        if camera.aspect is not None:
            lines.append(f"aspect = {camera.aspect:.4f}")
        if camera.stretch != 1:
            lines.append(f"stretch = {camera.stretch:.4f}")
        if any(camera.cut):
            lines.append(f"cut = [{', '.join(f'{share:.4f}' for share in camera.cut)}]")
    write_whole(Path(path), "\n".join(lines) + "\n")


def _text(value: str) -> str:
    """A TOML string: what JSON and TOML share, without characters that either escapes otherwise."""
    safe = "".join(letter if letter.isprintable() else " " for letter in value)
    return '"' + safe.replace("\\", "\\\\").replace('"', '\\"') + '"'

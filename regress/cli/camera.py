"""What options say of the camera that saw the landmarks."""

import re

from regress.errors import InputError
from regress.runtime.heads.camera import CameraSettings

_SIZE = re.compile(r"([1-9]\d{0,4})x([1-9]\d{0,4})")


def camera_settings(
    *, wanted: bool, picture: str | None, fov_deg: float | None, focal_px: float | None
) -> CameraSettings | None:
    """The camera's settings, None where nobody wants the head's pose; who says something of the camera wants it.

    Raises
    ------
    InputError
        Where the picture's size is none, an angle of view has no picture, or it is given beside a focal length.
    """
    if not wanted and picture is fov_deg is focal_px is None:
        return None
    if fov_deg is not None and focal_px is not None:
        raise InputError(
            f"--fov-deg {fov_deg:g} and --focal-px {focal_px:g} say the same thing: give one of them"
        )
    size = None if picture is None else picture_size(picture)
    return CameraSettings(picture_px=size, fov_deg=fov_deg, focal_px=focal_px)


def picture_size(picture: str) -> tuple[int, int]:
    """Width and height of what ``--picture`` says.

    Raises
    ------
    InputError
        Where it is no size.
    """
    match = _SIZE.fullmatch(picture)
    if match is None:
        raise InputError(
            f"--picture {picture!r} is no size; WIDTHxHEIGHT in pixels is needed, as in 1280x720"
        )
    return int(match[1]), int(match[2])

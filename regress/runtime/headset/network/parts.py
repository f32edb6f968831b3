"""Decides from cameras' names which shapes each is made to see, and which cameras mirror each other."""

import re

from facegen.conventions import BLENDSHAPES

_UPPER = ("eye", "brow", "cheekSquint", "noseSneer")
_LOWER = ("jaw", "mouth", "cheekPuff", "noseSneer", "tongue")
_SIDE = re.compile(r"(?<![a-z])(left|right|[lr](?=eye|brow|cheek|[^a-z]|$))")
_LOWER_CAMERA = re.compile(r"mouth|jaw|chin(?!e)|(?<![cfs])lip")
_UPPER_CAMERA = re.compile(r"eye|brow|cheek")
_OF_ONE_SIDE = re.compile(r"(eye|brow|cheek)(?!s)")
_OTHER_SIDE = {"left": "right", "right": "left", "l": "r", "r": "l"}


def part_of(camera: str) -> tuple[str, ...]:
    """Shapes that a camera is made to see.

    A camera called after mouth, jaw, chin or lip sees the lower face; after eye, brow or cheek the upper face, of its
    own side where its name has one (left, right, l, r), browInnerUp included. Nose sneers belong to both: the only
    shape in which two cameras add up (.43 and .33 of its variance alone, .53 together, in the trial). Any other name
    sees it all.

    Parameters
    ----------
    camera
        For example ``"left_eye"``.

    Returns
    -------
    tuple of str
        Names of blendshapes, in their order.
    """
    if _LOWER_CAMERA.search(camera.lower()):
        return tuple(name for name in BLENDSHAPES if name.startswith(_LOWER))
    if _UPPER_CAMERA.search(camera.lower()):
        other = {"left": "Right", "right": "Left"}.get(side_of(camera) or "", "neither")
        return tuple(name for name in BLENDSHAPES if name.startswith(_UPPER) and not name.endswith(other))
    return BLENDSHAPES


def side_of(camera: str) -> str | None:
    """``"left"``, ``"right"`` or None, from a camera's name: left_eye, lefteye, eye_l, leye."""
    side = _SIDE.search(camera.lower())
    return side and {"l": "left", "r": "right"}.get(side[1], side[1])


def is_of_one_eye(camera: str) -> bool:
    """Whether a camera's name says that it sees an eye, and which."""
    return "eye" in camera.lower() and side_of(camera) is not None


def mirror_partner(camera: str) -> str:
    """Name of the camera on the other side of the face; a camera without a side names itself."""
    return _SIDE.sub(lambda match: _OTHER_SIDE[match[1]], camera)


def without_side(cameras: tuple[str, ...]) -> list[str]:
    """Cameras of an eye, a brow or a cheek whose names say neither left nor right; one of both (eyes) needs no side."""
    return [name for name in cameras if _OF_ONE_SIDE.search(name.lower()) and side_of(name) is None]


def encoder_owners(cameras: tuple[str, ...]) -> dict[str, str | None]:
    """For each camera the one whose encoder sees its pictures mirrored; None where it has its own.

    The first of two partners owns the encoder, so the right eye's pictures go mirrored through the left's.
    """
    owners: dict[str, str | None] = {}
    for camera in cameras:
        partner = mirror_partner(camera)
        owners[camera] = partner if partner != camera and owners.get(partner, camera) is None else None
    return owners


def is_symmetric(cameras: tuple[str, ...]) -> bool:
    """Whether the mirror image of a frame is a frame of the same headset: every camera has its partner."""
    return not without_side(cameras) and all(mirror_partner(camera) in cameras for camera in cameras)

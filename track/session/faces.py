"""Names the faces that calibration asks people for, what it tells them, and whose ranges each gives."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from track.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Face:
    """One face that people are asked for.

    Parameters
    ----------
    text
        What to do.
    shapes
        Whose ranges it gives; none of the neutral face.
    """

    text: str
    shapes: tuple[str, ...] = ()


FACES: Mapping[str, Face] = {
    "neutral": Face(text="Look into the camera, mouth shut, face at rest"),
    "jaw_open": Face(text="Open your mouth as wide as it goes", shapes=("jawOpen",)),
    "smile": Face(
        text="Smile as broadly as you can, teeth shut", shapes=("mouthSmileLeft", "mouthSmileRight")
    ),
    "brows_up": Face(
        text="Raise your brows as high as they go",
        shapes=("browInnerUp", "browOuterUpLeft", "browOuterUpRight"),
    ),
    "pucker": Face(text="Pucker your lips as for a kiss", shapes=("mouthPucker",)),
    "cheeks": Face(text="Puff out both cheeks", shapes=("cheekPuff",)),
    "eyes_shut": Face(
        text="Shut both eyes until three seconds are over", shapes=("eyeBlinkLeft", "eyeBlinkRight")
    ),
    "eyes_wide": Face(text="Open both eyes as wide as they go", shapes=("eyeWideLeft", "eyeWideRight")),
    "lips_rolled": Face(
        text="Roll both lips in, over your teeth", shapes=("mouthRollUpper", "mouthRollLower")
    ),
    "look_around": Face(text="Look left, right, up and down, as far as is easy, head still"),
}
"""In the order of asking; names as a command's value has them."""

OF_HEADSETS = ("eyes_wide", "lips_rolled", "look_around")
"""Faces that networks of landmarks see too little of to be asked for."""

OF_ALL = tuple(name for name in FACES if name not in OF_HEADSETS)


def faces_of(asked: str, known: Sequence[str] = OF_ALL) -> tuple[str, ...]:
    """Names of the faces that a command's value asks for: one of `FACES`, or ``all`` of those that a model knows.

    Raises
    ------
    InputError
        Where there is no such face.
    """
    if asked == "all":
        return tuple(known)
    if asked not in FACES:
        raise InputError(
            f"there is no face {str(asked)[:40]!r} to calibrate; all, {', '.join(FACES)} are known"
        )
    return (asked,)

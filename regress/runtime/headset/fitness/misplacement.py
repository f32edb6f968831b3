"""Says what is wrong with where an eye or a mouth lies in a camera's pictures, and what to do about it."""

from collections.abc import Iterator

import numpy as np

from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.fitness.misfits import Finding, Misfit
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.placing.mouth_points import MouthPoints

_SIZE, _SHIFT, _ROLL_DEG = 0.25, 0.18, 10.0
"""Of a placement, from which frames are worth placing (log of the size, share of the view's width): in training people
differ by .09 and .067, standard deviations."""

_BROW = 0.5
"""Share of the brow's points that lie outside of the picture, from which it counts as cropped."""

_CLOSER = 0.45
"""Log of the size of a mouth's view up to which a mouth that comes nearer is left as it is: wider views of it show
repeated edges. Weights of 16 rendered people, 1.2 and 1.35 times as near, erred by .0136 and .0202 as they came, and by
.0160 and .0210 placed; 1.7 times as near by .063 and .058."""

_NOSE = 0.08
"""Of the picture's height, by which the base of the nose lies inside of it: nearer to the edge a network traces a nose
that is cut off too far inside. Of 16 people moved up by a fifth placements raised the error by a tenth, and that of
three by four fifths or more; as they come no nose is so near."""


def place_findings(
    name: str,
    placement: CameraPlacement,
    points: EyePoints | MouthPoints,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
    told: str | None,
) -> Iterator[Finding]:
    """What is wrong with where the eye or the mouth lies, by the placement at which it is found.

    Parameters
    ----------
    name
        Of the camera.
    placement
        As found.
    points
        Of the eye or the mouth in training.
    picture, view
        Sizes (width, height) of the camera's pictures and of what the network sees.
    told
        What mean pictures say of the camera; None where they say nothing.
    """
    turns = quarters(placement)
    if turns == 2:
        yield Finding(
            camera=name,
            misfit=Misfit.UPSIDE_DOWN,
            sentence=f"{name} is upside down; turn the camera, or take --placement, which turns it",
        )
    elif turns:
        yield Finding(
            camera=name,
            misfit=Misfit.SIDEWAYS,
            sentence=f"{name} lies on its side; turn the camera by a quarter, or take --placement, which turns it",
        )
    if placement.mirror:
        yield Finding(
            camera=name,
            misfit=Misfit.MIRRORED,
            sentence=f"{name} is mirrored, or of the other eye; give the other eye's pictures as that eye's, or take "
            f"--placement where the camera mirrors: of the other eye it would turn gaze to the wrong side",
        )
    if told is not None and not (turns or placement.mirror):
        yield turned(name, told)
    of_an_eye = isinstance(points, EyePoints)
    cropped = _cropped_brow if of_an_eye else _cropped_nose
    crops = list(cropped(name, placement, points, picture=picture, view=view))
    yield from crops
    # what a network traces of a mouth without a nose is no place
    if of_an_eye or not crops:
        yield from _elsewhere(name, placement, picture=picture, view=view, of_an_eye=of_an_eye)


def quarters(placement: CameraPlacement) -> int:
    """By how many quarters a camera is turned, clockwise: 0, 1, 2 or -1."""
    turned = round(placement.roll_deg / 90)
    return 2 if turned == -2 else turned


def _elsewhere(
    name: str,
    placement: CameraPlacement,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
    of_an_eye: bool,
) -> Iterator[Finding]:
    roll_deg = (placement.roll_deg - 90 * quarters(placement) + 180) % 360 - 180
    size = placement.size / whole_view(picture, view).size
    across, down = placement.x - 0.5, (placement.y - 0.5) * picture[1] / picture[0]
    if (
        not -_SIZE <= np.log(size) <= (_SIZE if of_an_eye else _CLOSER)
        or np.hypot(across, down) > _SHIFT * placement.size
        or abs(roll_deg) > _ROLL_DEG
    ):
        yield Finding(
            camera=name,
            misfit=Misfit.PLACED,
            sentence=f"{name} shows the {'eye' if of_an_eye else 'mouth'} elsewhere: {size:.2f} times as large as in "
            f"training, the view's middle at {100 * placement.x:.0f} % of the width and {100 * placement.y:.0f} % of "
            f"the height, turned by {roll_deg:.0f}°; take --placement, or render for this camera: multiply its fx and "
            f"fy in the headset's TOML by {size:.2f} and move its target there",
        )


def _cropped_brow(
    name: str,
    placement: CameraPlacement,
    points: EyePoints,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
) -> Iterator[Finding]:
    matrix = placement.picture_from_view(picture, view)
    brow = points.usual[points.brow] @ matrix[:, :2].T + matrix[:, 2]
    outside = ((brow < -0.5) | (brow > np.array(picture) - 0.5)).any(axis=1)
    inside_of_view = ((points.usual[points.brow] > 0) & (points.usual[points.brow] < view)).all(axis=1)
    if points.brow and outside[inside_of_view].mean() >= _BROW:
        yield Finding(
            camera=name,
            misfit=Misfit.BROW,
            sentence=f"{name} is cropped at the brow: {outside.sum()} of its {len(outside)} points lie outside, so its "
            f"shapes are guesses; tilt the camera up, or widen its view",
        )


def _cropped_nose(
    name: str,
    placement: CameraPlacement,
    points: MouthPoints,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
) -> Iterator[Finding]:
    matrix = placement.picture_from_view(picture, view)
    nose = (points.usual[points.nose].mean(axis=0) @ matrix[:, :2].T + matrix[:, 2] + 0.5) / picture
    if min(*nose, *(1 - nose)) < _NOSE:
        yield Finding(
            camera=name,
            misfit=Misfit.NOSE,
            sentence=f"{name} is cropped at the nose: its base lies at the picture's edge or outside, so the mouth is "
            f"left where it is and its shapes are guesses; tilt the camera up, or widen its view",
        )


def lost(name: str, what: str) -> Finding:
    """The finding of a camera in whose pictures what it should show is not found."""
    return Finding(
        camera=name,
        misfit=Misfit.LOST,
        sentence=f"{name}: the {what} is not found: wherever the model looks, it traces one elsewhere; the placement "
        f"is the whole picture: look at --sheet, write x, y and size into --out by hand, or try another model",
    )


def turned(name: str, told: str) -> Finding:
    """The finding of a camera of which mean pictures say that it is turned or mixed up."""
    return Finding(
        camera=name,
        misfit=Misfit.TURNED,
        sentence=f"{name} is turned or mixed up: {told} If it is turned, write roll_deg (180, 90 or -90) into --out",
    )

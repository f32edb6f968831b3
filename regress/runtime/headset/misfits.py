"""Names what is wrong with a camera's frames, and says in a sentence what to do about it."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np

from regress.runtime.headset.eye_points import EyePoints
from regress.runtime.headset.looks import CameraLooks, TakeLooks
from regress.runtime.headset.placement import CameraPlacement

_DARKER = 0.75
"""Of the darkest training's bright level: down to that, stretched levels lose nothing but grain."""

_CLIPPED = 0.01
"""Share of saturated pixels from which skin has lost its shape: glints alone have a tenth of it."""

_SOFTER = 0.85
"""Of the softest training's sharpness."""

_RIM = 0.08
"""Share of the picture by which a dark rim is larger than any in training."""

_FLICKER = 0.03
"""Change of light from frame to frame: a steady lamp's is a hundredth or less (60 clips of 60 people)."""

_SIZE, _SHIFT, _ROLL_DEG = 0.25, 0.18, 10.0
"""Of a placement, from which frames are worth placing (log of the size, share of the view's width): in training people
differ by .09 and .067, standard deviations."""

_BROW = 0.5
"""Share of the brow's points that lie outside of the picture, from which it counts as cropped."""


class Misfit(Enum):
    """What is wrong with a camera's frames; the value is what a person calls it."""

    DARK = "too dark"
    BRIGHT = "too bright"
    CLIPPED = "clipped"
    SOFT = "soft"
    MIRRORED = "mirrored, or of the other eye"
    UPSIDE_DOWN = "upside down"
    SIDEWAYS = "on its side"
    EXCHANGED = "exchanged"
    OTHER = "of the other eye"
    TURNED = "turned or mixed up"
    BROW = "cropped at the brow"
    RIM = "in a lens circle"
    FLICKER = "flickering"
    PLACED = "elsewhere"
    LOST = "not found"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One thing that is wrong with a camera's frames, and what to do about it in a sentence."""

    camera: str
    misfit: Misfit
    sentence: str


def light_findings(name: str, looks: TakeLooks, known: CameraLooks) -> Iterator[Finding]:
    """What is wrong with light and lens, by how a camera's frames look and how training's did."""
    if looks.high < _DARKER * known.high[0]:
        factor = known.high[1] / max(looks.high, 1)
        yield Finding(
            camera=name,
            misfit=Misfit.DARK,
            sentence=f"{name} is too dark: its bright levels are about {looks.high:.0f}, training's "
            f"{known.high[0]:.0f} to {known.high[2]:.0f}; expose {factor:.1f} times as long, or multiply "
            f"sensor.exposure in the headset's TOML by {1 / factor:.2f} and render anew",
        )
    elif looks.low > known.low[2] + 40:
        yield Finding(
            camera=name,
            misfit=Misfit.BRIGHT,
            sentence=f"{name} is too bright: its dark levels are about {looks.low:.0f}, training's {known.low[0]:.0f} "
            f"to {known.low[2]:.0f}; lower the camera's gain or black level (sensor.black_level in the headset's TOML)",
        )
    if looks.saturated > max(_CLIPPED, 3 * known.saturated[2]):
        yield Finding(
            camera=name,
            misfit=Misfit.CLIPPED,
            sentence=f"{name} is clipped: {100 * looks.saturated:.0f} % of its pixels are saturated, training's at "
            f"most {100 * known.saturated[2]:.1f} %; expose less, or dim the lamp that is nearest to the skin",
        )
    if looks.sharpness < _SOFTER * known.sharpness[0]:
        yield Finding(
            camera=name,
            misfit=Misfit.SOFT,
            sentence=f"{name} is soft: its detail is {looks.sharpness:.3f} of its contrast, training's "
            f"{known.sharpness[0]:.3f} to {known.sharpness[2]:.3f}; focus or clean the lens, or compress less",
        )
    # a dark picture's corners are as dark as a rim
    if looks.rim > known.rim[2] + _RIM and looks.high >= _DARKER * known.high[0]:
        yield Finding(
            camera=name,
            misfit=Misfit.RIM,
            sentence=f"{name} is seen in a lens circle: a dark rim covers {100 * looks.rim:.0f} % of its picture, "
            f"training's {100 * known.rim[0]:.0f} to {100 * known.rim[2]:.0f} %; move the camera nearer to the lens's "
            f"middle, or set lens.aperture_radius of this camera in the headset's TOML",
        )
    if looks.flicker > _FLICKER:
        yield Finding(
            camera=name,
            misfit=Misfit.FLICKER,
            sentence=f"{name} is flickering: its light changes by {100 * looks.flicker:.0f} % from frame to frame; run "
            f"the lamps with direct current, or expose for whole periods of them",
        )


def place_findings(
    name: str,
    placement: CameraPlacement,
    points: EyePoints,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
    told: str | None,
) -> Iterator[Finding]:
    """What is wrong with where the eye lies, by the placement at which it is found.

    Parameters
    ----------
    name
        Of the camera.
    placement
        As found.
    points
        Of the eye in training.
    picture, view
        Sizes (width, height) of the camera's pictures and of what the network sees.
    told
        What mean pictures say of the camera; None where they say nothing.
    """
    upside_down = abs(placement.roll_deg) > 135
    if upside_down:
        yield Finding(
            camera=name,
            misfit=Misfit.UPSIDE_DOWN,
            sentence=f"{name} is upside down; turn the camera, or take --placement, which turns it",
        )
    sideways = not upside_down and abs(placement.roll_deg) > 45
    if sideways:
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
    if told is not None and not (upside_down or sideways or placement.mirror):
        yield turned(name, told)
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
    turns = 180 if upside_down else 90 * sideways
    roll_deg = placement.roll_deg - np.sign(placement.roll_deg) * turns
    across, down = placement.x - 0.5, (placement.y - 0.5) * picture[1] / picture[0]
    if (
        abs(np.log(placement.size)) > _SIZE
        or np.hypot(across, down) > _SHIFT * placement.size
        or abs(roll_deg) > _ROLL_DEG
    ):
        yield Finding(
            camera=name,
            misfit=Misfit.PLACED,
            sentence=f"{name} shows the eye elsewhere: {placement.size:.2f} times as large as in training, the view's "
            f"middle at {100 * placement.x:.0f} % of the width and {100 * placement.y:.0f} % of the height, turned by "
            f"{roll_deg:.0f}°; take --placement, or render for this camera: multiply its fx and fy in the headset's "
            f"TOML by {placement.size:.2f} and move its target there",
        )


def lost(name: str) -> Finding:
    """The finding of a camera in whose pictures no eye is found."""
    return Finding(
        camera=name,
        misfit=Misfit.LOST,
        sentence=f"{name}: the eye is not found: wherever the model looks, it traces one farther out; the placement is "
        f"the whole picture: look at --sheet, write x, y and size into --out by hand, or try another model",
    )


def turned(name: str, told: str) -> Finding:
    """The finding of a camera of which mean pictures say that it is turned or mixed up."""
    return Finding(
        camera=name,
        misfit=Misfit.TURNED,
        sentence=f"{name} is turned or mixed up: {told} If it is turned, write roll_deg (180, 90 or -90) into --out",
    )

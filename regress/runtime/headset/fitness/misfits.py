"""Names what is wrong with a camera's frames, and says in a sentence what to do about it."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from regress.runtime.headset.pictures.looks import CameraLooks, TakeLooks

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
    NOSE = "cropped at the nose"
    RIM = "in a lens circle"
    FLICKER = "flickering"
    PLACED = "elsewhere"
    LOST = "not found"
    BARS = "with bars"
    SHRUNK = "shrunk in width"
    VIEWS = "of two views"
    FEW = "too few"


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


def few(name: str, count: int, needed: int) -> Finding:
    """The finding of a camera of whose frames too few are usable."""
    usable = f"{count} usable frame{'' if count == 1 else 's'}"
    return Finding(
        camera=name,
        misfit=Misfit.FEW,
        sentence=f"{name} has {usable}; at least {needed} are needed, best 100-300",
    )

"""Draws what differs between people's mouths: size and place of the arches, how teeth stand, their reflectance.

References
----------
.. [1] R. Vig and G. Brundo, "The kinetics of anterior tooth display", J. Prosthetic Dentistry 39(5), 1978: upper
   central incisors show 1.9 mm (men) and 3.4 mm (women) below the resting upper lip.
.. [2] W. Proffit, H. Fields and L. Moray, "Prevalence of malocclusion in the United States", Int. J. Adult Orthodontics
   13(2), 1998: overjet and overbite of about 3 mm in most adults.
"""

from dataclasses import dataclass

import numpy as np

from facegen.mouth.crowns import UPPER
from facegen.scene.materials import MATERIALS

TEETH = 2 * len(UPPER)
"""Of one arch, from the subject's right to the left; third molars are left out."""
MISSING = 0.04
"""Share of people that lack one tooth behind the canines."""


@dataclass(frozen=True, kw_only=True, eq=False)
class MouthTraits:
    """One person's.

    Attributes
    ----------
    size, ratio
        Factor on the teeth's size, and depth of the upper arch relative to its width.
    display_m, overjet_m, overbite_m
        How far the upper incisors' edges lie below the line where lips meet, and before and below the lower ones' when
        teeth meet.
    palate_m
        Height of the palate over the gum.
    turn_rad, forward_m, down_m
        (2, 14) how each tooth of the upper and lower arch, from right to left, stands off its place: turned about its
        axis, outwards, and towards the other arch.
    missing
        (2, 14) bool.
    tongue
        Factor on the tongue's width.
    materials
        Albedos by material name (`facegen.scene.materials`).
    """

    size: float
    ratio: float
    display_m: float
    overjet_m: float
    overbite_m: float
    palate_m: float
    turn_rad: np.ndarray
    forward_m: np.ndarray
    down_m: np.ndarray
    missing: np.ndarray
    tongue: float
    materials: dict[str, dict[str, float]]


def draw_mouth(rng: np.random.Generator) -> MouthTraits:
    """The mouth of one person, whose own stream ``rng`` is; lengths are for a head of average size."""
    size, ratio, display, overjet, overbite, palate, tongue = np.clip(rng.standard_normal(7), -2.0, 2.0)
    crowding = np.exp(0.6 * np.clip(rng.standard_normal((2, 1)), -2.0, 1.5))
    turn, forward, down = np.clip(rng.standard_normal((3, 2, TEETH)), -2.0, 2.0)
    # teeth behind the canines stand firmer, and lower incisors are the first to crowd
    order = np.abs(np.arange(TEETH) - (TEETH - 1) / 2)
    loose = crowding * np.where(order < 3, 1.0, 0.5) * np.array([[0.8], [1.2]])
    missing = np.zeros((2, TEETH), bool)
    lacks, arch, place = rng.random(), int(rng.integers(2)), int(rng.integers(4))
    side = int(rng.integers(2))
    if lacks < MISSING:
        missing[arch, place if side else TEETH - 1 - place] = True
    shade = np.clip(rng.normal(1.0, [0.06, 0.07, 0.08]), 0.8, 1.2)
    return MouthTraits(
        size=float(1.0 + 0.04 * size),
        ratio=float(0.80 + 0.035 * ratio),
        display_m=float(2.2e-3 + 0.8e-3 * display),
        overjet_m=float(2.8e-3 + 0.5e-3 * overjet),
        overbite_m=float(2.5e-3 + 0.6e-3 * overbite),
        palate_m=float(13e-3 + 1.5e-3 * palate),
        turn_rad=np.radians(4.0) * loose * turn,
        forward_m=0.25e-3 * loose * forward,
        down_m=0.2e-3 * loose * down,
        missing=missing,
        tongue=float(1.0 + 0.06 * tongue),
        materials={
            name: {"albedo": float(MATERIALS[name]["albedo"] * factor)}
            for name, factor in zip(("teeth", "gums", "tongue"), shade, strict=True)
        },
    )

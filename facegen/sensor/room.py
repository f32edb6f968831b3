"""Adds light of the room that leaks into a headset."""

import numpy as np

from facegen.conventions import Part
from facegen.sampling import Shot
from facegen.scene import Glimpse, Layers

ALBEDO: dict[Part, float] = {
    Part.SKIN: 0.55,
    Part.BROWS: 0.55,
    Part.LIPS: 0.52,
    Part.SCLERA: 0.44,
    Part.TEETH: 0.6,
    Part.GUMS: 0.45,
    Part.TONGUE: 0.42,
    Part.IRIS: 0.25,
    Part.PUPIL: 0.05,
    Part.LASHES: 0.08,
    Part.HAIR: 0.15,
    Part.EYE_CAVITY: 0.3,
    Part.MOUTH_CAVITY: 0.05,
    Part.HEADSET: 0.04,
    Part.GLASSES: 0.08,
}
"""Diffuse reflectances at 850 nm, about those of `facegen.scene.materials`; parts not named reflect nothing."""


def room_light(layers: Layers | Glimpse, camera_from_head: np.ndarray, shot: Shot) -> np.ndarray:
    """(h, w) radiance that the room adds, W sr-1 m-2.

    The room is a half of the sky, evenly bright, around ``shot.room_direction``: a matte surface at an angle a to that
    direction then reflects (1 + cos a) / 2 of what faces it fully. Nothing casts a shadow, so it costs no rendering.
    """
    direction = camera_from_head[:3, :3] @ np.array(shot.room_direction)
    facing = 0.5 * (1.0 + layers.normal.astype(np.float64) @ direction)
    albedo = layers.albedo if isinstance(layers, Glimpse) else _albedo_of_parts()[layers.part]
    return shot.room_radiance * albedo * facing


def _albedo_of_parts() -> np.ndarray:
    albedo = np.zeros(max(Part) + 1)
    for part, value in ALBEDO.items():
        albedo[part] = value
    return albedo

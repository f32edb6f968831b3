"""Brightens pupils by LEDs beside the camera's axis; all others leave them dark.

The lens of the eye focuses a lamp onto the retina, whose light goes back the way it came: a camera within about two
degrees of the lamp, as the eye sees both, looks into that beam [1]_.

References
----------
.. [1] K. Nguyen, C. Wagner, D. Koons, M. Flickner, "Differences in the infrared bright pupil response of human eyes",
   ETRA 2002: bright from lamps on the camera's axis, strength differs between people.
"""

import numpy as np

from facegen.geometry import invert_transform
from facegen.rigs import EyeGeometry
from facegen.scene.lamps import radiant_intensity
from facegen.scene.materials import MATERIALS
from facegen.scene.scene import Lamp, View

WIDTH_RAD = np.radians(1.5)
"""Angle at which an LED's share has fallen to 1/e: at 2 degrees it is a sixth, at 4 a thousandth (chosen)."""
GAIN = 0.6
"""Albedo that LEDs on the axis add to a pupil: it is then a little brighter than skin (chosen; people differ)."""
FEWEST = 0.01
"""Added albedo below which a pupil is left as it is: about a grey level."""


def bright_pupil(
    view: View, lamps: tuple[Lamp, ...], eyes: tuple[EyeGeometry, EyeGeometry], albedo: float | None = None
) -> dict[str, dict[str, float]]:
    """Parameters of the material ``pupil`` in one view, {} where its pupils are dark.

    Parameters
    ----------
    view
        Camera, ``camera_from_head``, and which lamps are lit.
    lamps
        All of the scene's.
    eyes
        The subject's left and right eye; the one nearer to the camera counts.
    albedo
        Of the dark pupil; the material's default if it is not given.
    """
    camera_m = invert_transform(view.camera_from_head)[:3, 3]
    eye = min(eyes, key=lambda eye: np.linalg.norm(eye.center - camera_m))
    pupil = eye.center + eye.iris_plane_offset * eye.axis
    to_camera = (camera_m - pupil) / np.linalg.norm(camera_m - pupil)
    light, returned = 0.0, 0.0
    for lamp in lamps:
        if lamp.name in view.lamps:
            away = lamp.position - pupil
            distance = np.linalg.norm(away)
            arriving = radiant_intensity(lamp, pupil) / distance**2
            angle = np.arctan2(np.linalg.norm(np.cross(away, to_camera)), away @ to_camera)
            light += arriving
            returned += arriving * np.exp(-((angle / WIDTH_RAD) ** 2))
    added = GAIN * returned / light if light > 0.0 else 0.0
    if added < FEWEST:
        return {}
    dark = MATERIALS["pupil"]["albedo"] if albedo is None else albedo
    return {"pupil": {"albedo": float(min(dark + added, 0.9))}}

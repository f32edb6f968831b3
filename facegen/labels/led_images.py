"""Finds the mirror images of LEDs in corneas, scleras, tears and lenses of glasses."""

from collections.abc import Callable, Sequence

import numpy as np

from facegen.geometry import Reflection, reflect_in_sphere, reflect_in_thread
from facegen.rigs.eyes import EyeGeometry
from facegen.scene import Lamp
from facegen.scene.glasses import LensMirror

SURFACES = ("cornea", "sclera", "tears", "lens")
MENISCUS_M = (0.4e-3, 15e-3)
"""Radii of the tears on the lower lid's edge, across it (as measured, 0.2 to 0.5) and along it."""


def led_images(
    eyes: Sequence[EyeGeometry],
    tear_lines: Sequence[np.ndarray],
    lenses: Sequence[LensMirror],
    lamps: list[Lamp],
    camera_m: np.ndarray,
) -> dict[tuple[int, str], list[Reflection]]:
    """Images of the lamps, their points NaN where there is none, by eye (0 the subject's left) and one of `SURFACES`.

    Parameters
    ----------
    eyes, tear_lines
        The subject's left and right eye, and their `facegen.scene.lids.tear_lines`.
    lenses
        The left and the right lens of glasses, if there are any.
    lamps
        Those that are lit.
    camera_m
        (3,) the camera's place, head frame.
    """
    mirrors = {
        (side, surface): _images(surface, eye, tear_lines[side], lamps, camera_m)
        for side, eye in enumerate(eyes)
        for surface in ("cornea", "sclera", "tears")
    }
    return mirrors | {
        (side, "lens"): _sphere_images(lens.center, lens.radius, lens.holds, lamps, camera_m)
        for side, lens in enumerate(lenses)
    }


def _images(
    surface: str, eye: EyeGeometry, tear_line: np.ndarray, lamps: list[Lamp], camera_m: np.ndarray
) -> list[Reflection]:
    """The lamps' images in one surface, their points NaN where there is none."""
    if surface == "tears":
        return [reflect_in_thread(tear_line, MENISCUS_M, lamp.position, camera_m) for lamp in lamps]
    if surface == "cornea":
        center, radius = eye.center + eye.cornea_center_offset * eye.axis, eye.cornea_radius
    else:
        center, radius = eye.center + eye.sclera_center_offset * eye.axis, eye.radius

    # the cornea ends, and the sclera begins, at the limbus
    def on_surface(points: np.ndarray) -> np.ndarray:
        before_limbus = ((points - eye.center) * eye.axis).sum(axis=-1) > eye.limbus_offset
        return before_limbus == (surface == "cornea")

    return _sphere_images(center, radius, on_surface, lamps, camera_m)


def _sphere_images(
    center: np.ndarray,
    radius: float,
    on_surface: Callable[[np.ndarray], np.ndarray],
    lamps: list[Lamp],
    camera_m: np.ndarray,
) -> list[Reflection]:
    """The lamps' images in the part of a sphere for whose points (n, 3) ``on_surface`` is True (n,)."""
    positions = np.array([lamp.position for lamp in lamps]).reshape(-1, 3)
    image = reflect_in_sphere(center, radius, positions, camera_m)
    point = np.where(on_surface(image.point)[:, None], image.point, np.nan)
    return [
        Reflection(point=point[i], cosine=image.cosine[i], gain=image.gain[i], shrinking=image.shrinking[i])
        for i in range(len(lamps))
    ]

"""What a camera sees of eyes: the pupil through the cornea, the limbus, and the edges of the lids.

The cornea refracts as a ball of one index does, which is what is rendered (`facegen.scene.eyes`): each point of the
pupil's edge leaves the cornea at one place towards a camera, and appears there. The ellipse shares 97 % with that
outline up to 45 degrees beside the optical axis where the pupil is 8 mm wide, up to 60 degrees where it is 4 mm.
"""

from dataclasses import dataclass

import numpy as np

from facegen.geometry import (
    Ellipse,
    apply_transform,
    fit_ellipse,
    invert_transform,
    project,
    refract_through_sphere,
)
from facegen.rigs.eyes import CORNEA_INDEX, EyeGeometry
from facegen.scene import View
from facegen.scene.eyes import head_from_eye

PLACES = 32
"""Points of a circle that are projected: with twice as many the ellipse is the same to a millionth of a pixel."""


@dataclass(frozen=True, kw_only=True, eq=False)
class EyeOutlines:
    """Outlines of one eye in a view, in pixels, wherever they lie and whatever hides them.

    NaN where the lens does not reach.

    Attributes
    ----------
    pupil_center_2d
        (2,) where the middle of the pupil appears through the cornea, which is not the middle of its ellipse.
    pupil
        The pupil's outline as it appears through the cornea.
    pupil_bare
        The same without refraction.
    iris
        The limbus circle, where the cornea ends at the sclera; it lies on the surface and is not refracted. From more
        than 35 degrees beside the axis the cornea bulges out over its far side.
    upper_lid_2d, lower_lid_2d
        (n, 2) along the margins of the lids, inner canthus first; both have the canthi.
    """

    pupil_center_2d: np.ndarray
    pupil: Ellipse
    pupil_bare: Ellipse
    iris: Ellipse
    upper_lid_2d: np.ndarray
    lower_lid_2d: np.ndarray


def outline_eye(view: View, eye: EyeGeometry, margins: tuple[np.ndarray, np.ndarray]) -> EyeOutlines:
    """Outlines of one eye in a view.

    Pupil and iris are NaN from behind: the bare ones where the camera lies behind their plane, the refracted ones
    where the light of the pupil's middle would leave the ball of the cornea beyond the limbus.

    Parameters
    ----------
    view
        Camera and ``camera_from_head``.
    eye
        The eye.
    margins
        Upper and lower margin of its lids, (n, 3) head frame, metres.
    """
    camera_m = invert_transform(view.camera_from_head)[:3, 3]

    def in_picture(points: np.ndarray, seen: bool | np.bool_ = True) -> np.ndarray:
        return np.where(seen, project(view.camera, apply_transform(view.camera_from_head, points)), np.nan)

    def along_axis(point: np.ndarray) -> float:
        return (point - eye.center) @ eye.axis

    edge = _circle(eye, eye.pupil_radius, eye.iris_plane_offset)
    limbus = _circle(eye, eye.limbus_radius, eye.limbus_offset)
    middle, cornea = (
        eye.center + way * eye.axis for way in (eye.iris_plane_offset, eye.cornea_center_offset)
    )
    shown = refract_through_sphere(
        cornea, eye.cornea_radius, CORNEA_INDEX, np.concatenate([middle[None], edge]), camera_m
    )
    through = in_picture(shown, along_axis(shown[0]) > eye.limbus_offset)
    bare = in_picture(edge, along_axis(camera_m) > eye.iris_plane_offset)
    upper, lower = (in_picture(margin) for margin in margins)
    return EyeOutlines(
        pupil_center_2d=through[0],
        pupil=fit_ellipse(through[1:]),
        pupil_bare=fit_ellipse(bare),
        iris=fit_ellipse(in_picture(limbus, along_axis(camera_m) > eye.limbus_offset)),
        upper_lid_2d=upper,
        lower_lid_2d=lower,
    )


def _circle(eye: EyeGeometry, radius: float, offset: float) -> np.ndarray:
    """Points (PLACES, 3) about the optical axis, ``offset`` along it from the eyeball's centre; head frame, metres."""
    angle = np.linspace(0.0, 2.0 * np.pi, PLACES, endpoint=False)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(PLACES, offset)], axis=-1)
    return apply_transform(head_from_eye(eye), points)

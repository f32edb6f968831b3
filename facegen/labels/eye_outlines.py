"""Outlines eyes in a headset's views: the pupil through the cornea, the limbus, and the margins of the lids.

The cornea refracts as a ball of one index does, which is what is rendered (`facegen.scene.eyes`): each point of the
pupil's edge leaves the cornea at one place towards a camera, and appears there. The ellipse shares 97 % with that
outline up to 45 degrees beside the optical axis where the pupil is 8 mm wide, up to 60 degrees where it is 4 mm.
"""

from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np

from facegen.conventions import SIDES
from facegen.geometry import (
    Ellipse,
    apply_transform,
    fit_ellipse,
    invert_transform,
    project,
    refract_through_sphere,
)
from facegen.labels.view_label import LabelKey
from facegen.rigs import Rig, lid_margins
from facegen.rigs.eyes import CORNEA_INDEX, EyeGeometry
from facegen.scene import View
from facegen.scene.eyes import head_from_eye
from facegen.sessions import SampleScene

CIRCLE_POINTS = 32
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


@dataclass(frozen=True, kw_only=True, eq=False)
class ViewOutlines:
    """Outlines of the subject's left and right eye in a view."""

    left: EyeOutlines
    right: EyeOutlines

    KEYS: ClassVar = (
        LabelKey(
            name="pupil_center_refracted_2d",
            meaning="by side: where the middle of the pupil appears through the cornea",
            unit="px",
        ),
        LabelKey(
            name="pupil_ellipse",
            meaning="by side: the pupil as it appears through the cornea: `center`, `semi_axes` (the longer first) and "
            "`angle_rad` (from the picture's x towards y to the longer axis)",
            unit="px, rad",
        ),
        LabelKey(name="pupil_ellipse_bare", meaning="the same without refraction", unit="px, rad"),
        LabelKey(
            name="iris_ellipse",
            meaning="the same of the limbus, where cornea and sclera meet",
            unit="px, rad",
        ),
        LabelKey(
            name="upper_lid_2d",
            meaning="by side: line along the lid's margin, from the inner to the outer canthus",
            unit="px",
        ),
        LabelKey(name="lower_lid_2d", meaning="likewise", unit="px"),
    )

    @classmethod
    def of_sample(cls, rig: Rig, sample: SampleScene) -> dict[str, Self]:
        """Label every view of a sample."""
        vertices = sample.face.vertices[0]
        margins = [tuple(vertices[line] for line in lid_margins(rig, eye)) for eye in range(len(SIDES))]
        return {
            view.name: cls(
                **{
                    side: outline_eye(view, eye, lids)
                    for side, eye, lids in zip(SIDES, sample.eyes, margins, strict=True)
                }
            )
            for view in sample.scene.views
        }

    def record(self) -> dict[str, Any]:
        """Values of `KEYS`."""
        sides = {side: _values(getattr(self, side)) for side in SIDES}
        return {key.name: {side: values[key.name] for side, values in sides.items()} for key in self.KEYS}


def _values(eye: EyeOutlines) -> dict[str, Any]:
    return {
        "pupil_center_refracted_2d": eye.pupil_center_2d,
        "pupil_ellipse": _ellipse(eye.pupil),
        "pupil_ellipse_bare": _ellipse(eye.pupil_bare),
        "iris_ellipse": _ellipse(eye.iris),
        "upper_lid_2d": eye.upper_lid_2d,
        "lower_lid_2d": eye.lower_lid_2d,
    }


def _ellipse(ellipse: Ellipse) -> dict[str, np.ndarray]:
    return {
        "center": np.asarray(ellipse.center),
        "semi_axes": np.asarray(ellipse.semi_axes),
        "angle_rad": np.asarray(ellipse.angle),
    }


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
    """Points (n, 3) about the optical axis, ``offset`` along it from the eyeball's centre; head frame, metres."""
    angle = np.linspace(0.0, 2.0 * np.pi, CIRCLE_POINTS, endpoint=False)
    points = np.stack(
        [radius * np.cos(angle), radius * np.sin(angle), np.full(CIRCLE_POINTS, offset)], axis=-1
    )
    return apply_transform(head_from_eye(eye), points)

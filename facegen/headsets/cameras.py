"""A headset's camera: intrinsics, lens, and where it is fixed."""

from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from facegen.geometry import Camera, look_at, project, transform, unproject
from facegen.geometry.cameras import DISTORTION_TERMS
from facegen.headsets.lens_shader import rendered_rays
from facegen.headsets.quantities import MM, Fraction, Name, Pair, Positive, Vector, record

SPARE = 0.005
"""A picture ends by this share before its distortion turns back. There the renderer's iteration (lens.osl) converges
slowly: with a share of 0.002 it is 0.08 px off, with this one less than 0.01 px."""
RENDERED_OFF_PX = 0.01
"""Rendered and labelled rays agree within this."""


@record()
class Distortion:
    """Coefficients by name, in OpenCV's meaning; those not given are 0."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    k4: float = 0.0
    p1: float = 0.0
    p2: float = 0.0


@record()
class Lens:
    """What a lens does to light besides bending it; lengths are shares of the picture's width.

    ``vignette`` is the share of the light that is lost in the corner farthest from the principal point, growing with
    the square of the distance from there. With an ``aperture_radius`` nothing is seen beyond a circle of that
    radius, whose middle lies ``aperture_offset`` (right, down) from the middle of the picture: the rim of a lens or of
    the eyecup that the camera looks through. ``blur`` is the standard deviation of what a lens that is out of focus
    spreads a point over.
    """

    vignette: Fraction = 0.0
    aperture_radius: Positive | None = None
    aperture_offset: Pair = (0.0, 0.0)
    blur: Annotated[float, Field(ge=0, le=0.1)] = 0.0


@record()
class HeadsetCamera:
    """One camera: its intrinsics in pixels and its pose in the headset frame.

    The camera stands at ``position_mm`` and its optical axis meets ``target_mm``; the headset's y appears
    upwards in the picture until ``roll_deg`` turns the camera about its axis (clockwise as the camera itself
    sees it).
    """

    name: Name
    model: Literal["pinhole", "fisheye"]
    width: Annotated[int, Field(ge=8, le=8192)]
    height: Annotated[int, Field(ge=8, le=8192)]
    fx: Positive
    fy: Positive
    cx: float
    cy: float
    distortion: Distortion = Distortion()
    position_mm: Vector
    target_mm: Vector
    roll_deg: float = 0.0
    lens: Lens = Lens()

    @model_validator(mode="after")
    def _check(self) -> "HeadsetCamera":
        allowed = DISTORTION_TERMS[self.model]
        for term in ("k1", "k2", "k3", "k4", "p1", "p2"):
            if term not in allowed and getattr(self.distortion, term) != 0.0:
                raise ValueError(
                    f"a {self.model} camera has no distortion term {term}; it has {', '.join(allowed)}"
                )
        line_of_sight = np.subtract(self.target_mm, self.position_mm)
        if np.linalg.norm(np.cross(line_of_sight, (0.0, 1.0, 0.0))) < 1e-6:
            raise ValueError(
                "target_mm lies straight above, below or at position_mm, so up in the picture is undefined"
            )
        if not self._sees_everywhere():
            raise ValueError(
                "distortion folds within the picture: some of its pixels see no ray; make it weaker"
            )
        if (self._border_rays()[:, 2] <= 0.0).any():
            raise ValueError(
                "the picture reaches 90 degrees and more from the optical axis, where depths have no meaning; make "
                "fx and fy larger or the picture smaller"
            )
        off_px = self._rendered_off_px()
        if not off_px <= RENDERED_OFF_PX:
            raise ValueError(
                f"distortion is too strong to be rendered: rays would be {off_px:.2g} px off, and "
                f"{RENDERED_OFF_PX:g} are allowed; make it weaker"
            )
        return self

    def _sees_everywhere(self) -> bool:
        """Whether every pixel has a ray; those of the border tell, because no two rays share a pixel."""
        return bool(np.isfinite(self._border_rays(SPARE)).all())

    def _border_rays(self, spare: float = 0.0) -> np.ndarray:
        """(204, 3) rays through the border of the picture, or of one that is larger by a share."""
        along = np.linspace(-1.0, 1.0, 51)
        corners = np.stack([along, np.ones_like(along)], axis=-1)
        border = np.concatenate([corners, -corners, corners[:, ::-1], -corners[:, ::-1]])
        half = np.array([self.width, self.height]) / 2.0
        pixels = half - 0.5 + border * half
        centre = np.array([self.cx, self.cy])
        return unproject(self.camera, centre + (1.0 + spare) * (pixels - centre))

    def _rendered_off_px(self) -> float:
        """How far rendered rays are from their pixels, at the most: the shader's iteration does not always converge."""
        x, y = (np.linspace(-0.5, side - 0.5, 33) for side in (self.width, self.height))
        pixels = np.stack(np.meshgrid(x, y), axis=-1)
        with np.errstate(all="ignore"):
            rendered_px = project(self.camera, rendered_rays(self.camera, pixels))
        off_px = np.linalg.norm(rendered_px - pixels, axis=-1).max()
        return float(off_px) if np.isfinite(off_px) else np.inf

    @property
    def camera(self) -> Camera:
        """Intrinsics."""
        terms = tuple(getattr(self.distortion, term) for term in DISTORTION_TERMS[self.model])
        return Camera(
            model=self.model,
            width=self.width,
            height=self.height,
            fx=self.fx,
            fy=self.fy,
            cx=self.cx,
            cy=self.cy,
            distortion=terms if any(terms) else (),
        )

    def inside_aperture_px(self, pixels: np.ndarray) -> np.ndarray:
        """How far points (..., 2) lie inside the rim of the lens, in pixels; negative beyond it."""
        if self.lens.aperture_radius is None:
            return np.full(pixels.shape[:-1], np.inf)
        middle = np.array([self.width - 1, self.height - 1]) / 2.0
        offset = pixels - middle - np.multiply(self.lens.aperture_offset, self.width)
        return self.lens.aperture_radius * self.width - np.linalg.norm(offset, axis=-1)

    @property
    def headset_from_camera(self) -> np.ndarray:
        """Pose (4, 4) of the OpenCV camera in the headset frame, metres."""
        pose = look_at(np.multiply(self.position_mm, MM), np.multiply(self.target_mm, MM))
        roll = np.radians(self.roll_deg)
        about_axis = np.array(
            [[np.cos(roll), -np.sin(roll), 0.0], [np.sin(roll), np.cos(roll), 0.0], [0.0, 0.0, 1.0]]
        )
        return pose @ transform(about_axis, np.zeros(3))

    def scaled(self, width: int) -> "HeadsetCamera":
        """The same camera with a picture ``width`` pixels wide: field of view and pose stay."""
        height = max(8, round(self.height * width / self.width))
        sx, sy = width / self.width, height / self.height
        # a pixel's centre is at +0.5 of its corner, and it is corners that scale
        return replace(
            self,
            width=width,
            height=height,
            fx=self.fx * sx,
            fy=self.fy * sy,
            cx=(self.cx + 0.5) * sx - 0.5,
            cy=(self.cy + 0.5) * sy - 0.5,
        )

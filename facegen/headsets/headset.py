"""A headset as data: cameras, LEDs, sensor, and how it sits on a head; checked once, then trusted.

Headset frame: axes as the head's (x to the subject's left, y up, z out of the face), origin between the
places where the file's maker expects the two eyeball centres. Keys carry their unit (``position_mm``,
``roll_deg``); the properties without one are in metres and radians.
"""

from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
from pydantic import ConfigDict, Field, model_validator
from pydantic.dataclasses import dataclass

from facegen.geometry import Camera, look_at, project, rotation_from_angles, transform, unproject
from facegen.geometry.cameras import DISTORTION_TERMS

CONFIG = ConfigDict(extra="forbid", allow_inf_nan=False)
_record = dataclass(frozen=True, kw_only=True, config=CONFIG)

Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]
Vector = tuple[float, float, float]
Spread = tuple[NotNegative, NotNegative, NotNegative]
MM = 1e-3


@_record
class Distortion:
    """Coefficients by name, in OpenCV's meaning; those not given are 0."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    k4: float = 0.0
    p1: float = 0.0
    p2: float = 0.0


@_record
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
        return self

    def _sees_everywhere(self) -> bool:
        """Whether the distortion has an inverse in the whole picture, judged along lines to its corners."""
        corners = np.array([[u, v] for u in (-0.5, self.width - 0.5) for v in (-0.5, self.height - 0.5)])
        centre = np.array([self.cx, self.cy])
        pixels = centre + (corners - centre)[:, None] * np.linspace(0.02, 1.0, 50)[:, None]
        rays = unproject(self.camera, pixels)
        # a polynomial that turns back has its ray elsewhere: on the other side, or nearer to the axis than
        # the last one
        same_side = (rays[..., :2] * (pixels - centre)).sum(axis=-1) > 0
        outwards = np.diff(rays[..., 2], axis=1) < 0
        # a hundredth of a pixel is far above rounding
        back = np.allclose(project(self.camera, rays), pixels, rtol=0.0, atol=0.01)
        return bool(same_side.all() and outwards.all() and back)

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


@_record
class Led:
    """A round infra-red LED, lit only while ``camera`` exposes (headsets strobe theirs)."""

    name: Name
    camera: Name
    position_mm: Vector
    target_mm: Vector
    wavelength_nm: Annotated[float, Field(ge=700, le=1100)]
    power_mw: NotNegative
    diameter_mm: Positive
    beam_deg: Annotated[float, Field(gt=0, le=180)]

    @model_validator(mode="after")
    def _check(self) -> "Led":
        if self.position_mm == self.target_mm:
            raise ValueError("position_mm and target_mm are the same point")
        return self

    @property
    def position(self) -> np.ndarray:
        """(3,) headset frame, metres."""
        return np.multiply(self.position_mm, MM)

    @property
    def direction(self) -> np.ndarray:
        """Unit vector along the middle of the beam, headset frame."""
        step = np.subtract(self.target_mm, self.position_mm)
        return step / np.linalg.norm(step)


@_record
class Sensor:
    """How linear radiance becomes grey levels: one setting for all people (see `facegen.sensor`).

    ``exposure`` is the number of full scales (levels above black) that a radiance of 1 W sr-1 m-2 gives,
    ``veiling_glare`` the share of the light that the lens scatters evenly over the picture.
    """

    exposure: Positive
    black_level: Annotated[float, Field(ge=0, le=200)]
    veiling_glare: Annotated[float, Field(ge=0, le=0.5)] = 0.0
    bits: Literal[8] = 8


@_record
class Fit:
    """Where the headset sits: the wearer's nose bridge and eye line, in the headset's frame.

    Only depth (z) and the middle (x) follow the nose bridge (landmark index 27); height follows the eyes.
    """

    nose_bridge_mm: Vector
    eye_line_mm: float = 0.0


@_record
class Tolerances:
    """Standard deviations: millimetres along x, y, z; degrees of yaw, pitch, roll about the origin.

    ``donning`` changes each time the headset is put on, ``slip`` within a clip; the others belong to a single
    unit.
    """

    donning_mm: Spread = (0.0, 0.0, 0.0)
    donning_deg: Spread = (0.0, 0.0, 0.0)
    slip_mm: Spread = (0.0, 0.0, 0.0)
    slip_deg: Spread = (0.0, 0.0, 0.0)
    mount_mm: NotNegative = 0.0
    mount_deg: NotNegative = 0.0
    focal_percent: NotNegative = 0.0
    led_power_percent: NotNegative = 0.0


@_record
class Headset:
    """Everything about a headset that does not depend on who wears it."""

    name: Name
    description: str = ""
    cameras: Annotated[tuple[HeadsetCamera, ...], Field(min_length=1)]
    leds: tuple[Led, ...] = ()
    sensor: Sensor
    fit: Fit
    tolerances: Tolerances = Tolerances()

    @model_validator(mode="after")
    def _check(self) -> "Headset":
        cameras = self.camera_names
        for kind, names in (("cameras", cameras), ("leds", tuple(led.name for led in self.leds))):
            repeated = sorted({name for name in names if names.count(name) > 1})
            if repeated:
                raise ValueError(f"two {kind} are named {repeated[0]!r}; names must differ")
        for index, led in enumerate(self.leds):
            if led.camera not in cameras:
                raise ValueError(
                    f"leds[{index}].camera is {led.camera!r}, but the cameras are {', '.join(cameras)}"
                )
        return self

    @property
    def camera_names(self) -> tuple[str, ...]:
        """Names of the cameras, in the file's order."""
        return tuple(camera.name for camera in self.cameras)

    def camera(self, name: str) -> HeadsetCamera:
        """The camera of that name; KeyError where there is none."""
        return {camera.name: camera for camera in self.cameras}[name]

    def scaled(self, width: int) -> "Headset":
        """The same headset with pictures ``width`` pixels wide."""
        return replace(self, cameras=tuple(camera.scaled(width) for camera in self.cameras))


def head_from_headset(headset: Headset, nose_bridge: np.ndarray, donning: np.ndarray) -> np.ndarray:
    """Place a headset on a person.

    Parameters
    ----------
    headset
        The headset.
    nose_bridge
        (3,) the person's neutral landmark 27, head frame, metres.
    donning
        (6,) how this donning deviates: metres along the head's x, y, z, then radians of yaw, pitch and roll
        about the headset's origin (`facegen.geometry.rotation_from_angles`).

    Returns
    -------
    numpy.ndarray
        ``head_from_headset`` (4, 4).
    """
    rest = np.multiply(headset.fit.nose_bridge_mm, MM)
    origin = np.array([nose_bridge[0] - rest[0], -headset.fit.eye_line_mm * MM, nose_bridge[2] - rest[2]])
    donning = np.asarray(donning, np.float64)
    return transform(rotation_from_angles(*donning[3:]), origin + donning[:3])

"""A headset as data: cameras, LEDs, sensor, and how it sits on a head; checked once, then trusted.

Headset frame: axes as the head's (x to the subject's left, y up, z out of the face), origin between the
places where the file's maker expects the two eyeball centres. Keys carry their unit (``position_mm``,
``roll_deg``); the properties without one are in metres and radians.
"""

from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from facegen.geometry import rotation_from_angles, transform
from facegen.headsets.cameras import HeadsetCamera
from facegen.headsets.occluders import HeadsetOccluder
from facegen.headsets.quantities import MM, Name, NotNegative, Positive, Spread, Vector, record

TAKEN = frozenset(
    {
        *("sample", "person", "session", "clip", "frame", "time_s", "split", "neutral", "component", "sex"),
        *("age_years", "weights", "identity", "rig", "points_2d", "detected_2d", "points_3d", "visibility"),
        *("camera_from_head", "intrinsics", "contour_2d", "contour_3d", "gaze", "head_from_headset", "slip"),
        "record",
    }
)
"""Columns of packs beside the cameras' own, which are called after them."""
RESERVED = frozenset(
    {"con", "prn", "aux", "nul", *(f"{port}{number}" for port in ("com", "lpt") for number in range(10))}
)
"""Windows takes these for devices, whatever comes after a dot: pictures are files called after cameras."""


@record()
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


@record()
class HeadsetSensor:
    """How linear radiance becomes grey levels: one setting for all people (see `facegen.sensor`).

    ``exposure`` times ``gain`` is the number of full scales (levels above black) that a radiance of 1 W sr-1 m-2
    gives, ``veiling_glare`` the share of the light that the lens scatters evenly over the picture. At full scale and
    gain 1 a pixel holds ``full_well_electrons``, whose number is uncertain by its square root (shot noise), and
    reading it out by ``read_noise_electrons`` more. Motion during ``exposure_ms`` blurs.
    """

    exposure: Annotated[float, Field(ge=1e-9, le=1e9)]
    gain: Annotated[float, Field(ge=1e-6, le=1e6)] = 1.0
    black_level: Annotated[float, Field(ge=0, le=200)]
    veiling_glare: Annotated[float, Field(ge=0, le=0.5)] = 0.0
    full_well_electrons: Annotated[float, Field(ge=100, le=1e9)] = 10_000.0
    read_noise_electrons: Annotated[float, Field(ge=0, le=1e6)] = 15.0
    exposure_ms: Annotated[float, Field(gt=0, le=1e4)] = 2.0
    bits: Literal[8] = 8


@record()
class HeadsetFit:
    """Where the headset sits: the wearer's nose bridge and eye line, in the headset's frame.

    Depth (z) and the middle (x) follow the person's nose bridge (landmark index 27). Height counts from the head
    frame's origin and follows nobody: the mean person's eyes turn 1.4 mm below it, others 0.9 mm from there (sd).
    """

    nose_bridge_mm: Vector
    eye_line_mm: float = 0.0


@record()
class Tolerances:
    """Standard deviations: millimetres along x, y, z; degrees of yaw, pitch, roll about the origin.

    ``donning`` changes each time the headset is put on, ``slip`` within a clip; the others belong to a single
    unit (`facegen.headsets.units`), and every session has a unit of its own.
    """

    donning_mm: Spread = (0.0, 0.0, 0.0)
    donning_deg: Spread = (0.0, 0.0, 0.0)
    slip_mm: Spread = (0.0, 0.0, 0.0)
    slip_deg: Spread = (0.0, 0.0, 0.0)
    mount_mm: NotNegative = 0.0
    mount_deg: NotNegative = 0.0
    focal_percent: NotNegative = 0.0
    led_mm: NotNegative = 0.0
    led_power_percent: NotNegative = 0.0
    exposure_percent: NotNegative = 0.0
    black_levels: NotNegative = 0.0


@record()
class Headset:
    """Everything about a headset that does not depend on who wears it."""

    name: Name
    description: str = ""
    cameras: Annotated[tuple[HeadsetCamera, ...], Field(min_length=1)]
    leds: tuple[Led, ...] = ()
    occluders: tuple[HeadsetOccluder, ...] = ()
    sensor: HeadsetSensor
    fit: HeadsetFit
    tolerances: Tolerances = Tolerances()

    @model_validator(mode="after")
    def _check(self) -> "Headset":
        cameras = self.camera_names
        for kind, things in (("cameras", self.cameras), ("leds", self.leds), ("occluders", self.occluders)):
            names = tuple(thing.name for thing in things)
            repeated = sorted({name for name in names if names.count(name) > 1})
            if repeated:
                raise ValueError(f"two {kind} are named {repeated[0]!r}; names must differ")
        for index, name in enumerate(cameras):
            if name in TAKEN or name in RESERVED:
                whose = (
                    "a column of packs" if name in TAKEN else "a device of Windows, which has no such files"
                )
                raise ValueError(f"cameras[{index}].name is {name!r}, the name of {whose}; choose another")
        for index, led in enumerate(self.leds):
            if led.camera not in cameras:
                raise ValueError(
                    f"leds[{index}].camera is {led.camera!r}, but the cameras are {', '.join(cameras)}"
                )
        for kind, things in (("cameras", self.cameras), ("leds", self.leds)):
            for index, thing in enumerate(things):
                for occluder in self.occluders:
                    if occluder.contains(np.multiply(thing.position_mm, MM)):
                        raise ValueError(
                            f"{kind}[{index}].position_mm is {list(thing.position_mm)}, inside the occluder "
                            f"{occluder.name!r}; move one of them"
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

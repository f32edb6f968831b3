"""Draws layouts: where a headset's cameras and LEDs are, what they see, and how its sensor answers."""

from dataclasses import dataclass, replace

import numpy as np

from facegen.errors import InputError
from facegen.geometry import direction_from_angles, look_at
from facegen.headsets import Headset, HeadsetCamera, Led, Lens
from facegen.headsets.cameras import Distortion
from facegen.spec import Distribution, LayoutRanges, draw

CAMERAS = ("left_eye", "right_eye", "mouth")
"""Cameras of every drawn headset, and of the one that it shares sizes with."""

EYE_MM = (31.5, 0.0, 13.0)
"""Where cameras are aimed in the headset's frame; the mean person's left pupil is 1.4 mm lower and 2.5 mm ahead."""
MOUTH_MM = (0.0, -74.0, 28.0)
"""Where lips meet, in the same frame: the mean of the mean head's landmarks."""

EYE_LIGHT, MOUTH_LIGHT = 0.0267, 0.030
"""Light of all LEDs of a camera at what it sees, mW/mm2 over 1 - cos(beam / 2): tracking3's."""
EYE_BEAM_DEG, MOUTH_BEAM_DEG = 90.0, 150.0
WAVELENGTH_NM = 850.0
BAR_STEP_MM, BAR_GAP_MM = 5.0, 7.0
"""Between the LEDs of a bar, and from the camera to it."""
MOUTH_LEDS_MM = (12.0, 30.0)
"""From the mouth's camera to its LEDs."""
MOUTH_LED_DIAMETER_MM = 1.5


@dataclass(frozen=True, kw_only=True)
class LayoutCamera:
    """One camera of a layout; the axis meets ``target_mm``, and ``width_mm`` are seen there."""

    name: str
    position_mm: tuple[float, float, float]
    target_mm: tuple[float, float, float]
    width_mm: float
    roll_deg: float
    aspect: float
    fisheye: bool
    lens: Lens

    @property
    def distance_mm(self) -> float:
        """From the camera to what its axis meets."""
        return float(np.linalg.norm(np.subtract(self.position_mm, self.target_mm)))


@dataclass(frozen=True, kw_only=True)
class Layout:
    """What is drawn of a headset; everything else is that of the headset which it is built on.

    Attributes
    ----------
    cameras
        In the order of `CAMERAS`.
    leds
        Of all cameras.
    exposure_stops
        Powers of two on the sensor's exposure.
    black_level, veiling_glare
        Instead of the sensor's.
    housing
        Whether the occluders are kept.
    """

    cameras: tuple[LayoutCamera, ...]
    leds: tuple[Led, ...]
    exposure_stops: float
    black_level: float
    veiling_glare: float
    housing: bool


def draw_layout(rng: np.random.Generator, ranges: LayoutRanges) -> Layout:
    """Draw a layout; ``rng`` is its own stream, and its draws do not depend on the ranges."""

    def one(distribution: Distribution) -> float:
        return float(draw(distribution, rng, 1)[0])

    def several(distribution: Distribution, count: int) -> np.ndarray:
        return draw(distribution, rng, count)

    def lens() -> Lens:
        vignette, blur = one(ranges.vignette), one(ranges.blur)
        circle, radius = rng.random() < ranges.lens_circle, one(ranges.lens_circle_radius)
        offset = several(ranges.lens_circle_offset, 2)
        rim = {"aperture_radius": radius, "aperture_offset": _tuple(offset)} if circle else {}
        return Lens(vignette=vignette, blur=blur, **rim)

    azimuth, elevation, distance = (
        one(ranges.eye_azimuth_deg),
        one(ranges.eye_elevation_deg),
        one(ranges.eye_distance_mm),
    )
    aim = several(ranges.eye_aim_mm, 2)
    left = LayoutCamera(
        name="left_eye",
        width_mm=one(ranges.eye_width_mm),
        roll_deg=one(ranges.eye_roll_deg),
        aspect=one(ranges.aspect),
        fisheye=bool(rng.random() < ranges.fisheye),
        lens=lens(),
        **_stood(np.add(EYE_MM, (*aim, 0.0)), azimuth, elevation, distance),
    )
    right = _mirrored(left, several(ranges.sides_mm, 3))
    azimuth, elevation, distance = (
        one(ranges.mouth_azimuth_deg),
        one(ranges.mouth_elevation_deg),
        one(ranges.mouth_distance_mm),
    )
    aim = several(ranges.mouth_aim_mm, 2)
    mouth = LayoutCamera(
        name="mouth",
        width_mm=one(ranges.mouth_width_mm),
        roll_deg=one(ranges.mouth_roll_deg),
        aspect=one(ranges.aspect),
        fisheye=bool(rng.random() < ranges.fisheye),
        lens=lens(),
        **_stood(np.add(MOUTH_MM, (*aim, 0.0)), azimuth, elevation, distance),
    )
    return Layout(
        cameras=(left, right, mouth),
        leds=_draw_leds(rng, ranges, left, mouth),
        exposure_stops=one(ranges.light_stops),
        black_level=one(ranges.black_level),
        veiling_glare=one(ranges.veiling_glare),
        housing=bool(rng.random() < ranges.housing),
    )


def check_base(base: Headset) -> None:
    """Refuse a headset of other cameras than those of layouts.

    Raises
    ------
    InputError
        Names both.
    """
    if base.camera_names != CAMERAS:
        raise InputError(
            f"render.headset has the cameras {', '.join(base.camera_names)}; [layout] draws {', '.join(CAMERAS)}, and "
            "takes their sizes from a headset that has these, as tracking3 has"
        )


def headset_of(layout: Layout, base: Headset) -> Headset:
    """The headset of a layout, with the fit, tolerances, noise, housing and pictures' sizes of another one.

    Raises
    ------
    pydantic.ValidationError
        Where no such headset can be built: a picture that its lens does not fill, an LED in its own target.
    """
    placed = [camera.position_mm for camera in layout.cameras] + [led.position_mm for led in layout.leds]
    occluders = [
        occluder
        for occluder in (base.occluders if layout.housing else ())
        if not any(occluder.contains(np.multiply(place, 1e-3)) for place in placed)
    ]
    return replace(
        base,
        cameras=tuple(_camera(one, base.camera(one.name)) for one in layout.cameras),
        leds=layout.leds,
        occluders=tuple(occluders),
        sensor=replace(
            base.sensor,
            exposure=base.sensor.exposure * 2.0**layout.exposure_stops,
            black_level=layout.black_level,
            veiling_glare=layout.veiling_glare,
        ),
    )


def _camera(one: LayoutCamera, base: HeadsetCamera) -> HeadsetCamera:
    half = 0.5 * one.width_mm / one.distance_mm
    focal = 0.5 * base.width / (np.arctan(half) if one.fisheye else half)
    return HeadsetCamera(
        name=one.name,
        model="fisheye" if one.fisheye else "pinhole",
        width=base.width,
        height=base.height,
        fx=float(focal),
        fy=float(focal * one.aspect),
        cx=(base.width - 1) / 2.0,
        cy=(base.height - 1) / 2.0,
        distortion=Distortion(),
        position_mm=one.position_mm,
        target_mm=one.target_mm,
        roll_deg=one.roll_deg,
        lens=one.lens,
    )


def _stood(target: np.ndarray, azimuth_deg: float, elevation_deg: float, distance_mm: float) -> dict:
    towards = direction_from_angles(np.radians(azimuth_deg), np.radians(elevation_deg))
    return {"target_mm": _tuple(target), "position_mm": _tuple(target + distance_mm * towards)}


def _mirrored(left: LayoutCamera, off_mm: np.ndarray) -> LayoutCamera:
    flip = np.array([-1.0, 1.0, 1.0])
    offset = left.lens.aperture_offset
    return replace(
        left,
        name="right_eye",
        position_mm=_tuple(flip * left.position_mm + off_mm),
        target_mm=_tuple(flip * left.target_mm),
        roll_deg=-left.roll_deg,
        lens=replace(left.lens, aperture_offset=(-offset[0], offset[1])),
    )


def _draw_leds(
    rng: np.random.Generator, ranges: LayoutRanges, left: LayoutCamera, mouth: LayoutCamera
) -> tuple[Led, ...]:
    """LEDs of the left eye, of the right eye as their mirror images, and of the mouth."""
    count, mouth_count = (int(draw(each, rng, 1)[0]) for each in (ranges.eye_leds, ranges.mouth_leds))
    ring, bar_side, phase, mouth_phase = rng.random(4)
    radius, depth, diameter = (
        float(draw(each, rng, 1)[0])
        for each in (ranges.ring_radius_mm, ranges.ring_depth_mm, ranges.led_diameter_mm)
    )
    stops, mouth_stops = draw(ranges.camera_stops, rng, 2)
    reach = rng.uniform(*MOUTH_LEDS_MM)
    turns = 2.0 * np.pi * (np.arange(count) / count + phase)
    if ring < ranges.ring:
        around = np.stack([np.cos(turns), np.sin(turns), np.zeros(count)], axis=-1)
        places = (EYE_MM[0], 0.0, depth) + radius * around
    else:
        right, down = look_at(left.position_mm, left.target_mm)[:3, :2].T
        along = BAR_STEP_MM * (np.arange(count) - (count - 1) / 2.0)
        side = BAR_GAP_MM if bar_side < 0.5 else -BAR_GAP_MM
        places = left.position_mm + along[:, None] * right + side * down
    eye = _lit("left_eye", places, np.tile(EYE_MM, (count, 1)), EYE_LIGHT, stops, diameter, EYE_BEAM_DEG)
    flip = np.array([-1.0, 1.0, 1.0])
    other = tuple(
        replace(
            led,
            name=led.name.replace("left", "right"),
            camera="right_eye",
            position_mm=_tuple(flip * led.position_mm),
            target_mm=_tuple(flip * led.target_mm),
        )
        for led in eye
    )
    right, down = look_at(mouth.position_mm, mouth.target_mm)[:3, :2].T
    turns = 2.0 * np.pi * (np.arange(mouth_count) / mouth_count + mouth_phase)
    around = np.cos(turns)[:, None] * right + np.sin(turns)[:, None] * down
    below = _lit(
        "mouth",
        mouth.position_mm + reach * around,
        mouth.target_mm + reach * around,
        MOUTH_LIGHT,
        mouth_stops,
        MOUTH_LED_DIAMETER_MM,
        MOUTH_BEAM_DEG,
    )
    return eye + other + below


def _lit(
    camera: str,
    places: np.ndarray,
    targets: np.ndarray,
    light: float,
    stops: float,
    diameter_mm: float,
    beam_deg: float,
) -> tuple[Led, ...]:
    """LEDs that together give a light where they meet, each an equal part of it."""
    distance = np.linalg.norm(places - targets, axis=1)
    share = light * 2.0**stops / len(places) * (1.0 - np.cos(np.radians(beam_deg / 2.0)))
    return tuple(
        Led(
            name=f"{camera}_{number + 1}",
            camera=camera,
            position_mm=_tuple(place),
            target_mm=_tuple(target),
            wavelength_nm=WAVELENGTH_NM,
            power_mw=float(share * far**2),
            diameter_mm=float(diameter_mm),
            beam_deg=beam_deg,
        )
        for number, (place, target, far) in enumerate(zip(places, targets, distance, strict=True))
    )


def _tuple(values: np.ndarray) -> tuple[float, ...]:
    return tuple(float(value) for value in values)

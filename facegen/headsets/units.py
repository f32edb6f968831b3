"""Draws single units of a headset: no two leave the factory with cameras and LEDs exactly where the drawing says."""

from dataclasses import replace

import numpy as np
from pydantic import ValidationError

from facegen.geometry import look_at, rotation_from_angles
from facegen.headsets.cameras import HeadsetCamera
from facegen.headsets.headset import Headset, Led

_SHARES = 0.5 ** np.arange(8)
"""Of the drawn deviations, until a unit can be built."""


def draw_unit(headset: Headset, rng: np.random.Generator, *, scale: float = 1.0) -> Headset:
    """One unit of a headset, off by its tolerances; ``rng`` is the unit's own stream.

    Cameras are shifted by ``mount_mm``, turned by ``mount_deg`` about their own centres, and have another focal
    length; LEDs are shifted by ``led_mm`` and shine more or less. Beam directions stay. Everything is drawn whatever
    the tolerances are, so setting one to 0 leaves the others' draws unchanged. A unit that nobody could build, with a
    camera inside the housing or a picture that its lens does not fill, is halfway nearer to the drawing, as often as it
    takes.

    Parameters
    ----------
    headset
        The headset as drawn.
    rng
        Stream of the unit.
    scale
        Factor on all standard deviations.
    """
    drawn = (
        rng.standard_normal(2),
        rng.standard_normal((len(headset.cameras), 7)),
        rng.standard_normal((len(headset.leds), 4)),
    )
    for share in _SHARES:
        try:
            return _unit(headset, *(scale * share * numbers for numbers in drawn))
        except ValidationError:  # what a headset's file may not say either
            continue
    return headset


def _unit(headset: Headset, drawn: np.ndarray, cameras: np.ndarray, leds: np.ndarray) -> Headset:
    """``drawn``: standard normal exposure and black level; a row of draws for each camera and LED."""
    sd, sensor = headset.tolerances, headset.sensor
    exposure, black = drawn * (sd.exposure_percent / 100.0, sd.black_levels)
    return replace(
        headset,
        cameras=tuple(
            _mounted(camera, headset, row) for camera, row in zip(headset.cameras, cameras, strict=True)
        ),
        leds=tuple(_soldered(led, headset, row) for led, row in zip(headset.leds, leds, strict=True)),
        sensor=replace(
            sensor,
            exposure=sensor.exposure * float(np.exp(exposure)),
            black_level=float(np.clip(sensor.black_level + black, 0.0, 200.0)),
        ),
    )


def _mounted(camera: HeadsetCamera, headset: Headset, drawn: np.ndarray) -> HeadsetCamera:
    """``drawn``: standard normal shift (3), yaw, pitch and roll, and focal length."""
    sd = headset.tolerances
    position = camera.position_mm + sd.mount_mm * drawn[:3]
    turned = camera.headset_from_camera[:3, :3] @ rotation_from_angles(*np.radians(sd.mount_deg) * drawn[3:6])
    distance = np.linalg.norm(np.subtract(camera.target_mm, camera.position_mm))
    target = position + distance * turned[:, 2]
    about_axis = look_at(position, target)[:3, :3].T @ turned
    longer = float(np.exp(sd.focal_percent / 100.0 * drawn[6]))
    return replace(
        camera,
        position_mm=tuple(map(float, position)),
        target_mm=tuple(map(float, target)),
        roll_deg=float(np.degrees(np.arctan2(about_axis[1, 0], about_axis[0, 0]))),
        fx=camera.fx * longer,
        fy=camera.fy * longer,
    )


def _soldered(led: Led, headset: Headset, drawn: np.ndarray) -> Led:
    """``drawn``: standard normal shift (3) and power."""
    sd = headset.tolerances
    shift = sd.led_mm * drawn[:3]
    return replace(
        led,
        position_mm=tuple(map(float, led.position_mm + shift)),
        target_mm=tuple(map(float, led.target_mm + shift)),
        power_mw=led.power_mw * float(np.exp(sd.led_power_percent / 100.0 * drawn[3])),
    )

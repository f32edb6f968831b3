"""Develops a whole view: room, motion, lens, exposure and noise in the order in which light meets them."""

from dataclasses import replace

import numpy as np

from facegen.headsets import HeadsetCamera, HeadsetSensor
from facegen.randomness import stream
from facegen.sampling import Shot
from facegen.scene import Glimpse, Layers
from facegen.sensor.development import develop
from facegen.sensor.lens import defocused, transmission
from facegen.sensor.motion import blurred
from facegen.sensor.room import room_light


def develop_view(
    layers: Layers | Glimpse,
    camera: HeadsetCamera,
    camera_from_head: np.ndarray,
    sensor: HeadsetSensor,
    shot: Shot,
) -> np.ndarray:
    """Grey picture (h, w) uint8 of a view's layers.

    Parameters
    ----------
    layers
        What a renderer gave, with glints in its radiance; the room's light falls on its surfaces.
    camera
        Its lens, at the picture's size.
    camera_from_head
        (4, 4) its pose.
    sensor
        The unit's sensor.
    shot
        What is particular to this picture.
    """
    light = layers.radiance.astype(np.float64) + room_light(layers, camera_from_head, shot)
    way_rad = np.multiply(shot.motion_rad_s, sensor.exposure_ms * 1e-3)
    light = blurred(light, (way_rad[0] * camera.fx, way_rad[1] * camera.fy))
    light = defocused(light, camera) * transmission(camera)
    noise = shot.noise * draw_noise(stream(shot.noise_seed, "sensor noise", 0), light.shape)
    return develop(light, replace(sensor, exposure=sensor.exposure * shot.exposure_factor), noise=noise)


def draw_noise(rng: np.random.Generator, shape: tuple[int, int]) -> np.ndarray:
    """Standard normal noise of one picture."""
    return rng.standard_normal(shape)

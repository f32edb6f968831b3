"""Computes the radiant intensity of LEDs: the same beam that Cycles gives its lamps."""

import numpy as np

from facegen.scene.scene import Lamp


def radiant_intensity(lamp: Lamp, point: np.ndarray) -> float:
    """W/sr that a lamp sends towards a point (3,): Lambert's cosine, cut to its beam.

    Cycles weighs the cosine by 1 - tan(angle) / tan(spread / 2) and keeps the power.
    """
    ray = point - lamp.position
    cosine = min(float(ray @ lamp.direction / np.linalg.norm(ray)), 1.0)
    if cosine <= 0.0:
        return 0.0
    half = lamp.spread_rad / 2.0
    if half > np.pi / 2 - 1e-6:
        return lamp.power_w / np.pi * cosine
    edge = np.tan(half)
    beam = max(edge - np.sqrt(1.0 - cosine**2) / cosine, 0.0) / (edge - half)
    return lamp.power_w / np.pi * cosine * beam

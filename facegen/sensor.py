"""The camera's sensor: from linear radiance to the grey levels that a headset's driver delivers."""

import numpy as np

from facegen.headsets import Sensor


def develop(radiance: np.ndarray, sensor: Sensor) -> np.ndarray:
    """Grey picture of a radiance image: linear above the black level, rounded, cut at full scale.

    A share of the light does not reach its pixel but is scattered in the lens, evenly over the picture (veiling
    glare, ISO 9358): dark corners of bright pictures are not black.

    Parameters
    ----------
    radiance
        (h, w) linear radiance, W sr-1 m-2.
    sensor
        Exposure, black level, glare and bits of the headset.

    Returns
    -------
    numpy.ndarray
        (h, w) uint8.
    """
    white = float(2**sensor.bits - 1)
    full_scale = white - sensor.black_level
    light = np.asarray(radiance, np.float64)
    light = (1.0 - sensor.veiling_glare) * light + sensor.veiling_glare * light.mean()
    levels = sensor.black_level + full_scale * sensor.exposure * light
    return np.rint(np.clip(levels, 0.0, white)).astype(np.uint8)

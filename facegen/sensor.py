"""The camera's sensor: from linear radiance to the grey levels that a headset's driver delivers."""

import numpy as np

from facegen.headsets import Sensor


def develop(radiance: np.ndarray, sensor: Sensor) -> np.ndarray:
    """Grey picture of a radiance image: linear above the black level, rounded, cut at full scale.

    Parameters
    ----------
    radiance
        (h, w) linear radiance, W sr-1 m-2.
    sensor
        Exposure, black level and bits of the headset.

    Returns
    -------
    numpy.ndarray
        (h, w) uint8.
    """
    white = float(2**sensor.bits - 1)
    full_scale = white - sensor.black_level
    levels = sensor.black_level + full_scale * sensor.exposure * np.asarray(radiance, np.float64)
    return np.rint(np.clip(levels, 0.0, white)).astype(np.uint8)

"""Develops radiance: light on the sensor becomes grey levels."""

import numpy as np

from facegen.headsets import HeadsetSensor


def develop(radiance: np.ndarray, sensor: HeadsetSensor, *, noise: np.ndarray | None = None) -> np.ndarray:
    """Grey picture of a radiance image: linear above the black level, rounded, cut at full scale.

    A share of the light does not reach its pixel but is scattered in the lens, evenly over the picture (veiling
    glare, ISO 9358): dark corners of bright pictures are not black. Noise has the variance of the electrons' number,
    as Poisson's distribution has, plus the read-out's (EMVA 1288, "linear sensors").

    Parameters
    ----------
    radiance
        (h, w) linear radiance, W sr-1 m-2.
    sensor
        Exposure, gain, black level, glare, electrons and bits of the headset.
    noise
        (h, w) standard normal; without, there is no noise.

    Returns
    -------
    numpy.ndarray
        (h, w) uint8.
    """
    white = float(2**sensor.bits - 1)
    full_scale = white - sensor.black_level
    light = np.asarray(radiance, np.float64)
    light = (1.0 - sensor.veiling_glare) * light + sensor.veiling_glare * light.mean()
    share = sensor.exposure * sensor.gain * light
    if noise is not None:
        electrons = sensor.full_well_electrons / sensor.gain
        share = share + noise * np.sqrt(share / electrons + (sensor.read_noise_electrons / electrons) ** 2)
    return np.rint(np.clip(sensor.black_level + full_scale * share, 0.0, white)).astype(np.uint8)

"""The sensor: monotone, black level at no light, full scale cut."""

from dataclasses import replace

import numpy as np
import pytest

from facegen.headsets import Sensor
from facegen.sensor import develop

SENSOR = Sensor(exposure=0.5, black_level=15)


def test_no_light_is_the_black_level():
    assert (develop(np.zeros((2, 3)), SENSOR) == 15).all()


def test_more_light_never_gives_less():
    levels = develop(np.linspace(0.0, 4.0, 2000)[None], SENSOR)[0].astype(int)
    assert (np.diff(levels) >= 0).all()
    assert levels[-1] == 255


def test_full_scale_is_reached_at_one_over_exposure_and_cut_above():
    assert develop(np.array([[1.99, 2.0, 1e6]]), SENSOR).tolist() == [[254, 255, 255]]


def test_half_of_full_scale_is_halfway():
    picture = develop(np.array([[1.0]], np.float32), SENSOR)
    assert picture.dtype == np.uint8
    assert picture[0, 0] == 135


def test_veiling_glare_takes_light_from_where_it_is_to_everywhere():
    radiance = np.zeros((10, 10))
    radiance[:5] = 1.0
    clear = develop(radiance, SENSOR).astype(float) - 15
    veiled = develop(radiance, replace(SENSOR, veiling_glare=0.1)).astype(float) - 15
    assert veiled.mean() == pytest.approx(clear.mean(), abs=0.5)  # none is lost
    assert veiled[9, 9] == pytest.approx(0.1 * clear.mean(), abs=0.5)

"""The sensor: monotone, black level at no light, full scale cut; noise, motion, lens and room as they say."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import Part
from facegen.headsets import HeadsetSensor, Lens, load_headset
from facegen.sampling import Shot
from facegen.scene import Layers
from facegen.sensor import develop, develop_view
from facegen.sensor.lens import SHARP_PX, defocused, transmission
from facegen.sensor.motion import blurred

SENSOR = HeadsetSensor(exposure=0.5, black_level=15)
QUIET = Shot(
    exposure_factor=1.0,
    motion_rad_s=(0.0, 0.0),
    noise=0.0,
    noise_seed=5,
    room="dark",
    room_radiance=0.0,
    room_direction=(0.0, 0.0, 1.0),
    flash=False,
    dropped_led=None,
)
EYE = load_headset("tracking3").camera("left_eye").scaled(64)
CLEAR_EYE = replace(EYE, lens=Lens())


def layers_of(radiance: np.ndarray) -> Layers:
    """A flat, skin-coloured wall before the camera."""
    normal = np.zeros((*radiance.shape, 3), np.float32)
    normal[..., 2] = -1.0
    return Layers(
        radiance=radiance.astype(np.float32),
        depth=np.ones(radiance.shape, np.float32),
        normal=normal,
        part=np.full(radiance.shape, Part.SKIN, np.uint8),
        uv=np.zeros((*radiance.shape, 2), np.float32),
    )


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


@pytest.mark.parametrize(("gain", "light"), [(1.0, 0.4), (1.0, 1.6), (4.0, 0.2)])
def test_noise_is_that_of_the_electrons(gain, light):
    sensor = replace(SENSOR, gain=gain, full_well_electrons=2000.0, read_noise_electrons=20.0)
    noise = np.random.default_rng(1).standard_normal((200, 200))
    levels = develop(np.full((200, 200), light), sensor, noise=noise).astype(float)
    electrons = light * sensor.exposure * 2000.0  # gain amplifies them, it makes none
    sd = 240.0 * gain / 2000.0 * np.sqrt(electrons + 20.0**2)
    assert levels.std() == pytest.approx(np.hypot(sd, 1 / np.sqrt(12)), rel=0.03)
    assert levels.mean() == pytest.approx(15 + 240 * sensor.exposure * gain * light, abs=4 * sd / 200)


@settings(max_examples=25, deadline=None)
@given(right=st.floats(-6.0, 6.0), down=st.floats(-6.0, 6.0))
def test_motion_smears_a_point_evenly_along_its_way(right, down):
    spot = np.zeros((41, 41))
    spot[20, 20] = 1.0
    image = blurred(spot, (right, down))
    v, u = np.mgrid[-20:21, -20:21]
    assert image.sum() == pytest.approx(1.0)
    assert (image * u).sum() == pytest.approx(0.0, abs=1e-9)
    assert (image * v).sum() == pytest.approx(0.0, abs=1e-9)
    # steps of a third to half a pixel give the variance of an even line; interpolation adds up to a quarter
    for axis, way in ((u, right), (v, down)):
        assert way**2 / 12 * 0.6 - 1e-9 <= (image * axis**2).sum() <= way**2 / 12 + 0.26
    assert np.allclose(blurred(np.full((9, 9), 0.7), (right, down)), 0.7)


def test_no_motion_leaves_a_picture_alone():
    image = np.random.default_rng(2).random((7, 9))
    assert (blurred(image, (0.0, 0.0)) == image).all()


def test_lens_shades_corners_and_its_rim_is_sharp():
    assert (transmission(CLEAR_EYE) == 1.0).all()
    shaded = transmission(replace(EYE, lens=Lens(vignette=0.4)))
    assert shaded.max() == pytest.approx(1.0, abs=1e-3)
    assert shaded.min() == pytest.approx(0.6)
    rim = transmission(replace(EYE, lens=Lens(aperture_radius=0.25, aperture_offset=(0.1, 0.0))))
    assert rim.sum() == pytest.approx(np.pi * (0.25 * EYE.width) ** 2, rel=0.01)
    columns = np.arange(EYE.width)
    assert (rim * columns).sum() / rim.sum() == pytest.approx(31.5 + 6.4, abs=0.01)
    assert ((rim > 0) & (rim < 1)).sum() < 2 * np.pi * 0.25 * EYE.width * 1.5


def test_behind_the_rim_there_is_only_glare():
    camera = replace(EYE, lens=Lens(aperture_radius=0.3))
    sensor = replace(SENSOR, veiling_glare=0.1)
    picture = develop_view(layers_of(np.full((64, 64), 1.0)), camera, np.eye(4), sensor, QUIET)
    assert picture[0, 0] == round(15 + 240 * 0.5 * 0.1 * transmission(camera).mean())
    assert picture[32, 32] > 120


def test_a_quiet_shot_through_a_clear_lens_is_plain_developing():
    radiance = np.random.default_rng(3).random((64, 64))
    layers = layers_of(radiance)
    assert (
        develop_view(layers, CLEAR_EYE, np.eye(4), SENSOR, QUIET) == develop(layers.radiance, SENSOR)
    ).all()


def test_shots_differ_in_what_they_say():
    layers = layers_of(np.full((64, 64), 0.8))

    def shoot(**change):
        return develop_view(layers, CLEAR_EYE, np.eye(4), SENSOR, replace(QUIET, **change)).astype(float) - 15

    plain = shoot()
    assert shoot(exposure_factor=1.25).mean() == pytest.approx(1.25 * plain.mean(), abs=0.5)
    noisy = shoot(noise=1.0)
    assert noisy.std() > 0.5
    assert (noisy == shoot(noise=1.0)).all(), "the same seed gives the same noise"
    assert (noisy != shoot(noise=1.0, noise_seed=6)).any()
    # the wall faces the camera: light from behind the camera meets it fully, light from behind the wall not at all
    lit = shoot(room_radiance=0.5, room_direction=(0.0, 0.0, -1.0))
    assert lit.mean() == pytest.approx(plain.mean() + 240 * 0.5 * 0.5 * 0.55, abs=0.6)
    assert (shoot(room_radiance=0.5, room_direction=(0.0, 0.0, 1.0)) == plain).all()


@given(blur=st.floats(0.0, 0.1), seed=st.integers(0, 2**16))
@settings(max_examples=20, deadline=None)
def test_a_lens_out_of_focus_spreads_light_and_loses_none(blur: float, seed: int):
    light = np.random.default_rng(seed).random((64, 64))
    camera = replace(EYE, lens=Lens(blur=blur))
    soft = defocused(light, camera)
    assert soft.min() >= light.min() - 1e-12
    assert soft.max() <= light.max() + 1e-12
    np.testing.assert_allclose(defocused(np.ones((64, 64)), camera), 1.0)
    spot = np.zeros((64, 64))
    spot[32, 30] = 1.0
    spread = defocused(spot, camera)
    v, u = np.mgrid[:64, :64]
    assert spread.sum() == pytest.approx(1.0, abs=2e-3)
    if SHARP_PX < 64 * blur < 4:  # the border above
        assert np.sqrt((spread * (u - 30) ** 2).sum()) == pytest.approx(blur * 64, rel=0.05)
        assert (spread * v).sum() == pytest.approx(32, abs=0.1)

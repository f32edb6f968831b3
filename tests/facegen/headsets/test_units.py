"""Units of a headset: off by the tolerances on average, equal to the drawing without any."""

from dataclasses import replace

import numpy as np
import pytest

from facegen.headsets import draw_unit, load_headset

TRACKING3 = load_headset("tracking3")


def test_a_unit_without_tolerances_is_the_drawing():
    unit = draw_unit(TRACKING3, np.random.default_rng(1), scale=0.0)
    for drawn, made in zip(TRACKING3.cameras, unit.cameras, strict=True):
        assert np.allclose(made.headset_from_camera, drawn.headset_from_camera, atol=1e-12)
        assert made.camera == drawn.camera
    places = [(made.position, drawn.position) for made, drawn in zip(unit.leds, TRACKING3.leds, strict=True)]
    assert np.allclose(*zip(*places, strict=True), atol=1e-12)
    assert unit.sensor == TRACKING3.sensor


def test_units_are_off_by_the_tolerances():
    sd = replace(
        TRACKING3.tolerances,
        mount_mm=0.5, mount_deg=1.0, focal_percent=2.0, led_mm=0.3, led_power_percent=5.0, exposure_percent=3.0,
        black_levels=0.5,
    )  # fmt: skip
    headset = replace(TRACKING3, tolerances=sd)
    units = [draw_unit(headset, np.random.default_rng(i)) for i in range(80)]
    drawn = np.array([camera.headset_from_camera for camera in headset.cameras])
    made = np.array([[camera.headset_from_camera for camera in unit.cameras] for unit in units])
    assert (made[..., :3, 3] - drawn[:, :3, 3]).std() == pytest.approx(0.5e-3, rel=0.1)
    turned = np.einsum("uckj,ckl->ucjl", made[..., :3, :3], drawn[:, :3, :3])
    angles = np.stack([turned[..., 2, 1], turned[..., 0, 2], turned[..., 1, 0]], axis=-1)  # small rotations
    assert np.degrees(angles.std(axis=(0, 1))) == pytest.approx(1.0, rel=0.15)
    focal = np.log([[c.fx for c in unit.cameras] for unit in units]) - np.log([c.fx for c in headset.cameras])
    assert focal.std() == pytest.approx(0.02, rel=0.15)
    power = np.log([[led.power_mw for led in unit.leds] for unit in units])
    assert power.std(axis=0).mean() == pytest.approx(0.05, rel=0.1)
    beams = [led.direction for led in headset.leds]
    assert np.allclose([led.direction for led in units[0].leds], beams)
    places = np.array([[led.position_mm for led in unit.leds] for unit in units])
    assert places.std(axis=0).mean() == pytest.approx(0.3, rel=0.1)
    assert np.std([unit.sensor.black_level for unit in units]) == pytest.approx(0.5, rel=0.25)
    assert np.log([unit.sensor.exposure for unit in units]).std() == pytest.approx(0.03, rel=0.25)


def test_one_tolerance_leaves_the_others_draws():
    loose = replace(TRACKING3, tolerances=replace(TRACKING3.tolerances, mount_mm=9.0))
    a, b = (draw_unit(headset, np.random.default_rng(3)) for headset in (TRACKING3, loose))
    assert a.leds == b.leds
    assert [c.fx for c in a.cameras] == [c.fx for c in b.cameras]


def test_a_unit_that_nobody_could_build_is_nearer_to_the_drawing():
    training9 = load_headset("training9")
    shares = []
    for seed in range(6):
        unit, random = (
            draw_unit(training9, np.random.default_rng(seed), scale=10.0),
            np.random.default_rng(seed),
        )
        random.standard_normal(2)
        drawn_mm = (
            10.0 * training9.tolerances.mount_mm * random.standard_normal((len(unit.cameras), 7))[:, :3]
        )
        places_mm = [[camera.position_mm for camera in one.cameras] for one in (unit, training9)]
        share = np.subtract(*places_mm) / drawn_mm
        assert np.allclose(share, share[0, 0])
        shares.append(share[0, 0])
    assert np.allclose(np.log2(shares), np.round(np.log2(shares)), atol=1e-6)
    assert min(shares) < 0.6

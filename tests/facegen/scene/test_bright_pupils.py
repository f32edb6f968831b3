"""Pupils are bright from LEDs on the camera's axis alone."""

import dataclasses

import numpy as np
import pytest

from facegen.geometry import invert_transform
from facegen.headsets import head_from_headset, load_headset
from facegen.rigs import eye_geometry
from facegen.scene import MATERIALS
from facegen.scene.assembly import headset_lamps, headset_views
from facegen.scene.bright_pupils import bright_pupil
from tests.facegen.blender.scenes import eye_scene

EYES = tuple(eye_geometry(np.array([x, 0.0, 0.0]), 0.012, np.array([0.0, 0.0, 1.0])) for x in (0.0, -0.06))


def _beside_the_axis(degrees: float):
    scene = eye_scene(96, yaw_rad=0.0)
    camera_m = invert_transform(scene.views[0].camera_from_head)[:3, 3]
    pupil = EYES[0].center + EYES[0].iris_plane_offset * EYES[0].axis
    aside = np.array([np.linalg.norm(camera_m - pupil) * np.tan(np.radians(degrees)), 0.0, 0.0])
    lamp = dataclasses.replace(
        scene.lamps[0], position=camera_m + aside, direction=np.array([0.0, 0.0, -1.0])
    )
    return dataclasses.replace(scene, lamps=(lamp,)), lamp


def test_a_pupil_is_brighter_than_the_iris_on_the_axis_and_dark_beyond_four_degrees():
    added = []
    for degrees in (0.0, 1.0, 2.0, 4.0):
        scene, _ = _beside_the_axis(degrees)
        view = dataclasses.replace(scene.views[0], lamps=("lamp_-1",))
        pupil = bright_pupil(view, scene.lamps, EYES).get("pupil", MATERIALS["pupil"])
        added.append(pupil["albedo"] - MATERIALS["pupil"]["albedo"])
    assert added[0] > MATERIALS["iris"]["albedo"]
    assert added[0] > added[1] > added[2] > 0.0
    assert added[2] == pytest.approx(added[0] / 6.0, rel=0.1)
    assert added[3] == 0.0
    dark = dataclasses.replace(scene.views[0], lamps=())
    assert bright_pupil(dark, scene.lamps, EYES) == {}


@pytest.mark.parametrize("name", ["tracking3", "training9", "mouth1"])
def test_headsets_that_come_with_facegen_have_dark_pupils(name):
    headset = load_headset(name)
    fit = head_from_headset(headset, np.array([0.0, -4e-3, 25.6e-3]), np.zeros(6))
    eyes = tuple(
        eye_geometry(np.array([x, 0.0, 0.0]), 0.012, np.array([0.0, 0.0, 1.0])) for x in (0.032, -0.032)
    )
    for view in headset_views(headset, fit):
        assert bright_pupil(view, headset_lamps(headset, fit), eyes) == {}


@pytest.mark.blender
def test_a_bright_pupil_shines_in_its_own_view_alone():
    from facegen.blender import open_renderer
    from facegen.conventions import Part

    scene, _ = _beside_the_axis(0.5)
    lit = dataclasses.replace(scene.views[0], lamps=("lamp_-1",))
    bright = dataclasses.replace(lit, materials=bright_pupil(lit, scene.lamps, EYES))
    renderer = open_renderer(threads=2)
    pictures = [
        renderer.render(dataclasses.replace(scene, views=(view,)), "eye", samples=8, seed=1)
        for view in (lit, bright, lit)
    ]
    assert np.array_equal(pictures[0].radiance, pictures[2].radiance)
    dark, shining = (
        [layers.radiance[layers.part == part].mean() for part in (Part.PUPIL, Part.IRIS)]
        for layers in pictures[:2]
    )
    assert dark[0] < dark[1]
    assert shining[0] > 1.3 * shining[1]

"""What is drawn of a headset's cameras, and which cannot do their work."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facegen.geometry import project, unproject
from facegen.headsets import list_headsets, load_headset
from facegen.preview.wearer import placement_faults, put_on

MINE = Path(__file__).parents[3] / "docs" / "examples" / "mine.toml"


@pytest.mark.parametrize("name", [*list_headsets(), str(MINE)])
def test_rays_that_are_drawn_stay_in_their_order(name):
    for camera in load_headset(name).cameras:
        corners = np.array([[-0.5, -0.5], [camera.width - 0.5, camera.height - 0.5]])
        least = unproject(camera.camera, corners)[:, 2].min()
        angle = np.linspace(0, np.radians(179), 400)
        for turn in np.linspace(0, 2 * np.pi, 37):
            rays = np.stack(
                [np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], axis=-1
            )
            places = project(camera.camera, rays)
            drawn = np.isfinite(places).all(axis=-1)
            assert drawn[np.cos(angle) > least].all()
            assert (np.diff(drawn.astype(int)) <= 0).all(), "none is drawn beyond one that is not"
            assert (np.diff(np.linalg.norm(places - places[0], axis=-1)[drawn]) > 0).all()


@pytest.mark.parametrize("name", [*list_headsets(), str(MINE)])
def test_cameras_of_headsets_stand_outside_the_face_and_see_it(anny, name):
    assert placement_faults(put_on(load_headset(name), anny)) == []


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"position_mm": (32.0, 0.0, 5.0)}, "behind the mean face's skin"),
        ({"target_mm": (60.0, -15.0, 200.0)}, "sees none of the mean face's 68 landmarks"),
        (
            {"position_mm": (-40.0, -15.0, 50.0), "target_mm": (-32.0, 0.0, 0.0)},
            "sees more of the other eye",
        ),
    ],
)
def test_a_camera_that_cannot_do_its_work_is_named(anny, change, words):
    headset = load_headset("tracking3")
    left, *others = headset.cameras
    (fault,) = placement_faults(put_on(replace(headset, cameras=(replace(left, **change), *others)), anny))
    assert "cameras[0] (left_eye)" in fault
    assert words in fault


def test_an_led_behind_the_skin_is_named(anny):
    """One in metres, say."""
    headset = load_headset("tracking3")
    first, *others = headset.leds
    inside = replace(first, position_mm=(0.05, 0.0, 0.041))
    (fault,) = placement_faults(put_on(replace(headset, leds=(inside, *others)), anny))
    assert f"leds[0] ({first.name})" in fault
    assert "behind the mean face's skin" in fault

"""Closed lids hide the eyes from headsets' cameras; open ones show each pupil that skin or housing does not cover."""

import numpy as np
import pytest

from facegen.conventions import Part
from facegen.geometry import direction_from_angles
from facegen.headsets import list_headsets, load_headset
from facegen.rigs import Rig, evaluate
from facegen.sampling.gaze import weights_from_axes
from tests.facegen.rigs.eye_views import before_pupils, eyeball_pixels, scene_of
from tests.facegen.rigs.people import people, weights

pytestmark = pytest.mark.slow

GAZE_DEG = np.array([[0.0, 0.0], [25.0, 25.0], [-25.0, -25.0]])


def looking(rig: Rig, blink: float):
    """Scenes of people who look straight ahead, up and aside, and down and aside, in every headset."""
    count = len(GAZE_DEG) if rig.components else 1
    axis = direction_from_angles(*np.radians(GAZE_DEG[:count].T))
    gaze = np.repeat(axis[:, None], 2, axis=1)
    rows = weights(count, eyeBlink=blink)
    for index, value in weights_from_axes(gaze).items():
        rows[:, index] = value
    faces = evaluate(rig, people(rig, count), rows, gaze)
    for name in list_headsets():
        if name != "tracking3":  # its cameras are among training9's
            for i in range(count):
                yield scene_of(rig, faces, i, gaze[i], load_headset(name), np.zeros(6))


def test_no_camera_sees_the_eyes_behind_shut_lids(rig: Rig) -> None:
    for scene in looking(rig, 1.0):
        seen = {view.name: eyeball_pixels(view, scene) for view in scene.views}
        assert max(seen.values()) == 0, seen


def test_nothing_but_skin_and_housing_covers_the_pupils_of_open_eyes(rig: Rig) -> None:
    met = [part for scene in looking(rig, 0.0) for view in scene.views for part in before_pupils(view, scene)]
    assert met.count(Part.PUPIL) >= 3
    # an eye that is turned far from a camera hides its pupil behind its own white
    covers = {Part.SKIN, Part.BROWS, Part.HEADSET, Part.SCLERA}
    assert not set(met) - {Part.PUPIL, *covers}


def test_open_eyes_are_seen(rig: Rig) -> None:
    (view,), scene = next(
        ([view for view in scene.views if view.name == "left_eye"], scene)
        for scene in looking(rig, 0.0)
        if len(scene.views) > 1
    )
    assert eyeball_pixels(view, scene) > 1000

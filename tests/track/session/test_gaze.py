"""Gaze behind a calibration that asked to look into the camera: eyes are the person's, however the head was held."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import LOOKS
from regress.runtime.stages.head import angles_of
from tests.regress.test_gaze import into_camera, seen
from tests.track.session.faces import new_session
from track.detectors.head import typical_camera
from track.session.calibration import Outcome

WIDTH, HEIGHT = 1280, 720
PLACE = (0.02, 0.05, 0.6)
HEADS = st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2)).map(np.array)


def looking(head_rad: np.ndarray, gaze: np.ndarray, *, given_head: bool) -> Sample:
    """A frame of somebody whose eyes turn like this in the head, which the detector gives, or not."""
    face, irises, pose = seen(head_rad, gaze, place=PLACE, camera=typical_camera(WIDTH, HEIGHT))
    head = np.concatenate([pose.translation[0], angles_of(pose.rotation)[0]]) if given_head else None
    picture = np.broadcast_to(np.uint8(0), (HEIGHT, WIDTH))
    return Sample(time_s=0.0, points=face, irises=irises, head=head, pictures={"camera": picture})


@pytest.mark.parametrize("given_head", [True, False])
@given(head=HEADS)
def test_who_was_asked_to_look_into_the_camera_looks_nowhere_else_afterwards(
    given_head: bool, head: np.ndarray
):
    """Before a screen that is below the camera the head is held down, and the eyes look up from it."""
    session = new_session(filter_name="none")
    neutral = looking(head, into_camera(head, PLACE), given_head=given_head)
    session.adjusting.take(Outcome(name="neutral", samples=(neutral,) * 12))
    stage = session.pipeline.stages["head"]
    ahead = stage.step(looking(head, np.zeros(4), given_head=given_head))
    np.testing.assert_allclose(np.degrees(ahead.gaze), 0, atol=2.5)
    up = stage.step(neutral)
    np.testing.assert_allclose(np.degrees(up.gaze), np.degrees(into_camera(head, PLACE)), atol=2.5)


def test_a_head_held_down_while_it_was_calibrated_moves_no_lid():
    """The weights of all day: 10 degrees were two fifths of eyeLookDown."""
    down = np.radians([0.0, -10.0, 0.0])
    session = new_session(filter_name="none")
    neutral = looking(down, into_camera(down, PLACE), given_head=True)
    session.adjusting.take(Outcome(name="neutral", samples=(neutral,) * 12))
    for row in range(30):  # what fades in has faded
        sample = looking(down, np.zeros(4), given_head=True)
        (answer,) = session.answer(replace(sample, time_s=row / 30))
    assert answer.weights[LOOKS].max() < 0.1

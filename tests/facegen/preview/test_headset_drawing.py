"""What is drawn of a headset's cameras: nothing that a distortion folds back into the picture."""

from pathlib import Path

import numpy as np
import pytest

from facegen.geometry import project, unproject
from facegen.headsets import load_headset
from facegen.preview.headsets import _pinhole_edge

MINE = Path(__file__).parents[3] / "docs" / "examples" / "mine.toml"


@pytest.mark.parametrize("name", ["tracking3", "training9", "mouth1", str(MINE)])
def test_rays_that_are_drawn_stay_in_their_order(name):
    for camera in load_headset(name).cameras:
        if camera.model != "pinhole":
            continue
        edge = _pinhole_edge(camera.camera)
        corners = np.array([[-0.5, -0.5], [camera.width - 0.5, camera.height - 0.5]])
        assert (unproject(camera.camera, corners)[:, 2] > edge).all()
        angle = np.linspace(0, np.arccos(edge), 200)
        for turn in np.linspace(0, 2 * np.pi, 37):
            rays = np.stack(
                [np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], axis=-1
            )
            places = project(camera.camera, rays)
            assert (np.diff(np.linalg.norm(places - places[0], axis=-1)) > 0).all()

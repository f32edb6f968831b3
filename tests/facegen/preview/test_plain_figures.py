"""Heads in plain colours: every rig has brows, and no black specks stand between lid and eyeball."""

from dataclasses import replace

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES, LANDMARK_GROUPS, Part
from facegen.headsets import load_headset
from facegen.preview import headsets
from facegen.preview.portraits import drawn_mesh, shade
from facegen.raster import nearest_along_z
from facegen.rigs import evaluate


@pytest.mark.parametrize("side", ["left_brow", "right_brow"])
def test_a_rig_that_marks_no_brows_has_them_along_their_landmarks(anny, side):
    bare = replace(anny, part=np.where(anny.part == Part.BROWS, Part.SKIN, anny.part))
    gaze = np.tile((0.0, 0.0, 1.0), (1, 2, 1))
    face = evaluate(bare, np.zeros((1, bare.components)), np.zeros((1, len(BLENDSHAPES))), gaze)
    vertices, triangles, part = drawn_mesh(bare, face, 0, gaze[0])
    centres = vertices[triangles[part == Part.BROWS]].mean(axis=1)
    marks = face.landmarks[0]
    line = marks[list(LANDMARK_GROUPS[side])]
    own = centres[np.sign(centres[:, 0]) == np.sign(line[0, 0])]
    far = np.linalg.norm(own[:, None] - line, axis=-1)
    assert far.min(axis=1).max() < 9e-3, "nothing else is painted"
    assert far.min(axis=0).max() < 4e-3, "the whole brow is"
    assert set(np.unique(part)) >= {Part.SKIN, Part.LIPS, Part.SCLERA}


def test_a_back_that_is_seen_is_lit_as_its_front_for_a_viewer_near_by():
    corners = np.array([[-1.0, -1.0, -2.0], [1.0, -1.0, -2.0], [0.0, 1.0, -2.0]])
    part = np.array([Part.SKIN])
    front, back = np.array([[0, 1, 2]]), np.array([[0, 2, 1]])

    def tone(triangles: np.ndarray, viewer: np.ndarray | None) -> np.ndarray:
        seen = nearest_along_z(corners, triangles, origin=np.array([-1.0, 1.0]), step=0.5, shape=(5, 5))
        return shade(corners, triangles, part, seen, viewer=viewer)[2, 2]

    near = np.zeros(3)
    assert (tone(back, near) == tone(front, near)).all()
    assert (tone(front, near) == tone(front, None)).all()
    assert (tone(back, None) < 0.5 * tone(front, None)).all(), "a far viewer's figures keep holes dark"


def test_a_headsets_cameras_see_no_unlit_backs_at_the_lids(anny, monkeypatch: pytest.MonkeyPatch):
    def views() -> np.ndarray:
        figure = headsets.draw_headset(load_headset("tracking3"), anny)
        return np.array([axes.images[0].get_array() for axes in figure.axes[3:5]])

    lit = views()
    monkeypatch.setattr(headsets, "shade", lambda *mesh, viewer=None: shade(*mesh))
    unlit = views()
    backs = (lit != unlit).any(axis=-1)
    assert (backs.sum(axis=(1, 2)) > 20).all(), "both eyes' cameras see some"
    assert np.median(lit[backs].max(axis=-1)) > 1.5 * np.median(unlit[backs].max(axis=-1))

"""Outlines of eyes in views, and how far lids stand apart; `tests/facegen/blender/test_ground_truth.py` sees them."""

import dataclasses

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.geometry import (
    Camera,
    apply_transform,
    direction_from_angles,
    invert_transform,
    look_at,
    project,
)
from facegen.labels import eye_outlines as module
from facegen.labels.eye_outlines import outline_eye
from facegen.rigs import evaluate, eye_geometry, lid_gap, lid_margins, open_lid_gap
from facegen.scene import View

CAMERA = Camera(model="fisheye", width=640, height=480, fx=600.0, fy=600.0, cx=319.5, cy=239.5)
AHEAD = View(
    name="eye", camera=CAMERA, camera_from_head=invert_transform(look_at([0.0, 0.0, 0.05], [0, 0, 0]))
)
LIDS = (
    np.array([[-0.01, 0.0, 0.012], [0.01, 0.0, 0.2]]),
    np.array([[-0.01, 0.0, 0.012], [0.0, -0.005, 0.012]]),
)


def _eye(yaw_deg: float, pitch_deg: float = 0.0, pupil_radius: float = 2e-3):
    axis = direction_from_angles(*np.radians([yaw_deg, pitch_deg]))
    return eye_geometry(np.zeros(3), 0.0145, axis, pupil_radius=pupil_radius)


def _numbers(ellipse) -> np.ndarray:
    return np.array([*ellipse.center, *ellipse.semi_axes, ellipse.angle])


def test_seen_along_the_axis_all_are_circles_about_its_pixel():
    outlines = outline_eye(AHEAD, _eye(0.0), LIDS)
    for ellipse in (outlines.pupil, outlines.pupil_bare, outlines.iris):
        np.testing.assert_allclose(ellipse.center, (319.5, 239.5), atol=1e-6)
        assert ellipse.semi_axes[0] == pytest.approx(ellipse.semi_axes[1], rel=1e-6)
    np.testing.assert_allclose(outlines.pupil_center_2d, (319.5, 239.5), atol=1e-6)
    # a lens of 336 / 7.8 = 43 dioptres, 3.6 mm before the pupil, magnifies it by 1.13 to an eye far away
    assert 1.10 < outlines.pupil.semi_axes[0] / outlines.pupil_bare.semi_axes[0] < 1.20
    assert outlines.pupil.semi_axes[0] < 0.5 * outlines.iris.semi_axes[0]


def test_a_cornea_without_refraction_shows_the_bare_pupil(monkeypatch):
    with_it = outline_eye(AHEAD, _eye(30.0, -12.0), LIDS)
    monkeypatch.setattr(module, "CORNEA_INDEX", 1.0)
    outlines = outline_eye(AHEAD, _eye(30.0, -12.0), LIDS)
    np.testing.assert_allclose(_numbers(outlines.pupil), _numbers(outlines.pupil_bare), atol=1e-6)
    np.testing.assert_array_equal(_numbers(outlines.pupil_bare), _numbers(with_it.pupil_bare))
    # it shows the pupil nearer and turned towards the camera
    assert np.linalg.norm(with_it.pupil.center - with_it.pupil_bare.center) > 5.0
    ratio = [np.divide(*e.semi_axes[::-1]) for e in (with_it.pupil, with_it.pupil_bare)]
    assert ratio[0] > ratio[1] + 0.02


def test_an_eye_that_looks_away_shows_no_pupil_and_what_the_lens_does_not_reach_has_no_pixel():
    behind = outline_eye(AHEAD, _eye(120.0), LIDS)
    for ellipse in (behind.pupil, behind.pupil_bare, behind.iris):
        assert np.isnan(_numbers(ellipse)).all()
    assert np.isnan(behind.pupil_center_2d).all()
    pinhole = dataclasses.replace(AHEAD, camera=dataclasses.replace(CAMERA, model="pinhole"))
    outlines = outline_eye(pinhole, _eye(0.0), LIDS)
    assert np.isnan(outlines.upper_lid_2d).any(axis=-1).tolist() == [False, True]  # the second lies behind it
    expected = project(pinhole.camera, apply_transform(pinhole.camera_from_head, LIDS[1]))
    np.testing.assert_array_equal(outlines.lower_lid_2d, expected)


def test_openness_falls_with_the_blink_and_is_one_in_the_neutral_face(anny):
    rng = np.random.default_rng(8)
    identity = np.repeat(rng.normal(size=(1, anny.components)), 6, axis=0)
    weights = np.zeros((6, 52))
    weights[:5, BLENDSHAPE_INDEX["eyeBlinkLeft"]] = (0.0, 0.3, 0.6, 0.9, 1.0)
    weights[5, BLENDSHAPE_INDEX["eyeWideLeft"]] = 1.0
    gaze = np.broadcast_to([0.0, 0.0, 1.0], (6, 2, 3))
    faces = evaluate(anny, identity, weights, gaze)
    opened = open_lid_gap(anny, tuple(identity[0].tolist()))
    openness = np.array([lid_gap(anny, vertices) for vertices in faces.vertices]) / opened
    np.testing.assert_allclose(openness[0], 1.0, atol=1e-12)
    assert (np.diff(openness[:5, 0]) < 0.0).all()
    assert openness[4, 0] == 0.0
    assert openness[5, 0] > 1.1
    np.testing.assert_allclose(openness[:5, 1], 1.0, atol=1e-12)
    assert (6e-3 < opened).all()  # palpebral fissures of adults: 8 to 11 mm
    assert (opened < 14e-3).all()


def test_margins_run_from_the_inner_to_the_outer_canthus(anny):
    for eye, outwards in enumerate((1.0, -1.0)):
        upper, lower = lid_margins(anny, eye)
        assert upper[0] == lower[0]
        assert upper[-1] == lower[-1]
        assert set(anny.upper_lid[eye]) < set(upper)
        assert outwards * (anny.vertices[upper[-1], 0] - anny.vertices[upper[0], 0]) > 0.02
        assert anny.vertices[upper, 1].mean() > anny.vertices[lower, 1].mean()
        steps = np.linalg.norm(np.diff(anny.vertices[upper], axis=0), axis=-1)
        assert steps.max() < 4e-3

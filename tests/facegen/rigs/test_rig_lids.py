"""Lids close in every identity, stop at contact, and rest on the eye."""

import numpy as np
import pytest

from facegen.geometry import direction_from_angles
from facegen.rigs import Rig, evaluate
from facegen.rigs.eyes import lid_support_radius
from facegen.rigs.lids import CONTACT_LANDMARKS
from tests.facegen.rigs.eyeball_area import eyeball_seen
from tests.facegen.rigs.people import PEOPLE, people, straight, weights


def seen(
    rig: Rig, rows: np.ndarray, *, pitch_deg: float = 0.0, gaze_yaw_deg: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Eyeball area seen, and the part outside the margins, in mm2 of each person and eye."""
    count = PEOPLE if rig.components else 1
    gaze = np.broadcast_to(direction_from_angles(np.radians(gaze_yaw_deg), 0.0), (count, 2, 3))
    faces = evaluate(rig, people(rig, count), rows[:count], gaze)
    found = [eyeball_seen(rig, faces, i, gaze[i], pitch_deg=pitch_deg) for i in range(count)]
    return np.array([f.area_mm2 for f in found]), np.array([f.outside_mm2 for f in found])


@pytest.mark.parametrize("pitch_deg", [0.0, -35.0])
def test_closed_lids_hide_the_eye(rig: Rig, pitch_deg: float) -> None:
    area, _ = seen(rig, weights(PEOPLE, eyeBlink=1.0), pitch_deg=pitch_deg)
    assert area.max() <= 0.1 + 0.2 * (pitch_deg != 0.0)


@pytest.mark.parametrize(("blink", "gaze_yaw_deg"), [(0.0, 0.0), (0.4, -25.0)])
def test_lids_show_the_eye_between_their_margins_only(rig: Rig, blink: float, gaze_yaw_deg: float) -> None:
    area, outside = seen(rig, weights(PEOPLE, eyeBlink=blink), gaze_yaw_deg=gaze_yaw_deg)
    assert area.min() > 30.0
    assert outside.max() <= 0.02


def margins(rig: Rig, rows: np.ndarray, gaze: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Height of the upper over the lower margin (2 rows, 9) and how far it stands in front, in metres."""
    faces = evaluate(rig, people(rig, len(rows)), rows, gaze, cage_only=True)
    gaps, fronts = [], []
    for eye in range(2):
        rings = (rig.upper_lid[eye], rig.lower_lid[eye])
        upper, lower = (faces.vertices[:, ring] - faces.eye_center[:, None, eye] for ring in rings)
        flip = 1.0 if eye == 0 else -1.0
        for face in range(len(rows)):
            order = np.argsort(flip * lower[face, :, 0])
            low = lower[face, order]
            x = np.linspace(flip * upper[face, 0, 0], flip * upper[face, -1, 0], 13)[2:-2]
            up_order = np.argsort(flip * upper[face, :, 0])
            up = upper[face, up_order]
            gap = np.interp(x, flip * up[:, 0], up[:, 1]) - np.interp(x, flip * low[:, 0], low[:, 1])
            reach = [np.interp(x, flip * p[:, 0], np.linalg.norm(p, axis=1)) for p in (up, low)]
            gaps.append(gap)
            fronts.append(reach[0] - reach[1])
    return np.array(gaps), np.array(fronts)


@pytest.mark.parametrize(
    "shapes",
    [
        {},
        {"eyeLookDown": 1.0},
        {"eyeSquint": 1.0, "cheekSquint": 1.0},
        {"eyeLookDown": 1.0, "eyeSquint": 1.0},
    ],
)
def test_upper_margin_ends_just_below_and_before_the_lower(rig: Rig, shapes: dict[str, float]) -> None:
    gap, front = margins(rig, weights(PEOPLE, eyeBlink=1.0, **shapes), straight(PEOPLE))
    assert gap.max() <= 0.1e-3
    assert gap.min() >= -2e-3
    assert front[:, 2:-2].min() > 0.0


def test_lids_close_monotonically(rig: Rig) -> None:
    steps = np.linspace(-0.02, 1.4, 15)
    heights = []
    for step in steps:
        faces = evaluate(rig, people(rig, 8), weights(8, eyeBlink=step), straight(8), cage_only=True)
        heights.append(
            [faces.landmarks[:, u, 1] - faces.landmarks[:, low, 1] for u, low in CONTACT_LANDMARKS]
        )
    heights = np.array(heights)
    assert (np.diff(heights, axis=0) < 1e-5).all()
    assert (heights[0] > 4e-3).all()
    np.testing.assert_array_equal(heights[steps >= 1.0], 0.0)


@pytest.mark.parametrize("pitch_deg", [-25.0, 0.0, 25.0])
def test_skin_stays_outside_the_eye(rig: Rig, pitch_deg: float) -> None:
    gaze = np.broadcast_to(direction_from_angles(np.radians(15.0), np.radians(pitch_deg)), (6, 2, 3))
    faces = evaluate(rig, people(rig, 6), weights(6, eyeBlink=0.7, eyeSquint=0.5), gaze, cage_only=True)
    for eye in range(2):
        margin = np.concatenate([rig.upper_lid[eye], rig.lower_lid[eye]])
        offset = faces.vertices[:, margin] - faces.eye_center[:, None, eye]
        length = np.linalg.norm(offset, axis=-1)
        support = lid_support_radius(
            offset / length[..., None], faces.eye_radius[:, None, eye], gaze[:, None, eye]
        )
        assert (length - support).min() > 0.3e-3


def test_one_eye_closes_alone(rig: Rig) -> None:
    rows = np.concatenate([weights(1), weights(1, eyeBlinkLeft=1.0)])
    points = evaluate(rig, people(rig, 1).repeat(2, 0), rows, straight(2), cage_only=True).landmarks
    assert points[1, 37, 1] - points[1, 41, 1] > 4e-3
    assert points[1, 43, 1] == points[1, 47, 1]

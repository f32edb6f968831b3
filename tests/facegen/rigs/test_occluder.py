"""The reduced mesh that hides keypoints hides what the rendered mesh hides."""

import numpy as np
import pytest

from facegen.conventions import Part, Visibility
from facegen.geometry import apply_transform, rotation_from_angles, transform
from facegen.labels import label_keypoints
from facegen.labels.keypoints import KEYPOINT_TOLERANCE_M
from facegen.raster import hidden_by_own
from facegen.rigs import Rig, closed_cage, evaluate, occluder
from facegen.sampling import draw_samples, plan_dataset
from facegen.sampling.cameras import FACING
from facegen.spec import parse_spec
from tests.facegen.rigs.people import people, straight, weights

FACES = 150
WIDE = {
    "yaw_deg": {"uniform": [-40, 40]},
    "pitch_deg": {"uniform": [-25, 25]},
    "roll_deg": {"uniform": [-20, 20]},
}


@pytest.mark.parametrize("head", [{}, WIDE], ids=["default", "wide"])
def test_flags_are_those_of_the_whole_mesh(rig: Rig, head: dict) -> None:
    """99 % of them; `benchmarks/bench_visibility.py` has 10,000 faces."""
    table = {"version": 1, "kind": "still", "seed": 11, "people": FACES // 2, "rig": rig.name, "head": head}
    spec = parse_spec(table | {"still": {"neutral": 1, "faces": 1}}, where="test")
    samples = draw_samples(plan_dataset(spec), rig, 0).rows(slice(0, FACES))
    faces = evaluate(rig, samples.identity, samples.weights, samples.gaze)
    flags = label_keypoints(spec, rig, samples).visibility
    # lashes are strips that a texture cuts into strands: they hide no landmark
    whole = rig.faces[rig.part != Part.LASHES]
    camera = samples.camera_from_head
    points = apply_transform(camera, faces.landmarks)
    expected = hidden_by_own(points, faces.vertices, camera, whole, tolerance_m=KEYPOINT_TOLERANCE_M)
    seen = flags != Visibility.OUTSIDE
    assert 0.1 < expected.mean() < 0.5
    assert np.mean((flags == Visibility.HIDDEN)[seen] == expected[seen]) >= 0.99


def test_far_landmarks_are_not_seen_through_the_eyes(rig: Rig) -> None:
    """The far end of the jaw lies behind an eye, where the cage has a hole, at some turn of the head."""
    yaw = np.radians(np.arange(20.0, 50.0))
    camera = transform(FACING @ rotation_from_angles(yaw, 0.0, 0.0), np.array([0.0, 0.0, 0.7]))
    face = evaluate(rig, people(rig, 1), weights(1), straight(1))
    reduced, count = occluder(rig), len(yaw)
    points = apply_transform(camera, np.repeat(face.landmarks[:, 16:17], count, axis=0))
    covered = [
        hidden_by_own(points, np.repeat(mesh, count, axis=0), camera, faces, tolerance_m=KEYPOINT_TOLERANCE_M)
        for mesh, faces in ((face.vertices, rig.faces), (face.vertices[:, reduced.vertices], reduced.faces))
    ]
    assert covered[0].mean() > 0.8
    np.testing.assert_array_equal(*covered)


def test_stands_for_each_face_of_the_cage_once(rig: Rig) -> None:
    reduced = occluder(rig)
    assert set(np.unique(reduced.faces)) <= set(range(-1, len(reduced.vertices)))
    np.testing.assert_array_equal(reduced.vertices[: rig.cage_vertices], np.arange(rig.cage_vertices))
    added = len(reduced.vertices) - rig.cage_vertices
    assert (added > 0) == (rig.name == "anny")  # the others are not subdivided
    assert added < 0.2 * rig.cage_vertices
    area, cage_area = (
        _area(rig.vertices[reduced.vertices], reduced.faces),
        _area(rig.vertices, closed_cage(rig)),
    )
    np.testing.assert_allclose(area, cage_area, rtol=0.002)


def _area(vertices: np.ndarray, faces: np.ndarray) -> float:
    a, b, c, d = np.moveaxis(vertices[np.where(faces >= 0, faces, faces[:, :1])], 1, 0)
    return 0.5 * float(np.linalg.norm(np.cross(c - a, d - b), axis=1).sum())

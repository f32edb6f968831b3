"""The sliding contour: on the outline of what the picture shows, and the jaw's landmarks where they are seen."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import Part, Visibility
from facegen.geometry import apply_transform
from facegen.headsets import load_headset
from facegen.labels import Keypoints, label_keypoints, label_rendered
from facegen.labels.contour import JAW, slide
from facegen.packing import Options, plan_pack, write_pack
from facegen.raster import triangles_of
from facegen.rigs import Rig, evaluate
from facegen.sampling import Samples, draw_samples, plan_dataset
from facegen.sessions import draw_sample_scene
from facegen.spec import Spec, parse_spec
from facegen.store import column_array, resolve, sample_record
from facegen.validation import check_shard
from facegen.work import generate

FACES = 40
FRONTAL = {"yaw_deg": 0, "pitch_deg": 0, "roll_deg": 0}
WIDE = {
    "yaw_deg": {"uniform": [-40, 40]},
    "pitch_deg": {"uniform": [-25, 25]},
    "roll_deg": {"uniform": [-20, 20]},
}


def labelled(rig: Rig, head: dict) -> tuple[Spec, Samples, Keypoints]:
    table = {"version": 1, "kind": "still", "seed": 3, "people": 20, "rig": rig.name, "head": head}
    spec = parse_spec(table | {"landmarks": {"sliding_contour": True}}, where="test")
    samples = draw_samples(plan_dataset(spec), rig, 0).rows(slice(0, FACES))
    return spec, samples, label_keypoints(spec, rig, samples)


def outline_distance_mm(rig: Rig, samples: Samples, points_2d: np.ndarray) -> np.ndarray:
    """How far pixels (n, p, 2) lie from edges of the whole mesh where skin turns away from the camera.

    (n, p) in the picture, scaled to the head's distance.
    """
    skin = triangles_of(rig.faces[np.isin(rig.part, (Part.SKIN, Part.LIPS, Part.BROWS))])
    edges = np.sort(np.concatenate([skin[:, [0, 1]], skin[:, [1, 2]], skin[:, [2, 0]]]), axis=1)
    edges, edge = np.unique(edges, axis=0, return_inverse=True)
    faces = evaluate(rig, samples.identity, samples.weights, samples.gaze)
    distances = []
    for camera, vertices, (focal, _, *center), points in zip(
        samples.camera_from_head, faces.vertices, samples.intrinsics, points_2d, strict=True
    ):
        mesh = apply_transform(camera, vertices)
        pixels = mesh[:, :2] / mesh[:, 2:] * focal + center
        a, b, c = np.moveaxis(pixels[skin], 1, 0)
        front = np.tile(np.cross(b - a, c - a) < 0, 3)
        turns = np.bincount(edge, front) % 2 == 1  # one of the edge's two faces
        start, end = np.moveaxis(pixels[edges[turns]], 1, 0)
        along, to = end - start, points[:, None] - start
        share = np.clip((to * along).sum(axis=-1) / np.maximum((along**2).sum(axis=-1), 1e-12), 0.0, 1.0)
        nearest = np.linalg.norm(to - share[..., None] * along, axis=-1).min(axis=1)
        distances.append(nearest * camera[2, 3] / focal * 1e3)
    return np.array(distances)


@pytest.mark.parametrize("head", [{}, WIDE], ids=["default", "wide"])
def test_is_the_landmark_where_seen_and_on_the_outline_elsewhere(anny: Rig, head: dict) -> None:
    _, samples, labels = labelled(anny, head)
    fixed = labels.points_2d[:, JAW]
    seen = labels.visibility[:, JAW] == Visibility.VISIBLE
    np.testing.assert_array_equal(labels.further["contour_2d"][seen], fixed[seen])
    np.testing.assert_array_equal(labels.further["contour_3d"][seen], labels.points_3d[:, JAW][seen])
    moved = (labels.further["contour_2d"] != fixed).any(axis=-1)
    assert moved[~seen].mean() > 0.95  # no point of the others' paths is in sight
    distance = outline_distance_mm(anny, samples, labels.further["contour_2d"])
    # the cage, on which the points lie, is up to a millimetre within the rendered skin
    assert np.mean(distance[moved] < 1.0) > 0.98
    assert np.mean(outline_distance_mm(anny, samples, fixed)[moved] < 1.0) < 0.7


def test_stays_near_the_landmarks_of_frontal_heads(anny: Rig) -> None:
    _, _, labels = labelled(anny, FRONTAL)
    moved = (
        np.linalg.norm(labels.further["contour_2d"] - labels.points_2d[:, JAW], axis=-1)
        / labels.face_width[:, None]
    )
    assert np.median(moved) < 0.02  # what the cheekbones hide from a camera at 0.7 m
    assert moved.max() < 0.12


@settings(deadline=None)
@given(hidden=st.lists(st.booleans(), min_size=1, max_size=9))
def test_slides_to_the_first_point_in_sight(hidden: list[bool]) -> None:
    points = np.arange(3.0 * len(hidden)).reshape(1, 1, -1, 3)
    expected = hidden.index(False) if False in hidden else 0
    np.testing.assert_array_equal(slide(points, np.array([[hidden]]))[0, 0], points[0, 0, expected])


def test_is_written_checked_and_packed_where_the_spec_asks(anny: Rig, tmp_path: Path) -> None:
    spec, samples, labels = labelled(anny, WIDE)
    dataset = resolve(replace(spec, people=4), tmp_path / "dataset")
    assert generate(dataset, workers=1).left == 0
    assert list(check_shard(dataset, 0)) == []
    write_pack(plan_pack(dataset, "keypoints", Options(columns=("contour_2d",))), tmp_path / "pack")
    packed = pq.read_table(sorted((tmp_path / "pack").glob("*.parquet"))).sort_by("sample")
    np.testing.assert_array_equal(
        column_array(packed, "contour_2d"), labels.further["contour_2d"].astype(np.float32)
    )
    headset = load_headset("tracking3")
    sample = draw_sample_scene(spec, anny, headset, samples.rows(slice(3, 4)))
    record = sample_record(label_rendered(spec, anny, sample), dataset_hash="", rig="anny")
    contour_3d = np.asarray(record["keypoints"]["contour_3d"], np.float32)
    np.testing.assert_array_equal(contour_3d, labels.further["contour_3d"][3].astype(np.float32))

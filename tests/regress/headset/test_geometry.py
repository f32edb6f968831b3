"""Millimetres of the face from errors of weights, and the clusters of the second paper's figure 4."""

import numpy as np
import pytest

from benchmarks.experiments.headset_clusters import cluster_error_mm
from regress.learning.headset.geometry import FaceGeometry

CAMERAS = ("left_eye", "right_eye", "mouth")


@pytest.fixture(scope="module")
def face() -> FaceGeometry:
    displacement = 0.003 * np.random.default_rng(0).standard_normal((52, 30, 3))
    return FaceGeometry(displacement=displacement.astype(np.float32), rest=np.zeros((30, 3), np.float32))


def test_the_error_is_the_mean_distance_of_displaced_vertices(face: FaceGeometry):
    random = np.random.default_rng(1)
    predicted, true = random.random((2, 5, 52))
    places = [
        np.einsum("nk,kvd->nvd", weights, face.displacement.astype(float)) for weights in (predicted, true)
    ]
    expected = 1000 * np.linalg.norm(places[0] - places[1], axis=2).mean(axis=1)
    np.testing.assert_allclose(face.error_mm(predicted, true), expected, rtol=1e-5)
    assert face.error_mm(true[:0], true[:0]).shape == (0,)


def test_blocks_do_not_matter(face: FaceGeometry, monkeypatch: pytest.MonkeyPatch):
    predicted, true = np.random.default_rng(2).random((2, 9, 52))
    whole = face.error_mm(predicted, true)
    monkeypatch.setattr("regress.learning.headset.geometry._BLOCK_BYTES", 4 * 30 * 3 * 2)
    np.testing.assert_allclose(face.error_mm(predicted, true), whole, rtol=1e-6)


def test_the_gram_matrix_gives_the_mean_squared_distance(face: FaceGeometry):
    error = np.random.default_rng(3).standard_normal(52)
    places = 1000 * np.einsum("k,kvd->vd", error, face.displacement.astype(float))
    assert error @ face.gram_mm2() @ error == pytest.approx(np.mean(np.sum(places**2, axis=1)))


def test_parts_combine_what_training_never_showed_together(face: FaceGeometry):
    """Upper and lower faces of 8 kinds each, shown with the other at rest: parts know all 64 pairs."""
    random = np.random.default_rng(4)
    upper, lower = np.zeros((2, 8, 52))
    upper[:, :14], lower[:, 14:44] = random.random((8, 14)), random.random((8, 30))
    pairs = (upper[:, None] + lower).reshape(-1, 52)
    seen = np.concatenate([upper, lower])
    modular = cluster_error_mm(face, seen, pairs, clusters=9, cameras=CAMERAS)
    holistic = cluster_error_mm(face, seen, pairs, clusters=27)
    assert modular < 0.6 * holistic  # k-means from one start finds most of the kinds, not all


def test_a_face_in_the_training_set_is_its_own_cluster(face: FaceGeometry):
    faces = np.random.default_rng(5).random((20, 52))
    assert cluster_error_mm(face, faces, faces, clusters=20, cameras=CAMERAS) < 1e-4

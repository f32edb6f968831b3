"""Features: what they ignore, what they mirror, where their edges come from."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import MIRRORED_LANDMARKS
from regress.errors import InputError
from regress.learning.reference_shape import delaunay_edges, make_reference_shape, reference_shape_json
from regress.runtime.features import (
    ANCHORS,
    STABLE,
    Features,
    align_affine,
    depths_of,
    edge_distances,
    extract,
    load_reference_shape,
    mean_shape,
    mirrored_edges,
)
from regress.runtime.features.reference_shape import edges_sha256
from tests.regress.drawn import drawn_faces

REFERENCE = load_reference_shape()
FACES = drawn_faces(np.random.default_rng(0), 30)


def _features(alignment: str) -> Features:
    """``turn`` is the affine alignment after the head's turn is undone."""
    return Features(
        alignment="affine" if alignment == "turn" else alignment,
        depth=depths_of(REFERENCE) if alignment == "turn" else None,
        mean_shape=mean_shape(FACES),
        edges=REFERENCE.edges,
        reference_name=REFERENCE.name,
        reference_sha256=REFERENCE.sha256,
    )


def test_the_reference_shape_has_178_edges_and_one_without_a_mirror_partner():
    assert REFERENCE.edges.shape == (178, 2)
    assert np.sum(mirrored_edges(REFERENCE.edges) < 0) == 1
    assert (REFERENCE.edges[:, 0] < REFERENCE.edges[:, 1]).all()
    assert np.array_equal(np.unique(REFERENCE.edges, axis=0), REFERENCE.edges)
    assert edges_sha256(REFERENCE.edges) == REFERENCE.sha256


def test_the_reference_shape_can_be_made_again_from_its_points():
    again = make_reference_shape(REFERENCE.points, name=REFERENCE.name, source=REFERENCE.source)
    assert reference_shape_json(again) == reference_shape_json(REFERENCE)


def test_the_reference_shape_is_the_default_rigs(anny):
    points = (anny.vertices[anny.landmark_vertices] * anny.landmark_weights[..., None]).sum(axis=1)
    made = make_reference_shape(np.asarray(points, dtype=np.float64), name="anny", source="")
    assert np.array_equal(made.edges, REFERENCE.edges)
    # float32 sums of another build may differ in the last bit
    assert np.allclose(made.points, REFERENCE.points, atol=1e-7)


def test_points_that_do_not_give_178_edges_are_refused():
    with pytest.raises(InputError, match=r"\(68, 3\)"):
        make_reference_shape(np.zeros((68, 2)), name="flat", source="")
    with pytest.raises(InputError, match="178 and 1 are needed"):
        make_reference_shape(np.random.default_rng(0).normal(size=(68, 3)), name="noise", source="")


@pytest.mark.parametrize("alignment", ["affine", "turn"])
@settings(max_examples=25, deadline=None)
@given(
    matrix=st.lists(st.floats(-3, 3), min_size=4, max_size=4),
    shift=st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)),
)
def test_affinely_aligned_features_ignore_every_affine_map(
    alignment: str, matrix: list[float], shift: tuple[float, float]
):
    matrix = np.reshape(matrix, (2, 2))
    # faces are hundreds of pixels wide: on far smaller ones a shift leaves too few digits, or none
    if np.linalg.norm(matrix) < 1e-3 or np.linalg.cond(matrix) > 20:
        return
    features = _features(alignment)
    moved = FACES @ matrix + shift
    assert np.allclose(extract(features, moved), extract(features, FACES), atol=1e-8)


@settings(max_examples=25, deadline=None)
@given(
    roll=st.floats(-np.pi, np.pi), scale=st.floats(0.01, 100), x=st.floats(-1e3, 1e3), y=st.floats(-1e3, 1e3)
)
def test_unaligned_features_ignore_place_size_and_roll(roll: float, scale: float, x: float, y: float):
    features = _features("none")
    turn = np.array([[np.cos(roll), -np.sin(roll)], [np.sin(roll), np.cos(roll)]])
    assert np.allclose(extract(features, scale * FACES @ turn + [x, y]), extract(features, FACES), atol=1e-7)


@settings(max_examples=25, deadline=None)
@given(yaw=st.floats(-0.6, 0.6), pitch=st.floats(-0.6, 0.6))
def test_a_turned_mean_face_has_the_features_of_a_frontal_one(yaw: float, pitch: float):
    frontal = REFERENCE.points * [1, -1, 1]
    features = dataclasses.replace(_features("turn"), mean_shape=mean_shape(frontal[None, :, :2]))
    about_y = [[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]]
    about_x = [[1, 0, 0], [0, np.cos(pitch), np.sin(pitch)], [0, -np.sin(pitch), np.cos(pitch)]]
    turned = frontal @ np.array(about_y).T @ np.array(about_x).T
    wanted = extract(features, frontal[None, :, :2])
    assert np.allclose(extract(features, turned[None, :, :2]), wanted, atol=1e-8)
    left = extract(dataclasses.replace(features, depth=None), turned[None, :, :2])
    assert np.abs(left - wanted).max() >= 0.05 * max(abs(yaw), abs(pitch))


@pytest.mark.parametrize("alignment", ["affine", "none", "turn"])
def test_a_mirrored_face_has_mirrored_features(alignment: str):
    features = _features(alignment)
    partner = mirrored_edges(features.edges)
    paired = partner >= 0
    mirrored = FACES[:, list(MIRRORED_LANDMARKS)] * [-1, 1]
    assert np.allclose(extract(features, mirrored)[:, paired], extract(features, FACES)[:, partner[paired]])


def test_aligning_is_the_least_squares_fit_of_the_anchors():
    target = mean_shape(FACES)
    anchors = list(ANCHORS)
    for face, aligned in zip(FACES, align_affine(FACES, target), strict=True):
        design = np.column_stack([face[anchors], np.ones(len(anchors))])
        solution, *_ = np.linalg.lstsq(design, target[anchors], rcond=None)
        assert np.allclose(aligned, np.column_stack([face, np.ones(68)]) @ solution, atol=1e-9)


def test_the_mean_shape_is_symmetric_level_and_one_wide():
    mean = mean_shape(FACES)
    assert np.allclose(mean[list(MIRRORED_LANDMARKS)] * [-1, 1], mean, atol=1e-12)
    assert np.allclose(mean[16] - mean[0], [1, 0])
    assert mean[8, 1] > mean[27, 1]  # y down: the chin lies below the nose's bridge


def test_a_face_with_a_missing_point_or_without_width_gives_nan():
    faces = FACES[:3].copy()
    faces[0, 40] = np.nan
    faces[1] = 7.0
    for alignment in ("affine", "none", "turn"):
        values = extract(_features(alignment), faces)
        assert np.isnan(values[:2]).all()
        assert np.isfinite(values[2]).all()


@pytest.mark.parametrize("alignment", ["affine", "stable"])
def test_no_faces_have_no_features(alignment: str):
    features = _features("affine")
    features = dataclasses.replace(features, alignment=alignment)
    assert extract(features, FACES[:0]).shape == (0, features.count)


def test_distances_are_lengths_over_face_width():
    face = np.zeros((1, 68, 2))
    face[0, 16] = [0, 4]
    face[0, 5] = [3, 0]
    assert np.allclose(edge_distances(face, np.array([[0, 5], [5, 16]])), [[3 / 4, 5 / 4]])


def test_a_square_has_four_sides_and_a_diagonal():
    edges = delaunay_edges(np.array([[0, 0], [1, 0], [1, 1.1], [0, 1.0]]))
    assert len(edges) == 5


@given(seed=st.integers(0, 2**32 - 1), size=st.floats(0.1, 1000), roll_deg=st.floats(-90, 90))
@settings(max_examples=40, deadline=None)
def test_laid_points_ignore_place_size_and_roll_and_mirror(seed, size, roll_deg):
    features = dataclasses.replace(_features("stable"), edges=np.empty((0, 2), dtype=np.int64))
    faces = drawn_faces(np.random.default_rng(seed), 3)
    values = extract(features, faces)
    assert values.shape == (3, features.count) == (3, 136)
    turn = np.deg2rad(roll_deg)
    roll = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    np.testing.assert_allclose(extract(features, faces @ roll * size + [30, -7]), values, atol=1e-9)
    partners, signs = features.mirror
    image = faces[:, list(MIRRORED_LANDMARKS)] * [-1, 1]
    np.testing.assert_allclose(extract(features, image), values[:, partners] * signs, atol=1e-9)
    # in the mean shape's unit and place: the stable points are as near to it as any similarity brings them
    anchors = list(STABLE)
    laid = values.reshape(3, 68, 2)[:, anchors]
    rest = laid - features.mean_shape[anchors]
    np.testing.assert_allclose(rest.sum(axis=1), 0, atol=1e-9)
    np.testing.assert_allclose(
        (rest * (laid - laid.mean(axis=1, keepdims=True))).sum(axis=(1, 2)), 0, atol=1e-9
    )


def test_what_a_detector_is_always_off_by_cancels_in_laid_points():
    features = dataclasses.replace(_features("stable"), edges=np.empty((0, 2), dtype=np.int64))
    neutral, moved = FACES[:1], FACES[:1].copy()
    moved[:, 48:] += 0.02
    bias = 0.02 * np.random.default_rng(4).standard_normal((1, 68, 2))
    bias[:, list(STABLE)] = 0  # there it would turn and scale the face, by little
    plain = extract(features, moved) - extract(features, neutral)
    biased = extract(features, moved + bias) - extract(features, neutral + bias)
    np.testing.assert_allclose(biased, plain, atol=1e-12)

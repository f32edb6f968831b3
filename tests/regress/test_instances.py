"""Faces of pose estimators: bodies of 133 points, lists of results, OpenPose's files, meshes in arrays."""

import json
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs import read_frames
from regress.runtime.inputs.mesh import VERTICES, irises_of, landmarks_of
from tests.regress.drawn import drawn_faces
from tests.regress.test_inputs import openpose_numbers

FACES = drawn_faces(np.random.default_rng(1), 3)


def _body(face: np.ndarray) -> np.ndarray:
    """133 points (133, 2) of COCO-WholeBody whose points 23 to 90 are a face's."""
    body = np.random.default_rng(2).uniform(0, 900, (133, 2))
    body[23:91] = face
    return body


def _triples(points: np.ndarray) -> list[float]:
    return np.column_stack([points, np.full(len(points), 0.7)]).ravel().tolist()


def _read(path: Path, document: object):
    path.write_text(json.dumps(document))
    return read_frames(path)


def test_a_whole_body_has_a_face(tmp_path: Path):
    annotations = [{"id": 1, "image_id": 1, "keypoints": _triples(_body(FACES[0]))}]
    read = _read(tmp_path / "a.json", {"annotations": annotations})
    np.testing.assert_allclose(read.points, FACES[:1])


def test_face_points_of_their_own_go_before_the_bodys(tmp_path: Path):
    entry = {"keypoints": _triples(_body(FACES[0])), "face_kpts": _triples(FACES[1])}
    read = _read(tmp_path / "a.json", {"annotations": [{"id": 1, "image_id": 1, **entry}]})
    np.testing.assert_allclose(read.points, FACES[1:2])


def test_results_of_coco_are_a_list(tmp_path: Path):
    results = [
        {"image_id": image, "category_id": 1, "score": 0.9, "keypoints": _triples(_body(face))}
        for image, face in zip((7, 8, 8), FACES, strict=True)
    ]
    read = _read(tmp_path / "a.json", results)
    np.testing.assert_allclose(read.points, FACES)
    assert read.labels == ("7", "8/1", "8/2")
    assert read.numbers.tolist() == [0, 1, 1]


@pytest.mark.parametrize(
    ("scores", "seen"),
    [
        (np.full(68, 0.01), False),
        (np.linspace(0, 0.58, 68), False),  # the body's own scores do not count
        (np.linspace(0.05, 0.6, 68), True),
        (np.full(68, 1.0), True),
        (np.full(68, np.nan), False),
    ],
)
def test_a_result_of_low_scores_is_no_face(scores: np.ndarray, seen: bool, tmp_path: Path):
    """As mmpose's own files have it; of a labelled face every point counts, hidden ones too."""
    triples = np.column_stack([_body(FACES[0]), np.ones(133)])
    triples[23:91, 2] = scores
    read = _read(
        tmp_path / "a.json",
        [
            {"image_id": 1, "keypoints": triples.ravel().tolist()},
            {"image_id": 2, "keypoints": _triples(_body(FACES[1]))},
        ],
    )
    assert read.usable.tolist() == [seen, True]


def _instance(points: np.ndarray, score: float = 0.8) -> dict:
    return {"keypoints": points.tolist(), "keypoint_scores": [score] * len(points), "bbox": [[0, 0, 9, 9]]}


@pytest.mark.parametrize("meta", [False, True])
@pytest.mark.parametrize("points_of", [_body, lambda face: face])
def test_instances_of_a_film_are_its_faces(meta: bool, points_of, tmp_path: Path):
    pictures = [
        {"frame_id": 3, "instances": [_instance(points_of(FACES[0]))]},
        {"frame_id": 4, "instances": []},
        {"frame_id": 5, "instances": [_instance(points_of(FACES[1])), _instance(points_of(FACES[2]), 0.1)]},
    ]
    document = {"meta_info": {"dataset_name": "x"}, "instance_info": pictures} if meta else pictures
    read = _read(tmp_path / "a.json", document)
    assert read.labels == ("3", "5/1", "5/2")
    np.testing.assert_allclose(read.points[:2], FACES[:2])
    assert read.usable.tolist() == [True, True, False], "the third has low scores"
    assert read.at_rate(10).time_s == pytest.approx([0, 0.2, 0.2])


def test_instances_of_one_picture_are_its_faces(tmp_path: Path):
    read = _read(tmp_path / "a.json", [_instance(_body(face)) for face in FACES[:2]])
    np.testing.assert_allclose(read.points, FACES[:2])


def test_openposes_folder_is_a_film_with_irises(tmp_path: Path):
    irises = np.array([[300.0, 200.0], [400.0, 210.0]])  # the right one first
    for number in (9, 10, 11):
        numbers = openpose_numbers(FACES[0])
        numbers[3 * LANDMARK_COUNT :] = np.column_stack([irises, [0.9, 0.9]]).ravel().tolist()
        people = [{"face_keypoints_2d": numbers}, {"face_keypoints_2d": []}] if number != 10 else []
        (tmp_path / f"take_{number}_keypoints.json").write_text(json.dumps({"people": people}))
    read = read_frames(tmp_path)
    assert read.labels == ("take_9", "take_11")
    np.testing.assert_allclose(read.points, np.broadcast_to(FACES[0], (2, 68, 2)))
    np.testing.assert_allclose(read.irises, np.broadcast_to(irises[::-1], (2, 2, 2)))
    assert read.at_rate(10).time_s == pytest.approx([0, 0.2])
    alone = read_frames(tmp_path / "take_9_keypoints.json")
    np.testing.assert_allclose(alone.points, FACES[:1])


def test_irises_and_points_that_openpose_does_not_see_are_missing(tmp_path: Path):
    numbers = openpose_numbers(FACES[0])
    lost = [*numbers[:3], 0.0, 0.0, 0.0, *numbers[6:]]
    read = _read(tmp_path / "a.json", {"people": [{"face_keypoints_2d": each} for each in (numbers, lost)]})
    assert read.usable.tolist() == [True, False]
    assert np.isnan(read.irises).all()


@pytest.mark.parametrize("count", [68, 70, 98, 133, 136, VERTICES])
def test_faces_of_low_scores_in_an_array_are_none(count: int, tmp_path: Path):
    scores = np.array([0.9, 0.01, 0.4])
    pixels = np.random.default_rng(3).uniform(0, 900, (3, count, 2))
    np.save(tmp_path / "a.npy", pixels)
    bare = read_frames(tmp_path / "a.npy")
    np.save(
        tmp_path / "a.npy", np.concatenate([pixels, np.tile(scores[:, None, None], (1, count, 1))], axis=2)
    )
    read = read_frames(tmp_path / "a.npy")
    assert read.usable.tolist() == [True, False, True]
    np.testing.assert_array_equal(read.points[read.usable], bare.points[read.usable])
    if bare.irises is not None:
        assert np.isfinite(read.irises).all(axis=(1, 2)).tolist() == [True, False, True]


@pytest.mark.parametrize("depths", [0.0, -0.1, 7.0])
@pytest.mark.parametrize("shares", [False, True])
def test_third_numbers_of_a_face_that_are_no_scores_are_left_alone(
    depths: float, shares: bool, tmp_path: Path
):
    faces = np.concatenate(
        [FACES / 2000 if shares else FACES, np.full((3, LANDMARK_COUNT, 1), depths)], axis=2
    )
    faces[:, ::2, 2] /= 2
    np.save(tmp_path / "a.npy", faces)
    assert read_frames(tmp_path / "a.npy").usable.all()
    if shares:
        faces[..., 2] = 0.1
        np.save(tmp_path / "a.npy", faces)
        assert read_frames(tmp_path / "a.npy").usable.all(), (
            "shares of the picture's width, as MediaPipe's depths"
        )


def test_distances_in_metres_are_no_scores(tmp_path: Path):
    faces = np.concatenate([FACES / 2000 - 0.2, np.full((3, LANDMARK_COUNT, 1), 0.25)], axis=2)
    np.save(tmp_path / "a.npy", faces)
    assert read_frames(tmp_path / "a.npy").usable.all()


@pytest.mark.parametrize("depth", [0, 1])
def test_an_array_of_meshes_has_landmarks_and_irises(depth: int, tmp_path: Path):
    meshes = np.random.default_rng(3).uniform(0, 900, (4, VERTICES, 2 + depth))
    np.save(tmp_path / "a.npy", meshes)
    read = read_frames(tmp_path / "a.npy")
    np.testing.assert_array_equal(read.points, landmarks_of(meshes[..., :2]))
    np.testing.assert_array_equal(read.irises, irises_of(meshes[..., :2]))


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ({"people": [{"face_keypoints_2d": [1, 2, 3]}]}, "has 3 numbers; 210 are needed"),
        ({"people": 3}, "no list of people"),
        ({"people": [{"pose_keypoints_2d": [1, 2, 3]}]}, "OpenPose wants --face"),
        ({"instance_info": 3}, "no list of pictures"),
        ([{"instances": 3}], "picture 0 has no list of instances"),
        ([{"instances": [3]}], "picture 0 has an instance that is no table"),
        ([{"instances": [{"keypoints": [["x", "y"]]}]}], "not a number"),
        ([{"instances": [{**_instance(FACES[0]), "keypoint_scores": [1]}]}], "1 scores of 68 points"),
    ],
)
def test_what_is_no_face_is_refused_in_a_sentence(document: object, said: str, tmp_path: Path):
    with pytest.raises(InputError) as caught:
        _read(tmp_path / "a.json", document)
    assert said in str(caught.value)
    assert "a.json" in str(caught.value)
    assert "\n" not in str(caught.value)

"""MediaPipe's results in JSON: lists of points under many names, of pictures and films."""

import json
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.errors import InputError
from regress.runtime.inputs import read_frames
from regress.runtime.inputs.mesh import irises_of, landmarks_of

MESHES = np.random.default_rng(1).uniform(0, 1, (3, 478, 2))


def _points(mesh: np.ndarray) -> list[dict[str, float]]:
    return [{"x": x, "y": y, "z": 0.1, "visibility": 0} for x, y in mesh.tolist()]


def _read(path: Path, document: object):
    path.write_text(json.dumps(document))
    return read_frames(path)


FILMS = {
    "results of a landmarker in JavaScript": [
        {"faceLandmarks": [_points(mesh)], "faceBlendshapes": [{"categories": [{"categoryName": name}]}]}
        for mesh, name in zip(MESHES, BLENDSHAPES, strict=False)
    ],
    "of one in Python": [{"face_landmarks": [_points(mesh)]} for mesh in MESHES],
    "of the face mesh": [{"multi_face_landmarks": [{"landmark": _points(mesh)}]} for mesh in MESHES],
    "with a head": {"fps": 30, "frames": [{"landmarks": _points(mesh)} for mesh in MESHES]},
    "lists of points": [_points(mesh) for mesh in MESHES],
    "lists of faces": [[_points(mesh)] for mesh in MESHES],
    "lists of numbers": np.concatenate([MESHES, MESHES[..., :1]], axis=2).tolist(),
    "behind names": {
        "landmarks": ["chin"],
        "frames": [{"landmarks": [_points(each)]} for each in MESHES],
    },
    "behind files": {
        "frames": ["a.png"],
        "results": [{"faceLandmarks": ["mesh"], "landmark": _points(each)} for each in MESHES],
    },
    "of TensorFlow": [[{"box": {"xMin": 1}, "keypoints": _points(mesh)}] for mesh in MESHES],
}


@pytest.mark.parametrize("name", FILMS)
def test_films_are_read_however_their_results_are_called(name: str, tmp_path: Path):
    read = _read(tmp_path / "a.json", FILMS[name])
    np.testing.assert_array_equal(read.points, landmarks_of(MESHES))
    np.testing.assert_array_equal(read.irises, irises_of(MESHES))
    assert read.labels == ("0", "1", "2")
    assert read.shares
    assert read.time_s is None


def test_an_empty_list_of_faces_says_that_there_is_none(tmp_path: Path):
    body = _points(MESHES[0])[:33]
    results = [{"faceLandmarks": faces, "landmarks": [body]} for faces in ([_points(MESHES[0])], [])]
    assert _read(tmp_path / "a.json", results).labels == ("0",)


def test_one_result_is_a_picture_of_all_of_its_faces(tmp_path: Path):
    read = _read(tmp_path / "a.json", {"faceLandmarks": [_points(mesh) for mesh in MESHES]})
    assert read.labels == ("0/1", "0/2", "0/3")
    assert len(read.takes()) == 3


@pytest.mark.parametrize(
    ("key", "times"), [("timestamp", [1.0, 1.1, 1.2]), ("timestampMs", [1000, 1100, 1200])]
)
def test_times_of_results_are_read_and_pictures_without_a_face_take_theirs(
    key: str, times: list[float], tmp_path: Path
):
    shown = ([_points(MESHES[0])], [], [_points(MESHES[2])])
    results = [{key: time, "faceLandmarks": faces} for time, faces in zip(times, shown, strict=True)]
    read = _read(tmp_path / "a.json", results)
    assert read.labels == ("0", "2")
    np.testing.assert_allclose(read.time_s, [1.0, 1.2])
    np.testing.assert_allclose(read.at_rate(10).time_s, [0, 0.2])


def test_numbers_of_results_that_do_not_go_on_are_no_times(run, quick_model_folder: Path, tmp_path: Path):
    mesh = 0.3 + 0.3 * MESHES[0]
    results = [
        {"timestamp": 0.02, "timeMs": "?", "time_ms": 100 * place, "faceLandmarks": [_points(mesh)]}
        for place in range(12)
    ]
    np.testing.assert_allclose(_read(tmp_path / "a.json", results).time_s, np.arange(12) / 10)
    for result in results:
        del result["time_ms"]
    read = _read(tmp_path / "a.json", results)
    assert (read.time_s, read.odd_times) == (None, "timestamp")
    for place, result in enumerate(results):
        result["timestamp"] = 33 * place
    _read(tmp_path / "a.json", results)
    said = run("predict", quick_model_folder, tmp_path / "a.json")[2]
    assert "if they are milliseconds, call the key timestamp_ms" in said


@pytest.mark.parametrize("time", [1e30, 10**400])
def test_a_time_after_all_times_is_refused(time: float, tmp_path: Path):
    with pytest.raises(InputError, match="a timestamp is beyond 1e\\+19 s"):
        _read(tmp_path / "a.json", {"timestamp": time, "faceLandmarks": [_points(MESHES[0])]})


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ({"faceLandmarks": [_points(MESHES[0])[:100]]}, "has a face of 100 points; 68 in iBUG's order"),
        ({"faceLandmarks": [[{"x": 1, "y": "a"}]]}, "picture 0 has a point without two numbers"),
        ([{"landmarks": [{"x": 1, "y": 1}, {"x": 1}]}], "picture 0 has a point without two numbers"),
        ({"faceLandmarks": []}, "of MediaPipe (faceLandmarks) are read as well"),
    ],
)
def test_what_is_no_face_is_refused_in_a_sentence(document: object, said: str, tmp_path: Path):
    with pytest.raises(InputError) as caught:
        _read(tmp_path / "a.json", document)
    assert said in str(caught.value)
    assert "a.json" in str(caught.value)
    assert "\n" not in str(caught.value)

"""Points in the orders of other detectors, whatever file they stand in and however a table's columns are called."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT, LANDMARK_GROUPS
from facegen.formats import write_pts
from regress.errors import InputError
from regress.runtime.inputs import Frames, read_frames
from regress.runtime.inputs.faults import face_faults
from regress.runtime.inputs.mesh import irises_of, landmarks_of
from regress.runtime.inputs.orders import COUNTS
from tests.regress.drawn import drawn_faces

FACES = drawn_faces(np.random.default_rng(1), 3)
IRISES = np.stack([FACES[:, 42:48].mean(axis=1), FACES[:, 36:42].mean(axis=1)], axis=1)


def _between(points: np.ndarray) -> np.ndarray:
    """A point more between each two neighbours (n, k, 2)."""
    middles = (points[:, :-1] + points[:, 1:]) / 2
    return np.stack([points[:, :-1], middles], axis=2).reshape(len(points), -1, 2)


def _wflw() -> np.ndarray:
    """98 points (n, 98, 2) as WFLW's picture shows them, of our faces."""
    group = {name: FACES[:, list(indices)] for name, indices in LANDMARK_GROUPS.items()}
    brows = [
        np.concatenate([group[name], group[name][:, 1:] + [0, 9]], axis=1)
        for name in ("right_brow", "left_brow")
    ]
    eyes = []
    for name in ("right_eye", "left_eye"):
        outer, upper, upper_in, inner, lower_in, lower = group[name].transpose(1, 0, 2)
        middles = (upper + upper_in) / 2, (lower + lower_in) / 2
        eyes.append(
            np.stack([outer, upper, middles[0], upper_in, inner, lower_in, middles[1], lower], axis=1)
        )
    jaw = np.concatenate([_between(group["jaw"]), group["jaw"][:, -1:]], axis=1)
    nose, lips = (
        [group["nose_bridge"], group["nose_base"]],
        [group["outer_lip"], group["inner_lip"]],
    )
    return np.concatenate([jaw, *brows, *nose, *eyes, *lips, IRISES[:, ::-1]], axis=1)


def _in_order(count: int) -> np.ndarray:
    """Our faces (n, count, 2) among other points; of a mesh some points that are no face."""
    others = np.random.default_rng(2).uniform(0, 900, (len(FACES), count, 2))
    if count == 98:
        return _wflw()
    if count in (468, 478):
        return others
    start = {68: 0, 70: 0, 133: 23, 136: 26}[count]
    others[:, start : start + LANDMARK_COUNT] = FACES
    if count == 70:
        others[:, LANDMARK_COUNT:] = IRISES[:, ::-1]
    return others


def _check(read: Frames, count: int, points: np.ndarray) -> None:
    mesh = count in (468, 478)
    np.testing.assert_allclose(read.points, landmarks_of(points) if mesh else FACES, atol=1e-4)
    irises = {70: IRISES, 98: IRISES, 478: irises_of(points) if count == 478 else None}.get(count)
    if irises is None:
        assert read.irises is None
    else:
        np.testing.assert_allclose(read.irises, irises, atol=1e-4)


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("ending", ["npy", "npz", "json", "csv", "pts"])
def test_every_order_is_read_of_every_kind_of_file(ending: str, count: int, tmp_path: Path):
    points, path = _in_order(count), tmp_path / f"a.{ending}"
    if ending == "npy":
        np.save(path, points)
    elif ending == "npz":
        np.savez(path, landmarks=points)
    elif ending == "json":
        seen = np.full((len(points), count, 1), 0.8)
        triples = np.concatenate([points, seen], axis=2).reshape(len(points), -1)
        path.write_text(
            json.dumps([{"image_id": n, "keypoints": row.tolist()} for n, row in enumerate(triples)])
        )
    elif ending == "csv":
        names = [f"{axis}_{index}" for axis in "xy" for index in range(count)]
        rows = [",".join(map(repr, face.T.ravel().tolist())) for face in points]
        path.write_text("\n".join([",".join(names), *rows]) + "\n")
    else:
        path = tmp_path / "faces"
        path.mkdir()
        for number, face in enumerate(points):
            write_pts(path / f"{number}.pts", face)
    _check(read_frames(path), count, points)


def test_mmposes_instances_may_be_of_any_order(tmp_path: Path):
    points = _in_order(98)
    instances = [{"keypoints": face.tolist(), "keypoint_scores": [0.9] * 98} for face in points]
    (tmp_path / "a.json").write_text(json.dumps([{"instances": [one]} for one in instances]))
    _check(read_frames(tmp_path / "a.json"), 98, points)


@pytest.mark.parametrize("start", [0, 1])
@pytest.mark.parametrize(
    "name", ["{a}_{i}", "{a}{i}", "{i}_{a}", "landmark_{i}_{a}", "lm.{i}.{a}", "P{i:02d}{a}", " {a}_{i}"]
)
def test_columns_are_an_axis_and_a_number_in_any_order(name: str, start: int, tmp_path: Path):
    """From 0 or from 1, beside columns of a body, of depths and of a table's own."""
    columns = [
        *("id", "68_score", "box_x", "hand_x_1", "hand_y_1"),
        *(name.format(a=axis, i=index + start) for index in range(LANDMARK_COUNT) for axis in "xyz"),
    ]
    with open(tmp_path / "a.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(columns)
        for face in FACES:
            deep = np.column_stack([face, np.zeros(LANDMARK_COUNT)])
            table.writerow(["n", 1, 2, 3, 4, *deep.ravel().tolist()])
    read = read_frames(tmp_path / "a.csv")
    np.testing.assert_allclose(read.points, FACES)


def test_openfaces_millimetres_are_no_points_of_a_picture(tmp_path: Path):
    names = [f"{axis}_{index}" for axis in "XYZ" for index in range(LANDMARK_COUNT)]
    (tmp_path / "a.csv").write_text(",".join(names) + "\n" + ",".join(["1"] * len(names)) + "\n")
    with pytest.raises(InputError, match=r"lacks 136 of the columns x_0 \.\. x_67"):
        read_frames(tmp_path / "a.csv")


def test_small_letters_go_before_capitals_of_other_points(tmp_path: Path):
    """As OpenFace calls points in space, whatever stands before the letter."""
    names = [f"lm_{axis}_{index}" for axis in "xyXYZ" for index in range(LANDMARK_COUNT)]
    rows = [",".join(map(repr, [*face.T.ravel().tolist(), *[7.0] * 3 * LANDMARK_COUNT])) for face in FACES]
    (tmp_path / "a.csv").write_text("\n".join([",".join(names), *rows]) + "\n")
    np.testing.assert_allclose(read_frames(tmp_path / "a.csv").points, FACES)


def test_an_archive_of_several_arrays_is_refused(tmp_path: Path):
    np.savez(tmp_path / "a.npz", b=FACES, a=FACES)
    with pytest.raises(InputError, match=r"holds 2 arrays \(a, b\); one is needed"):
        read_frames(tmp_path / "a.npz")


def test_a_real_mesh_without_irises_gives_the_same_face(real: Path, tmp_path: Path):
    """As older programs of MediaPipe write 468 points, in columns x_i and y_i."""
    path = real / "landmarks" / "pyfeat_clip_001.csv"
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    columns = [f"mesh_{axis}_{index}" for axis in "xy" for index in range(468)]
    with open(tmp_path / "old.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow([name.removeprefix("mesh_") for name in columns])
        table.writerows([row[name] for name in columns] for row in rows)
    read = read_frames(tmp_path / "old.csv")
    np.testing.assert_array_equal(read.points, read_frames(path).points)
    assert read.irises is None
    assert face_faults(read.points) == [None] * len(rows)


@pytest.mark.parametrize(
    "document",
    [
        {"frames": [{"timestamp": 0, "blendShapes": dict.fromkeys(BLENDSHAPES, 0.1)}]},
        {"names": [name[0].upper() + name[1:] for name in BLENDSHAPES], "weights": [[0.1] * 52]},
        [{"categories": [{"categoryName": name, "score": 0.1} for name in BLENDSHAPES[:51]]}],
        {"exprs": [[0.1]], "facsNames": list(BLENDSHAPES)},
    ],
)
def test_weights_of_apps_are_told_from_points(document: object, tmp_path: Path):
    (tmp_path / "a.json").write_text(json.dumps(document))
    with pytest.raises(InputError, match=r"a\.json holds weights already; the landmarks that they came from"):
        read_frames(tmp_path / "a.json")


def test_a_table_of_an_apps_weights_is_told_from_points(tmp_path: Path):
    """Also without a tongue, which MediaPipe's lack."""
    names = [name[0].upper() + name[1:] for name in BLENDSHAPES if name != "tongueOut"]
    (tmp_path / "a.csv").write_text(",".join(["Timecode", "BlendShapeCount", *names]) + "\n")
    with pytest.raises(InputError, match="is a table of weights already"):
        read_frames(tmp_path / "a.csv")

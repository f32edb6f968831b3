"""Tables of OpenFace and py-feat that hold more than 68 points: meshes, sizes of pictures, how sure a detector is."""

import csv
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import LANDMARK_COUNT
from facegen.errors import FormatError
from regress.errors import InputError
from regress.runtime.inputs import read_frames
from regress.runtime.inputs.mesh import VERTICES, irises_of, landmarks_of
from tests.regress.drawn import drawn_faces

FACE = drawn_faces(np.random.default_rng(1), 1)[0]
COLUMNS = [f"{axis}_{index}" for axis in "xy" for index in range(LANDMARK_COUNT)]


def _mesh() -> np.ndarray:
    return np.random.default_rng(2).uniform(0, 900, (VERTICES, 2))


def _written(path: Path, *rows: dict[str, object]) -> Path:
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, list(rows[0]))
        table.writeheader()
        table.writerows(rows)
    return path


def _points(points: np.ndarray, prefix: str = "") -> dict[str, float]:
    named = {}
    for axis, values in zip("xy", points.T, strict=True):
        named |= {f"{prefix}{axis}_{index}": float(value) for index, value in enumerate(values)}
    return named


@pytest.mark.parametrize("beside", [{}, _points(FACE[::-1])])
@pytest.mark.parametrize("prefix", ["mesh_", ""])
def test_a_mesh_goes_before_68_points_that_are_picked_from_it(prefix: str, beside: dict, tmp_path: Path):
    """py-feat's own picks are in another order than iBUG's."""
    mesh = _mesh()
    read = read_frames(_written(tmp_path / "a.csv", {**beside, **_points(mesh, prefix)}))
    np.testing.assert_array_equal(read.points, landmarks_of(mesh)[None])
    np.testing.assert_array_equal(read.irises, irises_of(mesh)[None])


def test_irises_of_openface_are_the_middles_of_their_edges(tmp_path: Path):
    """28 points an eye, the eye at the picture's left first: eight of the iris, then lids and pupil."""
    rng = np.random.default_rng(4)
    right, left = FACE[36:42].mean(axis=0), FACE[42:48].mean(axis=0)
    turns = np.arange(8) * np.pi / 4
    circle = 5 * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    eyes = np.concatenate(
        [right + circle, rng.uniform(0, 9, (20, 2)), left + circle, rng.uniform(0, 9, (20, 2))]
    )
    row = {**_points(FACE), **_points(eyes, "eye_lmk_"), "success": 1}
    read = read_frames(_written(tmp_path / "a.csv", row, {**row, "success": 0}))
    np.testing.assert_allclose(read.points[0], FACE)
    np.testing.assert_allclose(read.irises[0], [left, right])
    assert np.isnan(read.irises[1]).all()


def test_a_part_of_a_mesh_is_refused(tmp_path: Path):
    path = _written(tmp_path / "a.csv", _points(_mesh()[:400]))
    with pytest.raises(InputError, match="has columns of 400 points; 68 in iBUG's order"):
        read_frames(path)


def test_a_chin_of_a_real_mesh_is_the_lowest_point(real: Path):
    """The file's own point 8 lies at the side of the chin, and its point 33 on the tip of the nose."""
    for name in ("pyfeat_clip_001.csv", "pyfeat_clip_007.csv"):
        read = read_frames(real / "landmarks" / name)
        assert (read.points[..., 1].argmax(axis=1) == 8).all()
        middle, width = read.points[:, 33, 0], np.ptp(read.points[..., 0], axis=1)
        ends = (read.points[:, 31, 0] + read.points[:, 35, 0]) / 2
        assert (np.abs(middle - ends) < 0.05 * width).all(), "under the nose, between its wings"
        assert read.irises is not None
        assert read.picture_px is not None


@pytest.mark.parametrize(
    ("widths", "size_px"),
    [((1920.0, 1920.0), (1920, 1080)), ((1920, 1280), None), ((1920, ""), (1920, 1080))],
)
def test_the_size_of_pictures_is_taken_where_all_rows_say_the_same(
    widths: tuple, size_px: tuple | None, tmp_path: Path
):
    rows = [{**_points(FACE), "FrameWidth": width, "FrameHeight": 1080} for width in widths]
    assert read_frames(_written(tmp_path / "a.csv", *rows)).picture_px == size_px


@pytest.mark.parametrize("column", ["confidence", "FaceScore"])
def test_a_face_of_which_the_detector_is_not_sure_is_none(column: str, tmp_path: Path):
    rows = [{**_points(FACE), column: score} for score in (0.98, 0.3, 0.5, "")]
    assert read_frames(_written(tmp_path / "a.csv", *rows)).usable.tolist() == [True, False, True, True]


def test_the_head_stands_before_the_camera_of_the_table_s_pictures(
    run, quick_model_folder: Path, tmp_path: Path
):
    sized = {**_points(FACE), "FrameWidth": 640.0, "FrameHeight": 480.0}
    heads = {}
    for name, row in (("sized", sized), ("bare", _points(FACE))):
        path = _written(tmp_path / f"{name}.csv", row)
        for options in (("--head",), ("--picture", "640x480")):
            code, heads[name, options[0]], err = run("predict", quick_model_folder, path, *options)
            assert code == 0, err
    assert heads["sized", "--head"] == heads["sized", "--picture"] == heads["bare", "--picture"]
    assert heads["bare", "--head"] != heads["bare", "--picture"]


@pytest.mark.parametrize(
    ("column", "second"),
    [("timestamp", 1), ("time_s", 1), ("time", 1), ("timestamp_ms", 1000), ("time_ms", 1000)],
)
def test_times_are_read_of_any_table(column: str, second: float, tmp_path: Path):
    rows = [{"frame": number, column: 0.5 * number * second, **_points(FACE)} for number in (4, 5, 7)]
    read = read_frames(_written(tmp_path / "a.csv", *rows))
    np.testing.assert_allclose(read.time_s, [2.0, 2.5, 3.5])


def test_a_column_of_other_text_is_no_time(tmp_path: Path):
    rows = [{"time": time, **_points(FACE)} for time in ("0.1", "12:30:01")]
    assert read_frames(_written(tmp_path / "a.csv", *rows)).time_s is None


@pytest.mark.parametrize(
    "times",
    [
        np.random.default_rng(5).uniform(0.02, 0.03, 40),  # what each frame took
        np.tile(np.arange(20) / 30, 2),  # two clips, one after the other
        1.7e9 + np.arange(40) // 30,
        np.zeros(40),
    ],
)
def test_numbers_that_do_not_go_on_are_no_times(
    times: np.ndarray, run, quick_model_folder: Path, tmp_path: Path
):
    rows = [{"time": float(time), **_points(FACE)} for time in times]
    path = _written(tmp_path / "a.csv", *rows)
    read = read_frames(path)
    assert (read.time_s, read.odd_times) == (None, "time")
    code, _, said = run("predict", quick_model_folder, path)
    assert code == 0
    assert said.count("the column time does not go on from frame to frame, so there are no times; --fps") == 1
    assert "no times are given" not in said
    code, _, said = run("predict", quick_model_folder, path, "--one-euro", 1)
    assert code == 2, "rows would be lost for it"
    assert "does not go on" not in run("predict", quick_model_folder, path, "--fps", 30)[2]
    openface = _written(
        tmp_path / "b.csv", *({"success": 1, "timestamp": row["time"], **row} for row in rows)
    )
    np.testing.assert_array_equal(read_frames(openface).time_s, times)
    said = run("predict", quick_model_folder, openface)[2]
    told = "its times do not go on from frame to frame, so weights are not filtered" in said
    assert told == (np.median(np.diff(times)) <= 0)


def test_times_that_are_set_back_once_or_stand_for_a_while_are_times(tmp_path: Path):
    times = np.arange(60) / 30
    times[[5, 30, 31]] = times[[4, 28, 29]]
    rows = [{"time": float(time), **_points(FACE)} for time in times]
    np.testing.assert_array_equal(read_frames(_written(tmp_path / "a.csv", *rows)).time_s, times)


@pytest.mark.parametrize("beside", ["12:30:01", 0.02])
def test_what_is_no_time_hides_no_time_beside_it(beside: object, tmp_path: Path):
    rows = [{"time_s": beside, "timestamp": number / 30, **_points(FACE)} for number in range(3)]
    read = read_frames(_written(tmp_path / "a.csv", *rows))
    np.testing.assert_array_equal(read.time_s, np.arange(3) / 30)
    assert read.odd_times is None


def test_a_column_that_stands_twice_is_refused_where_it_counts(tmp_path: Path):
    row = {"time": 1, "Time": 2, **_points(FACE)}
    path = _written(tmp_path / "a.csv", row)
    path.write_text(path.read_text().replace("Time", "time"))
    with pytest.raises(FormatError, match="has several columns time;"):
        read_frames(path)
    path = _written(tmp_path / "a.csv", {**row, "timestamp": 3})
    path.write_text(path.read_text().replace("Time", "time"))
    assert read_frames(path).time_s == [3]


def test_units_go_before_bare_names(tmp_path: Path):
    row = {"timestamp": 60, "time": 50, "time_ms": 70, **_points(FACE)}
    assert read_frames(_written(tmp_path / "a.csv", row)).time_s == [0.07]


def test_seconds_go_before_other_columns_of_time(tmp_path: Path):
    row = {"time_ms": 70, "time": 60, "time_s": 50, **_points(FACE)}
    assert read_frames(_written(tmp_path / "a.csv", row)).time_s == [50]

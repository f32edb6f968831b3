"""Readers of landmark files, on real files and on broken ones."""

import json
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from facegen.errors import FormatError
from facegen.formats import write_pts
from regress.errors import InputError
from regress.runtime.inputs import READERS, Frames, read_frames
from tests.regress.drawn import drawn_faces

FACES = drawn_faces(np.random.default_rng(1), 3)
COLUMNS = [f"{axis}_{index}" for axis in "xy" for index in range(LANDMARK_COUNT)]


def _cells(face: np.ndarray) -> list[str]:
    return [repr(float(value)) for value in face.T.ravel()]


def _openface(path: Path, *, success: tuple[int, ...] = (1, 1, 1)) -> Path:
    lines = [", ".join(["frame", "timestamp", "confidence", "success", *COLUMNS])]
    for row, (face, seen) in enumerate(zip(FACES, success, strict=True)):
        lines.append(", ".join([str(row + 1), str(row / 30), "0.9", str(seen), *_cells(face)]))
    path.write_text("\n".join(lines) + "\n")
    return path


def _pyfeat(path: Path, *, empty: tuple[int, ...] = ()) -> Path:
    lines = [",".join(["FaceScore", *COLUMNS, "frame"])]
    for row, face in enumerate(FACES):
        cells = [""] * len(COLUMNS) if row in empty else _cells(face)
        lines.append(",".join(["0.99", *cells, str(2 * row)]))
    path.write_text("\n".join(lines) + "\n")
    return path


def _dlib(path: Path) -> Path:
    """Two faces in the first picture, one in the second; a box without parts has no face."""
    first, second, third = _boxes(FACES)
    images = f"<image file='1.jpg'>{first}{second}</image><image file='2.jpg'>{third}</image>"
    path.write_text(f"<?xml version='1.0'?><dataset><images>{images}</images></dataset>")
    return path


def _boxes(faces: np.ndarray) -> list[str]:
    def box(face: np.ndarray) -> str:
        parts = [f"<part name='{i:02d}' x='{x!r}' y='{y!r}'/>" for i, (x, y) in enumerate(face.tolist())]
        return f"<box top='1' left='1' width='9' height='9'>{''.join(reversed(parts))}</box>"

    return list(map(box, faces))


def _coco(path: Path, *, key: str = "keypoints", hidden: tuple[int, ...] = ()) -> Path:
    annotations = []
    for number, face in enumerate(FACES):
        seen = np.full((LANDMARK_COUNT, 1), 0 if number in hidden else 2)
        triples = np.concatenate([face, seen], axis=1)
        annotations.append({"id": 9 - number, "image_id": 5 + number, key: triples.ravel().tolist()})
    images = [{"id": 5 + number, "file_name": f"{number}.png"} for number in range(len(FACES))]
    path.write_text(json.dumps({"images": images, "annotations": annotations[::-1]}))
    return path


def _ck_plus(folder: Path) -> Path:
    for number, face in enumerate(FACES):
        place = folder / "S005" / "001"
        place.mkdir(parents=True, exist_ok=True)
        np.savetxt(place / f"S005_001_{number:08d}_landmarks.txt", face, fmt="  %.9e")
    return folder


def _openpose(folder: Path) -> Path:
    """One face in each of three pictures, and a picture without one."""
    folder.mkdir()
    for number, face in enumerate([*FACES, None]):
        people = [] if face is None else [{"person_id": [-1], "face_keypoints_2d": openpose_numbers(face)}]
        (folder / f"take_{number:012d}_keypoints.json").write_text(
            json.dumps({"version": 1.3, "people": people})
        )
    return folder


def openpose_numbers(face: np.ndarray) -> list[float]:
    """70 points x y c of a face (68, 2), whose irises are not seen."""
    triples = np.concatenate([face, np.full((LANDMARK_COUNT, 1), 0.8)], axis=1)
    return np.concatenate([triples, np.zeros((2, 3))]).ravel().tolist()


def example_file(name: str, folder: Path) -> Path:
    """A file of three faces (one for ``pts``) in a format of the table."""
    if name == "pts_folder":
        (folder / "faces").mkdir()
        for number, face in zip((2, 10, 100), FACES, strict=True):
            write_pts(folder / "faces" / f"frame_{number}.pts", face)
        return folder / "faces"
    if name == "pts":
        write_pts(folder / "one.pts", FACES[0])
        return folder / "one.pts"
    if name == "npy":
        np.save(folder / "a.npy", FACES.astype(np.float32))
        return folder / "a.npy"
    if name == "csv":
        return _openface(folder / "a.csv")
    if name == "dlib_xml":
        return _dlib(folder / "a.xml")
    if name == "coco":
        return _coco(folder / "a.json")
    if name == "openpose_folder":
        return _openpose(folder / "json")
    if name == "ck_plus":
        return _ck_plus(folder / "Landmarks")
    raise AssertionError(f"the format {name!r} has no example here: write one")


@pytest.mark.parametrize("name", READERS)
def test_every_format_of_the_table_gives_the_points_back(name: str, tmp_path: Path):
    frames = read_frames(example_file(name, tmp_path))
    expected = FACES[: len(frames.points)]
    assert len(frames.labels) == len(frames.points) > 0
    assert np.allclose(frames.points, expected, atol=1e-4)
    assert frames.points.dtype == np.float64
    assert frames.usable.all()


def test_an_array_of_one_face_needs_no_count(tmp_path: Path):
    """As the exports' page keeps a neutral face."""
    np.save(tmp_path / "neutral.npy", FACES[0])
    assert np.array_equal(read_frames(tmp_path / "neutral.npy").points, FACES[:1])


def test_a_folder_goes_by_number_not_by_letter(tmp_path: Path):
    assert read_frames(example_file("pts_folder", tmp_path)).labels == ("frame_2", "frame_10", "frame_100")


@pytest.mark.parametrize(
    ("name", "litter"), [("pts", "._frame_2.pts"), ("ck-plus", "._S005_001_00000002_landmarks.txt")]
)
def test_what_a_mac_leaves_beside_files_is_no_face(name: str, litter: str, tmp_path: Path):
    if name == "pts":
        write_pts(tmp_path / "frame_2.pts", FACES[0])
    else:
        np.savetxt(tmp_path / "S005_001_00000002_landmarks.txt", FACES[0])
    (tmp_path / litter).write_bytes(bytes(range(256)))
    assert len(read_frames(tmp_path).points) == 1


def test_300w_folders_are_read_below_the_folder(tmp_path: Path):
    for place, face in zip(("01_Indoor", "02_Outdoor"), FACES, strict=False):
        (tmp_path / place).mkdir()
        write_pts(tmp_path / place / "indoor_001.pts", face)
    frames = read_frames(tmp_path)
    assert frames.labels == ("01_Indoor/indoor_001", "02_Outdoor/indoor_001")
    assert np.allclose(frames.points, FACES[:2], atol=1e-4)


def test_dlib_faces_are_called_by_picture_and_number(tmp_path: Path):
    path = _dlib(tmp_path / "a.xml")
    path.write_text(path.read_text().replace("</image></images>", "<box top='1'/></image></images>"))
    frames = read_frames(path)
    assert frames.labels == ("1.jpg", "1.jpg/2", "2.jpg", "2.jpg/2")
    assert frames.usable.tolist() == [True, True, True, False]
    assert {face: rows.tolist() for face, rows in frames.takes().items()} == {"1": [0, 2], "2": [1, 3]}
    assert frames.at_rate(10).time_s == pytest.approx([0, 0, 0.1, 0.1])


@pytest.mark.parametrize("true", ["1", "true"])
def test_boxes_that_dlib_ignores_are_no_faces(true: str, tmp_path: Path):
    """Also where they have parts; a box behind one has the number that it had without."""
    first, second, third = _boxes(FACES)
    ignored = third.replace("<box", f"<box ignore='{true}'")
    kept = second.replace("<box", "<box ignore='0'")
    images = f"<image file='1.jpg'>{ignored}{first}{kept}</image><image file='2.jpg'>{ignored}</image>"
    path = tmp_path / "a.xml"
    path.write_text(f"<dataset><images>{images}</images></dataset>")
    frames = read_frames(path)
    assert frames.labels == ("1.jpg", "1.jpg/2")
    np.testing.assert_allclose(frames.points, FACES[:2])
    path.write_text(f"<dataset><images><image file='1.jpg'>{ignored}</image></images></dataset>")
    with pytest.raises(InputError, match="no image with a box"):
        read_frames(path)


@pytest.mark.parametrize(
    ("tracks", "takes"),
    [
        (None, {"1": [0], "2": [1, 2]}),  # the third face is nearer to the second
        ([7, 8, 8], {"7": [0], "8": [1, 2]}),
        ([7, 7, 8], {"1": [0], "2": [1, 2]}),  # one person twice in a picture
        ([7, None, 8], {"1": [0], "2": [1, 2]}),
    ],
)
def test_coco_faces_of_one_picture_are_takes_of_their_own(tracks: list | None, takes: dict, tmp_path: Path):
    path = _coco(tmp_path / "a.json")
    document = json.loads(path.read_text())
    for number, annotation in enumerate(document["annotations"]):
        annotation["image_id"] = document["images"][number // 2]["id"]
        if tracks is not None:
            annotation["track_id"] = tracks[number]
    path.write_text(json.dumps(document))
    frames = read_frames(path)
    assert {face: rows.tolist() for face, rows in frames.takes().items()} == takes
    assert frames.at_rate(10).time_s == pytest.approx([0, 0, 0.1])


@pytest.mark.parametrize(
    "without",
    [{}, {"keypoints": None}, {"keypoints": []}, {"keypoints": [1, 2, 2] * 17}, {"face_kpts": "no"}],
)
def test_coco_annotations_without_68_points_are_no_faces(without: dict, tmp_path: Path):
    """As boxes alone, or bodies, beside a face and in a picture of their own; tracks are of faces."""
    path = _coco(tmp_path / "a.json")
    document = json.loads(path.read_text())
    for track, annotation in enumerate(document["annotations"]):
        annotation["track_id"] = track
    document["annotations"] += [{"id": 50 + image, "image_id": image, **without} for image in (4, 5, 8)]
    path.write_text(json.dumps(document))
    frames = read_frames(path)
    assert frames.labels == ("0.png", "1.png", "2.png")
    np.testing.assert_allclose(frames.points, FACES)
    assert frames.numbers.tolist() == [1, 2, 3]
    assert frames.faces is None


@given(seen=st.sets(st.integers(0, 19), min_size=1, max_size=3))
@pytest.mark.parametrize("name", ["coco", "dlib_xml", "pts_folder"])
def test_pictures_without_a_face_take_their_time(name: str, seen: set[int]):
    with tempfile.TemporaryDirectory() as folder:
        frames = read_frames(_film_of_twenty(name, Path(folder), sorted(seen)))
    first = min(seen)
    counts = name != "pts_folder" or (len(seen) > 1 and np.median(np.diff(sorted(seen))) == 1)
    expected = [number - first if counts else row for row, number in enumerate(sorted(seen))]
    assert frames.at_rate(10).time_s == pytest.approx(np.array(expected) / 10)
    assert frames.faces is None


def _film_of_twenty(name: str, folder: Path, seen: list[int]) -> Path:
    """A film of which only some pictures have a face."""
    if name == "pts_folder":
        for number, face in zip(seen, FACES, strict=False):
            write_pts(folder / f"take2_{number}.pts", face)
        return folder
    if name == "coco":
        document = json.loads(_coco(folder / "a.json").read_text())
        annotations = sorted(document["annotations"], key=lambda each: each["image_id"])[: len(seen)]
        for annotation, number in zip(annotations, seen, strict=True):
            annotation["image_id"] = 100 - 5 * (19 - number)
        images = [{"id": 100 - 5 * number, "file_name": f"{number}.png"} for number in range(20)]
        (folder / "a.json").write_text(json.dumps({"images": images, "annotations": annotations}))
        return folder / "a.json"
    boxes = dict(zip(seen, _boxes(FACES), strict=False))
    images = "".join(f"<image file='{number}.jpg'>{boxes.get(number, '')}</image>" for number in range(20))
    (folder / "a.xml").write_text(f"<dataset><images>{images}</images></dataset>")
    return folder / "a.xml"


@pytest.mark.parametrize(
    ("names", "numbers"),
    [
        (["frame_1", "frame_2", "frame_10", "frame_11"], [1, 2, 10, 11]),
        (["a/7_l", "a/8_l"], [7, 8]),
        (["a/7", "a/8", "a/10", "a/11", "b/still", "c/1", "c/2"], [7, 8, 10, 11, 12, 13, 14]),
        (["a/7", "b/1", "b/2", "b/4", "b/5"], [0, 1, 2, 4, 5]),
        (["indoor_018", "indoor_090", "indoor_203"], None),
        (["1000", "1033", "1066"], None),
        (["a/1", "b/2"], None),
        (["a_1", "a_01"], None),
        (["1_1", "2_2"], None),
        (["one", "two"], None),
        (["1" * 30, "1" * 29 + "2"], None),
        (["frame_1"], None),
    ],
)
def test_names_of_faces_count_pictures_where_most_go_up_by_one(
    names: list[str], numbers: list[int] | None, tmp_path: Path
):
    for name in names:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        write_pts(tmp_path / f"{name}.pts", FACES[0])
    found = read_frames(tmp_path).numbers
    assert (None if found is None else found.tolist()) == numbers


def test_coco_points_that_are_not_labelled_are_missing(tmp_path: Path):
    frames = read_frames(_coco(tmp_path / "a.json", key="face_kpts", hidden=(1,)))
    assert frames.labels == ("0.png", "1.png", "2.png")
    assert frames.usable.tolist() == [True, False, True]
    assert np.allclose(frames.points[2], FACES[2])


def test_ck_plus_frames_are_called_by_subject_sequence_and_number(tmp_path: Path):
    frames = read_frames(_ck_plus(tmp_path))
    assert frames.labels == ("S005_001_00000000", "S005_001_00000001", "S005_001_00000002")


def test_openface_frames_without_success_have_no_face(tmp_path: Path):
    frames = read_frames(_openface(tmp_path / "a.csv", success=(1, 0, 1)))
    assert frames.usable.tolist() == [True, False, True]
    assert frames.labels == ("1", "2", "3")
    assert frames.time_s == pytest.approx([0, 1 / 30, 2 / 30])


@pytest.mark.parametrize("cell", ["-nan(ind)", "nan(ind)", "-1.#IND00", "1.#QNAN", "nan", "-nan", "NA"])
def test_frames_whose_points_are_written_as_no_number_have_no_face(cell: str, tmp_path: Path):
    """OpenFace's programs for Windows write the first of them where tracking fails (its issue 301)."""
    path = _openface(tmp_path / "a.csv")
    header, first, second, third = path.read_text().splitlines()
    lost = [*second.split(", ")[:4], *[cell] * len(COLUMNS)]
    path.write_text("\n".join([header, first, ", ".join(lost), third]) + "\n")
    assert read_frames(path).usable.tolist() == [True, False, True]


def test_pyfeat_rows_with_empty_cells_have_no_face(tmp_path: Path):
    frames = read_frames(_pyfeat(tmp_path / "a.csv", empty=(0,)))
    assert frames.usable.tolist() == [False, True, True]
    assert frames.labels == ("0", "2", "4")


def test_a_rate_counts_pictures_not_rows(tmp_path: Path):
    frames = read_frames(_pyfeat(tmp_path / "a.csv")).at_rate(30)
    np.testing.assert_allclose(frames.time_s, [0, 2 / 30, 4 / 30])
    assert frames.take([1, 2]).at_rate(10).time_s == pytest.approx([0, 0.2])
    np.save(tmp_path / "a.npy", FACES)
    assert read_frames(tmp_path / "a.npy").at_rate(10).time_s == pytest.approx([0, 0.1, 0.2])


def _with_frames(path: Path, frames: list[str]) -> Path:
    """A table of py-feat whose column ``frame`` says this."""
    header, *rows = path.read_text().splitlines()
    named = [f"{row.rpartition(',')[0]},{frame}" for row, frame in zip(rows, frames, strict=True)]
    path.write_text("\n".join([header, *named]) + "\n")
    return path


@pytest.mark.parametrize("frames", [["a", "b", "c"], ["3", "2", "1"], ["0", "nan", "2"], ["0", "1.5", "2"]])
def test_frames_that_do_not_count_are_rows(frames: list[str], tmp_path: Path):
    read = read_frames(_with_frames(_pyfeat(tmp_path / "a.csv"), frames))
    assert read.numbers is None
    assert read.at_rate(10).time_s == pytest.approx([0, 0.1, 0.2])


def test_a_table_that_is_sorted_by_faces_is_a_film_of_them_all_the_same(tmp_path: Path):
    path = _openface(tmp_path / "a.csv")
    header, *rows = path.read_text().splitlines()
    cells = [row.split(", ")[1:] for row in rows]
    sorted_by_face = [("5", "0", 1), ("6", "0", 2), ("5", "1", 0)]  # face 1 of picture 5 comes last
    lines = [", ".join(["frame", "face_id", *header.split(", ")[1:]])]
    lines += [", ".join([frame, face, "0.2", *cells[row][1:]]) for frame, face, row in sorted_by_face]
    path.write_text("\n".join(lines) + "\n")
    read = read_frames(path)
    assert read.labels == ("5/0", "5/1", "6/0")
    assert read.faces == ("0", "1", "0")
    np.testing.assert_allclose(read.points, np.array(FACES)[[1, 0, 2]], atol=1e-6)
    assert read.at_rate(10).time_s == pytest.approx([0, 0, 0.1])


def test_faces_of_one_picture_share_its_time_and_have_names_of_their_own(tmp_path: Path):
    read = read_frames(_with_frames(_pyfeat(tmp_path / "a.csv"), ["4", "4", "5"]))
    assert read.labels == ("4/0", "4/1", "5/0")
    assert {face: rows.tolist() for face, rows in read.takes().items()} == {"0": [0, 2], "1": [1]}
    assert read.at_rate(10).time_s == pytest.approx([0, 0, 0.1])


@pytest.mark.parametrize(
    ("people", "takes"),
    [
        (["Person_0", "Person_1", "Person_1", "Person_0"], {"Person_0": [0, 3], "Person_1": [1, 2]}),
        (["Person_0", "Person_0", "Person_1", "Person_0"], {"0": [0, 3], "1": [1, 2]}),
        (["Person_0", "", "Person_1", "Person_0"], {"0": [0, 3], "1": [1, 2]}),
        (["", "", "", ""], {"0": [0, 3], "1": [1, 2]}),
    ],
)
@pytest.mark.parametrize("column", ["Identity", "face_id"])
def test_people_whose_rows_change_order_are_told_by_their_names(
    column: str, people: list[str], takes: dict, tmp_path: Path
):
    """Without names by their places. The last frame has no face, and py-feat no name for it."""
    lines = [",".join([*COLUMNS, "frame", column])]
    for frame, face, person in zip("4455", [*FACES, FACES[0]], people, strict=True):
        lines.append(",".join([*_cells(face), frame, person]))
    (tmp_path / "a.csv").write_text("\n".join([*lines, "," * len(COLUMNS) + "6,"]) + "\n")
    read = read_frames(tmp_path / "a.csv")
    first = next(iter(takes))
    expected = {**takes, first: [*takes[first], 4]}
    assert {face: rows.tolist() for face, rows in read.takes().items()} == expected
    assert read.labels[4] == f"6/{first}"


def _subjects_right_is_at_the_images_left(frames: Frames) -> None:
    """Point 0 is the subject's right jaw, 36 the right eye's outer, 48 the right mouth corner; y is down."""
    x, y = frames.points[frames.usable][..., 0], frames.points[frames.usable][..., 1]
    for right, left in ((0, 16), (17, 26), (36, 45), (48, 54)):
        assert (x[:, right] < x[:, left]).all()
    assert (y[:, 8] > y[:, 27]).all()


@pytest.mark.parametrize(
    ("name", "rows", "timed"),
    [
        ("einstein.pts", 1, False),
        ("breakingbad.pts", 1, False),
        ("openface_sequence.csv", 100, True),
        ("pyfeat_clip_001.csv", 20, False),
        ("pyfeat_clip_007.csv", 14, False),
        ("dlib_faces.xml", 18, False),
    ],
)
def test_real_files_are_read_with_all_rows_and_times(real: Path, name: str, rows: int, timed: bool):
    frames = read_frames(real / "landmarks" / name)
    assert frames.points.shape == (rows, 68, 2)
    assert (frames.time_s is not None) == timed
    assert len(set(frames.labels)) == rows
    _subjects_right_is_at_the_images_left(frames)


def test_coco_pictures_that_are_called_by_names_are_in_the_order_of_their_numbers(tmp_path: Path):
    triples = np.concatenate([FACES[0], np.full((LANDMARK_COUNT, 1), 2)], axis=1).ravel().tolist()
    ids = ["frame_10", "frame_9", 3]
    annotations = [{"id": 1, "image_id": name, "keypoints": triples} for name in ids]
    (tmp_path / "a.json").write_text(json.dumps({"annotations": annotations}))
    assert read_frames(tmp_path / "a.json").labels == ("3", "frame_9", "frame_10")


def test_a_real_pts_file_counts_from_1(real: Path):
    path = real / "landmarks" / "einstein.pts"
    first = [float(value) for value in path.read_text().split("{")[1].split()[:2]]
    assert read_frames(path).points[0, 0] == pytest.approx(np.array(first) - 1)


def bad_inputs(folder: Path) -> dict[str, tuple[Path, str]]:
    """Files that cannot be used, each with what must be said about it."""
    folder.mkdir(parents=True, exist_ok=True)
    write_pts(folder / "short.pts", FACES[0][:67])
    np.save(folder / "empty.npy", np.full((2, 68, 2), np.nan))
    np.save(folder / "flat.npy", np.zeros((5, 136)))
    np.save(folder / "words.npy", np.full((1, 68, 2), "x"))
    (folder / "no.npy").write_bytes(b"hello")
    (folder / "other.csv").write_text("a,b\n1,2\n")
    (folder / "nothing.csv").write_text("")
    (folder / "header.csv").write_text(",".join(COLUMNS) + "\n")
    (folder / "cut.csv").write_text(",".join(COLUMNS) + "\n1,2,3\n")
    (folder / "words.csv").write_text(",".join(COLUMNS) + "\n" + ",".join(["x"] * len(COLUMNS)) + "\n")
    (folder / "not.xml").write_text("<a")
    (folder / "other.xml").write_text("<a/>")
    (folder / "high.xml").write_text(
        "<a><image file='b'><box><part name='68' x='1' y='1'/></box></image></a>"
    )
    (folder / "other.json").write_text("[1]")
    (folder / "other_list.json").write_text('[{"a": 1}]')
    (folder / "none.json").write_text('{"annotations": []}')
    (folder / "body.json").write_text('{"annotations": [{"id": 1, "image_id": 1, "keypoints": [1, 2, 2]}]}')
    (folder / "S1_landmarks.txt").write_text("1 2 3\n")
    (folder / "take.mp4").write_bytes(b"")
    (folder / "take.wav").write_bytes(b"")
    (folder / "bare").mkdir(exist_ok=True)
    (folder / "seen").mkdir(exist_ok=True)
    (folder / "seen" / "1.png").write_bytes(b"")
    (folder / "weights.csv").write_text(",".join(["frame", *BLENDSHAPES]) + "\n")
    (folder / "cut.json").write_text("{")
    (folder / "lines.txt").write_text(" ".join(["1"] * 136) + "\n")
    _openface(folder / "unseen.csv", success=(0, 0, 0))
    said = {
        "short.pts": "holds 67 points",
        "empty.npy": "no usable frame",
        "flat.npy": "shape (5, 136)",
        "words.npy": "numbers are needed",
        "no.npy": "no .npy file that can be read",
        "other.csv": "lacks 136 of the columns x_0",
        "nothing.csv": "lacks 136 of the columns",
        "header.csv": "a header and no rows",
        "cut.csv": "row 2 has 3 cells",
        "words.csv": "not a number",
        "not.xml": "is not XML",
        "other.xml": "no image with a box",
        "high.xml": "a part 68",
        "other.json": "not a COCO keypoints file: must be a table",
        "other_list.json": "not a COCO keypoints file: key 'annotations[0].image_id' is missing",
        "none.json": "no annotation",
        "body.json": "no 204 numbers",
        "S1_landmarks.txt": "1 lines of 3",
        "take.mp4": f"is a film, and landmarks of it are needed; track --fast --no-page --camera {folder}/take.mp4",
        "take.wav": "no known format",
        "bare": "holds no .pts file",
        "seen": f"holds pictures and no .pts file; track --fast --no-page --camera {folder}/seen",
        "weights.csv": "is a table of weights already",
        "cut.json": "cut.json is not a COCO keypoints file: is not JSON",
        "lines.txt": f"regress predict - < {folder}/lines.txt",
        "unseen.csv": "no usable frame",
        "missing.pts": "does not exist",
    }
    return {name: (folder / name, text) for name, text in said.items()}


def test_bad_files_are_refused_in_one_sentence_that_names_them(tmp_path: Path):
    for name, (path, said) in bad_inputs(tmp_path).items():
        with pytest.raises((InputError, FormatError)) as caught:
            read_frames(path)
        assert said in str(caught.value), name
        assert name in str(caught.value)
        assert "\n" not in str(caught.value)

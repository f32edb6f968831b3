"""Who is who in films of several faces whose detector does not say: the nearest to where somebody was."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import LANDMARK_COUNT
from facegen.formats import write_pts
from regress.cli.neutral_faces import named_rows, neutral_faces
from regress.runtime.inputs import Frames, read_frames
from regress.runtime.inputs.people import people_of
from tests.regress.drawn import drawn_faces

FACES = drawn_faces(np.random.default_rng(1), 2) + np.array([[[0.0, 0.0]], [[2000.0, 0.0]]])
ORDERS = ((0, 1), (1, 0), (1,), (1, 0))
"""Of the two people's rows in four pictures; one shows one of them."""


@given(count=st.integers(1, 4), pictures=st.integers(1, 8), seed=st.integers(0, 2**32 - 1))
def test_people_are_told_by_where_they_were_whatever_their_order(count: int, pictures: int, seed: int):
    rng = np.random.default_rng(seed)
    points, of, true = [], [], []
    for picture in range(pictures):
        present = range(count) if picture == 0 else np.flatnonzero(rng.random(count) < 0.8)
        for person in rng.permutation(present) if picture else present:
            middle = np.array([300 * person + rng.uniform(-60, 60), 100])
            points.append(rng.normal(middle, 20, (68, 2)))
            of.append(f"{picture}.png")
            true.append(str(7 + person))
    assert people_of(np.array(points), of, first=7) == true


@given(st.lists(st.sampled_from(["face", "none"]), min_size=1, max_size=4), st.integers(0, 2**32 - 1))
def test_everyone_in_a_picture_is_somebody_else(rows: list[str], seed: int):
    """Also where rows have no face: those are who is left."""
    points = np.random.default_rng(seed).uniform(0, 99, (3, len(rows), 68, 2))
    points[1, [row == "none" for row in rows]] = np.nan
    people = np.reshape(people_of(points.reshape(-1, 68, 2), np.repeat([4, 5, 6], len(rows))), (3, -1))
    for picture in people:
        assert sorted(picture) == sorted(map(str, range(len(rows))))


def _table(path: Path) -> Path:
    columns = [f"{axis}_{index}" for axis in "xy" for index in range(LANDMARK_COUNT)]
    lines = [",".join([*columns, "frame", "Identity"])]
    for picture, order in enumerate(ORDERS):
        lines += [",".join([*map(repr, FACES[each].T.ravel().tolist()), str(picture), ""]) for each in order]
    path.write_text("\n".join(lines) + "\n")
    return path


def _dlib(path: Path) -> Path:
    images = []
    for picture, order in enumerate(ORDERS):
        boxes = [
            "".join(
                f"<part name='{number}' x='{x!r}' y='{y!r}'/>"
                for number, (x, y) in enumerate(FACES[each].tolist())
            )
            for each in order
        ]
        images.append(f"<image file='{picture}'>{''.join(f'<box>{box}</box>' for box in boxes)}</image>")
    path.write_text(f"<dataset>{''.join(images)}</dataset>")
    return path


def _coco(path: Path) -> Path:
    triples = np.concatenate([FACES, np.full((2, LANDMARK_COUNT, 1), 2.0)], axis=2).reshape(2, -1).tolist()
    annotations = [
        {"id": 10 * picture + place, "image_id": picture, "keypoints": triples[each]}
        for picture, order in enumerate(ORDERS)
        for place, each in enumerate(order)
    ]
    path.write_text(json.dumps({"annotations": annotations}))
    return path


@pytest.fixture(params=[_table, _dlib, _coco])
def frames(request: pytest.FixtureRequest, tmp_path: Path) -> Frames:
    """Of two people whose rows change places."""
    ending = {_table: "csv", _dlib: "xml", _coco: "json"}[request.param]
    return read_frames(request.param(tmp_path / f"a.{ending}"))


def test_rows_that_exchange_places_stay_their_persons(frames: Frames):
    first, second = frames.takes().values()
    assert (first.tolist(), second.tolist()) == ([0, 3, 6], [1, 2, 4, 5])
    for face, rows in zip(FACES, (first, second), strict=True):
        np.testing.assert_allclose(frames.points[rows], np.broadcast_to(face, (len(rows), 68, 2)))


def test_a_picture_is_named_for_everyone_in_it(frames: Frames):
    takes = [frames.take(rows) for rows in frames.takes().values()]
    assert [named_rows(take, "1") for take in takes] == [[1], [1]]
    assert [named_rows(take, "2") for take in takes] == [[], [2]]


def _folders(path: Path, name: str) -> Path:
    """Two people's films, each in a folder of its own; of the second film's pictures one has no face."""
    for folder, shown in (("001", range(3)), ("002", (0, 2, 3, 4))):
        (path / folder).mkdir()
        for number in shown:
            face = FACES[int(folder) - 1] + number
            if name == "pts":
                write_pts(path / folder / f"{number:06d}.pts", face)
            else:
                np.savetxt(path / folder / f"S{folder}_001_{number:08d}_landmarks.txt", face)
    return path


@pytest.mark.parametrize("name", ["pts", "ck_plus"])
def test_each_folder_is_a_take_with_a_neutral_face_of_its_own(
    name: str, run, quick_model_folder, quick_model, tmp_path: Path
):
    frames = read_frames(_folders(tmp_path, name))
    assert {face: rows.tolist() for face, rows in frames.takes().items()} == {
        "001": [0, 1, 2],
        "002": [3, 4, 5, 6],
    }
    calm = neutral_faces(quick_model, frames, "first")
    assert {face: take.labels for face, take in calm.items()} == {
        "001": frames.labels[:1],
        "002": frames.labels[3:4],
    }
    named = neutral_faces(quick_model, frames, frames.labels[0])
    assert named["002"] is None, "another person's face is not neutral for this one"
    code, out, err = run("predict", quick_model_folder, tmp_path, "--neutral", "first")
    assert code == 0, err
    assert len(out.splitlines()) == 8


def test_numbers_of_films_in_folders_go_on_and_count_lost_pictures(tmp_path: Path):
    frames = read_frames(_folders(tmp_path, "pts"))
    assert frames.numbers.tolist() == [0, 1, 2, 3, 5, 6, 7]
    assert read_frames(tmp_path / "002").numbers.tolist() == [0, 2, 3, 4]
    assert read_frames(tmp_path / "002").faces is None


def test_a_first_frame_without_a_face_is_not_neutral(quick_model):
    points = FACES[:1].repeat(3, axis=0)
    points[0] = np.nan
    frames = Frames(points=points, labels=("a", "b", "c"), time_s=None, source="a.npy")
    assert neutral_faces(quick_model, frames, "first")[None].labels == ("b",)

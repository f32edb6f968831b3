"""Landmark files that nobody meant well: one sentence each, in bounded time and memory, whatever is in them."""

import contextlib
import errno
import io
import json
import os
import struct
import sys
import time
import tracemalloc
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import LANDMARK_COUNT
from facegen.errors import InputError
from facegen.formats import csv_rows, write_pts
from regress.runtime.inputs import READERS, Fault, frames, lines, read_frames, read_lines, text_lines
from tests.regress.drawn import drawn_faces
from tests.regress.test_inputs import COLUMNS, FACES, example_file

HUGE = "9" * 400
MANY = "1" * 5000


def _coco(path: Path, **changes: object) -> Path:
    triples = np.concatenate([FACES[0], np.full((LANDMARK_COUNT, 1), 2)], axis=1).ravel().tolist()
    entry = {"id": 1, "image_id": 1, "keypoints": triples} | changes
    path.write_text(json.dumps({"annotations": [entry]}))
    return path


def _npy_claim(path: Path, rows: int) -> Path:
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, 68, 2)}}".ljust(117) + "\n"
    path.write_bytes(b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header.encode() + bytes(1088))
    return path


def _npz_as_npy(path: Path) -> Path:
    with open(path, "wb") as file:
        np.savez(file, points=FACES)
    return path


def _text(path: Path, text: str | bytes) -> Path:
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def _xml(path: Path, *, before: str = "", part: str = "name='0' x='1' y='1'") -> Path:
    return _text(path, f"{before}<d><image file='a'><box><part {part}/></box></image></d>")


def _cut(path: Path) -> Path:
    np.save(path, FACES)
    return _text(path, path.read_bytes()[:-100])


def _pickled(path: Path) -> Path:
    np.save(path, np.array([object()]), allow_pickle=True)
    return path


BOMB = "<!DOCTYPE d [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;'><!ENTITY c '&b;&b;&b;&b;'>]>"

DAMAGE: dict[str, tuple[Callable[[Path], Path], str]] = {
    "keypoints.json": (lambda path: _coco(path, keypoints=5), "no 204 numbers"),
    "image.json": (lambda path: _coco(path, image_id=[1]), "image_id"),
    "name.json": (lambda path: _coco(path, id={}), "id"),
    "huge.json": (lambda path: _coco(path, keypoints=[int(HUGE)] * 204), "not a number"),
    "digits.json": (lambda path: _text(path, f'{{"annotations": [{MANY}]}}'), "too many digits"),
    "deep.json": (lambda path: _text(path, "[" * 100_000), "nested too deeply"),
    "number.json": (lambda path: _text(path, "5"), "not a COCO keypoints file"),
    "utf16.json": (lambda path: _text(path, '{"annotations": []}'.encode("utf-16")), "UTF-8"),
    "archive.npy": (_npz_as_npy, "no .npy file"),
    "claim.npy": (lambda path: _npy_claim(path, 10**9), "cut or damaged"),
    "cut.npy": (_cut, "cut or damaged"),
    "pickled.npy": (_pickled, "object"),
    "complex.npy": (lambda path: np.save(path, FACES.astype(complex)) or path, "complex128"),
    "encoding.xml": (lambda path: _xml(path, before="<?xml version='1.0' encoding='klingon'?>"), "not XML"),
    "bytes.xml": (lambda path: _xml(path, before="<?xml version='1.0' encoding='shift_jis'?>"), "not XML"),
    "bomb.xml": (lambda path: _xml(path, before=BOMB), "declares a document type"),
    "digits.xml": (lambda path: _xml(path, part=f"name='{MANY}' x='1' y='1'"), "lacks a number"),
    "digits.pts": (
        lambda path: _text(path, f"version: 1\nn_points: {MANY}\n{{\n1 1\n}}\n"),
        "not a .pts file",
    ),
    "twice.csv": (lambda path: _text(path, ",".join([*COLUMNS, "x_3"]) + "\n"), "several columns x_3"),
    "wide.csv": (lambda path: _text(path, "a," * 300_000), "a row of more than"),
    "late.csv": (
        lambda path: _text(
            path,
            ",".join(["timestamp", "success", *COLUMNS])
            + "\n"
            + ",".join(["1e300", "1"] + ["1"] * 136)
            + "\n",
        ),
        "a timestamp is beyond",
    ),
    "S1_landmarks.txt": (lambda path: _text(path, ""), "0 lines"),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_damage_is_one_sentence(name: str, tmp_path: Path):
    make, said = DAMAGE[name]
    path = make(tmp_path / name)
    with pytest.raises(InputError) as caught:
        read_frames(path)
    assert said in str(caught.value)
    assert name in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("reader", READERS)
@given(place=st.floats(0, 1), junk=st.binary(max_size=8), kept=st.floats(0, 1))
def test_no_bytes_of_a_file_are_a_traceback(
    reader: str, tmp_path_factory: pytest.TempPathFactory, place: float, junk: bytes, kept: float
):
    path = example_file(reader, tmp_path_factory.mktemp("hostile"))
    file = path if path.is_file() else next(one for one in sorted(path.rglob("*")) if one.is_file())
    content = file.read_bytes()
    at = int(place * len(content))
    file.write_bytes((content[:at] + junk + content[at + len(junk) :])[: int(len(content) * (0.5 + kept))])
    with contextlib.suppress(InputError):
        assert "".join(read_frames(path).labels).encode()


def test_superscripts_in_names_are_no_numbers(tmp_path: Path):
    for name in ("x²", "x10", "x9"):
        write_pts(tmp_path / f"{name}.pts", FACES[0])
    assert read_frames(tmp_path).labels == ("x9", "x10", "x²")


def test_names_that_are_no_text_come_out_as_text(tmp_path: Path):
    write_pts(tmp_path / "a\udcff.pts", FACES[0])
    (label,) = read_frames(tmp_path).labels
    assert label.encode().startswith(b"a")
    path = _coco(tmp_path / "a.json")
    path.write_text(json.dumps(json.loads(path.read_text()) | {"images": [{"id": 1, "file_name": "\ud800"}]}))
    assert read_frames(path).labels[0].encode()


@pytest.mark.parametrize("name", ["x" * 300 + ".pts", "x/" * 3000 + "a.csv"])
def test_names_that_are_too_long_are_refused(name: str, tmp_path: Path):
    with pytest.raises(InputError, match="cannot be read"):
        read_frames(tmp_path / name)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_without_a_writer_is_not_waited_for(tmp_path: Path):
    os.mkfifo(tmp_path / "a.csv")
    with pytest.raises(InputError, match="pipe or a device"):
        read_frames(tmp_path / "a.csv")


@pytest.mark.parametrize("name", ["a.pts", "a.npy", "a.csv", "a.xml", "a.json"])
def test_a_folder_with_the_name_of_a_file_holds_nothing(name: str, tmp_path: Path):
    (tmp_path / name).mkdir()
    with pytest.raises(InputError, match=r"holds no \.pts file"):
        read_frames(tmp_path / name)


def _seconds(path: Path) -> float:
    start = time.process_time()
    with pytest.raises(InputError):
        read_frames(path)
    return time.process_time() - start


def test_blanks_in_a_pts_header_cost_as_much_as_they_are(tmp_path: Path):
    """100,000 of them took 50 s, as many again four times that."""
    assert _seconds(_text(tmp_path / "a.pts", "version: 1" + "\n" * 100_000 + "x")) < 1


def test_annotations_cost_as_much_as_they_are(tmp_path: Path):
    """Each one's picture was looked up among all of them: 30,000 took 10 s more than they do."""
    entries = ", ".join(
        f'{{"id": {number}, "image_id": {number}, "keypoints": []}}' for number in range(30_000)
    )
    triples = ", ".join(["1, 1, 2"] * LANDMARK_COUNT)
    path = _text(tmp_path / "a.json", f'{{"annotations": [{entries.replace("[]", f"[{triples}]")}]}}')
    start = time.process_time()
    assert len(read_frames(path).labels) == 30_000
    assert time.process_time() - start < 12


def test_a_row_of_a_table_is_not_kept_as_text(tmp_path: Path):
    """Its strings took 12 kB; its numbers take 1.1."""
    cells = [repr(float(value)) for value in FACES[0].ravel()]
    with open(tmp_path / "a.csv", "w") as file:
        file.write(",".join(["success", *COLUMNS]) + "\n")
        for _ in range(3000):
            file.write(",".join(["1", *cells]) + "\n")
    tracemalloc.start()
    read_frames(tmp_path / "a.csv")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 3000 * 3000


@pytest.mark.parametrize("reader", ["pts_folder", "dlib_xml", "coco", "csv", "npy", "ck_plus"])
def test_there_are_only_so_many_frames(reader: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    path = example_file(reader, tmp_path)
    for module in (frames, sys.modules["regress.runtime.inputs.arrays"]):
        monkeypatch.setattr(module, "MOST_FRAMES", 2)
    monkeypatch.setattr(csv_rows, "MOST_ROWS", 2)
    with pytest.raises(InputError, match=r"more than 2|n from 1 to 2"):
        read_frames(path)


def _line(face: np.ndarray, *time_s: float) -> str:
    return " ".join(map(repr, [*time_s, *face.ravel().tolist()])) + "\n"


BAD_LINES = {
    "words": "a b c\n",
    "few": "1 2 3\n",
    "no text": "\ufffd\ufffd\n",
    "no time": _line(FACES[0], float("nan")),
    "long": "1 " * lines.MOST_CHARACTERS + "\n",
}


@pytest.mark.parametrize("kind", BAD_LINES)
@pytest.mark.parametrize("first", [True, False])
def test_a_bad_line_costs_itself(
    kind: str, first: bool, run, quick_model_folder: Path, monkeypatch: pytest.MonkeyPatch
):
    good = [_line(face) for face in drawn_faces(np.random.default_rng(4), 4)]
    place = 0 if first else 2
    spoilt = [*good[:place], BAD_LINES[kind], *good[place:]]
    monkeypatch.setattr(sys, "stdin", io.StringIO("".join(good)))
    _, out, _ = run("predict", quick_model_folder, "-")
    monkeypatch.setattr(sys, "stdin", io.StringIO("".join(spoilt)))
    code, spoilt_out, err = run("predict", quick_model_folder, "-")
    assert (code, err) == (0, f"line {place + 1} has {Fault.UNREADABLE.value}\n")
    cells = [line.partition(",")[2] for line in out.splitlines()[1:]]
    spoilt_cells = [line.partition(",")[2] for line in spoilt_out.splitlines()[1:]]
    assert spoilt_cells == [*cells[:place], "," * 51, *cells[place:]]
    monkeypatch.setattr(sys, "stdin", io.StringIO("".join(spoilt)))
    code, _, err = run("predict", quick_model_folder, "-", "--strict")
    assert code == 2
    assert f"line {place + 1} has" in err


def test_a_stream_that_is_something_else_ends():
    with pytest.raises(InputError, match="line 1 has 1 numbers"):
        list(read_lines(["5\n"] * 3))

    def endless() -> Iterator[str]:
        while True:
            yield "5\n"

    with pytest.raises(InputError, match="line 1 has 1 numbers"):
        list(read_lines(endless()))


def test_a_line_without_an_end_takes_no_memory():
    class Zeros(io.RawIOBase):
        left = 3000

        def readable(self) -> bool:
            return True

        def readinto(self, buffer: memoryview) -> int:
            self.left -= 1
            buffer[:] = b"0" * len(buffer)
            return len(buffer) if self.left > 0 else 0

    stream = io.TextIOWrapper(io.BufferedReader(Zeros()), encoding="utf-8")
    tracemalloc.start()
    assert len(list(text_lines(stream))) == 1
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2e6


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252"])
def test_a_byte_order_mark_costs_no_frame(encoding):
    """As Windows writes and reads text, whatever the locale is."""
    line = " ".join(map(str, range(136))) + "\r\n"
    stream = io.TextIOWrapper(io.BytesIO(b"\xef\xbb\xbf" + 2 * line.encode()), encoding=encoding)
    samples = list(read_lines(text_lines(stream)))
    assert [sample.faults for sample in samples] == [{}, {}]


NUMBERS = ("inf", "-inf", "nan", "1e999", "1e300", "-1e300")


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize(
    "option", ["--fps", "--one-euro", "--beta", "--smooth-landmarks", "--left-right-blend", "--smooth"]
)
def test_numbers_of_options_have_bounds(option: str, number: str, run, quick_model_folder, tmp_path: Path):
    np.save(tmp_path / "a.npy", FACES)
    code, out, err = run("predict", quick_model_folder, tmp_path / "a.npy", f"{option}={number}")
    assert (code, out) == (2, "")
    assert option in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize("command", [("predict",), ("headset", "predict", "headset-any")])
def test_beta_without_its_filter_is_refused(command: tuple[str, ...], run, tmp_path: Path):
    """It changed nothing, without a word; with ``--filter one-euro`` too."""
    np.save(tmp_path / "a.npy", FACES)
    for filter_ in ((), ("--filter", "one-euro")):
        code, out, err = run(*command, tmp_path / "a.npy", "--beta", "9", *filter_)
        assert (code, out, len(err.splitlines())) == (2, "", 1)
        assert "--beta 9 is of --one-euro, which is not given" in err


EDGES = {
    "words.npy": np.full((68, 3), "1"),
    "complex.npy": np.ones((68, 3), complex),
    "line.npy": np.zeros((68, 3)),
    "far.npy": np.random.default_rng(0).normal(size=(68, 3)) * 1e200,
    "nan.npy": np.full((68, 3), np.nan),
    "shape.npy": np.zeros((68, 2)),
}


@pytest.mark.parametrize(
    "name", [*EDGES, "archive.npy", "cut.npy", "pickled.npy", "huge.json", "deep.json", "null.json"]
)
def test_edges_are_made_of_68_points_alone(name: str, run, tmp_path: Path):
    path = tmp_path / name
    if name in EDGES:
        np.save(path, EDGES[name])
    elif name in DAMAGE and name != "huge.json":
        DAMAGE[name][0](path)
    else:
        path.write_text({"huge.json": f"[[{HUGE}, 1, 1]]", "null.json": "null"}[name])
    code, _, err = run("edges", path, "--out", tmp_path / "out.json")
    assert code == 2, err
    assert len(err.splitlines()) == 1
    assert not (tmp_path / "out.json").exists()


LONG = "x" * 300


@pytest.mark.parametrize(
    "words",
    [
        ("predict", LONG, "a.npy"),
        ("predict", "--model", LONG, "a.npy"),
        ("predict", "a.npy", "--neutral", LONG),
        ("predict", "a.npy", "--adjust", LONG),
        ("predict", "a.npy", "--gltf", LONG, "--out", "b.glb", "--fps", "30"),
        ("evaluate", LONG, LONG),
        ("headset", "predict", LONG),
        ("headset", "predict", "--mouth", LONG),
        ("edges", f"{LONG}.npy", "--out", "b.json"),
    ],
    ids=lambda words: " ".join(word.replace(LONG, "LONG") for word in words),
)
def test_names_of_over_255_bytes_are_one_sentence(
    words: tuple[str, ...], run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    np.save("a.npy", FACES)
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert "too long" in err
    assert [path.name for path in tmp_path.iterdir()] == ["a.npy"]


def test_a_folder_that_changes_while_it_is_read_is_one_sentence(tmp_path, monkeypatch):
    def vanished(*_):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(tmp_path / "gone"))

    monkeypatch.setattr(Path, "rglob", vanished)  # as /proc does whenever a process ends
    with pytest.raises(InputError, match="cannot be read: No such file or directory"):
        read_frames(tmp_path)

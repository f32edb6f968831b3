"""Pictures and films that nobody meant well: faults of frames or one sentence, nothing decoded beyond bounds."""

import contextlib
import os
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.errors import InputError
from regress.runtime.headset.pictures import picture_file
from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.recordings import film_frames, recording
from regress.runtime.headset.recordings.footage import line_up
from regress.runtime.headset.recordings.recording import Recording, read_recording, read_rendered
from tests.regress.headset.takes import HEIGHT, WIDTH, pictures, write_pictures

SIZES = {"left_eye": (WIDTH, HEIGHT), "mouth": (WIDTH, HEIGHT)}


def _read(folder: Path, camera: str = "mouth") -> Recording:
    return read_recording(folder, camera, width=WIDTH, height=HEIGHT)


def _picture(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), pictures([100])[0])
    return path


def _png_claim(width: int, height: int, rows: int = 10) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    body = zlib.compress(bytes(rows * (width + 1)))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


@given(
    names=st.lists(
        st.text("0123456789", min_size=1, max_size=40), min_size=1, max_size=6, unique_by=lambda name: name
    )
)
def test_numbers_of_any_length_make_an_order(names: list[str], tmp_path_factory: pytest.TempPathFactory):
    folder = tmp_path_factory.mktemp("take")
    for name in names:
        _picture(folder / f"{name}.png")
    recording = _read(folder)
    assert len(recording.numbers) == len(names)
    assert (np.diff(recording.numbers) > 0).all()
    footage = line_up({"mouth": recording, "left_eye": recording}, SIZES)
    assert footage.present.any(axis=0).all()
    assert len(footage.numbers) <= 4 * len(names)


@pytest.mark.parametrize("name", ["²", "1²", "x" * 200, "1_000", "٣", "0" * 30 + "7", "-5", "a\udcff9"])
def test_odd_names_are_read(name: str, tmp_path: Path):
    _picture(tmp_path / "2.png")
    _picture(tmp_path / "a.png").rename(tmp_path / f"{name}.png")
    assert len(_read(tmp_path).numbers) == 2


def test_renders_with_odd_names_are_left_out(tmp_path: Path):
    for name in ("000004", "²", "x", "9" * 30, "9" * 200):
        _picture(tmp_path / "renders" / "000" / name / "mouth.png")
    assert read_rendered(tmp_path, "mouth", width=WIDTH, height=HEIGHT).numbers.tolist() == [4]


SPOILERS: dict[str, tuple[Callable[[Path], object], Fault]] = {
    "claim": (lambda path: path.write_bytes(_png_claim(65_535, 65_535)), Fault.LARGE),
    "filled": (lambda path: path.write_bytes(_png_claim(16_000, 16_000, rows=16_000)), Fault.LARGE),
    "long": (lambda path: os.truncate(_picture(path), 300 * 1024**2), Fault.LARGE),
    "folder": (lambda path: path.mkdir(), Fault.UNREADABLE),
    "nothing": (lambda path: path.write_bytes(b""), Fault.UNREADABLE),
    "words": (lambda path: path.write_text("hello"), Fault.UNREADABLE),
    "cut": (lambda path: path.write_bytes(_picture(path).read_bytes()[:60]), Fault.UNREADABLE),
    "dangling": (lambda path: path.symlink_to("nowhere"), Fault.UNREADABLE),
    "pipe": (lambda path: os.mkfifo(path), Fault.UNREADABLE),
}


@pytest.mark.parametrize("kind", SPOILERS)
def test_a_bad_picture_costs_its_frame(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    decode, sizes = cv2.imdecode, []

    def watched(content: np.ndarray, flags: int) -> np.ndarray | None:
        grey = decode(content, flags)
        sizes.append(0 if grey is None else grey.size)
        return grey

    monkeypatch.setattr(picture_file.cv2, "imdecode", watched)
    spoil, fault = SPOILERS[kind]
    for number in (1, 3):
        _picture(tmp_path / f"{number}.png")
    spoil(tmp_path / "2.png")
    assert _read(tmp_path).faults == (None, fault, None)
    assert max(sizes) == WIDTH * HEIGHT


def test_a_take_has_only_so_many_frames(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    write_pictures(tmp_path / "take", pictures([100] * 4))
    film = cv2.VideoWriter(
        str(tmp_path / "a.avi"), cv2.VideoWriter_fourcc(*"MJPG"), 30, (WIDTH, HEIGHT), isColor=False
    )
    for picture in pictures([100] * 4):
        film.write(picture)
    film.release()
    assert len(_read(tmp_path / "a.avi").numbers) == 4
    monkeypatch.setattr(recording, "MOST_FRAMES", 3)
    for path in (tmp_path / "take", tmp_path / "a.avi"):
        with pytest.raises(InputError, match="more than 3 frames"):
            _read(path)
    monkeypatch.setattr(film_frames, "MOST_PIXELS", 100)
    with pytest.raises(InputError, match="at most 100 are read"):
        _read(tmp_path / "a.avi")


@pytest.mark.parametrize("name", ["x" * 300, "a.mp4", "none", "pipe.mp4", "loop", "a\udcff.avi"])
def test_what_is_no_recording_is_refused(name: str, tmp_path: Path):
    (tmp_path / "a.mp4").write_bytes(b"hello")
    (tmp_path / "a\udcff.avi").write_bytes(b"hello")  # of which OpenCV 4.11 dies
    os.mkfifo(tmp_path / "pipe.mp4")
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(InputError) as caught:
        _read(tmp_path / name)
    assert name[:20] in str(caught.value)


@given(place=st.floats(0, 1), junk=st.binary(min_size=1, max_size=8), kept=st.floats(0.2, 1))
def test_no_bytes_of_a_film_are_a_traceback(
    tmp_path_factory: pytest.TempPathFactory, place: float, junk: bytes, kept: float
):
    path = tmp_path_factory.mktemp("film") / "a.avi"
    film = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 30, (WIDTH, HEIGHT), isColor=False)
    film.write(pictures([100])[0])
    film.release()
    content = path.read_bytes()
    at = int(place * len(content))
    path.write_bytes((content[:at] + junk + content[at + len(junk) :])[: int(kept * len(content))])
    with contextlib.suppress(InputError):
        assert len(_read(path).numbers)

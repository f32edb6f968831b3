"""Films that were cut or damaged: what can be read counts, what lacks is told, and FFmpeg is quiet about it."""

import os
import re
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from regress.runtime.even_rows import even_rows
from regress.runtime.headset.recordings.film_frames import Film
from regress.runtime.headset.recordings.recording import Recording, read_recording

FRAMES = 60


def film(path: Path) -> Path:
    random = np.random.default_rng(3)
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 30, (96, 96))
    for _ in range(FRAMES):
        writer.write(random.integers(40, 200, (96, 96, 3), dtype=np.uint8))
    writer.release()
    return path


def cut(path: Path, share: float) -> Path:
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    return path


def read(path: Path, **options: object) -> Recording:
    return read_recording(path, "left_eye", width=64, height=64, **options)


def test_a_whole_film_is_told_nothing_of(tmp_path: Path):
    assert read(film(tmp_path / "eye.avi")).note == ""
    assert read(tmp_path / "eye.avi", choose=lambda count: even_rows(count, 8)).note == ""


@pytest.mark.parametrize("some", [False, True])
def test_a_film_that_ends_early_is_told(tmp_path: Path, some: bool):
    path = cut(film(tmp_path / "eye.avi"), 0.5)
    recording = read(path, **({"choose": lambda count: even_rows(count, 30)} if some else {}))
    assert 10 < len(recording.pictures) < 0.6 * FRAMES
    assert recording.note.startswith(f"left_eye: its film says that it has {FRAMES} frames, and ends")
    assert some or f"after {len(recording.pictures)};" in recording.note


def without_every_third(path: Path) -> None:
    """Make every third frame of a Matroska film a void element, as if the camera had dropped it; times stay."""
    content = bytearray(path.read_bytes())
    block = re.compile(
        rb"\xa3([\x80-\xff]|[\x40-\x7f].|[\x20-\x3f]..|[\x10-\x1f]...)\x81..\x80(?=\xff\xd8)", re.DOTALL
    )
    found = [each.start() for each in block.finditer(bytes(content))]
    assert len(found) > 0.9 * FRAMES
    for start in found[1::3]:
        content[start] = 0xEC
    path.write_bytes(content)


@pytest.mark.parametrize("ends", ["whole", "early"])
def test_frames_that_a_camera_dropped_do_not_lack_from_a_film_that_only_knows_how_long_it_lasts(
    tmp_path: Path, ends: str
):
    path = film(tmp_path / "eye.mkv")
    without_every_third(path)
    with Film(path) as opened:
        assert opened.length == FRAMES
    recording = read(path if ends == "whole" else cut(path, 0.5))
    assert len(recording.pictures) < 0.7 * FRAMES
    assert ("and ends or cannot be decoded" in recording.note) == (ends == "early")


def test_what_ffmpeg_is_asked_to_say_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("OPENCV_FFMPEG_LOGLEVEL", "16")
    read(film(tmp_path / "eye.avi"))
    assert os.environ["OPENCV_FFMPEG_LOGLEVEL"] == "16"


def test_ffmpeg_writes_nothing_of_a_damaged_film(tmp_path: Path):
    path = film(tmp_path / "eye.avi")
    content = bytearray(path.read_bytes())
    for place in range(20_000, len(content) - 20_000, 500):
        content[place : place + 60] = bytes(60)
    path.write_bytes(content)
    source = (
        "from pathlib import Path\n"
        "from regress.runtime.headset.recordings.recording import read_recording\n"
        f"read_recording(Path({str(path)!r}), 'left_eye', width=64, height=64)\n"
    )
    done = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("ending", [".mjpeg", ".mpg", ".ts", ".m4v", ".mkv"])
def test_films_of_many_endings_are_read(tmp_path: Path, ending: str):
    """Cameras' programs write Motion JPEG without a container, and broadcasters' tools transport streams."""
    path = film(tmp_path / "eye.avi")
    if ending == ".mjpeg":
        capture, pictures = cv2.VideoCapture(str(path)), []
        while (read_one := capture.read())[0]:
            pictures.append(cv2.imencode(".jpg", read_one[1])[1].tobytes())
        path = path.with_suffix(ending)
        path.write_bytes(b"".join(pictures))
    else:
        path = path.rename(path.with_suffix(ending))  # FFmpeg goes by what is in it
    found = read(path)
    assert (len(found.pictures), found.note) == (FRAMES, "")


def test_portable_pixmaps_are_pictures(tmp_path: Path):
    for number in range(3):
        picture = np.random.default_rng(number).integers(40, 200, (64, 64, 3), dtype=np.uint8)
        assert cv2.imwrite(str(tmp_path / f"{number}.ppm"), picture)
    assert read(tmp_path).faults == (None,) * 3

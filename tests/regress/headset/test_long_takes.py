"""Of a long take `check` reads a part: the first frames, which follow one another, and others all over it."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from regress.runtime.headset.fitness.fitness import checked_rows
from regress.runtime.headset.recordings.recorded_paths import recorded_size
from regress.runtime.headset.recordings.recording import read_recording
from tests.regress.headset.takes import write_pictures


def test_rows_of_a_long_take():
    rows = checked_rows(7200)
    assert rows[:300].tolist() == list(range(300))
    assert 580 < len(rows) <= 600
    assert rows[-1] == 7199
    assert checked_rows(120).tolist() == list(range(120))


@pytest.mark.parametrize("kind", ["folder", "film"])
def test_what_is_chosen_is_read_alone(tmp_path: Path, kind: str):
    stack = np.stack([np.full((24, 32), 60 + number % 180, np.uint8) for number in range(700)])
    stack[:, :12] //= 2
    path = tmp_path / "eye.avi"
    if kind == "folder":
        path = write_pictures(tmp_path / "eye", stack)
    else:
        film = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"FFV1"), 30, (32, 24), isColor=False)
        for picture in stack:
            film.write(picture)
        film.release()
    found = read_recording(path, "left_eye", width=32, height=24, choose=checked_rows)
    assert found.numbers.tolist() == checked_rows(700).tolist()
    assert np.abs(found.pictures.astype(int) - stack[found.numbers]).max() <= 2


def test_a_folders_size_is_that_of_most_pictures(tmp_path: Path):
    write_pictures(tmp_path, np.full((30, 24, 32), 99, np.uint8))
    write_pictures(tmp_path, np.full((1, 400, 300), 99, np.uint8), name="000_cover.png")
    (tmp_path / "0000.png").write_bytes(b"no picture")
    assert recorded_size(tmp_path) == (32, 24)

"""One camera that shows both eyes: its halves are cameras of their own, live and in recordings."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.pictures.halves import HALVES, half_of, half_size, split_half
from regress.runtime.headset.recordings.recorded_paths import recorded_size
from regress.runtime.headset.recordings.recording import read_recording
from tests.track.virtual import Switches, VirtualCamera
from track.errors import CameraError
from track.sources import Capture, Pace, open_capture


@given(st.integers(2, 9), st.integers(2, 9), st.sampled_from(HALVES))
def test_halves_are_of_one_size_and_share_nothing(width: int, height: int, half: str):
    picture = np.arange(width * height).reshape(height, width)
    other = dict(zip(HALVES, ("right", "left", "bottom", "top"), strict=True))[half]
    first, second = half_of(picture, half), half_of(picture, other)
    assert first.shape == second.shape == half_size((width, height), half)[::-1]
    assert not set(first.ravel()) & set(second.ravel())
    assert half_of(picture, "") is not None
    assert half_of(picture, "").shape == (height, width)


@pytest.mark.parametrize(
    ("source", "parts"),
    [
        ("0#left", ("0", "left")),
        ("take/both.mp4#bottom", ("take/both.mp4", "bottom")),
        ("http://10.0.0.2:81/stream#right", ("http://10.0.0.2:81/stream", "right")),
        ("take#1", ("take#1", "")),
        ("#left", ("#left", "")),
        ("0", ("0", "")),
    ],
)
def test_a_half_stands_behind_a_source(source: str, parts: tuple[str, str]):
    assert split_half(source) == parts


@pytest.mark.parametrize("first", ["0", "/dev/video0", "http://me:secret@10.0.0.2:81/stream", "HD Webcam"])
@pytest.mark.parametrize("half", ["", "#left"])
def test_one_camera_for_two_names_is_told_with_its_halves(first: str, half: str):
    """It opens once: the second name found it busy, and no sentence said why."""
    second = "00" if first in ("0", "/dev/video0") else first
    with pytest.raises(CameraError) as refused:
        open_capture({"left_eye": first + half, "mouth": "7", "right_eye": second + half})
    said = str(refused.value)
    assert said.startswith("left_eye and right_eye are the same, ")
    shown = first.replace("me:secret@", "")
    assert (f"left_eye={shown}#left" in said) == (half == "")
    assert "secret" not in said


def both_eyes(folder: Path) -> Path:
    """Pictures whose left halves are dark, and whose right ones are bright."""
    folder.mkdir()
    for number in range(10):
        picture = np.full((24, 64), 60 + number, np.uint8)
        picture[:, 32:] += 100
        picture[::2] += 30
        assert cv2.imwrite(str(folder / f"{number:03d}.png"), picture)
    return folder


def test_halves_of_a_folder_are_recordings(tmp_path: Path):
    folder = both_eyes(tmp_path / "both")
    assert recorded_size(Path(f"{folder}#left")) == (32, 24)
    for half, level in (("left", 75), ("right", 175)):
        found = read_recording(Path(f"{folder}#{half}"), "left_eye", width=32, height=24)
        assert found.pictures.shape == (10, 24, 32)
        assert found.pictures[0].mean() == level
        assert found.faults == (None,) * 10


def test_a_folder_that_is_called_so_is_whole(tmp_path: Path):
    folder = both_eyes(tmp_path / "take#left")
    assert recorded_size(folder) == (64, 24)
    with open_capture({"left_eye": str(folder)}, Pace(fast=True)) as capture:
        assert capture.read().pictures["left_eye"].shape[:2] == (24, 64)


def test_live_one_source_is_opened_once_for_both_halves():
    switches = Switches()
    opened = []

    def opener() -> VirtualCamera:
        opened.append(1)
        return VirtualCamera(switches)

    halves = {"left_eye": ("0", "right"), "right_eye": ("0", "left")}
    with Capture({"0": opener}, halves=halves) as capture:
        # profiles go by titles, and another half is another camera
        assert capture.titles == {"left_eye": "virtual camera#right", "right_eye": "virtual camera#left"}
        samples = [sample for sample in (capture.read() for _ in range(8)) if sample.pictures]
        switches.dark = True
        while "left_eye" not in (sample := capture.read()).faults:
            pass
    assert len(opened) == 1
    assert set(sample.faults) == {"left_eye", "right_eye"}
    assert not sample.pictures
    for sample in samples:
        whole = sample.pictures["left_eye"].base
        assert whole is sample.pictures["right_eye"].base
        assert np.shares_memory(sample.pictures["left_eye"], whole[:, 32:])


def test_films_and_folders_are_split_by_their_names(tmp_path: Path):
    folder = both_eyes(tmp_path / "both")
    cameras = {"left_eye": f"{folder}#right", "right_eye": f"{folder}#left"}
    with open_capture(cameras, Pace(fast=True)) as capture:
        samples = list(capture)
    assert len(samples) == 10
    for number, sample in enumerate(samples):
        levels = {name: picture.mean() for name, picture in sample.pictures.items()}
        assert levels == pytest.approx({"left_eye": 175 + number, "right_eye": 75 + number})

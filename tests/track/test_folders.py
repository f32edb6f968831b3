"""Folders of pictures as cameras: their order, pace, lost numbers, growth, and what is no picture."""

import threading
import time
from pathlib import Path

import cv2
import numpy as np
import pytest

from tests.track.pictures import folder_of, numbered, read_all
from tests.track.virtual import noise
from track.errors import CameraError
from track.sources import CameraFault, Pace, open_capture, open_source
from track.sources.camera import Camera
from track.sources.folders import FOLLOWED_S


def test_a_folder_is_read_in_natural_order_at_its_pace(tmp_path: Path):
    folder = folder_of(tmp_path / "takes", [f"frame_{number}.png" for number in range(12)])
    (folder / "notes.txt").write_text("no picture")
    pictures = read_all(open_source(str(folder), Pace(fast=True, fps=50)))
    assert [round((picture.pixels.mean() - 66) / 8) for picture in pictures] == list(range(12))
    assert [picture.time_s for picture in pictures] == pytest.approx(np.arange(12) / 50)


def _number_of(picture: np.ndarray) -> int:
    return round((picture.mean() - 66) / 8)


def test_a_wait_for_a_picture_behind_many_lost_ones_can_be_ended(tmp_path: Path):
    for number in (*range(3), *range(100, 400)):
        cv2.imwrite(str(tmp_path / f"take_{number:03d}.png"), noise(number))
    camera = Camera(lambda: open_source(str(tmp_path), Pace(fps=5)), threading.Condition())
    camera.start()
    time.sleep(1)
    began = time.monotonic()
    camera.close()  # the next picture is due in 19 s, and a source that cannot be woken has 15
    assert time.monotonic() - began < 10


@pytest.mark.parametrize("fast", [True, False])
def test_pictures_that_a_folder_lost_leave_their_time_empty(fast: bool, tmp_path: Path):
    folder = folder_of(tmp_path / "takes", [f"take2_{number:03d}a.png" for number in range(12)])
    for number in (5, 6, 7):
        (folder / f"take2_{number:03d}a.png").unlink()
    source = open_source(str(folder), Pace(fast=fast, fps=20))
    pictures = read_all(source)
    steps = np.array([_number_of(picture.pixels) for picture in pictures]) / 20
    assert source.length_s == pytest.approx(12 / 20)
    times = np.array([picture.time_s for picture in pictures])
    if fast:
        assert times == pytest.approx(steps)
    else:
        assert (times >= steps - 1e-6).all(), "a busy machine is late, and never early"


@pytest.mark.parametrize("fps", [30, 100])
def test_a_folder_that_lost_pictures_stays_beside_the_others_also_when_they_come_again(
    fps: int, tmp_path: Path
):
    """At the start, where the time from picture to picture is not known yet, in the middle and at the end."""
    names = [f"{number}.png" for number in range(20)]
    whole, lossy = (folder_of(tmp_path / name, names) for name in ("whole", "lossy"))
    for number in (0, 7, 8, 19):
        (lossy / f"{number}.png").unlink()
    pace = Pace(fast=True, fps=fps, again=True)
    together = []
    with open_capture({"whole": str(whole), "lossy": str(lossy)}, pace) as capture:
        for _ in range(40):
            sample = capture.read()
            seen = {name: _number_of(picture) for name, picture in sample.pictures.items()}
            together.append((seen["whole"], seen.get("lossy", -1)))
            assert len(together) < 3 or sample.time_s == pytest.approx((len(together) - 1) / fps)
    assert [number for number, _ in together] == [*range(20)] * 2
    both = [(one, other) for one, other in together[3:] if one not in (0, 7, 8, 19)]
    assert all(one == other for one, other in both)
    assert all(other <= one for one, other in together[3:20]), "the last one that came stands in"


@pytest.mark.parametrize(
    "names",
    [
        [f"{1_700_000_000_000_000_000 + 33_333_333 * number}.png" for number in range(6)],
        [f"{2 * number}.png" for number in range(6)],
        ["a1.png", "a2.png", "b7.png", "b8.png"],
        ["1.jpg", "1.png", "5.png"],
        ["first.png", "second.png"],
    ],
)
def test_names_that_do_not_count_pictures_say_nothing_of_their_times(names: list[str], tmp_path: Path):
    """Of a clock, each second one, of two takes, twice one number, and none."""
    pictures = read_all(open_source(str(folder_of(tmp_path / "takes", names)), Pace(fast=True, fps=50)))
    assert [picture.time_s for picture in pictures] == pytest.approx(np.arange(len(names)) / 50)


def test_folders_of_other_numbers_begin_together(tmp_path: Path):
    """Each camera's program counts from where it likes."""
    folders = {
        name: str(folder_of(tmp_path / name, [f"{start + number}.png" for number in range(5)]))
        for name, start in (("left", 0), ("right", 1000))
    }
    with open_capture(folders, Pace(fast=True)) as capture:
        seen = [[_number_of(picture) for picture in sample.pictures.values()] for sample in capture]
    assert seen == [[number] * 2 for number in range(5)]


def test_a_folder_that_grows_is_followed_until_it_stops(tmp_path: Path):
    folder = folder_of(tmp_path / "takes", ["0.png"])

    def grow() -> None:
        for number in (1, 2, 3):
            time.sleep(0.3)
            encoded = cv2.imencode(".png", numbered(number))[1].tobytes()
            with open(folder / f"{number}.png", "wb") as file:  # slowly, as some programs write
                file.write(encoded[:500])
                file.flush()
                time.sleep(0.1)
                file.write(encoded[500:])

    writer = threading.Thread(target=grow)
    writer.start()
    source = open_source(str(folder), Pace(fps=30))
    pictures = read_all(source)
    since_last_s = source.now_s() - pictures[-1].time_s
    writer.join()
    assert [picture.fault for picture in pictures] == [None] * 4
    assert [round((picture.pixels.mean() - 66) / 8) for picture in pictures] == [0, 1, 2, 3]
    # .4 s apart, less what a busy machine notices one late; by the rate it would be a thirtieth
    assert np.diff([picture.time_s for picture in pictures]).min() > 0.1, "when they came"
    assert since_last_s >= FOLLOWED_S


def test_a_file_that_is_no_picture_costs_no_more_than_itself(tmp_path: Path):
    folder = folder_of(tmp_path / "takes", ["0.png", "1.png", "2.png"])
    (folder / "1.png").write_bytes(b"no picture")
    with open_capture({"camera": str(folder)}, Pace(fast=True)) as capture:
        samples = list(capture)
    assert [sample.faults.get("camera") for sample in samples] == [None, CameraFault.UNREADABLE, None]
    assert [bool(sample.pictures) for sample in samples] == [True, False, True]


@pytest.mark.parametrize("first", [0, 1])
def test_pictures_of_16_bits_are_refused_and_not_called_black(first: int, tmp_path: Path):
    """Ten bits in sixteen, as cameras of headsets have them; at the start, or behind others."""
    folder = folder_of(tmp_path / "takes", ["0.png", "1.png", "2.png"])
    for number in range(first, 3):
        cv2.imwrite(str(folder / f"{number}.png"), numbered(number).astype(np.uint16) * 4)
    with (
        pytest.raises(CameraError, match=r"png has 16 bits a pixel, and 8 are read here; save"),
        open_capture({"camera": str(folder)}, Pace(fast=True)) as capture,
    ):
        list(capture)

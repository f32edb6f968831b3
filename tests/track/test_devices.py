"""``track devices``: every webcam with a picture, as text and as JSON."""

import json
import re
from pathlib import Path

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from tests.track.faces import film_of, seen
from tests.track.fake_webcams import FakeCapture
from track.cli import app
from track.errors import CameraError
from track.sources import open_source
from track.sources.devices import NO_PICTURE, look_at_webcams


@pytest.fixture
def webcams(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A system with a webcam that shows a face, and one that another program uses."""
    system = tmp_path / "video4linux"
    for number, name in ((0, "HD Webcam"), (4, "Mouth Tracker")):
        (system / f"video{number}").mkdir(parents=True)
        (system / f"video{number}" / "name").write_text(f"{name}\n")
    film = film_of(tmp_path / "face.avi", [seen()] * 10)
    monkeypatch.setattr(
        "track.sources.webcams.opened",
        lambda number, backend: cv2.VideoCapture(str(film)) if number == 0 else None,
    )
    monkeypatch.setattr("track.sources.devices.FOLDER", system)
    return system


def test_each_camera_has_its_picture_or_its_fault(webcams: Path, tmp_path: Path):
    first, second = look_at_webcams(tmp_path / "pictures", folder=webcams)
    assert (first.number, first.name, first.width, first.height, first.fault) == (
        0,
        "HD Webcam",
        320,
        240,
        None,
    )
    shown = cv2.imread(str(first.picture))
    assert np.abs(shown.astype(int) - seen()).mean() < 6
    assert (second.number, second.width, second.picture) == (4, None, None)
    assert second.fault == NO_PICTURE


def test_nothing_is_kept_unasked(webcams: Path, tmp_path: Path):
    before = set(tmp_path.rglob("*"))
    assert [each.picture for each in look_at_webcams(folder=webcams)] == [None, None]
    assert set(tmp_path.rglob("*")) == before


def test_a_program_reads_the_list(webcams: Path, tmp_path: Path):
    done = CliRunner().invoke(app, ["devices", "--json", "--pictures", str(tmp_path)])
    assert done.exit_code == 0
    records = json.loads(done.stdout)
    assert [record["name"] for record in records] == ["HD Webcam", "Mouth Tracker"]
    assert records[0]["picture"] == str(tmp_path / "camera-0.jpg")
    assert Path(records[0]["picture"]).is_file()


def test_a_person_reads_a_line_each(webcams: Path):
    done = CliRunner().invoke(app, ["devices"])
    lines = done.stdout.splitlines()
    assert re.fullmatch(r" 0  HD Webcam  320 x 240  \d+ a second", lines[0])
    assert lines[1:] == [f" 4  Mouth Tracker  {NO_PICTURE}"]


def test_the_rate_is_that_of_the_pictures_that_came(webcams: Path, monkeypatch: pytest.MonkeyPatch):
    """Whatever rate the driver tells of."""
    cameras = {0: FakeCapture(gap_s=0.05), 4: FakeCapture(fails=lambda number: number > 6)}
    monkeypatch.setattr("track.sources.webcams.opened", lambda number, _: cameras[number])
    first, second = look_at_webcams(folder=webcams)
    assert 5 < first.fps <= 20
    assert (second.width, second.fps) == (640, None)


def test_a_camera_s_name_is_text_alone(webcams: Path):
    """Whatever is plugged in says its name itself."""
    (webcams / "video0" / "name").write_text("HD \x1b]0;yours\x07Webcam", encoding="utf-8")
    done = CliRunner().invoke(app, ["devices"])
    assert "Webcam" in done.stdout
    assert not {"\x1b", "\x07"} & set(done.stdout)


def test_no_camera_is_said_in_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
):
    monkeypatch.setattr("track.sources.devices.FOLDER", tmp_path / "none")
    done = CliRunner().invoke(app, ["devices"])
    assert done.exit_code == 0
    assert done.stdout == ""
    assert "no camera that its system tells of" in done.stderr


def test_on_linux_a_camera_is_named_by_its_device_too(
    webcams: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Two cameras of one make have one name; the socket's path tells them apart."""
    by_path = {"/dev/v4l/by-path/usb-0:1:1.0-video-index0": "/dev/video0"}
    monkeypatch.setattr("track.sources.video_nodes.os.path.realpath", lambda path: by_path.get(path, path))
    for wanted in ("/dev/video0", *by_path):
        camera = open_source(wanted)
        try:
            assert camera.title == wanted
            assert camera.read().pixels.shape == (240, 320, 3)
        finally:
            camera.close()
    with pytest.raises(CameraError, match="there is no camera /dev/video4 here"):
        open_source("/dev/video4")

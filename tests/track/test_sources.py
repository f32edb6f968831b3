"""Every kind of source by what a person writes; the tests run over the table."""

import io
import re
import subprocess
import sys
import textwrap
import threading
import time
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.redaction import without_secrets
from regress.runtime.inputs import Fault
from tests.lying_film import lying_film
from tests.track.faces import film_of
from tests.track.mjpeg_server import MANNERS, MjpegServer, mjpeg_server
from tests.track.other_servers import SERVERS
from tests.track.pictures import folder_of, numbered, read_all
from tests.track.virtual import noise, told
from track.errors import CameraError
from track.sources import SOURCES, Pace, open_capture, open_source
from track.sources.addresses import SCHEMES, is_address, is_local
from track.sources.films import Film
from track.sources.lines import Lines
from track.sources.webcams import WebcamSource, list_webcams

LINE = " ".join(map(str, range(136)))


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("-", "lines"),
        ("http://10.0.0.7:81/stream", "address"),
        ("rtsp://camera.local/live", "address"),
        ("ftp://camera.local/live", "address"),
        ("FOLDER", "folder"),
        ("FOLDER/film.avi", "film"),
        ("0", "webcam"),
        ("HD Webcam", "webcam"),
        ("a\0b", "webcam"),
    ],
)
def test_what_is_written_finds_its_kind(text: str, kind: str, tmp_path: Path):
    (tmp_path / "film.avi").touch()
    text = text.replace("FOLDER", str(tmp_path))
    assert next(name for name, each in SOURCES.items() if each.matches(text)) == kind


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "a camera has no name; give - for lines"),
        ("97", "there is no camera 97"),
        ("no such thing", "there is no camera no such thing"),
        (
            "/dev/ttyACM0",
            "/dev/ttyACM0 is a serial port, and pictures of serial boards are not read; give the board",
        ),
        ("/dev/cu.usbserial-10", "is a serial port"),
        ("COM4", "COM4 is a serial port"),
        (
            "ftp://me:secret@camera.local/live",
            "ftp://camera.local/live is no camera's address; these begin with http",
        ),
        ("http://", "is no camera's address"),
        ("http://a:b:c/", "is no camera's address"),
        ("http://me:secret@127.0.0.1:9/stream?token=secret", "http://127.0.0.1:9/stream cannot be reached"),
        ("rtsp://me:secret@127.0.0.1:9/live", "rtsp://127.0.0.1:9/live cannot be reached"),
        ("FOLDER/empty", "holds no picture; files that end in .png"),
        ("FOLDER/text.mp4", "text.mp4 is no film that can be read"),
    ],
)
def test_what_cannot_be_opened_is_one_sentence(text: str, said: str, tmp_path: Path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "text.mp4").write_text("no film\n" * 100)
    with pytest.raises(CameraError) as refused:
        open_source(text.replace("FOLDER", str(tmp_path)))
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)
    assert "secret" not in str(refused.value)


def test_opencv_says_nothing_of_its_own(tmp_path: Path):
    (tmp_path / "text.mp4").write_text("no film\n" * 100)
    program = """
        import sys
        from track.errors import CameraError
        from track.sources import open_source

        for text in sys.argv[1:]:
            try:
                open_source(text)
            except CameraError:
                print("refused")
    """
    texts = [
        "97",
        "http://me:secret@127.0.0.1:9/stream",
        "rtsp://me:secret@127.0.0.1:9/live",
        tmp_path / "text.mp4",
    ]
    command = [sys.executable, "-c", textwrap.dedent(program), *map(str, texts)]
    # a process of its own: OpenCV asks once, when it first opens something, whether it may talk
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("refused\n" * 4, "")


_SIGNS = st.text(st.characters(codec="ascii", categories=["L", "N", "P", "S"]), max_size=8)


@given(
    scheme=st.sampled_from(SCHEMES),
    before=_SIGNS,
    behind=_SIGNS,
    ending=st.sampled_from(["", "/", "/a", "/a?b=c"]),
)
def test_no_title_holds_a_password(scheme: str, before: str, behind: str, ending: str):
    address = f"{scheme}://me:{before}secret{behind}@camera.local:8080{ending}"
    assert is_address(address)
    assert without_secrets(address) in (
        f"{scheme}://camera.local:8080{ending.partition('?')[0]}",
        f"{scheme}://…",
    )


@given(before=_SIGNS, behind=_SIGNS)
def test_nor_one_that_stands_behind_a_question_mark(before: str, behind: str):
    assert "secret" not in without_secrets(
        f"http://camera.local/live?user=me&password={before}secret{behind}"
    )


@pytest.mark.parametrize("manners", MANNERS)
def test_servers_of_any_manners_are_read(manners: str):
    with mjpeg_server(MjpegServer(picture=noise, manners=manners, fps=100)) as server:
        source = open_source(f"http://127.0.0.1:{server.port}/stream")
        pictures = [source.read() for _ in range(5)]
        source.close()
    assert all(picture.pixels.shape == (48, 64, 3) for picture in pictures)
    assert (np.diff([picture.time_s for picture in pictures]) >= 0).all()
    assert all(not np.array_equal(one.pixels, other.pixels) for one, other in pairwise(pictures))


def test_an_address_of_one_s_own_network_goes_through_no_proxy(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("http_proxy", "http://127.0.0.1:9")
    monkeypatch.setenv("no_proxy", "")
    with mjpeg_server(MjpegServer(picture=noise, fps=100)) as server:
        source = open_source(f"http://127.0.0.1:{server.port}/stream")
        assert source.read() is not None
        source.close()


@pytest.mark.parametrize(
    ("host", "local"),
    [
        ("192.168.0.20", True),
        ("10.0.0.7", True),
        ("127.0.0.1", True),
        ("169.254.3.4", True),
        ("fe80::1", True),
        ("esp32", True),
        ("esp32.local", True),
        ("8.8.8.8", False),
        ("camera.example.org", False),
    ],
)
def test_which_addresses_are_of_one_s_own_network(host: str, local: bool):
    assert is_local(host) is local


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the backend is Linux's")
@pytest.mark.parametrize(("number", "backend"), [(7, cv2.CAP_ANY), (100, cv2.CAP_V4L2), (142, cv2.CAP_V4L2)])
def test_the_hundreds_of_a_number_are_no_backend(monkeypatch: pytest.MonkeyPatch, number: int, backend: int):
    """OpenCV takes camera 142 for camera 42 of a backend 100."""
    asked = []
    monkeypatch.setattr("track.sources.webcams.opened", lambda *each: asked.append(each))
    with pytest.raises(CameraError):
        WebcamSource(str(number))
    assert asked == [(number, backend)]


def test_opencv_is_told_how_long_to_wait_before_it_loads():
    program = """
        import os, sys
        from track.__main__ import main

        sys.argv = ["track", "--version"]
        try:
            main()
        except SystemExit:
            pass
        assert "cv2" not in sys.modules
        assert os.environ["OPENCV_VIDEOIO_MSMF_ENABLE_HW_TRANSFORMS"] == "0"

        from track.sources import open_source
        try:
            open_source("97")
        except Exception:
            pass
        assert os.environ["OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT"] == "2"
    """
    subprocess.run([sys.executable, "-c", textwrap.dedent(program)], check=True, capture_output=True)


@pytest.mark.parametrize("make", SERVERS)
def test_servers_of_other_makes_are_read(make: str):
    with SERVERS[make]() as port:
        source = open_source(f"http://127.0.0.1:{port}/stream")
        pictures = [source.read() for _ in range(5)]
        source.close()
    assert all(picture.pixels.shape == (48, 64, 3) for picture in pictures)
    assert all(not np.array_equal(one.pixels, other.pixels) for one, other in pairwise(pictures))


def test_cameras_that_differ_behind_a_question_mark_have_profiles_of_their_own_and_tell_no_password():
    keys = set()
    with mjpeg_server(MjpegServer(picture=noise)) as server:
        address = f"http://127.0.0.1:{server.port}/stream"
        for query in ("", "?channel=1&password=secret", "?channel=2&password=secret"):
            with open_capture({"camera": f"{address}{query}"}) as capture:
                assert capture.titles == {"camera": address}
                keys.add(capture.keys["camera"])
            with open_capture({"eye": f"{address}{query}#left"}) as capture:
                keys.add(capture.keys["eye"])
    assert len(keys) == 6
    assert not re.search("secret|channel", " ".join(keys))
    assert {address, f"{address}#left"} < keys  # as they were called before


def test_a_server_that_stops_is_told_and_found_again():
    server, before = MjpegServer(picture=noise, password="secret"), threading.active_count()
    samples = []

    def read_until(wanted) -> None:
        until_s = time.monotonic() + 120
        while not samples or not wanted(samples[-1]):
            assert time.monotonic() < until_s
            samples.append(capture.read())

    with mjpeg_server(server):
        capture = open_capture({"camera": f"http://me:secret@127.0.0.1:{server.port}/stream"})
        assert capture.titles == {"camera": f"http://127.0.0.1:{server.port}/stream"}
        read_until(lambda sample: sample.pictures)
    read_until(lambda sample: sample.faults)
    server.stopped = False
    with mjpeg_server(server):
        read_until(lambda sample: sample.pictures)
        capture.close()
    assert told(samples) == ["camera: UNPLUGGED"]
    assert (np.diff([sample.time_s for sample in samples]) > 0).all()
    assert threading.active_count() == before


def test_a_wrong_password_is_refused():
    with mjpeg_server(MjpegServer(picture=noise, password="right")) as server:
        with pytest.raises(CameraError, match="wants another password"):
            open_source(f"http://me:wrong@127.0.0.1:{server.port}/stream")
        assert server.sent == 0


@pytest.mark.parametrize("fast", [True, False])
@pytest.mark.parametrize("kind", ["film", "folder"])
def test_what_is_kept_can_come_again_and_again_while_time_goes_on(kind: str, fast: bool, tmp_path: Path):
    """Five pictures come two and a half times, each a step behind the one before, and live at the clock's pace."""
    place = folder_of(tmp_path / "takes", [f"{number}.png" for number in range(5)])
    if kind == "film":
        place = film_of(
            tmp_path / "film.avi", [np.full((48, 64, 3), 40 * number, np.uint8) for number in range(5)]
        )
    source = open_source(str(place), Pace(fast=fast, fps=30, again=True))
    pictures = [source.read() for _ in range(13)]
    late_s = source.now_s() - pictures[-1].time_s
    source.close()
    levels = np.array([picture.pixels.mean() for picture in pictures])
    assert np.array_equal(levels[5:], levels[:-5])
    assert (np.diff(levels[:5]) > 5).all()
    steps = np.diff([picture.time_s for picture in pictures])
    if fast:
        assert steps == pytest.approx(np.full(12, 1 / 30), abs=1e-3)
    else:
        assert (steps > 0).all()
        assert pictures[-1].time_s >= 12 / 30 - 1e-3
        assert 0 <= late_s < 1


def test_a_film_is_turned_as_it_says(tmp_path: Path):
    upright = np.zeros((96, 64, 3), np.uint8)
    upright[:48] = 220
    source = open_source(str(lying_film(tmp_path / "phone.mp4", [upright] * 3)), Pace(fast=True))
    for picture in read_all(source):
        assert picture.pixels.shape == upright.shape
        assert np.abs(picture.pixels.astype(int) - upright).mean() < 10


def test_a_film_whose_next_picture_is_due_in_an_hour_can_be_stopped(tmp_path: Path, monkeypatch):
    film = Film(film_of(tmp_path / "film.avi", [noise(number) for number in range(2)]))
    assert film.read() is not None
    monkeypatch.setattr(film, "now_s", lambda: -3600.0)
    reading = threading.Thread(target=film.read, daemon=True)
    reading.start()
    film.stop()
    reading.join(60)
    assert not reading.is_alive()
    film.close()


def test_a_film_that_is_gone_does_not_come_again(tmp_path: Path):
    film = film_of(tmp_path / "film.avi", [numbered(number) for number in range(3)])
    source = open_source(str(film), Pace(fast=True, again=True))
    first = source.read()
    film.unlink()
    assert [first.pixels is None, *(picture.pixels is None for picture in read_all(source))] == [False] * 3


def test_lines_give_points_with_their_times():
    text = f"0.5 {LINE}\n1.0 {LINE}\n1.5 something else\n2.0\n2.5 {LINE}\n"
    frames = read_all(Lines(fps=30, fast=True, stream=io.StringIO(text)))
    assert [frame.time_s for frame in frames][:2] == [0.5, 1.0]
    assert len(frames) == 5
    assert [frame.fault for frame in frames][2] is Fault.UNREADABLE
    assert np.array_equal(frames[0].points.ravel(), np.arange(136))
    assert frames[0].pixels is None


def test_lines_without_times_have_those_of_their_coming_or_of_a_rate():
    text = f"{LINE}\n" * 3
    fast = read_all(Lines(fps=50, fast=True, stream=io.StringIO(text)))
    assert [frame.time_s for frame in fast] == [0.0, 0.02, 0.04]
    source = Lines(fps=50, stream=io.StringIO(text))
    source.read()
    before_s = source.now_s()
    second = source.read()
    assert before_s <= second.time_s <= source.now_s()


def test_webcams_are_listed_by_number_with_their_names(tmp_path: Path):
    for number, name in ((10, "Mouth"), (2, "HD Webcam: HD Webcam"), (3, "HD Webcam: IR")):
        (tmp_path / f"video{number}").mkdir()
        (tmp_path / f"video{number}" / "name").write_text(f"{name}\n")
    (tmp_path / "video-without-number").mkdir()
    webcams = list_webcams(tmp_path)
    assert [(webcam.number, webcam.name) for webcam in webcams] == [
        (2, "HD Webcam: HD Webcam"),
        (3, "HD Webcam: IR"),
        (10, "Mouth"),
    ]
    with pytest.raises(
        CameraError, match="several cameras: HD Webcam: HD Webcam, HD Webcam: IR; give more of one"
    ):
        WebcamSource("hd webcam", folder=tmp_path)
    with pytest.raises(CameraError, match=r"mouth gives no picture: another program may be using it"):
        WebcamSource("mouth", folder=tmp_path)
    with pytest.raises(
        CameraError, match=r"there is no camera nose, nor a file of this name; cameras here: 2 \(HD"
    ):
        WebcamSource("nose", folder=tmp_path)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the system's list is Linux's")
def test_elsewhere_numbers_are_tried(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    film = film_of(tmp_path / "0.avi", [noise(0)])
    tried = []

    def opened(number: int, backend: int) -> cv2.VideoCapture | None:
        tried.append(number)
        return cv2.VideoCapture(str(film)) if number == 1 else None

    monkeypatch.setattr("track.sources.webcams.opened", opened)
    monkeypatch.setattr("sys.platform", "win32")
    assert [(webcam.number, webcam.name) for webcam in list_webcams()] == [(1, "camera 1")]
    assert tried == list(range(8))


def test_elsewhere_than_on_linux_a_number_opens_that_camera_alone(monkeypatch: pytest.MonkeyPatch):
    """To list them all are opened: lamps go on, and a camera that another program uses is disturbed."""
    opened: list[int] = []
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setattr("track.sources.webcams.opened", lambda number, _: opened.append(number))
    with pytest.raises(CameraError, match="camera 3 gives no picture, or there is none of this number"):
        WebcamSource("3")
    assert opened == [3]


def test_all_of_track_reads_the_clock_of_the_pictures():
    """`Source.now_s` says why: two clocks would not agree, and the other one stands still on some Windows."""
    modules = sorted((Path(__file__).parents[2] / "track").rglob("*.py"))
    assert len(modules) > 50
    assert not [path.name for path in modules if "time.monotonic()" in path.read_text(encoding="utf-8")]

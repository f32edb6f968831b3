"""A webcam's mode: what may be written, what each backend is asked, and what is told of a camera that gives another."""

import math

import cv2
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.track.fake_webcams import FakeCapture
from track.errors import CameraError
from track.sources import open_capture, open_source
from track.sources.camera_memory import CameraMemory
from track.sources.camera_mode import CameraMode, ask_for, split_mode
from track.sources.picture_rate import MEASURED_S, SETTLING_S, RateWatch
from track.sources.webcams import WebcamSource

WHOLE = "size=400x400,fps=120,format=MJPG,exposure=5ms,gain=16"
MODES = st.builds(
    CameraMode,
    size=st.none() | st.tuples(st.integers(1, 4000), st.integers(1, 4000)),
    fps=st.none() | st.integers(1, 1000).map(float),
    format=st.none() | st.sampled_from(["MJPG", "YUYV", "GREY", "Y16 "]),
    exposure=st.none() | st.just("auto") | st.integers(1, 10_000).map(lambda ms: ms * 1e-3),
    gain=st.none() | st.integers(0, 255).map(float),
)


@pytest.fixture
def captures(monkeypatch: pytest.MonkeyPatch) -> dict[int, FakeCapture]:
    """Cameras by their numbers; each opening lets the last one go."""
    known: dict[int, FakeCapture] = {}

    def opened(number: int, _backend: int) -> FakeCapture | None:
        if number in known:
            known[number].reads, known[number].released = 0, False
        return known.get(number)

    monkeypatch.setattr("track.sources.webcams.opened", opened)
    return known


@given(st.sampled_from(["0", "HD Webcam, Inc.", "/dev/v4l/by-path/usb-0:1", "a=b"]), MODES)
def test_a_mode_that_is_written_is_the_one_that_is_read(camera: str, mode: CameraMode):
    keys = [key for key in ("size", "fps", "format", "exposure", "gain") if getattr(mode, key) is not None]
    found, read = split_mode(",".join([camera, *(mode.said(key) for key in keys)]))
    assert found == camera
    assert read.exposure == (
        mode.exposure if mode.exposure in (None, "auto") else pytest.approx(mode.exposure)
    )
    assert (read.size, read.fps, read.format, read.gain) == (mode.size, mode.fps, mode.format, mode.gain)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0,sise=400x400", "sise=400x400 is no setting of a camera; size, fps, format, exposure, gain are"),
        ("Eye,fps=30,sise=4x4", "sise=4x4 is no setting"),
        ("0,fps=30,fps=60", "fps=60 is the second fps"),
        ("0,size=400", "size=400 can be asked of no camera; give width and height"),
        ("0,size=0x400", "size=0x400 can be asked of no camera"),
        ("0,size=99999x99999", "can be asked of no camera"),
        ("0,fps=0", "fps=0 can be asked of no camera; give pictures a second from 1 to 1000"),
        ("0,fps=nan", "fps=nan can be asked of no camera"),
        ("0,fps=.", "can be asked of no camera"),
        ("0,format=MOTIONJPEG", "as in format=MJPG"),
        ("0,exposure=5", "as in exposure=5ms, or auto"),
        ("0,exposure=0ms", "can be asked of no camera"),
        ("0,gain=loud", "can be asked of no camera"),
        ("-,size=4x4", "- is no webcam, and webcams alone have a mode"),
        ("http://me:secret@10.0.0.7/a?b=1,fps=30", "http://10.0.0.7/a is no webcam"),
        ("FOLDER,fps=30", "is no webcam"),
        ("FOLDER/film.avi,fps=30", "is no webcam"),
        ("0#left,fps=30", "the half 'left' stands before the mode of camera 0; put it last: 0,fps=60#left"),
    ],
)
def test_what_is_no_mode_is_one_sentence(text: str, said: str, tmp_path):
    (tmp_path / "film.avi").touch()
    for opening in (open_source, lambda each: open_capture({"camera": each})):
        with pytest.raises(CameraError) as refused:
            opening(text.replace("FOLDER", str(tmp_path)))
        assert said in str(refused.value)
        assert "secret" not in str(refused.value)


@pytest.mark.parametrize("name", ["Webcam, Inc.", "a,b=c", "/dev/video0", "take,1"])
def test_commas_of_a_name_are_its_own(name: str):
    assert split_mode(name) == (name, CameraMode())


@pytest.mark.parametrize("password", ["a,gain=secret", "a,gain=1", "a,ss=secret,fps=no"])
def test_a_password_that_looks_like_a_mode_is_none(password: str):
    address = f"rtsp://me:{password}@camera.local/live"
    assert split_mode(address) == (address, CameraMode())
    assert split_mode(f"{address},fps=60") == (address, CameraMode(fps=60))


def test_a_file_whose_name_ends_like_a_mode_is_one(tmp_path):
    (tmp_path / "take,fps=30.mp4").touch()
    (tmp_path / "takes,fps=30").mkdir()
    for name, said in (("take,fps=30.mp4", "no film that can be read"), ("takes,fps=30", "holds no picture")):
        with pytest.raises(CameraError, match=said):
            open_source(str(tmp_path / name))


SIZE = [("FRAME_WIDTH", 400), ("FRAME_HEIGHT", 400)]
MJPG = ("FOURCC", cv2.VideoWriter.fourcc(*"MJPG"))


@pytest.mark.parametrize(
    ("backend", "asked"),
    [
        (
            "V4L2",
            [MJPG, *SIZE, ("FPS", 120), ("AUTO_EXPOSURE", 1), ("EXPOSURE", 50), ("GAIN", 16)],
        ),
        (
            "DSHOW",
            [("FPS", 120), MJPG, *SIZE, ("AUTO_EXPOSURE", 0), ("EXPOSURE", -8), ("GAIN", 16)],
        ),
        (
            "MSMF",
            [*SIZE, *SIZE, ("FPS", 120), ("AUTO_EXPOSURE", 0), ("EXPOSURE", -8), ("GAIN", 16)],
        ),
        ("AVFOUNDATION", SIZE),
    ],
)
def test_each_backend_is_asked_in_its_order_before_the_first_picture(
    captures: dict[int, FakeCapture], backend: str, asked: list[tuple[str, float]]
):
    captures[0] = FakeCapture(backend=backend)
    source = open_source(f"0,{WHOLE}")
    assert source.title == "camera 0"
    assert captures[0].asked == asked
    assert source.read().pixels.shape == (400, 400, 3)


@pytest.mark.parametrize(("backend", "value"), [("V4L2", 3), ("DSHOW", 1), ("MSMF", 1)])
def test_an_exposure_that_was_set_can_be_given_back(captures, backend: str, value: int):
    captures[0] = FakeCapture(backend=backend)
    open_source("0,exposure=auto")
    assert captures[0].asked == [("AUTO_EXPOSURE", value)]


@given(st.floats(1e-6, 10))
def test_an_exposure_is_the_nearest_that_a_system_counts(exposure_s: float):
    """Windows counts powers of two: the next one is at most half a step away; on Linux 100 us are the least."""
    for backend, seconds in (("DSHOW", lambda value: 2.0**value), ("V4L2", lambda value: value * 1e-4)):
        capture = FakeCapture(backend=backend)
        ask_for(CameraMode(exposure=exposure_s), capture)
        set_s = seconds(dict(capture.asked)["EXPOSURE"])
        assert abs(math.log2(set_s / max(exposure_s, 1e-4 if backend == "V4L2" else 0))) <= 0.6


def test_another_size_is_told_once_and_asked_again_at_each_opening(captures: dict[int, FakeCapture]):
    captures[0] = FakeCapture(sizes=(), refuses=("GAIN",))
    said: list[str] = []
    memory = CameraMemory(mode=split_mode(f"0,{WHOLE}")[1], say=said.append)
    for _ in range(3):
        captures[0].asked.clear()
        WebcamSource("0", memory=memory).close()
        assert len(captures[0].asked) == 7
    assert said == [
        "camera 0 does not take gain=16; it goes on without",
        "camera 0 gives 640x480 where 400x400 was asked; ask for a size that it has, which may need another format",
    ]


def test_a_camera_that_gives_what_was_asked_is_not_spoken_of(captures: dict[int, FakeCapture]):
    captures[0] = FakeCapture()
    said: list[str] = []
    open_source(f"0,{WHOLE}", say=said.append)
    assert said == []


@given(st.floats(5, 240), st.integers(0, 400))
def test_a_rate_is_measured_once_and_a_pause_of_the_machine_does_not_count(fps: float, pause_at: int):
    watch = RateWatch()
    measured = [watch.step(number / fps + 0.4 * (number > pause_at)) for number in range(int(4 * fps))]
    told = [each for each in measured if each is not None]
    assert told == [pytest.approx(fps)]
    assert measured.index(told[0]) / fps <= SETTLING_S + MEASURED_S + 3 / fps


@pytest.mark.parametrize(("gives_fps", "told"), [(30, True), (95, True), (97, False), (120, False)])
def test_a_rate_below_four_fifths_is_told_once(
    captures: dict[int, FakeCapture], monkeypatch: pytest.MonkeyPatch, gives_fps: int, told: bool
):
    captures[0] = FakeCapture()
    said: list[str] = []
    source = open_source("0,fps=120", say=said.append)
    monkeypatch.setattr("track.sources.webcams.time.perf_counter", lambda: captures[0].reads / gives_fps)
    for _ in range(5 * gives_fps):
        source.read()
    assert [line.startswith(f"camera 0 gives {gives_fps} pictures a second where 120") for line in said] == [
        True
    ] * told


def test_halves_of_one_camera_have_one_mode(captures: dict[int, FakeCapture]):
    captures[0] = FakeCapture(gap_s=0.01)
    with open_capture({"left_eye": "0,size=400x400#left", "right_eye": "0#right"}) as capture:
        assert set(capture.titles.values()) == {"camera 0#left", "camera 0#right"}
        sample = capture.read(within_s=5)
        assert {each.shape[:2] for each in sample.pictures.values()} == {(400, 200)}
    assert captures[0].asked == SIZE


@pytest.mark.parametrize("other", ["0,fps=60#right", "00,size=640x480#right", "/dev/video0,size=640x480"])
def test_one_camera_in_two_modes_is_refused(captures: dict[int, FakeCapture], other: str):
    captures[0] = FakeCapture()
    with pytest.raises(CameraError, match=r"left_eye and right_eye ask for camera 0 in two modes"):
        open_capture({"left_eye": "0,size=400x400#left", "right_eye": other})
    assert captures[0].asked == []

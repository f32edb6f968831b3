"""A webcam that comes back is the same one, whatever its number, and a picture that is lost is no unplugging."""

import shutil
from pathlib import Path

import pytest

from tests.track.fake_webcams import FakeCapture
from track.errors import CameraError
from track.sources.camera_memory import CameraMemory
from track.sources.webcams import AGAIN_S, OPENING_S, WebcamSource


class Bus:
    """A system's list of cameras, and what OpenCV opens by their numbers."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.sockets, self.cameras = folder / "video4linux", folder / "devices", {}
        self.folder.mkdir()

    def plug(
        self, number: int, socket: str, name: str, *, index: int = 0, sees: int = 640, serial: str = ""
    ) -> None:
        node = self.folder / f"video{number}"
        node.mkdir()
        (self.sockets / socket).mkdir(parents=True, exist_ok=True)
        (node / "device").symlink_to(self.sockets / socket)
        if serial:
            (self.sockets / socket).parent.joinpath("serial").write_text(f"{serial}\n")
        (node / "name").write_text(f"{name}\n")
        (node / "index").write_text(f"{index}\n")
        self.cameras[number] = FakeCapture(size=(sees, 480))

    def unplug(self, *numbers: int) -> None:
        for number in numbers:
            shutil.rmtree(self.folder / f"video{number}")
            del self.cameras[number]

    def width(self, wanted: str, memory: CameraMemory) -> int:
        """Which camera is opened: each has pictures of another width."""
        source = WebcamSource(wanted, folder=self.folder, memory=memory)
        try:
            return source.read().pixels.shape[1]
        finally:
            source.close()
            self.cameras = {
                number: FakeCapture(size=each.size, fails=each.fails) for number, each in self.cameras.items()
            }


@pytest.fixture
def bus(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Bus:
    bus = Bus(tmp_path)
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr("track.sources.webcams.opened", lambda number, _: bus.cameras.get(number))
    monkeypatch.setattr("track.sources.webcams.OPENING_S", 0.05)
    return bus


@pytest.mark.parametrize("wanted", ["0", "/dev/video0"])
def test_another_camera_at_the_same_number_is_refused_and_the_same_one_found_at_another(
    bus: Bus, wanted: str
):
    said: list[str] = []
    memory = CameraMemory(say=said.append)
    bus.plug(0, "usb1/1-2", "Left Eye", sees=320)
    bus.plug(2, "usb1/1-3", "Mouth", sees=640)
    assert bus.width(wanted, memory) == 320
    bus.unplug(0, 2)
    with pytest.raises(CameraError):
        bus.width(wanted, memory)
    assert said == []  # it is away, and nothing is in its place
    bus.plug(0, "usb1/1-3", "Mouth", sees=640)
    for _ in range(3):
        with pytest.raises(CameraError):
            bus.width(wanted, memory)
    (sentence,) = said
    assert "was 'Left Eye', and another camera or another socket has its place now; plug it in" in sentence
    bus.plug(4, "usb1/1-2", "Left Eye", sees=320)
    assert bus.width(wanted, memory) == 320


def test_two_cameras_of_one_make_are_told_apart_by_their_sockets(bus: Bus):
    memory = CameraMemory()
    bus.plug(0, "usb1/1-2", "Eye", sees=320)
    bus.plug(2, "usb1/1-3", "Eye", sees=640)
    assert bus.width("2", memory) == 640
    bus.unplug(0, 2)
    bus.plug(0, "usb1/1-3", "Eye", sees=640)
    bus.plug(2, "usb1/1-2", "Eye", sees=320)
    assert bus.width("2", memory) == 640


@pytest.mark.parametrize("wanted", ["0", "Eye"])
def test_a_camera_that_comes_back_on_another_bus_is_known_by_its_serial_number(bus: Bus, wanted: str):
    memory = CameraMemory()
    bus.plug(0, "usb2/2-1/2-1:1.0", "Eye", sees=320, serial="A1")
    assert bus.width(wanted, memory) == 320
    bus.unplug(0)
    bus.plug(0, "usb1/1-7/1-7:1.0", "Eye", sees=640, serial="A2")
    bus.plug(2, "usb1/1-1/1-1:1.0", "Eye", sees=320, serial="A1")
    assert bus.width(wanted, memory) == 320
    bus.unplug(2)
    with pytest.raises(CameraError):
        bus.width("0", memory)


def test_a_serial_number_that_all_cameras_of_a_make_have_tells_nothing(bus: Bus):
    memory = CameraMemory()
    bus.plug(0, "usb1/1-1/1-1:1.0", "Eye", sees=320, serial="01.00.00")
    bus.plug(2, "usb1/1-2/1-2:1.0", "Eye", sees=640, serial="01.00.00")
    assert bus.width("0", memory) == 320
    bus.unplug(0)
    with pytest.raises(CameraError):
        bus.width("0", memory)


def test_nodes_of_one_camera_are_told_apart(bus: Bus):
    memory = CameraMemory()
    bus.plug(0, "usb1/1-2", "Eye", index=0, sees=320)
    bus.plug(1, "usb1/1-2", "Eye", index=1, sees=640)
    assert bus.width("1", memory) == 640
    bus.unplug(0, 1)
    bus.plug(3, "usb1/1-2", "Eye", index=0, sees=320)
    bus.plug(4, "usb1/1-2", "Eye", index=1, sees=640)
    assert bus.width("1", memory) == 640


def test_a_name_follows_its_only_camera_to_another_socket_and_not_one_of_two(bus: Bus):
    alone, one_of_two = CameraMemory(), CameraMemory()
    bus.plug(0, "usb1/1-2", "Eye", sees=320)
    assert bus.width("eye", alone) == 320
    bus.unplug(0)
    bus.plug(2, "usb1/1-7", "Eye", sees=320)
    assert bus.width("eye", alone) == 320
    bus.plug(4, "usb1/1-8", "Eye", sees=640)
    assert bus.width("eye", one_of_two) == 320
    bus.unplug(2)
    with pytest.raises(CameraError):
        bus.width("eye", one_of_two)


def test_cameras_that_a_program_makes_are_opened_by_their_number(bus: Bus):
    memory = CameraMemory()
    bus.plug(7, "none", "Virtual", sees=320)
    (bus.folder / "video7" / "device").unlink()
    assert [bus.width("7", memory) for _ in range(2)] == [320, 320]


def test_elsewhere_what_is_not_known_is_told_once(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setattr("track.sources.webcams.opened", lambda *_: FakeCapture())
    said: list[str] = []
    memory = CameraMemory(say=said.append)
    for _ in range(3):
        WebcamSource("1", memory=memory)
    (sentence,) = said
    assert "camera 1 is back by its number, and this system does not tell whether it is the same" in sentence


def test_pictures_that_are_lost_are_no_unplugging(monkeypatch: pytest.MonkeyPatch):
    capture = FakeCapture(fails=lambda number: number in (3, 4, 5, 9))
    monkeypatch.setattr("track.sources.webcams.opened", lambda *_: capture)
    source = WebcamSource("0")
    assert all(source.read() is not None for _ in range(10))
    assert capture.reads == 14


@pytest.mark.parametrize("platform", ["linux", "win32"])
def test_a_camera_may_take_seconds_to_its_first_picture_and_one_that_is_mute_is_let_go(
    monkeypatch: pytest.MonkeyPatch, platform: str
):
    clock_s = [0.0]

    def sleep(pause_s: float) -> None:
        clock_s[0] += pause_s

    slow = FakeCapture(fails=lambda _: clock_s[0] < OPENING_S - 0.1)
    mute = FakeCapture(fails=lambda _: True)
    gone = FakeCapture(fails=lambda number: number > 1)
    cameras = {0: slow, 1: mute, 2: gone}
    monkeypatch.setattr("sys.platform", platform)
    monkeypatch.setattr("track.sources.webcams.opened", lambda number, _: cameras[number])
    monkeypatch.setattr("track.sources.webcams.time.perf_counter", lambda: clock_s[0])
    monkeypatch.setattr("track.sources.webcams.time.sleep", sleep)
    assert WebcamSource("0").read() is not None
    clock_s[0] = 0.0
    with pytest.raises(CameraError):
        WebcamSource("1")
    assert mute.released
    assert OPENING_S <= clock_s[0] < OPENING_S + 0.1
    source = WebcamSource("2")
    source.read()
    clock_s[0] = 0.0
    assert source.read() is None
    assert AGAIN_S <= clock_s[0] < AGAIN_S + 0.1
    source.stop()
    clock_s[0] = 0.0
    assert source.read() is None
    assert clock_s[0] == 0.0

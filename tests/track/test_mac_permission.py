"""On macOS the first start waits for a person's permission, and a camera that was unplugged asks for another start."""

import pytest

from track.errors import CameraError
from track.sources.camera_memory import CameraMemory
from track.sources.mac_permission import PERMISSION_S, opened_with_permission
from track.sources.webcams import WebcamSource


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """A clock that sleeping moves, on macOS."""
    now_s = [0.0]
    monkeypatch.setattr("sys.platform", "darwin")
    monkeypatch.setattr("track.sources.mac_permission.time.perf_counter", lambda: now_s[0])
    monkeypatch.setattr(
        "track.sources.mac_permission.time.sleep", lambda pause_s: now_s.append(now_s.pop() + pause_s)
    )
    return now_s


@pytest.mark.parametrize("answered_s", [0.0, 5.0, PERMISSION_S - 1, None])
def test_the_first_start_waits_for_an_answer(clock: list[float], answered_s: float | None):
    said: list[str] = []
    memory = CameraMemory(say=said.append)
    came = opened_with_permission(
        lambda: answered_s is not None and clock[0] >= answered_s, "camera 0", memory
    )
    assert came is (answered_s is not None)
    assert clock[0] == (PERMISSION_S if answered_s is None else answered_s)
    assert len(said) == (answered_s != 0.0)
    assert all("System Settings > Privacy & Security > Camera" in line for line in said)


def test_nobody_waits_who_only_looks_which_cameras_there_are(clock: list[float]):
    assert not opened_with_permission(lambda: False, "camera 0", CameraMemory())
    assert clock == [0.0]


def test_a_camera_that_was_unplugged_asks_for_another_start_once(clock: list[float]):
    said: list[str] = []
    memory = CameraMemory(say=said.append, opened=True)
    for _ in range(3):
        assert not opened_with_permission(lambda: False, "camera 0", memory)
    assert said == [
        "camera 0 went away, and macOS gives it to new programs alone; end track and start it again"
    ]
    assert clock == [0.0]


def test_the_refusal_names_the_settings(clock: list[float], monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("track.sources.webcams.opened", lambda *_: None)
    with pytest.raises(
        CameraError, match=r"macOS must allow the camera in System Settings > Privacy & Security"
    ):
        WebcamSource("0", memory=CameraMemory(say=lambda _: None))

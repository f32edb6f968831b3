"""Threads of cameras: the newest picture, rising times, faults told once, and cameras that come back by themselves."""

import threading
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.sample import Sample
from tests.track.faces import film_of
from tests.track.virtual import Switches, VirtualCamera, noise, told
from track.errors import CameraError, InputError
from track.session.pipeline import sentences_of
from track.sources import CameraFault, Capture, Pace, Picture, open_capture
from track.sources.backlog import LONGEST_S
from track.sources.camera import PAUSES_S, SILENT_S, RisingClock
from track.sources.capture import LATE_S
from track.sources.faults import PictureWatch
from track.sources.webcams import WebcamSource

PAUSES = (0.05, 0.1, 0.2)

LONG_WAIT_S = 0.2
"""For other cameras, where a machine wakes threads late that has other work."""


@pytest.fixture(autouse=True)
def _no_thread_stays() -> Iterator[None]:
    before = set(threading.enumerate())
    yield
    assert set(threading.enumerate()) <= before


def _capture(**cameras: Switches) -> Capture:
    openers = {name: lambda switches=switches: VirtualCamera(switches) for name, switches in cameras.items()}
    return Capture(openers, pauses_s=PAUSES)


def _until(capture: Capture, wanted: Callable[[Sample], bool], *, within_s: float = 120.0) -> list[Sample]:
    """Samples up to the first wanted one."""
    samples, until_s = [], time.monotonic() + within_s
    while time.monotonic() < until_s:
        samples.append(capture.read())
        if wanted(samples[-1]):
            return samples
    raise AssertionError(f"did not come; the last samples have {[each.faults for each in samples[-3:]]}")


def _for(capture: Capture, seconds: float) -> list[Sample]:
    """Samples of a little more than this time."""
    samples = [capture.read()]
    while samples[-1].time_s < samples[0].time_s + seconds + 0.1:
        samples.append(capture.read())
    return samples


def _well(sample: Sample) -> bool:
    return bool(sample.pictures) and not sample.faults


def _rises(samples: list[Sample]) -> bool:
    return bool((np.diff([sample.time_s for sample in samples]) > 0).all())


def test_a_slow_reader_gets_the_newest_picture_and_its_own_time():
    switches = Switches(fps=100)
    with _capture(eye=switches) as capture:
        assert capture.endless
        behind, numbers = [], []
        for _ in range(6):
            # for longer than pictures wait in line, however slow the machine is
            before_s, given = time.monotonic(), switches.given
            while switches.given < given + 10 or time.monotonic() < before_s + 2 * LONGEST_S:
                time.sleep(0.01)
            given = switches.given
            sample = capture.read()
            of = range(switches.given, 0, -1)
            numbers.append(
                next(number for number in of if np.array_equal(sample.pictures["eye"], noise(number)))
            )
            behind.append(given - numbers[-1])
    assert max(behind) <= 1, "the newest one that has been kept"
    assert min(np.diff(numbers)) >= 3, "those between were let go"


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True, width=64), min_size=1, max_size=50))
def test_times_rise_whatever_the_driver_says(times: list[float]):
    clock = RisingClock()
    made = [clock.step(time_s)[0] for time_s in times]
    assert np.isfinite(made).all()
    assert (np.diff(made) > 0).all()


@given(st.lists(st.floats(0.001, 1.0), min_size=2, max_size=20), st.integers(1, 19), st.floats(1.0, 1e4))
def test_a_clock_that_was_set_back_costs_one_fault(steps: list[float], at: int, back_s: float):
    times = np.cumsum(steps)
    times[at:] -= back_s + 20
    clock = RisingClock()
    made, faults = zip(*(clock.step(time_s) for time_s in times), strict=True)
    assert sum(faults) == (at < len(times))
    later = np.diff(made)[at:]
    assert np.allclose(later, np.diff(times)[at:], atol=1e-6), (
        "behind it, pictures are as far apart as before"
    )


def test_the_pauses_between_tries_double():
    assert PAUSES_S[0] == 0.5
    assert PAUSES_S[-1] == 8.0
    assert all(later == 2 * sooner for sooner, later in pairwise(PAUSES_S))


def test_an_unplugged_camera_is_told_once_tried_with_growing_pauses_and_comes_back():
    switches = Switches()
    with _capture(eye=switches) as capture:
        samples = _until(capture, _well)
        switches.plugged = False
        samples += _until(capture, lambda sample: sample.faults.get("eye") is CameraFault.UNPLUGGED)
        samples += _until(capture, lambda _: len(switches.tries_s) >= 5)
        switches.plugged = True
        samples += _until(capture, _well)
    assert _rises(samples)
    pauses = np.diff(switches.tries_s[1:])
    assert len(pauses) >= 3
    assert pauses[0] >= PAUSES[1]
    assert (pauses[1:] >= PAUSES[2]).all()
    assert told(samples) == ["eye: UNPLUGGED"]


def test_a_camera_that_opens_and_gives_nothing_is_tried_ever_less_often():
    class Empty(VirtualCamera):
        def read(self):
            return None

    switches = Switches()
    with Capture({"eye": lambda: Empty(switches)}, pauses_s=PAUSES) as capture:
        samples = _until(capture, lambda _: len(switches.tries_s) >= 5)
    assert all(sample.pictures == {} for sample in samples)
    gaps = np.diff(switches.tries_s)
    assert gaps[0] >= PAUSES[0]
    assert gaps[1] >= PAUSES[1]
    assert (gaps[2:] >= PAUSES[2]).all()


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"frozen": True}, CameraFault.FROZEN),
        ({"dark": True}, CameraFault.BLACK),
        ({"silent": True}, CameraFault.SILENT),
    ],
)
def test_what_a_camera_does_wrong_is_told_once_and_its_pictures_do_not_count(
    change: dict, fault: CameraFault
):
    switches = Switches()
    with _capture(eye=switches) as capture:
        samples = _until(capture, _well)
        vars(switches).update(change)
        samples += _until(capture, lambda sample: sample.faults == {"eye": fault})
        wrong = [capture.read() for _ in range(3)]
        vars(switches).update(dict.fromkeys(change, False))
        samples += wrong + _until(capture, _well)
    assert all(sample.pictures == {} and sample.faults == {"eye": fault} for sample in wrong)
    assert _rises(samples)
    assert told(samples) == [f"eye: {fault.name}"]


@pytest.mark.parametrize("dark_s", [0.3, 0.9])
def test_a_camera_that_wakes_in_the_dark_is_told_only_where_it_stays_dark(dark_s: float):
    """Its first pictures are black while the shutter opens; none of them counts, and each time that it is opened."""
    watch, times_s = PictureWatch(moving=True), np.arange(60) / 30
    faults = [
        watch.step(Picture(time_s=time_s, pixels=noise(row) * np.uint8(time_s > dark_s)))
        for row, time_s in enumerate(times_s)
    ]
    for time_s, fault in zip(times_s, faults, strict=True):
        assert fault is (
            None if time_s > dark_s else CameraFault.BLACK if time_s > 0.5 + 1e-9 else CameraFault.WAKING
        )
    assert watch.step(Picture(time_s=3.0, pixels=noise(0) * np.uint8(0))) is CameraFault.BLACK
    assert list(sentences_of({"eye": CameraFault.WAKING, "mouth": CameraFault.BLACK})) == ["mouth"]


def test_a_camera_that_comes_back_in_the_dark_wakes_again():
    switches = Switches()
    with _capture(eye=switches) as capture:
        _until(capture, _well)
        switches.plugged = False
        _until(capture, lambda sample: sample.faults.get("eye") is CameraFault.UNPLUGGED)
        switches.dark = switches.plugged = True
        samples = _until(capture, lambda sample: sample.faults.get("eye") is CameraFault.WAKING)
        switches.dark = False
        samples += _until(capture, _well)
    assert not any(sample.pictures for sample in samples[:-1])


def test_a_camera_that_stops_is_called_silent_after_its_time():
    switches = Switches()
    with _capture(eye=switches) as capture:
        _until(capture, _well)
        switches.silent, since_s = True, time.monotonic()
        _until(capture, lambda sample: "eye" in sample.faults)
        took_s = time.monotonic() - since_s
        switches.silent = False
    assert took_s > SILENT_S - 0.1


def test_light_that_jumps_is_no_fault():
    switches = Switches()
    with _capture(eye=switches) as capture:
        samples = _until(capture, _well)
        for light in (1.6, 0.4, 1.0):
            switches.light = light
            for _ in range(5):  # with pictures: a busy machine has moments without
                samples += _until(capture, lambda sample: bool(sample.pictures))
    assert not any(sample.faults for sample in samples)


def test_a_clock_that_goes_back_spoils_no_picture():
    switches = Switches()
    with _capture(eye=switches) as capture:
        samples = _until(capture, _well)
        switches.clock_s = -100.0
        samples += _until(capture, lambda sample: bool(sample.faults))
        spoilt = samples[-1]
        for _ in range(10):
            samples += _until(capture, _well)
    assert _rises(samples)
    assert "eye" in spoilt.pictures
    assert told(samples) == ["eye: DISORDER"]


def test_several_cameras_make_one_sample_a_moment(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("track.sources.capture.WAIT_S", LONG_WAIT_S)
    switches = {name: Switches(fps=20) for name in ("left", "right", "mouth")}
    with _capture(**switches) as capture:
        samples = _until(capture, lambda sample: len(sample.pictures) == 3)
        samples += [capture.read() for _ in range(20)]
    whole = [sample for sample in samples[-20:] if len(sample.pictures) == 3 and not sample.faults]
    assert len(whole) >= 15, "a busy machine may wake a thread too late now and then"
    assert _rises(samples)
    assert np.median(np.diff([sample.time_s for sample in whole])) > 0.5 / 20


def test_a_camera_that_lags_is_left_out_and_told_once():
    switches = {"left": Switches(fps=100), "mouth": Switches()}
    with _capture(**switches) as capture:
        _until(capture, lambda sample: len(sample.pictures) == 2)
        switches["mouth"].fps = 4
        samples = _until(capture, lambda sample: sample.faults.get("mouth") is CameraFault.LATE)
        assert set(samples[-1].pictures) == {"left"}
        given = switches["left"].given
        later = _for(capture, 1.0)
        assert len(later) > (switches["left"].given - given) / 4, (
            "not held up by the slow one, which gives four"
        )
        samples += later
        switches["mouth"].fps = 60
        samples += _until(capture, lambda sample: len(sample.pictures) == 2 and not sample.faults)
    # a busy machine holds up the quick one as well: then, and only then, it may be told
    held_up = np.diff([*switches["left"].given_s, time.monotonic()]).max() > LATE_S
    assert told(samples) == ["mouth: LATE"] or (
        held_up and set(told(samples)) == {"mouth: LATE", "left: LATE"}
    )


def test_a_camera_alone_is_never_later_than_others():
    """A film on a busy machine stays behind the time that goes on while it is silent."""
    switches = Switches()
    with _capture(film=switches) as capture:
        samples = _until(capture, _well)
        switches.silent = True
        samples += _until(capture, lambda sample: sample.faults.get("film") is CameraFault.SILENT)
        switches.clock_s, switches.silent = -0.5, False
        samples += _until(capture, _well)
    assert _rises(samples)
    assert told(samples) == ["film: SILENT"]


def test_one_unplugged_camera_does_not_hold_up_the_others(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("track.sources.capture.WAIT_S", LONG_WAIT_S)
    switches = {"left": Switches(fps=20), "mouth": Switches(fps=20)}
    with _capture(**switches) as capture:
        _until(capture, lambda sample: len(sample.pictures) == 2)
        switches["mouth"].plugged = False
        _until(capture, lambda sample: sample.faults.get("mouth") is CameraFault.UNPLUGGED)
        ages = _ages(capture, 20)
    assert np.median(ages) < 0.8 * LONG_WAIT_S, "nobody waits for the one that is away"


def _ages(capture: Capture, count: int) -> list[float]:
    """How old the left camera's pictures are that are read next; no other's are there."""
    ages: list[float] = []
    while len(ages) < count:
        sample = capture.read()
        assert "mouth" not in sample.pictures
        if sample.pictures:  # a busy machine has moments without
            ages.append(capture.now_s() - sample.time_s)
    return ages


def test_cameras_that_were_exchanged_are_found_by_their_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    films = {}
    for number, level in ((0, 80), (1, 160)):  # what is seen from each socket
        films[number] = film_of(tmp_path / f"{number}.mp4", [np.full((48, 64, 3), level, np.uint8)])
    system = tmp_path / "video4linux"
    _name(system, {0: "Left Eye", 1: "Mouth"})
    opened = _films_for_cameras(films)
    monkeypatch.setattr("track.sources.webcams.opened", opened)

    def level(name: str) -> int:
        camera = WebcamSource(name, folder=system)
        try:
            return int(camera.read().pixels.mean())
        finally:
            camera.close()

    assert level("left eye") == pytest.approx(80, abs=3)
    _name(system, {0: "Mouth", 1: "Left Eye"})
    assert level("left eye") == pytest.approx(160, abs=3)


def _name(system: Path, names: dict[int, str]) -> None:
    for number, name in names.items():
        (system / f"video{number}").mkdir(parents=True, exist_ok=True)
        (system / f"video{number}" / "name").write_text(name + "\n")


def _films_for_cameras(films: dict[int, Path]):
    import cv2

    def opened(place: int, backend: int):
        return cv2.VideoCapture(str(films[place]), cv2.CAP_FFMPEG) if place in films else None

    return opened


def test_films_that_wait_lose_no_picture_and_are_paired_by_their_times(tmp_path: Path):
    pictures = [np.full((48, 64, 3), 60 + 9 * number, np.uint8) for number in range(20)]
    films = {name: str(film_of(tmp_path / f"{name}.avi", pictures, fps=25)) for name in ("left", "right")}
    with open_capture(films, Pace(fast=True)) as capture:
        samples = []
        for sample in capture:
            time.sleep(0.002)
            samples.append(sample)
    assert len(samples) == 20
    for sample, picture in zip(samples, pictures, strict=True):
        assert not sample.faults
        for pixels in sample.pictures.values():
            assert abs(pixels.mean() - picture.mean()) < 4, "the codec is off by 3, the next frame by 9"
    assert [sample.time_s for sample in samples] == pytest.approx(np.arange(20) / 25)


def test_a_black_stretch_of_a_film_keeps_its_frames(tmp_path: Path):
    pictures = [np.full((48, 64, 3), 0 if 5 <= number < 9 else 120, np.uint8) for number in range(15)]
    path = str(film_of(tmp_path / "film.avi", pictures))
    with open_capture({"camera": path}, Pace(fast=True)) as capture:
        samples = list(capture)
    assert [bool(sample.pictures) for sample in samples] == [
        number not in range(5, 9) for number in range(15)
    ]
    assert {sample.faults.get("camera") for sample in samples[5:9]} == {CameraFault.BLACK}


def test_a_film_has_its_own_pace(tmp_path: Path):
    path = str(film_of(tmp_path / "film.avi", [noise(number) for number in range(12)], fps=30))
    since_s = time.monotonic()
    with open_capture({"camera": path}) as capture:
        samples = list(capture)
    assert time.monotonic() - since_s >= 11 / 30
    assert _rises(samples)
    assert samples[-1].time_s == pytest.approx(11 / 30, abs=0.01)


def test_a_second_camera_that_cannot_be_opened_lets_the_first_one_go():
    left = VirtualCamera(Switches())
    with pytest.raises(CameraError, match="not plugged in"):
        Capture({"left": lambda: left, "right": lambda: VirtualCamera(Switches(plugged=False))})
    assert left.closed


def test_what_is_wrong_with_lines_comes_out_of_the_thread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    path = tmp_path / "lines.txt"
    path.write_text("this is no point\n")
    with open(path) as stream:
        monkeypatch.setattr("sys.stdin", stream)
        with (
            open_capture({"camera": "-"}, Pace(fast=True)) as capture,
            pytest.raises(InputError, match="not a number"),
        ):
            list(capture)


@pytest.fixture
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Waits for a slow camera longer than a busy machine holds it up."""
    monkeypatch.setattr("track.sources.capture.EMPTY_AFTER_STEPS", 4.0)


@pytest.mark.usefixtures("patient")
def test_between_pictures_of_a_slow_camera_nothing_comes_and_its_end_is_told_still():
    """Two a second, as an ESP32's board gives: an empty sample between each two took the face away."""
    switches = Switches(fps=2)
    with _capture(camera=switches) as capture:
        _until(capture, _well)
        _until(capture, _well)
        samples = _for(capture, 2.0)
        switches.silent = True
        _until(capture, lambda sample: not sample.pictures)
    assert all(sample.pictures for sample in samples)


@pytest.mark.usefixtures("patient")
def test_a_slow_film_is_known_from_its_first_picture_on(tmp_path: Path):
    path = str(film_of(tmp_path / "slow.avi", [noise(number) for number in range(3)], fps=2))
    with open_capture({"camera": path}, Pace()) as capture:
        assert [bool(sample.pictures) for sample in capture] == [True, True, True]

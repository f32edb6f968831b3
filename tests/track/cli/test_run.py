"""`track run` from the words on the command line to the recording, on the sample of a headset."""

import contextlib
import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from tests.track.session.faces import SAMPLES, frames, new_session
from track.cli import main
from track.cli.opening import Wishes, open_pipeline
from track.cli.running import RunOptions, _open_page, ended_by_signals, run_session
from track.errors import InputError
from track.messages import Command
from track.page import Page
from track.session.session import Session

pytestmark = pytest.mark.slow

CAMERAS = [
    word
    for name in ("left_eye", "right_eye", "mouth")
    for word in ("--camera", f"{name}={SAMPLES / 'headset' / name}")
]


@pytest.mark.parametrize(
    ("host", "where"), [("127.0.0.1", "stay on this machine"), ("0.0.0.0", "who has this link")]
)
def test_it_is_told_where_pictures_go(host, where):
    said: list[str] = []
    with contextlib.ExitStack() as closing:
        options = RunOptions(host=host, browser=False)
        _open_page(options, new_session(), {"camera": "0"}, said.append, closing)
    assert where in said[0]


def rows(path) -> list[dict[str, str]]:
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def wait_until_idle(running: subprocess.Popen) -> None:
    """Wait until a process hardly works for two seconds on end: it waits for something, however busy the machine is."""
    process = psutil.Process(running.pid)
    until_s = time.monotonic() + 180
    while time.monotonic() < until_s:
        before_s = sum(process.cpu_times()[:2])
        time.sleep(2)
        if sum(process.cpu_times()[:2]) - before_s < 0.05:
            return
    pytest.fail("the process does not come to rest")


@pytest.fixture
def home(tmp_path, monkeypatch):
    for name in ("XDG_CONFIG_HOME", "HOME", "APPDATA", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_film_moves_a_face_into_a_table(home, capsys, monkeypatch):
    """No command is `run`; the answers are those of every frame, and the summary says how it went."""
    words = [*CAMERAS, "--fast", "--no-page", "--record", "take.csv", "--json", "--filter", "none"]
    monkeypatch.setattr(sys, "argv", ["track", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    told = capsys.readouterr()
    assert ended.value.code == 0
    summary = json.loads(told.out)
    assert summary["frames"] == summary["faces"] == 100
    assert summary["faults"] == {}
    assert "calibrate" in told.err
    table = rows("take.csv")
    assert len(table) == 100
    assert max(float(row["jawOpen"]) for row in table) > 0.2


def test_several_recordings_are_all_written_and_one_that_is_replaced_is_told(home, capsys, monkeypatch):
    Path("take.csv").write_text("the former one")
    words = [*CAMERAS, "--fast", "--no-page", "--record", "take.csv", "--record", "take.vrma"]
    monkeypatch.setattr(sys, "argv", ["track", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    told = capsys.readouterr().err.splitlines()
    assert ended.value.code == 0
    assert told[:2] == [
        "sending csv to take.csv, in place of the file that is there",
        "sending vrma to take.vrma",
    ]
    assert len(rows("take.csv")) == 100
    assert Path("take.vrma").read_bytes().startswith(b"glTF")


def test_a_detector_is_closed_where_the_rest_cannot_be_opened(monkeypatch):
    closed = []
    monkeypatch.setattr("track.detectors.points.PointsDetector.close", lambda self: closed.append(self))
    with pytest.raises(InputError, match="no filter 'smooth'"):
        open_pipeline(Wishes(cameras=("-",), filter_name="smooth"), {"camera": "-"}, pytest.fail)
    assert len(closed) == 1


def test_recordings_of_a_start_that_was_stopped_leave_nothing(home, monkeypatch):
    held = []

    def interrupted(wishes, texts, sinks, *_, **__):
        held.extend(sinks)  # or the garbage collector would clean up
        raise KeyboardInterrupt

    monkeypatch.setattr("track.cli.running.open_session", interrupted)
    options = RunOptions(record=[Path("a.csv"), Path("b.glb")], page=False)
    with pytest.raises(KeyboardInterrupt):
        run_session(Wishes(cameras=("take.mp4",)), options, lambda said: None)
    assert len(held) == 2
    assert [path.name for path in home.iterdir() if "part" in path.name] == []


def test_a_film_that_is_over_takes_the_page_along_and_says_so(home, capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["track", *CAMERAS, "--fast", "--no-browser", "--port", "0"])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 0
    assert "left_eye, right_eye and mouth are over, and so is the page; --loop" in capsys.readouterr().err


def test_a_film_that_is_read_fast_shows_how_far_and_how_it_went(home, capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["track", *CAMERAS, "--fast", "--fps", "25", "--no-page"])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 0
    *_, progress, end = capsys.readouterr().err.splitlines()
    assert progress.startswith("left_eye, right_eye, mouth: 4 of 4 s, ")
    assert end == "100 frames, a face in 100"


@pytest.mark.parametrize("looped", [True, False])
def test_a_loop_ends_by_the_clock_alone(looped, home, capsys, monkeypatch):
    """Five pictures are over at once when read fast; the same ones again and again are not."""
    words = ["--fast", "--no-page", "--json", "--seconds", "3", *(["--loop"] if looped else [])]
    for name in ("left_eye", "right_eye", "mouth"):
        (home / name).mkdir()
        for picture in sorted((SAMPLES / "headset" / name).iterdir())[:5]:
            shutil.copy(picture, home / name)
        words += ["--camera", f"{name}={home / name}"]
    monkeypatch.setattr(sys, "argv", ["track", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    told = capsys.readouterr()
    assert ended.value.code == 0
    assert (json.loads(told.out)["frames"] > 5) is looped
    assert "over" not in told.err


def test_a_retargeted_table_has_the_other_names(home, capsys, monkeypatch):
    words = [*CAMERAS, "--fast", "--no-page", "--record", "take.csv", "--retarget", "vrm1"]
    monkeypatch.setattr(sys, "argv", ["track", "run", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 0
    assert "aa" in rows("take.csv")[0]
    assert "jawOpen" not in rows("take.csv")[0]


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no such signals to one process")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP], ids=["Ctrl-C", "a closed window"])
def test_a_stop_ends_it_and_the_recording_is_whole(home, number: int):
    words = [*CAMERAS, "--loop", "--no-page", "--record", "take.csv"]
    before = signal.signal(number, signal.SIG_DFL)  # a child of tests under nohup would ignore it as they do
    try:
        running = subprocess.Popen([sys.executable, "-m", "track", *words], stderr=subprocess.PIPE, text=True)
    finally:
        signal.signal(number, before)
    until_s = time.monotonic() + 180
    while not any(part.stat().st_size for part in home.glob(".part-*/*.csv")) and time.monotonic() < until_s:
        time.sleep(0.05)
    running.send_signal(number)
    _, told = running.communicate(timeout=180)
    assert running.returncode == 0, told
    assert "Traceback" not in told
    table = rows(home / "take.csv")
    assert table
    assert all(len(row) == len(table[0]) for row in table)
    assert list(home.glob(".part-*")) == []


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGHUP")
def test_what_nohup_ignores_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with ended_by_signals(None, None):
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
            assert signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no SIGINT to one process")
def test_ctrl_c_ends_a_wait_for_the_next_line(home):
    words = ["--camera", "-", "--fast", "--no-page", "--record", "take.csv", "--filter", "none"]
    running = subprocess.Popen(
        [sys.executable, "-m", "track", *words], stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    running.stdin.writelines(
        " ".join(f"{value:.2f}" for value in sample.points.ravel()) + "\n" for sample in frames(0, 40)
    )
    running.stdin.flush()
    until_s = time.monotonic() + 180
    while not list(home.glob(".part-*")) and time.monotonic() < until_s:
        time.sleep(0.1)
    wait_until_idle(running)
    running.send_signal(signal.SIGINT)
    try:
        running.wait(timeout=180)
    finally:
        running.kill()
        told = running.stderr.read()
        running.stdin.close()
        running.stderr.close()
    assert running.returncode == 0, told
    assert "Traceback" not in told
    assert len(rows(home / "take.csv")) == 40


def calibrated(faces: str, *, seconds: float) -> subprocess.CompletedProcess:
    """`track calibrate` by lines of points: the sample's resting face, over and over."""
    rest = [" ".join(f"{value:.2f}" for value in sample.points.ravel()) for sample in frames(0, 60)]
    lines = [f"{number / 30:.4f} {rest[number % 60]}\n" for number in range(round(30 * seconds))]
    words = ["calibrate", faces, "--camera", "-", "--fast"]
    return subprocess.run(
        [sys.executable, "-m", "track", *words],
        input="".join(lines),
        capture_output=True,
        text=True,
        timeout=600,
    )


def test_who_calibrates_is_not_told_to_and_learns_where_it_is_kept(home):
    ended = calibrated("neutral", seconds=8)
    *steps, done, kept = ended.stderr.splitlines()
    assert ended.returncode == 0, ended.stderr
    assert [step.split(": ")[1] for step in steps] == ["countdown", "recording", "done"]
    assert done == "calibration: done"
    assert Path(kept.removeprefix("kept in ")).is_file()


@pytest.mark.parametrize(
    ("seconds", "found"), [(4, "nothing was found before it"), (8, "neutral found before it stays")]
)
def test_pictures_that_end_too_soon_leave_what_was_found(seconds, found, home):
    ended = calibrated("all", seconds=seconds)
    assert ended.returncode == 2
    assert ended.stderr.endswith(f"track: the pictures ended before calibration did; {found}\n")


def test_who_stops_a_calibration_is_not_told_that_the_pictures_ended(home, capsys, monkeypatch):
    run = Session.run

    def stopped(session, capture, screen, **options):
        publish = screen.publish

        def stop_later(moment):
            publish(moment)
            if moment.sample.time_s > 1:
                signal.raise_signal(signal.SIGINT)

        screen.publish = stop_later
        return run(session, capture, screen, **options)

    monkeypatch.setattr(Session, "run", stopped)
    monkeypatch.setattr(sys, "argv", ["track", "calibrate", *CAMERAS, "--fast", "--loop"])
    with pytest.raises(SystemExit) as ended:
        main()
    told = capsys.readouterr().err
    assert ended.value.code == 75
    assert "calibration was stopped; nothing was found before it" in told
    assert "pictures ended" not in told


def test_the_page_stays_until_recordings_are_written(home, monkeypatch):
    there = []
    close = Page.close
    monkeypatch.setattr(Page, "close", lambda page: (there.append(Path("take.csv").is_file()), close(page)))
    wishes = Wishes(cameras=CAMERAS[1::2], fast=True)
    run_session(wishes, RunOptions(record=[Path("take.csv")], browser=False, seconds=1.0), lambda line: None)
    assert there == [True]


def test_a_profile_that_cannot_be_kept_ends_no_session_but_calibration(home, capsys, monkeypatch):
    (home / "file").write_text("no folder")
    for name in ("XDG_CONFIG_HOME", "HOME", "APPDATA", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(home / "file"))
    ask = Session.run

    def run(session, *arguments, **options):
        session.ask(Command(verb="mirror", value=True))
        return ask(session, *arguments, **options)

    monkeypatch.setattr(Session, "run", run)
    ended, told_last = {}, {}
    for command, options in {
        "run": ["--fast", "--no-page", "--record", "take.csv"],
        "compare": ["--truth", "livelink:0", "--seconds", "8"],
        "calibrate": ["--fast"],
    }.items():
        monkeypatch.setattr(sys, "argv", ["track", command, *CAMERAS, *options])
        with pytest.raises(SystemExit) as end:
            main()
        ended[command] = end.value.code
        told = capsys.readouterr().err
        assert "internal error" not in told
        assert told.count("cannot be written") == 1, told
        told_last[command] = told.splitlines()[-1]
    assert ended == {"run": 0, "compare": 2, "calibrate": 74}
    assert "phone" in told_last["compare"], "it went on to its end, at which no phone had said anything"
    assert len(rows("take.csv")) == 100

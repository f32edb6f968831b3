"""How a run ends: by Ctrl-C with whole recordings, and with those that can be written where one cannot."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from facegen.errors import OutputError
from facegen.formats.gltf_container import open_glb
from regress.runtime.inputs import read_frames
from tests.track.session.faces import frames, new_session
from tests.track.sinks.receivers import receiver
from track.sinks.targets import open_sink, parse_target

ROOT = Path(__file__).resolve().parents[3]


@pytest.mark.skipif(sys.platform == "win32", reason="sends a signal")
def test_ctrl_c_leaves_whole_recordings(tmp_path: Path):
    points = read_frames(ROOT / "docs" / "samples" / "talking-face.csv").points[:60]
    lines = [" ".join(f"{value:.3f}" for value in face.ravel()) + "\n" for face in np.round(points, 3)]
    names = {"csv": "a.csv", "livelink-csv": "b.csv", "gltf": "c.glb", "vrma": "d.vrma"}
    with receiver() as taken:
        words = ["run", "--camera", "-", "--no-page", "--profile", tmp_path / "me.toml", "--to"]
        words.append(f"vmc:127.0.0.1:{taken.getsockname()[1]}")
        for name, file in names.items():
            words += ["--to", f"{name}:{tmp_path / file}"]
        run = subprocess.Popen(
            [sys.executable, "-m", "track", *map(str, words)],
            **{"stdin": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "cwd": ROOT},
        )
        taken.settimeout(0.01)
        came = 0
        started = time.monotonic()
        while came < 20 and time.monotonic() - started < 180:  # frames until answers have come
            run.stdin.write(lines[came % len(lines)])
            run.stdin.flush()
            try:
                came += bool(taken.recv(2000))
            except TimeoutError:
                continue
    assert sorted(path.name for path in tmp_path.iterdir() if path.is_file()) == []
    run.send_signal(signal.SIGINT)
    run.stdin.write(lines[0])
    _, said = run.communicate(timeout=180)
    assert run.returncode == 0, said
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names.values())
    rows = (tmp_path / "a.csv").read_text().splitlines()
    assert len(rows) == len((tmp_path / "b.csv").read_text().splitlines()) > 6
    for file in ("c.glb", "d.vrma"):
        document, _ = open_glb(tmp_path / file)
        clock = document["animations"][-1]["samplers"][0]["input"]
        assert document["accessors"][clock]["count"] <= len(rows) - 1


def on_a_small_disk(tmp_path: Path, *words: str, count: int = 60) -> subprocess.CompletedProcess:
    """`track` over so many faces, where no file gets larger than 10,000 bytes."""
    import resource

    faces = read_frames(ROOT / "docs" / "samples" / "talking-face.csv").points[:count]
    return subprocess.run(
        [sys.executable, "-m", "track", "--camera", "-", "--fast", "--no-page", *words],
        input="".join(" ".join(f"{value:.3f}" for value in face.ravel()) + "\n" for face in faces),
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000)),
        env={**os.environ, "PYTHONPATH": str(ROOT), "XDG_CONFIG_HOME": str(tmp_path / "none")},
        **{"capture_output": True, "text": True, "cwd": tmp_path, "check": False},
    )


@pytest.mark.skipif(sys.platform == "win32", reason="makes a small disk of a limit")
@pytest.mark.parametrize("name", ["csv", "livelink-csv"])
def test_a_table_on_a_full_disk_keeps_its_whole_rows_and_all_else_goes_on(name: str, tmp_path: Path):
    with receiver() as taken:
        to_others = f"vmc:127.0.0.1:{taken.getsockname()[1]}"
        run = on_a_small_disk(tmp_path, "--to", f"{name}:a.csv", "--to", to_others)
    assert run.returncode == 74, run.stderr
    assert f"{name} to a.csv ends here, and the rest goes on: a.csv: " in run.stderr
    assert f"recorded {name} to a.csv\n" in run.stderr
    assert "60 frames, " in run.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]
    text = (tmp_path / "a.csv").read_text()
    assert 8_000 < len(text) <= 10_000
    assert text.endswith("\n")
    assert len({line.count(",") for line in text.splitlines()}) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="makes a small disk of a limit")
def test_a_take_on_a_full_disk_is_left_as_numbers_where_nothing_else_fits(tmp_path: Path):
    run = on_a_small_disk(tmp_path, "--to", "vrma:a.vrma")
    assert run.returncode == 74, run.stderr
    assert "; the recorded weights are in a-weights." in run.stderr
    (left,) = tmp_path.glob("a-weights.*")
    assert left.stat().st_size == 10_000 // (63 * 8) * (63 * 8)
    assert np.isfinite(np.fromfile(left, "<f8").reshape(-1, 63)[:, :53]).all()


@pytest.mark.skipif(sys.platform == "win32", reason="makes a small disk of a limit")
def test_a_run_whose_only_recording_has_ended_ends(tmp_path: Path):
    run = on_a_small_disk(tmp_path, "--record", "a.csv", count=200)
    assert run.returncode == 74, run.stderr
    assert "200 frames" not in run.stderr
    assert run.stderr.splitlines()[-1].startswith("track: a.csv: ")


@pytest.mark.parametrize("order", [1, -1])
def test_a_recording_that_cannot_be_written_takes_no_other_along(order: int, tmp_path: Path):
    session, places = new_session(), ["a.csv", "b.csv"]
    session.sinks[:] = [
        open_sink(parse_target(f"csv:{tmp_path / name}"), pytest.fail) for name in places[::order]
    ]
    for sample in frames(0, 3):
        session.answer(sample)
    (tmp_path / "a.csv").mkdir()
    (tmp_path / "a.csv" / "full").touch()  # somebody put a folder there meanwhile
    with pytest.raises(OutputError):
        session.close()
    assert len((tmp_path / "b.csv").read_text().splitlines()) == 4


def test_a_sink_that_cannot_be_opened_leaves_nothing_of_the_others(tmp_path: Path):
    words = ["run", "--camera", "-", "--no-page", "--profile", tmp_path / "me.toml"]
    words += [
        "--to",
        f"csv:{tmp_path / 'a.csv'}",
        "--to",
        f"vrma:{tmp_path / 'b.vrma'}",
        "--to",
        "vmc:nobody.invalid",
    ]
    run = subprocess.run(
        [sys.executable, "-m", "track", *map(str, words)],
        **{"stdin": subprocess.DEVNULL, "capture_output": True, "text": True, "cwd": ROOT, "check": False},
    )
    assert run.returncode == 2
    assert "host 'nobody.invalid' is not known" in run.stderr
    assert list(tmp_path.iterdir()) == []

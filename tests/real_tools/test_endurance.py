"""Datasets made in spite of everything: random kills, a full disk, two supervisors on one folder."""

import os
import random
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.real_tools.farms import (
    ROOT,
    attempts,
    children_of,
    facegen,
    files_of,
    no_leftovers,
    outcomes,
    processes_with,
    rendered,
    wait_for,
    write_spec,
)

pytestmark = [pytest.mark.blender, pytest.mark.slow, pytest.mark.usefixtures("anny")]

KILLS = 20


def start(spec: Path, out: Path, *arguments: str) -> subprocess.Popen:
    command = [
        sys.executable,
        "-m",
        "facegen",
        "generate",
        str(spec),
        "--out",
        str(out),
        "--workers",
        "2",
        *arguments,
    ]
    temporary = spec.parent / "temporary"
    temporary.mkdir(exist_ok=True)
    environ = os.environ | {"TMPDIR": str(temporary)}
    quiet = subprocess.DEVNULL
    return subprocess.Popen(command, cwd=ROOT, env=environ, stdout=quiet, stderr=quiet)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> tuple[Path, dict[str, bytes]]:
    """The spec, and all files of an undisturbed run of its 60 samples."""
    folder = tmp_path_factory.mktemp("undisturbed")
    spec = write_spec(folder)
    facegen("generate", spec, "--out", folder / "out", "--workers", 2)
    files = files_of(folder / "out")
    assert len([name for name in files if name.endswith("sample.json")]) == 60
    return spec, files


def check_same(found: dict[str, bytes], wanted: dict[str, bytes]) -> None:
    """Every byte is the same."""
    assert found.keys() == wanted.keys()
    assert [name for name in wanted if found[name] != wanted[name]] == []


def test_twenty_random_kills_change_nothing_and_leave_nothing(tmp_path, undisturbed):
    spec, files = undisturbed
    # a pause as long as a sample takes, so that as few of the 60 are done by the last kill on a fast machine
    pace_s = statistics.median(attempt["seconds"] for attempt in attempts(spec.parent / "out"))
    out, rng, kills = tmp_path / "out", random.Random(8), {"supervisor": 0, "worker": 0}
    process = start(spec, out)
    while sum(kills.values()) < KILLS and process.poll() is None:
        # in the middle of work, not of starting: one more thing is there, and the next is begun
        count = len(outcomes(out))
        while len(outcomes(out)) < count + 1 and process.poll() is None:
            time.sleep(pace_s / 20)
        time.sleep(rng.uniform(0.0, 1.2 * pace_s))
        workers = children_of(process.pid)
        if workers and rng.random() < 0.65:
            os.kill(rng.choice(workers), signal.SIGKILL)
            kills["worker"] += 1
        else:
            process.kill()
            process.wait()
            kills["supervisor"] += 1
            process = start(spec, out)
    process.wait(timeout=1200)
    # a sample that was hit three times is in quarantine, as it should be
    facegen("generate", spec, "--out", out, "--workers", 2, "--retry-quarantined")
    assert sum(kills.values()) == KILLS
    assert min(kills.values()) >= 4, kills
    check_same(files_of(out), files)
    assert no_leftovers(out)
    assert list((spec.parent / "temporary").iterdir()) == []
    assert not processes_with(str(out))


def test_two_supervisors_on_one_folder_do_no_harm(tmp_path, undisturbed):
    spec, files = undisturbed
    out = tmp_path / "out"
    both = [start(spec, out, "--samples", "0-9") for _ in range(2)]
    assert [process.wait(timeout=1200) for process in both] == [0, 0]
    wanted = {name for name in files if not name.startswith("renders")} | {
        name for name in files if name.startswith("renders") and int(name.split("/")[2]) < 10
    }
    check_same(files_of(out), {name: files[name] for name in wanted})
    assert set(outcomes(out)) == {"done"}
    assert no_leftovers(out)


def test_a_full_disk_stops_the_run_and_loses_nothing(tmp_path, undisturbed):
    spec, files = undisturbed
    disk = tmp_path / "disk"
    disk.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", str(disk)], capture_output=True
    )
    if mounted.returncode:
        pytest.skip("a small file system cannot be mounted here (that takes root)")
    try:
        out, ballast = disk / "out", disk / "ballast"
        ballast.write_bytes(b"x" * 2_500_000)
        process = start(spec, out, "--samples", "0-14")
        assert process.wait(timeout=1200) == 74
        made = rendered(out)
        assert 0 < len(made) < 15
        assert no_leftovers(out)
        assert not (out / "quarantine").exists()
        assert "failed" not in outcomes(out)
        # to the last byte: even a folder cannot be made
        free = os.statvfs(disk)
        with (disk / "brim").open("wb", buffering=0) as brim:
            while True:
                try:
                    brim.write(b"x" * min(4096, max(free.f_bsize, 1)))
                except OSError:
                    break
        assert facegen("generate", spec, "--out", out, "--samples", "0-14", code=74) == ""
        assert rendered(out) == made
        ballast.unlink()
        (disk / "brim").unlink()
        facegen("generate", spec, "--out", out, "--samples", "0-14")
        assert rendered(out) == list(range(15))
        found = files_of(out)
        check_same(found, {name: files[name] for name in found})
        assert no_leftovers(out)
    finally:
        wait_for(lambda: not processes_with(str(disk)), what="no process on the small disk")
        subprocess.run(["umount", str(disk)], check=True)


def test_a_read_only_folder_is_said_to_be_one(tmp_path, undisturbed):
    spec, _ = undisturbed
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "tmpfs", str(disk)], capture_output=True).returncode:
        pytest.skip("a file system cannot be mounted here (that takes root)")
    try:
        facegen("generate", spec, "--out", disk / "out", "--shards", "0")
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        facegen(
            "generate", spec, "--out", disk / "out", "--shards", "0"
        )  # nothing is missing, nothing is written
        command = [sys.executable, "-m", "facegen", "generate", spec, "--out", disk / "out", "--samples", "0"]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        assert (done.returncode, "Read-only file system" in done.stderr) == (74, True), done.stderr
    finally:
        subprocess.run(["umount", str(disk)], check=True)

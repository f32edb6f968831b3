"""Half-made things go when their maker is dead, and never while it lives."""

import os
import subprocess
import sys
import time

from facegen.machine import is_alive, machine_name
from facegen.store import DatasetFolder, staging, sweep


def leftover(folder: DatasetFolder, name: str, *, age_s: float = 0.0):
    path = folder.path / "tmp" / name
    path.mkdir(parents=True)
    (path / "half.png").write_bytes(b"half")
    os.utime(path, (time.time() - age_s,) * 2)
    return path


def test_only_the_dead_and_the_old_are_swept(tmp_path):
    folder = DatasetFolder(tmp_path)
    dead = subprocess.Popen([sys.executable, "-c", "pass"])
    dead.wait()
    now = time.time_ns()
    gone = [
        leftover(folder, f"sample-1-{machine_name()}-{dead.pid}-{now}"),
        leftover(
            folder, f"sample-2-{machine_name()}-{os.getpid()}-{now - 10**15}"
        ),  # an earlier process of that number
        leftover(folder, f"sample-3-node7.0123abcd-17-{now}", age_s=90_000),
        leftover(folder, "no-name-of-ours", age_s=90_000),
    ]
    kept = [
        leftover(folder, f"sample-4-{machine_name()}-{os.getpid()}-{now}"),
        leftover(folder, f"sample-5-node7.0123abcd-17-{now}"),
    ]
    with staging(folder, "sample-6") as stage:
        assert sweep(folder) == len(gone)
        assert sorted((tmp_path / "tmp").iterdir()) == sorted([*kept, stage])


def test_a_zombie_is_dead(tmp_path):
    process = subprocess.Popen([sys.executable, "-c", "pass"])
    deadline = time.monotonic() + 10
    while is_alive(process.pid) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not is_alive(process.pid)
    process.wait()
    assert is_alive(os.getpid(), since_ns=time.time_ns())

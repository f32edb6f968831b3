"""Half-made things go when their maker is dead, and never while it lives."""

import os
import subprocess
import sys
import time

import pytest

from facegen.machine import is_alive, machine_name
from facegen.store import DatasetFolder, commit_file, commit_folder, staging, sweep


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


def test_a_stage_outlives_that_an_equal_run_removes_the_empty_folder_around_it(tmp_path, monkeypatch):
    folder, mkdir = DatasetFolder(tmp_path), os.mkdir

    def removed_once_made(path, mode=0o777):
        mkdir(path, mode)
        if os.path.basename(path) == "tmp":
            monkeypatch.setattr(os, "mkdir", mkdir)
            os.rmdir(path)

    monkeypatch.setattr(os, "mkdir", removed_once_made)
    with staging(folder, "begin") as stage:
        assert stage.is_dir()


def test_a_zombie_is_dead(tmp_path):
    process = subprocess.Popen([sys.executable, "-c", "pass"])
    deadline = time.monotonic() + 10
    while is_alive(process.pid) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not is_alive(process.pid)
    process.wait()
    assert is_alive(os.getpid(), since_ns=time.time_ns())


@pytest.mark.parametrize(("name", "commit"), [("rename", commit_folder), ("replace", commit_file)])
def test_a_rename_whose_answer_is_lost_is_done_and_one_that_is_refused_is_not(
    tmp_path, monkeypatch, name, commit
):
    rename, out = getattr(os, name), tmp_path / "out"

    def done(source, target):
        rename(source, target)
        raise FileNotFoundError("the answer")

    def swept(source, target):
        rename(source, tmp_path / "elsewhere")
        raise FileNotFoundError("the source")

    def refused(source, target):
        raise OSError("the server")

    for answer in (done, swept, refused):
        made, there = tmp_path / answer.__name__, out / answer.__name__
        made.mkdir() if commit is commit_folder else made.write_bytes(b"whole")
        monkeypatch.setattr(os, name, answer)
        if answer is done:
            assert commit(made, there) is not False
            assert there.exists()
            continue
        there.mkdir()
        with pytest.raises(OSError, match=r"the (source|server)"):
            commit(made, there)

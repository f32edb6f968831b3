"""A file's name never stands for half of it, and the system's refusal is one sentence."""

import errno
import os
import shutil
import signal
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from facegen.errors import InputError, OutputError
from facegen.files import output_errors, refuse_ending, staging, swap_folders, sync, whole_file, write_whole


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = write_whole(tmp_path / "face.json", "old\n")

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError, match=r"face\.json: no space left"):
        write_whole(path, "new, and half of it\n")
    assert path.read_bytes() == b"old\n"
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_no_system_flushes_is_no_obstacle_and_a_file_is(tmp_path, monkeypatch):
    path = write_whole(tmp_path / "face.json", "old\n")

    def unknown(_):
        raise OSError(errno.EINVAL, "Invalid argument")

    monkeypatch.setattr(os, "fsync", unknown)
    sync(tmp_path)
    with pytest.raises(OSError, match="Invalid argument"):
        sync(path)


def test_a_name_ends_as_what_is_written_does(tmp_path):
    there = write_whole(tmp_path / "face.csv", "old\n")
    for out in (there, tmp_path / "none.csv", tmp_path / "face", Path("a" * 5000)):
        with pytest.raises(InputError, match=r"an avatar ends with \.glb or \.vrm: name such a file"):
            refuse_ending(out, ".glb", ".vrm", what="an avatar")
    for out in (tmp_path / "face.GLB", tmp_path / "face.vrm", tmp_path, Path(os.devnull)):
        refuse_ending(out, ".glb", ".vrm", what="an avatar")


def test_an_interrupted_writer_leaves_the_old_file(tmp_path):
    path = write_whole(tmp_path / "face.json", b"old\n")

    def interrupted() -> None:
        with whole_file(path) as part:
            assert part.suffix == ".json"
            part.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert path.read_bytes() == b"old\n"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(("module", "name"), [(Path, "mkdir"), (shutil, "rmtree")])
def test_a_stage_goes_whole_where_a_stop_falls_into_its_making_or_removal(
    tmp_path, monkeypatch, module, name
):
    slow, stops = getattr(module, name), [KeyboardInterrupt]

    def stopped(path, *arguments, **named):
        if name == "mkdir" or not stops:
            slow(path, *arguments, **named)
        if stops:
            raise stops.pop()

    monkeypatch.setattr(module, name, stopped)
    with pytest.raises(KeyboardInterrupt), staging(tmp_path, "stage") as stage:
        (stage / "half").touch()
    assert not list(tmp_path.iterdir())


def test_a_folder_is_no_place_for_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for path in (Path("."), Path("/"), tmp_path):
        with pytest.raises(OutputError, match="is a folder; name the file to write"):
            write_whole(path, "new\n")
        with pytest.raises(InputError, match="is a folder; name the file"), whole_file(path):
            pass
    assert not list(tmp_path.iterdir())


def test_the_systems_reason_is_in_the_sentence(tmp_path):
    with pytest.raises(OutputError, match=r"a: cannot be written \(No such file or directory\)"):
        write_whole(write_whole(tmp_path / "file", "") / "a", "new\n")
    with pytest.raises(OutputError, match=r"a: there is no folder .*none; make it, or name another$"):
        write_whole(tmp_path / "none" / "a", "new\n")
    with pytest.raises(OutputError, match=r"b: cannot be written \(odd\)"), output_errors(Path("b")):
        raise OSError("odd")


def test_a_pipe_takes_the_bytes_and_stays(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    link = tmp_path / "link"
    link.symlink_to("pipe")
    for path in (pipe, link):
        arrived: list[bytes] = []
        reader = threading.Thread(target=lambda arrived=arrived: arrived.append(pipe.read_bytes()))
        reader.start()
        write_whole(path, b"new\n" * 100_000)
        reader.join()
        assert arrived == [b"new\n" * 100_000]
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert sorted(tmp_path.iterdir()) == [link, pipe]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can lose a device")
def test_a_device_takes_the_bytes_and_stays(tmp_path):
    device = tmp_path / "null"
    os.mknod(device, 0o666 | stat.S_IFCHR, os.makedev(1, 3))
    try:
        device.read_bytes()
    except PermissionError:
        pytest.skip("this file system takes no devices")
    write_whole(device, "new\n")
    with whole_file(device, suffix=".png") as part:
        assert part.suffix == ".png"
        part.write_bytes(b"picture")
    assert stat.S_ISCHR(device.stat().st_mode)
    assert list(tmp_path.iterdir()) == [device]


def test_a_full_device_is_told():
    with pytest.raises(OutputError, match="/dev/full: no space left"):
        write_whole(Path("/dev/full"), "new\n")


@pytest.mark.parametrize("name", ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "link"])
def test_an_open_handle_is_written_where_it_stands(tmp_path, name):
    if name == "link":
        name = str(tmp_path / "link")
        os.symlink("/dev/stdout", name)
    program = f"""
from pathlib import Path
from facegen.files import write_whole
print("before", flush=True)
write_whole(Path({name!r}), "whole\\n")
print("after")
"""
    log = tmp_path / "log"
    log.write_text("old\n")
    with open(log, "a") as appended:
        subprocess.run([sys.executable, "-c", program], stdout=appended, check=True)
    assert log.read_text() == "old\nbefore\nwhole\nafter\n"
    piped = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert piped.stdout == "before\nwhole\nafter\n"


def test_links_stay_links_and_their_files_are_replaced(tmp_path):
    (tmp_path / "there").mkdir()
    real = tmp_path / "there" / "face.json"
    link, second = tmp_path / "link.json", tmp_path / "second.json"
    link.symlink_to("there/face.json")
    second.symlink_to(link)
    for text in ("made through a dangling link\n", "replaced\n"):
        write_whole(second, text)
        assert (link.is_symlink(), second.is_symlink(), real.is_symlink()) == (True, True, False)
        assert real.read_text() == text
    assert list((tmp_path / "there").iterdir()) == [real]
    link.unlink()
    link.symlink_to("second.json")
    with pytest.raises(OutputError, match=r"second\.json: cannot be written"):
        write_whole(second, "round and round\n")


def test_a_files_mode_stays_and_a_new_one_is_everybodys_own(tmp_path):
    path = tmp_path / "face.json"
    for mode in (0o600, 0o640, 0o444 if os.geteuid() == 0 else 0o644):
        path.touch()
        path.chmod(mode)
        write_whole(path, "new\n")
        assert stat.S_IMODE(path.stat().st_mode) == mode
    mask = os.umask(0o027)
    try:
        assert stat.S_IMODE(write_whole(tmp_path / "new.json", "new\n").stat().st_mode) == 0o640
    finally:
        os.umask(mask)


def test_a_write_protected_file_is_not_replaced(tmp_path, monkeypatch):
    path = tmp_path / "face.json"
    path.write_text("old\n")
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write to anything
    with pytest.raises(OutputError, match=r"face\.json: cannot be written \(Permission denied\)"):
        write_whole(path, "new\n")
    assert path.read_text() == "old\n"


def test_the_longest_name_can_be_written(tmp_path):
    path = tmp_path / ("a" * 250 + ".json")
    assert write_whole(path, "new\n").read_text() == "new\n"


def test_what_a_killed_writer_left_goes_with_the_next_write(tmp_path):
    program = f"""
import os, signal
from pathlib import Path
from facegen.files import whole_file
with whole_file(Path({str(tmp_path / "face.json")!r})) as part:
    part.write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""
    assert subprocess.run([sys.executable, "-c", program]).returncode == -signal.SIGKILL
    other = tmp_path / ".part-of-somebody-else"
    other.mkdir()
    assert len(list(tmp_path.iterdir())) == 2
    path = write_whole(tmp_path / "face.json", "whole\n")
    assert sorted(tmp_path.iterdir()) == [other, path]


def test_two_folders_change_names_in_one_step(tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / name).touch()
    assert swap_folders(tmp_path / "a", tmp_path / "b")
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b"]
    assert [path.name for path in (tmp_path / "b").iterdir()] == ["a"]
    with pytest.raises(FileNotFoundError):
        swap_folders(tmp_path / "a", tmp_path / "none")
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b"]

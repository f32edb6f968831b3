"""A file's name never stands for half of it, and the system's refusal is one sentence."""

import os
from pathlib import Path

import pytest

from facegen.errors import InputError, OutputError
from facegen.files import output_errors, whole_file, write_whole


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = write_whole(tmp_path / "face.json", "old\n")

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError, match=r"face\.json: no space left"):
        write_whole(path, "new, and half of it\n")
    assert path.read_bytes() == b"old\n"
    assert list(tmp_path.iterdir()) == [path]


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


def test_a_folder_is_no_place_for_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for path in (Path("."), Path("/"), tmp_path):
        with pytest.raises(OutputError, match=r"cannot be written \(Is a directory\)"):
            write_whole(path, "new\n")
        with pytest.raises(InputError, match="is a folder; name the file"), whole_file(path):
            pass
    assert not list(tmp_path.iterdir())


def test_the_systems_reason_is_in_the_sentence(tmp_path):
    with pytest.raises(OutputError, match=r"a: cannot be written \(No such file or directory\)"):
        write_whole(tmp_path / "none" / "a", "new\n")
    with pytest.raises(OutputError, match=r"b: cannot be written \(odd\)"), output_errors(Path("b")):
        raise OSError("odd")

"""No recording is written over what `track` reads, nor over another one: a recording may have no other copy."""

import contextlib
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.facegen.formats.test_gltf_animation import avatar
from tests.track.session.faces import frames
from track.cli import main
from track.cli.opening import Wishes
from track.cli.running import RunOptions, open_session
from track.cli.sending import named_targets, open_sinks
from track.messages import Command

LINES = ["--camera", "-", "--fast", "--no-page"]

CASES = {
    "the page's avatar": [*LINES, "--avatar", "a.glb", "--record", "a.glb"],
    "the avatar that moves": [*LINES, "--to", "gltf:a.glb,avatar=a.glb"],
    "another sink's avatar": [*LINES, "--record", "a.glb", "--to", "gltf:new.glb,avatar=a.glb"],
    "by another name": [*LINES, "--to", "gltf:link.glb,avatar=a.glb"],
    "a neutral face": [*LINES, "--neutral", "n.csv", "--record", "n.csv"],
    "a placement": ["--camera", "mouth=0", "--placement", "p.json", "--to", "csv:p.json"],
    "a headset": ["--camera", "mouth=0", "--headset", "h.toml", "--to", "csv:h.toml"],
    "a profile": [*LINES, "--profile", "me.toml", "--to", "csv:me.toml"],
    "a profile that is new": [*LINES, "--profile", "new.toml", "--to", "csv:new.toml"],
    "a stored profile": [*LINES, "--to", "csv:profiles/me.camera.toml"],
    "a retargeting": [*LINES, "--retarget", "mine.toml", "--to", "csv:mine.toml"],
    "a detector": ["--camera", "0", "--detector-file", "d.task", "--to", "vrma:d.task"],
    "a film": ["--camera", "film.avi", "--no-page", "--to", "csv:./film.avi"],
    "a picture": ["--camera", "mouth=pictures", "--to", "csv:pictures/0.png"],
    "a model": ["--camera", "-", "--model", "model", "--to", "csv:model/weights.npz"],
    "one table twice": [*LINES, "--record", "new.csv", "--record", "./new.csv"],
    "two sinks of one name": [*LINES, "--record", "new.csv", "--to", "livelink-csv:new.csv"],
}


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder to be in, with files that `track` reads; nothing of this machine's user is seen."""
    monkeypatch.chdir(tmp_path)
    profiles = tmp_path / "profiles"
    monkeypatch.setattr("track.cli.sending.profile_folder", lambda: profiles)
    monkeypatch.setattr("track.profile.places.profile_folder", lambda: profiles)
    for file in ("n.csv", "p.json", "film.avi", "h.toml", "me.toml", "mine.toml", "d.task"):
        (tmp_path / file).write_text("what was there")
    for file in ("pictures/0.png", "model/weights.npz", "profiles/me.camera.toml"):
        (tmp_path / file).parent.mkdir()
        (tmp_path / file).write_text("what was there")
    avatar(tmp_path / "a.glb")
    (tmp_path / "link.glb").symlink_to("a.glb")
    with open(os.devnull, encoding="utf-8") as nothing:
        monkeypatch.setattr(sys, "stdin", nothing)
        yield tmp_path


def contents(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("name", CASES)
def test_it_is_refused_and_stays(name, place, capsys, monkeypatch):
    before = contents(place)
    monkeypatch.setattr(sys, "argv", ["track", *CASES[name]])
    with pytest.raises(SystemExit) as ended:
        main()
    (said,) = capsys.readouterr().err.splitlines()
    assert ended.value.code == 2, said
    assert re.fullmatch(r"track: --(to|record) \S+ is also what .*; give another name", said)
    assert contents(place) == before


def test_a_take_of_the_page_leaves_the_names_of_recordings_that_come_at_the_end(place):
    said: list[str] = []
    wishes, options = Wishes(cameras=("-",), fast=True), RunOptions(record=[Path("track-001.csv")])
    with contextlib.ExitStack() as closing:
        sinks = open_sinks(named_targets(record=options.record), said.append, closing, contextlib.ExitStack())
        session, _ = open_session(wishes, {"camera": "-"}, sinks, said.append, closing, options=options)
        session.ask(Command(verb="record", value=True))
        session.answer(frames(0, 1)[0])
    assert sorted(path.name for path in place.glob("track-*")) == ["track-001.csv", "track-002.csv"]
    assert said[-2:] == ["recorded csv to track-002.csv", "recorded csv to track-001.csv"]


@pytest.mark.skipif(not Path("/dev/stdin").exists(), reason="standard input has no name here")
def test_lines_that_come_from_a_file_stay(tmp_path):
    (tmp_path / "take.csv").write_text("1 2 3\n")
    words = [*LINES, "--profile", "me.toml", "--record", "take.csv"]
    with open(tmp_path / "take.csv", encoding="utf-8") as lines:
        ended = subprocess.run(
            [sys.executable, "-m", "track", *words], stdin=lines, cwd=tmp_path, capture_output=True, text=True
        )
    assert ended.returncode == 2, ended.stderr
    assert "is also what is read" in ended.stderr
    assert (tmp_path / "take.csv").read_text() == "1 2 3\n"


@pytest.mark.parametrize(("file", "name"), [("Take.CSV", "csv"), ("take.Glb", "gltf"), ("a.b.VRMA", "vrma")])
def test_the_case_of_a_recording_s_ending_means_nothing(file: str, name: str):
    ((_, target),) = named_targets(record=[Path(file)])
    assert (target.name, target.place) == (name, file)


def test_a_recording_s_name_has_any_commas_and_a_retargeting_beside_it():
    (told,) = named_targets(record=[Path("take,v=1.csv")], retarget="vrm1")
    assert told[1].path == Path("take,v=1.csv")
    assert told[1].options == {"names": "vrm1"}

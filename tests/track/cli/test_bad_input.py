"""Bad input is refused in one sentence with exit code 2, before anything is written."""

import os
import socket
import sys
from pathlib import Path

import pytest

from tests.track.session.faces import SAMPLES, calibrated_profile
from track.cli import main
from track.profile.profile import ModelMark, write_profile

MOUTH = f"mouth={SAMPLES / 'headset' / 'mouth'}"
POINTS_PROFILE, BROKEN_PROFILE, BROKEN_VRM, TEXT = "points.toml", "broken.toml", "broken.vrm", "text.txt"
OTHER_HEADSET = "other.toml"


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder to be in, with files that are not what they should be; nothing of this machine's user is seen."""
    monkeypatch.chdir(tmp_path)
    for name in ("XDG_CONFIG_HOME", "XDG_CACHE_HOME", "HOME", "APPDATA", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.delenv("TRACK_DETECTOR_FILE", raising=False)
    profile = calibrated_profile().model_copy(update={"model": ModelMark(kind="landmarks", sha256="ab" * 32)})
    write_profile(tmp_path / POINTS_PROFILE, profile)
    (tmp_path / BROKEN_PROFILE).write_text("person = [")
    (tmp_path / BROKEN_VRM).write_bytes(b"glTF no more")
    (tmp_path / TEXT).write_text("hello")
    headset = (Path(__file__).parents[1] / "drawn_layout" / "headset.toml").read_text()
    for name in ("left_eye", "right_eye", "mouth"):
        headset = headset.replace(f'"{name}"', f'"my_{name}"')
    (tmp_path / OTHER_HEADSET).write_text(headset)
    with open(os.devnull, encoding="utf-8") as nothing:
        monkeypatch.setattr(sys, "stdin", nothing)
        yield tmp_path


def refused(capsys, monkeypatch, *words: str) -> str:
    """The sentence with which a command ends."""
    monkeypatch.setattr(sys, "argv", ["track", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    told = capsys.readouterr()
    assert ended.value.code == 2, told.err
    assert told.out == ""
    *_, last = told.err.splitlines()
    assert last.startswith("track: ")
    assert "Traceback" not in told.err
    assert "internal error" not in told.err
    return last


CASES = {
    "no camera": (["--camera", "97", "--detector", "points", "--no-page"], "97"),
    "a film that is not there": (
        ["--camera", "take.mp4", "--detector", "points", "--no-page"],
        "there is no file take.mp4",
    ),
    "a folder that is not there": (
        ["--camera", "no/pictures", "--detector", "points"],
        "there is no file no/pictures",
    ),
    "a file that is no film": (["--camera", TEXT, "--detector", "points", "--no-page"], TEXT),
    "no model file and no network": (["--camera", "0", "--no-page"], "TRACK_DETECTOR_FILE"),
    "no detector of that name": (["--camera", "-", "--detector", "eyes"], "no detector 'eyes'"),
    "no model of that name": (["--camera", "-", "--model", "nobody"], "nobody"),
    "no filter of that name": (["--camera", "-", "--filter", "smooth"], "no filter 'smooth'"),
    "unknown sink": (["--camera", MOUTH, "--to", "smoke"], "no sink 'smoke'"),
    "a sink's port": (["--camera", MOUTH, "--to", "vmc:127.0.0.1:99999"], "99999"),
    "a recording of another kind": (["--camera", MOUTH, "--record", "take.mp3"], ".csv, .glb, .vrma"),
    "a broken avatar of a recording": (
        ["--camera", MOUTH, "--to", f"gltf:take.glb,avatar={BROKEN_VRM}", "--no-page"],
        BROKEN_VRM,
    ),
    "no avatar": (["--camera", MOUTH, "--avatar", "nobody.vrm", "--no-browser"], "nobody.vrm"),
    "another kind of avatar": (["--camera", MOUTH, "--avatar", TEXT, "--no-browser"], TEXT),
    "a broken avatar": (["--camera", MOUTH, "--avatar", BROKEN_VRM, "--no-browser"], BROKEN_VRM),
    "no retargeting of that name": (
        ["--camera", MOUTH, "--record", "take.csv", "--retarget", "robot", "--no-page"],
        "robot",
    ),
    "a retargeting of nothing that is written": (
        ["--camera", MOUTH, "--to", "vmc", "--retarget", "vrm1", "--no-page"],
        "none is written",
    ),
    "two cameras of a landmark model": (["--camera", "0", "--camera", "1"], "2 cameras are given"),
    "a headset's camera without a name": (
        ["--model", "headset-tracking3", "--camera", "0"],
        "needs its name before it, as in left_eye=0",
    ),
    "a headset's address without a name": (
        ["--model", "headset-tracking3", "--camera", "rtsp://me:pass@camera.local/live"],
        "--camera rtsp://camera.local/live: a headset's camera needs its name before it, as in left_eye=rtsp://camera.",
    ),
    "a camera that the headset has not": (["--camera", "nose=0"], "no camera 'nose'"),
    "a camera twice": (["--camera", MOUTH, "--camera", MOUTH], "given twice"),
    "a detector for a headset": (["--camera", MOUTH, "--detector", "mediapipe"], "finds 68 points"),
    "a neutral file that is not there": (
        ["--camera", "-", "--neutral", "nobody.csv", "--no-page"],
        "--neutral 'nobody.csv' is no file",
    ),
    "a profile of another kind of model": (
        ["--camera", MOUTH, "--profile", POINTS_PROFILE, "--no-page"],
        "a profile for a landmarks model, and this one is a headset model",
    ),
    "a profile that is none": (
        ["--camera", MOUTH, "--profile", BROKEN_PROFILE, "--no-page"],
        "not valid TOML",
    ),
    "a profile's name that is none": (["--camera", MOUTH, "--profile", "a/b", "--no-page"], "neither a file"),
    "a placement for points": (
        ["--camera", "-", "--placement", TEXT, "--no-page"],
        "for a headset's cameras",
    ),
    "a headset's places for points": (
        ["--camera", "-", "--headset", "tracking3", "--no-page"],
        "for a headset's cameras",
    ),
    "a headset's places for a model of one headset": (
        ["--camera", MOUTH, "--headset", "tracking3", "--no-page"],
        "take --model headset-any",
    ),
    "a headset that there is not": (
        ["--model", "headset-any", "--camera", MOUTH, "--headset", "mine.toml", "--no-page"],
        "there is no such file",
    ),
    "a headset of another kind of file": (
        ["calibrate", "--model", "headset-any", "--camera", MOUTH, "--headset", BROKEN_PROFILE],
        "not valid TOML",
    ),
    "a headset of other cameras": (
        ["--model", "headset-any", "--camera", MOUTH, "--headset", OTHER_HEADSET, "--no-page"],
        "the model has left_eye, right_eye, mouth",
    ),
    "a face that there is not": (["calibrate", "ears", "--camera", "-"], "no face 'ears'"),
    "another truth": (["compare", "--truth", "mirror"], "livelink or livelink:PORT"),
    "a take that is there": (["compare", "--keep", TEXT], "is there already"),
    "nobody's profile": (["profiles", "show", "nobody"], "no profile 'nobody'"),
    "a file to delete that is no profile": (["profiles", "delete", OTHER_HEADSET], "is not deleted"),
    "a damaged file to delete": (["profiles", "delete", BROKEN_PROFILE], "goes by its name in"),
    "an unknown option": (["--kamera", "0"], "--kamera"),
}


@pytest.mark.parametrize("name", CASES)
def test_one_sentence(name, place, capsys, monkeypatch):
    words, expected = CASES[name]
    before = sorted(path.name for path in place.iterdir())
    assert expected in refused(capsys, monkeypatch, *words)
    assert sorted(path.name for path in place.iterdir() if path.name != "home") == before


def test_a_port_that_is_taken(place, capsys, monkeypatch):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        sentence = refused(capsys, monkeypatch, "--camera", MOUTH, "--no-browser", "--port", str(port))
    assert f"127.0.0.1:{port}" in sentence


def test_ranges_of_another_model_are_left_out_and_told(place, capsys, monkeypatch):
    """The neutral face stays: it is the detector's."""
    profile = calibrated_profile().model_copy(
        update={"model": ModelMark(kind="landmarks", sha256="cd" * 32), "ranges": {"jawOpen": 0.5}}
    )
    write_profile(place / "other.toml", profile)
    monkeypatch.setattr(
        sys, "argv", ["track", "--camera", "-", "--fast", "--profile", "other.toml", "--no-page"]
    )
    with pytest.raises(SystemExit):
        main()
    assert "its ranges were read by another model and are left out" in capsys.readouterr().err

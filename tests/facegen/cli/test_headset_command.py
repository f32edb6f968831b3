"""``facegen headset``: lists, shows, and refuses with exit code 2 through the program's entry."""

import json

import cv2
import pytest
from typer.testing import CliRunner

from facegen.cli.headset import headset_app
from facegen.errors import MissingAsset
from facegen.headsets import list_headsets


def test_list_names_every_headset():
    result = CliRunner().invoke(headset_app, ["list"])
    assert result.exit_code == 0
    assert [line.split()[0] for line in result.stdout.splitlines()] == list(list_headsets())


@pytest.mark.parametrize("name", list_headsets())
def test_show_names_the_lens_of_every_camera(name):
    result = CliRunner().invoke(headset_app, ["show", name])
    assert result.exit_code == 0
    assert "fisheye" in result.stdout or "pinhole" in result.stdout


def test_show_as_json_is_the_whole_headset():
    result = CliRunner().invoke(headset_app, ["show", "tracking3", "--json"])
    shown = json.loads(result.stdout)
    assert [camera["name"] for camera in shown["cameras"]] == ["left_eye", "right_eye", "mouth"]
    assert shown["sensor"]["bits"] == 8


def test_preview_draws_every_camera(anny, tmp_path):
    result = CliRunner().invoke(headset_app, ["preview", "mouth1", "--out", str(tmp_path / "a.png")])
    assert result.exit_code == 0, result.output
    assert result.stdout.strip() == str(tmp_path / "a.png")
    picture = cv2.imread(str(tmp_path / "a.png"))
    assert min(picture.shape[:2]) > 600
    # the middle of the lower half is what the camera sees: skin, and the dark plate above it
    height, width = picture.shape[:2]
    view = picture[height // 2 :, width // 4 : 3 * width // 4].reshape(-1, 3).astype(int)
    assert ((view[:, 2] - view[:, 0]) > 30).mean() > 0.1
    assert (view.max(axis=-1) < 60).mean() > 0.03
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png"]


def test_an_unknown_headset_is_bad_input():
    result = CliRunner().invoke(headset_app, ["show", "nothing"])
    assert isinstance(result.exception, MissingAsset)
    assert result.exception.exit_code == 2

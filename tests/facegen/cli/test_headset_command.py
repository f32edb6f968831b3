"""``facegen headset``: lists, shows, and refuses with exit code 2 through the program's entry."""

import json

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
def test_show(name):
    result = CliRunner().invoke(headset_app, ["show", name])
    assert result.exit_code == 0
    assert "fisheye" in result.stdout or "pinhole" in result.stdout


def test_show_as_json_is_the_whole_headset():
    result = CliRunner().invoke(headset_app, ["show", "tracking3", "--json"])
    shown = json.loads(result.stdout)
    assert [camera["name"] for camera in shown["cameras"]] == ["left_eye", "right_eye", "mouth"]
    assert shown["sensor"]["bits"] == 8


def test_an_unknown_headset_is_bad_input():
    result = CliRunner().invoke(headset_app, ["show", "nothing"])
    assert isinstance(result.exception, MissingAsset)
    assert result.exception.exit_code == 2

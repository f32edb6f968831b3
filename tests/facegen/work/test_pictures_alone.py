"""Datasets of pictures without truth: what is there is right, and what is not there is said in one sentence."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.packing import Options, plan_pack, write_pack
from facegen.spec import parse_spec
from facegen.store import Dataset, read_png, resolve
from facegen.validation import validate
from facegen.work import generate

pytestmark = [pytest.mark.blender, pytest.mark.slow]

TABLE = {
    "version": 1,
    "kind": "still",
    "seed": 3,
    "people": 1,
    "sensor": {"room_light": 1.0, "room": "bright_office"},
}
CHEAP = {"samples": "1", "size_px": 48, "samples_per_pixel": 1, "subsurface": False, "truth": False}


@pytest.fixture(scope="module")
def alone(anny, tmp_path_factory) -> Dataset:
    """One sample rendered without truth."""
    dataset = resolve(
        parse_spec(TABLE | {"render": CHEAP}, where="test"), tmp_path_factory.mktemp("alone") / "cheap"
    )
    assert generate(dataset, workers=1).left == 0
    return dataset


def test_files_are_pictures_and_labels_and_are_found_good(alone):
    folder = alone.folder.render(1)
    assert sorted(path.name for path in folder.iterdir()) == [
        "left_eye.png",
        "mouth.png",
        "right_eye.png",
        "sample.json",
    ]
    assert not validate(alone).wrong
    # damage is still found
    path = folder / "mouth.png"
    content = path.read_bytes()
    path.write_bytes(content[:-1])
    wrong = validate(alone).wrong
    path.write_bytes(content)
    assert "checksum" in wrong


def test_pictures_are_those_with_truth_but_for_the_rooms_light(alone, anny, tmp_path):
    render = CHEAP | {"truth": True}
    whole = resolve(parse_spec(TABLE | {"render": render}, where="test"), tmp_path / "whole")
    assert generate(whole, workers=1).left == 0
    room = alone.sample(1)["views"]["mouth"]["shot"]["room_radiance"]
    assert room > 0.01
    for view in ("left_eye", "mouth", "right_eye"):
        one, two = (read_png(d.folder.render(1) / f"{view}.png").astype(float) for d in (alone, whole))
        # the room adds about three levels; its surfaces are seen by the denoiser's guides instead of exactly
        assert np.abs(one - two).mean() < 0.5
        assert abs(one.mean() - two.mean()) < 0.3


def test_what_is_not_there_is_said(alone, tmp_path):
    folder = str(alone.folder.path)
    for arguments, words in (
        (["develop", folder, "--out", str(tmp_path / "a")], "render.truth = false"),
        (["pack", folder, "--out", str(tmp_path / "b"), "--format", "webdataset", "--exr"], "leave it out"),
    ):
        result = CliRunner().invoke(app, arguments)
        assert result.exception.exit_code == 2
        assert words in str(result.exception)
    assert not list(tmp_path.iterdir())
    result = CliRunner().invoke(app, ["validate", folder, "--workers", "1"])
    assert result.exit_code == 0, result.output
    assert "no label was held against depths" in result.output
    result = CliRunner().invoke(app, ["preview", folder, "--out", str(tmp_path / "sheet.png")])
    assert result.exit_code == 0, result.output


def test_packs_hold_what_there_is(alone, tmp_path):
    for name in ("webdataset", "parquet", "arrays"):
        write_pack(plan_pack(alone, name, Options()), tmp_path / name)
    about = json.loads((tmp_path / "arrays" / "arrays.json").read_text())
    assert about["rows"] == 1
    assert {camera["width"] for camera in about["cameras"]} == {48}

"""Drawn headsets: one seed gives one layout, cameras stand where ranges say and see the face, labels know them."""

import itertools
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import tomli_w
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from typer.testing import CliRunner

from facegen.cli import app
from facegen.conventions import CAMERA_TERMS, CAMERA_TERMS_MIRRORED
from facegen.errors import InputError
from facegen.geometry import apply_transform, camera_terms, project
from facegen.headsets import Headset, load_headset
from facegen.randomness import stream
from facegen.rigs import Rig
from facegen.sampling import draw_samples
from facegen.sessions import (
    draw_layout,
    draw_sample_scene,
    drawn_headset,
    drawn_headsets,
    headset_of,
    layouts,
    sees_enough,
)
from facegen.spec import LayoutRanges, Spec, parse_spec
from facegen.store import Dataset, begin, resolve

BASE = load_headset("tracking3").scaled(96)
SETTINGS = settings(max_examples=25, deadline=None)


def spec_of(**layout: object) -> Spec:
    table = {"version": 1, "kind": "still", "seed": 5, "people": 12, "render": {"size_px": 96}}
    return parse_spec({**table, "layout": layout}, where="here")


@given(seed=st.integers(0, 2**32), person=st.integers(0, 10**6))
@SETTINGS
def test_a_layout_follows_from_its_stream_and_keeps_to_its_ranges(seed: int, person: int):
    ranges = LayoutRanges()
    layout, same = (draw_layout(stream(seed, "layout", person), ranges) for _ in range(2))
    assert layout == same
    left, right, mouth = layout.cameras
    assert [camera.name for camera in layout.cameras] == list(layouts.CAMERAS) == list(BASE.camera_names)
    for camera, distance, width in (
        (left, ranges.eye_distance_mm, ranges.eye_width_mm),
        (mouth, ranges.mouth_distance_mm, ranges.mouth_width_mm),
    ):
        assert distance.low - 1e-9 <= camera.distance_mm <= distance.high + 1e-9
        assert width.low <= camera.width_mm <= width.high
    off = np.subtract(right.position_mm, np.multiply(left.position_mm, (-1, 1, 1)))
    assert (np.abs(off) <= ranges.sides_mm.high).all()
    lamps = {camera: [led for led in layout.leds if led.camera == camera] for camera in layouts.CAMERAS}
    assert len(lamps["left_eye"]) == len(lamps["right_eye"]) in range(1, 9)
    assert len(lamps["mouth"]) in range(1, 5)


def test_a_key_moves_what_it_says_and_nothing_drawn_beside_it():
    plain, turned = (
        draw_layout(stream(1, "layout", 0), LayoutRanges(**changes))
        for changes in ({}, {"eye_roll_deg": 20.0, "fisheye": 1.0, "housing": 1.0})
    )
    assert turned.cameras[0].roll_deg == 20.0 == -turned.cameras[1].roll_deg
    assert turned.cameras[2].fisheye
    assert turned.housing
    assert turned.leds == plain.leds
    assert turned.cameras[0].position_mm == plain.cameras[0].position_mm


@given(number=st.integers(0, 10**6))
@SETTINGS
def test_a_drawn_camera_sees_as_wide_as_its_layout_says(number: int):
    layout = draw_layout(stream(2, "layout", number), LayoutRanges())
    try:
        headset = headset_of(layout, BASE)
    except ValidationError:
        return
    for drawn, camera in zip(layout.cameras, headset.cameras, strict=True):
        half_m = 5e-4 * drawn.width_mm
        edge = [half_m, 0.0, 1e-3 * drawn.distance_mm]
        edge_px = project(camera.camera, np.array([edge]))[0]
        np.testing.assert_allclose(
            edge_px, [camera.cx + camera.width / 2, camera.cy], atol=0.02 * camera.width
        )


def test_people_wear_different_headsets_that_see_them_and_a_count_repeats_them(anny: Rig):
    spec = spec_of()
    worn = [drawn_headset(spec, anny, BASE, person) for person in range(6)]
    assert len({headset.cameras for headset in worn}) == 6
    assert all(sees_enough(headset, anny) for headset in worn)
    few = spec_of(count=2)
    first, second, third = (drawn_headset(few, anny, BASE, person) for person in range(3))
    assert first == third != second
    assert drawn_headset(replace(spec, layout=None), anny, BASE, 3) is BASE


def moved(headset: Headset, **changes: object) -> Headset:
    left, *others = headset.cameras
    return replace(headset, cameras=(replace(left, **changes), *others))


@pytest.mark.parametrize(
    "changes",
    [
        pytest.param({"position_mm": (32.0, 0.0, 12.0)}, id="camera in the eye"),
        pytest.param({"position_mm": (60.0, -60.0, -20.0)}, id="camera in the cheek"),
        pytest.param({"target_mm": (32.0, 60.0, 30.0)}, id="looks at the forehead"),
        pytest.param({"fx": 2000.0, "fy": 2000.0}, id="sees a part of the eye"),
        pytest.param(
            {"position_mm": (-40.0, 0.0, 22.0), "target_mm": (31.0, 0.0, 13.0)}, id="behind the nose"
        ),
    ],
)
def test_a_headset_that_sees_too_little_is_not_worn(anny: Rig, changes: dict):
    assert sees_enough(BASE, anny)
    assert not sees_enough(moved(BASE, **changes), anny)


def test_ranges_without_a_headset_are_refused_in_one_sentence(
    anny: Rig, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    monkeypatch.setattr("facegen.sessions.drawn_headsets.MOST_DRAWS", 3)
    with pytest.raises(InputError, match="layout: none of 3 draws"):
        drawn_headset(spec_of(eye_width_mm=15), anny, BASE, 0)
    table = {"version": 1, "kind": "still", "seed": 5, "people": 2, "render": {"headset": "training9"}}
    with pytest.raises(InputError, match=r"\[layout\] draws left_eye, right_eye, mouth"):
        resolve(parse_spec({**table, "layout": {}}, where="here"), tmp_path)


@pytest.mark.parametrize(
    ("every", "changes", "said"),
    [
        (10**6, {"people": 1}, "layout: 0 of 200 drawn headsets .* rig 'anny' .* so of 1 person at least"),
        (40, {"people": 10**5}, "layout: 5 of 200 drawn headsets .* so of 100000 people at least one"),
        (40, {"people": 10**5, "layout": {"count": 9}}, None),
        (40, {"people": 12}, None),
        (1, {"people": 10**6}, None),
    ],
)
def test_ranges_that_leave_a_person_without_a_headset_are_refused_before_anything_is_written(
    anny: Rig, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, every: int, changes: dict, said: str | None
):
    tries = itertools.count(1)
    monkeypatch.setattr(drawn_headsets, "sees_enough", lambda headset, rig: next(tries) % every == 0)
    table = {"version": 1, "kind": "still", "seed": 5, "still": {"neutral": 1, "faces": 0}, "layout": {}}
    table |= {"render": {"samples": "0-99999" if changes["people"] > 99999 else "0"}} | changes
    made = resolve(parse_spec(table, where="here"), tmp_path / "out")
    file = tmp_path / "spec.toml"
    file.write_text(tomli_w.dumps(table))
    if said is None:
        begin(made)
        assert made.folder.dataset_json.is_file()
        return
    with pytest.raises(InputError, match=said):
        begin(made)
    assert not (tmp_path / "out").exists()
    checked = CliRunner().invoke(app, ["spec", "check", str(file)])
    assert isinstance(checked.exception, InputError)
    assert re.search(said, str(checked.exception))


@pytest.fixture(scope="module")
def dataset(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> Dataset:
    return resolve(spec_of(), tmp_path_factory.mktemp("drawn"))


def test_a_samples_views_are_the_drawn_cameras_and_its_labels_say_them(dataset: Dataset, anny: Rig):
    row = draw_samples(dataset.plan, anny, 0).rows(slice(11, 12))
    person = int(row.person[0])
    exact = replace(dataset.spec, sensor=replace(dataset.spec.sensor, tolerances=0.0))
    sample = draw_sample_scene(exact, anny, dataset.headset, row)
    worn = drawn_headset(exact, anny, dataset.headset, person)
    assert worn.cameras != dataset.headset.cameras
    for view, camera in zip(sample.scene.views, worn.cameras, strict=True):
        assert view.camera == camera.camera
        pose = sample.head_from_headset @ camera.headset_from_camera
        np.testing.assert_allclose(view.camera_from_head @ pose, np.eye(4), atol=1e-12)
        place = apply_transform(view.camera_from_head, pose[None, :3, 3])
        np.testing.assert_allclose(place, 0, atol=1e-12)


def test_the_hash_knows_of_layouts_and_datasets_without_them_keep_theirs(dataset: Dataset, tmp_path: Path):
    without, other = (
        resolve(spec, tmp_path) for spec in (replace(dataset.spec, layout=None), spec_of(blur=0.0))
    )
    assert len({dataset.hash, without.hash, other.hash}) == 3
    assert (dataset.headset.name, without.headset.name) == ("drawn", "tracking3")


def test_terms_of_mirrored_cameras_are_mirrored(anny: Rig):
    headset = drawn_headset(spec_of(sides_mm=0), anny, BASE, 1)
    left, right, mouth = (camera_terms(one.camera, one.headset_from_camera) for one in headset.cameras)
    assert len(left) == len(CAMERA_TERMS)
    np.testing.assert_allclose(right, left * CAMERA_TERMS_MIRRORED, atol=1e-9)
    assert np.abs(mouth[:3] - left[:3]).max() > 0.3

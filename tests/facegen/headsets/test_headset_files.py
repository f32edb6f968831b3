"""Headset files: what they must hold, what is refused and how, and where cameras and LEDs end up."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest

from facegen.errors import FormatError, InputError, MissingAsset
from facegen.geometry import apply_transform, invert_transform, project, rotation_from_angles
from facegen.headsets import head_from_headset, headset_path, list_headsets, load_headset, parse_headset
from facegen.headsets.cameras import Distortion

SMALL = """
name = "small"
[[cameras]]
name = "eye"
model = "fisheye"
width = 64
height = 48
fx = 60.0
fy = 61.0
cx = 31.5
cy = 23.5
distortion = { k1 = -0.02 }
position_mm = [40, -10, 45]
target_mm = [32, 0, 15]
[[leds]]
name = "led"
camera = "eye"
position_mm = [40, 10, 40]
target_mm = [32, 0, 15]
wavelength_nm = 850
power_mw = 1.0
diameter_mm = 1.5
beam_deg = 100
[sensor]
exposure = 0.5
black_level = 12
[fit]
nose_bridge_mm = [0, -4, 25]
"""


def parse(text: str):
    return parse_headset(tomllib.loads(text), source="small.toml")


@pytest.mark.parametrize("name", list_headsets())
def test_headsets_of_the_project_load(name):
    headset = load_headset(name)
    assert headset.name == name
    assert all(any(led.camera == camera for led in headset.leds) for camera in headset.camera_names)


@pytest.mark.parametrize(
    ("was", "becomes", "says"),
    [
        (
            "fx = 60.0",
            "fx = 60.0\nfocal = 3",
            r"small\.toml: unknown key 'cameras\[0\]\.focal'; .*Known keys here: name, model,",
        ),
        (
            "exposure = 0.5",
            "exposure = 0.5\niso = 2",
            r"unknown key 'sensor\.iso'; .*Known keys here: exposure, gain, black_level, veiling_glare, ",
        ),
        (
            "k1 = -0.02",
            "k7 = -0.02",
            r"unknown key 'cameras\[0\]\.distortion\.k7'; .*Known keys here: k1, k2",
        ),
        (
            "width = 64",
            "width = -64",
            r"cameras\[0\]\.width = -64: must be greater than or equal to 8",
        ),
        ("fx = 60.0", "fx = 0.0", r"cameras\[0\]\.fx = 0\.0: must be greater than 0"),
        (
            '"fisheye"',
            '"orthographic"',
            r"cameras\[0\]\.model = \"orthographic\": must be 'pinhole' or 'fisheye'",
        ),
        ("fy = 61.0", "", r"key 'cameras\[0\]\.fy' is missing"),
        ("k1 = -0.02", "p1 = 0.1", r"a fisheye camera has no distortion term p1; it has k1, k2, k3, k4"),
        ("k1 = -0.02", "k1 = -4.0", r"distortion folds within the picture"),
        ('camera = "eye"', 'camera = "nose"', r"leds\[0\]\.camera is 'nose', but the cameras are eye"),
        ("target_mm = [32, 0, 15]", "target_mm = [40, 5, 45]", r"up in the picture is undefined"),
        (
            "power_mw = 1.0",
            'power_mw = "much"',
            r"leds\[0\]\.power_mw = \"much\": must be a number",
        ),
        ("[40, -10, 45]", "[40, -10]", r"key 'cameras\[0\]\.position_mm\[2\]' is missing"),
    ],
)
def test_refusals_name_the_key_and_what_is_allowed(was, becomes, says):
    assert was in SMALL
    with pytest.raises(InputError, match=says):
        parse(SMALL.replace(was, becomes, 1))


def test_pictures_that_cannot_be_rendered_as_labelled_are_refused():
    square = {"width": 256, "height": 256, "cx": 127.5, "cy": 127.5}
    camera = replace(load_headset("tracking3").camera("mouth"), **square, distortion=Distortion())
    with pytest.raises(ValueError, match="90 degrees and more from the optical axis"):
        replace(camera, model="fisheye", fx=70.0, fy=70.0)
    replace(camera, model="fisheye", fx=130.0, fy=130.0)
    # an iteration of fixed points swings for ever there; Newton's, which labels have, does not
    strong = Distortion(k1=-0.3, k2=0.1, k3=0.1)
    with pytest.raises(
        ValueError, match=r"too strong to be rendered: rays would be .* px off, and 0\.01 are allowed"
    ):
        replace(camera, model="pinhole", fx=165.0, fy=165.0, distortion=strong)


def test_missing_and_damaged_files(tmp_path):
    with pytest.raises(MissingAsset, match=r"no headset 'nothing'; known are .*tracking3"):
        load_headset("nothing")
    path = tmp_path / "bad.toml"
    with pytest.raises(MissingAsset, match=r"bad\.toml: there is no such file"):
        load_headset(path)
    path.write_text("name = ")
    with pytest.raises(FormatError, match="is not valid TOML"):
        load_headset(path)


def test_an_installed_package_finds_the_headsets_of_the_clone_it_is_used_in(tmp_path, monkeypatch):
    clone = headset_path("tracking3").parents[2]
    monkeypatch.setattr("facegen.assets.__file__", str(tmp_path / "site-packages" / "facegen" / "assets.py"))
    monkeypatch.chdir(clone)
    assert load_headset("tracking3").name == "tracking3"
    monkeypatch.chdir(tmp_path)
    with pytest.raises(MissingAsset, match=r"no headset 'tracking3'; none are in blender_assets.headsets"):
        load_headset("tracking3")


def test_a_path_is_as_good_as_a_name():
    assert load_headset(headset_path("tracking3")) == load_headset("tracking3")


def test_target_lies_on_the_optical_axis_and_up_is_up():
    camera = parse(SMALL).camera("eye")
    camera_from_headset = invert_transform(camera.headset_from_camera)
    target = np.multiply(camera.target_mm, 1e-3)
    above = target + np.array([0.0, 1e-3, 0.0])
    pixels = project(camera.camera, apply_transform(camera_from_headset, np.stack([target, above])))
    assert np.allclose(pixels[0], [camera.cx, camera.cy])
    assert pixels[1, 1] < pixels[0, 1]
    assert abs(pixels[1, 0] - pixels[0, 0]) < 1e-6


def test_rolling_a_camera_clockwise_turns_its_picture_the_other_way():
    plain, rolled = (
        parse(SMALL).camera("eye"),
        parse(SMALL.replace("cx =", "roll_deg = 90\ncx =")).camera("eye"),
    )
    above = np.multiply(plain.target_mm, 1e-3) + np.array([0.0, 1e-3, 0.0])
    before, after = (
        project(c.camera, apply_transform(invert_transform(c.headset_from_camera), above[None]))[0]
        for c in (plain, rolled)
    )
    assert before[1] < plain.cy - 1
    assert after[0] < plain.cx - 1
    assert abs(after[1] - plain.cy) < 0.1


def test_scaling_keeps_rays_through_corners():
    camera = parse(SMALL).camera("eye")
    scaled = camera.scaled(128)
    assert (scaled.width, scaled.height) == (128, 96)
    point = np.array([[2e-3, -1e-3, 30e-3]])
    # corners coincide: (pixel + 0.5) scales
    assert np.allclose((project(camera.camera, point) + 0.5) * 2, project(scaled.camera, point) + 0.5)


def test_nose_bridge_rests_where_the_file_says():
    headset = load_headset("tracking3")
    bridge = np.array([0.001, -0.006, 0.031])
    placed = head_from_headset(headset, bridge, np.zeros(6))
    rest = np.multiply(headset.fit.nose_bridge_mm, 1e-3)
    there = apply_transform(placed, rest[None])[0]
    assert np.allclose(there[[0, 2]], bridge[[0, 2]])
    assert np.allclose(placed[:3, :3], np.eye(3))
    assert placed[1, 3] == 0.0


def test_donning_shifts_and_turns_about_the_headsets_origin():
    headset = load_headset("tracking3")
    donning = np.array([1e-3, -2e-3, 3e-3, 0.1, 0.2, 0.3])
    still = head_from_headset(headset, np.zeros(3), np.zeros(6))
    moved = head_from_headset(headset, np.zeros(3), donning)
    assert np.allclose(moved[:3, 3] - still[:3, 3], donning[:3])
    assert np.allclose(moved[:3, :3], rotation_from_angles(0.1, 0.2, 0.3))


def test_tracking3_is_mirror_symmetric():
    headset = load_headset("tracking3")
    left, right = headset.camera("left_eye"), headset.camera("right_eye")
    mirrored = np.array([-1.0, 1.0, 1.0])
    assert np.allclose(np.multiply(left.position_mm, mirrored), right.position_mm)
    assert np.allclose(np.multiply(left.target_mm, mirrored), right.target_mm)
    assert np.isclose(left.cx + right.cx, left.width - 1)
    places = {
        side: [led.position_mm for led in headset.leds if led.camera == f"{side}_eye"]
        for side in ("left", "right")
    }
    assert np.allclose(np.multiply(places["left"], mirrored), places["right"])


def test_tracking3_is_a_subset_of_training9():
    tracking3, training9 = load_headset("tracking3"), load_headset("training9")
    assert len(training9.cameras) == 9
    for kind in ("cameras", "leds", "occluders"):
        assert set(getattr(tracking3, kind)) <= set(getattr(training9, kind)), kind
    assert (tracking3.sensor, tracking3.fit, tracking3.tolerances) == (
        training9.sensor,
        training9.fit,
        training9.tolerances,
    )


@pytest.mark.parametrize("name", ["nul", "com1", "weights", "points_2d"])
def test_cameras_are_not_called_as_windows_devices_or_columns_are(name: str):
    text = SMALL.replace('"eye"', f'"{name}"')
    with pytest.raises(InputError, match=rf"cameras\[0\]\.name is '{name}'"):
        parse_headset(tomllib.loads(text), source="small.toml")

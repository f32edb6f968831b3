"""Profiles: the same after writing and reading, refused in a sentence where they are something else."""

import os

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLINK_INDICES
from regress.runtime.headset.person.person import HIGHEST_REST, LEAST_SPAN, OwnEnds, OwnEye
from regress.runtime.stages.own_blinks import Ends
from track.cli import app
from track.errors import InputError
from track.profile import places
from track.profile.neutral import NeutralFace, lines_of
from track.profile.places import (
    camera_key,
    disposable_path,
    known_path,
    person_of,
    profile_path,
    stored_path,
    stored_profiles,
)
from track.profile.profile import (
    FULL_GAIN,
    LARGEST_GAIN,
    SMALLEST_RANGE,
    ModelMark,
    Profile,
    read_profile,
    write_profile,
)

SHAPES = st.sampled_from(BLENDSHAPES)
ANGLES = st.floats(-1, 1, allow_subnormal=False)


@st.composite
def neutrals(draw: st.DrawFn) -> NeutralFace:
    count = draw(st.integers(1, 3))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    return NeutralFace(
        detector=draw(st.sampled_from(["mediapipe", "points"])),
        picture=(640, 480),
        points=lines_of(rng.normal(300, 100, (count, 68, 2)), places=2),
        irises=lines_of(rng.normal(300, 100, (count, 2, 2)), places=2),
        heads=lines_of(rng.normal(0, 1, (count, 6)), places=4),
    )


PROFILES = st.builds(
    Profile,
    person=st.text(min_size=1, max_size=20),
    camera=st.text(min_size=1, max_size=20),
    mirror=st.booleans(),
    gaze=st.none() | st.tuples(ANGLES, ANGLES, ANGLES, ANGLES),
    model=st.none()
    | st.builds(ModelMark, kind=st.sampled_from(["landmarks", "headset"]), sha256=st.just("ab" * 32)),
    neutral=st.none() | neutrals(),
    ranges=st.dictionaries(SHAPES, st.floats(SMALLEST_RANGE, 1), max_size=5),
    blinks=st.dictionaries(
        st.sampled_from(["eyeBlinkLeft", "eyeBlinkRight"]),
        st.builds(Ends, open=st.floats(0, 1), full=st.floats(0, 1)),
    ),
    gains=st.dictionaries(SHAPES, st.floats(0, LARGEST_GAIN), max_size=5),
    eyes=st.dictionaries(
        st.sampled_from(["left_eye", "right_eye"]),
        st.builds(OwnEye, shut_mm=st.none() | st.floats(0, 40), rest_mm=st.none() | st.floats(0, 40)),
    ),
)


@given(profile=PROFILES)
def test_what_is_written_is_read(tmp_path_factory, profile):
    path = write_profile(tmp_path_factory.mktemp("profiles") / "new" / "a.toml", profile)
    assert read_profile(path) == profile


@given(profile=PROFILES)
def test_a_full_movement_reads_one_unless_the_gain_ends(profile):
    plain = profile.model_copy(update={"gains": {}})
    for name, reading in plain.ranges.items():
        full = reading * plain.factors()[BLENDSHAPE_INDEX[name]]
        assert full == pytest.approx(min(1.0, plain.most_gain(name) * reading))
    unnamed = [index for name, index in BLENDSHAPE_INDEX.items() if name not in plain.ranges]
    assert np.all(plain.factors()[unnamed] == 1)


@given(
    rests=st.dictionaries(SHAPES, st.floats(0, HIGHEST_REST), max_size=5),
    spans=st.dictionaries(SHAPES, st.floats(LEAST_SPAN, 0.5), max_size=5),
    seed=st.integers(0, 2**32 - 1),
)
def test_a_headset_s_weights_are_stretched_live_as_by_a_guided_minute(rests, spans, seed):
    """But for blinks: the minute measures how noisy they read, and nobody does so live."""
    full = {name: min(1.0, rests.get(name, 0.0) + span) for name, span in spans.items()}
    mark = ModelMark(kind="headset", sha256="ab" * 32)
    profile = Profile(person="a", camera="b", model=mark, rests=rests, ranges=full)
    read = np.random.default_rng(seed).uniform(size=52)
    live = np.clip((read - profile.at_rest()) * profile.factors(), 0, 1)
    kept = OwnEnds(rests, full, np.zeros(2)).apply(read, None)
    others = np.setdiff1d(np.arange(52), BLINK_INDICES)
    np.testing.assert_allclose(live[others], kept[others], atol=1e-9)
    assert all(profile.most_gain(BLENDSHAPES[column]) == FULL_GAIN for column in BLINK_INDICES)


@given(
    st.dictionaries(SHAPES, st.floats(0, HIGHEST_REST), max_size=5),
    st.dictionaries(SHAPES, st.floats(0.1, 0.5), max_size=5),
)
def test_a_rest_reads_nothing_and_a_full_movement_above_it_one(rests, spans):
    ranges = {name: min(1.0, rests.get(name, 0.0) + span) for name, span in spans.items()}
    profile = Profile(person="a", camera="b", rests=rests, ranges=ranges)
    rest = profile.at_rest()
    for name, reading in ranges.items():
        column = BLENDSHAPE_INDEX[name]
        read = (reading - rest[column]) * profile.factors()[column]
        assert read == pytest.approx(
            min(1.0, FULL_GAIN * (reading - rest[column]) / (1 - rest[column])), abs=1e-9
        )
    np.testing.assert_allclose((1 - rest)[rest > 0] * profile.factors()[rest > 0] >= 1 - 1e-9, True)


GOOD = 'format = "track-profile"\nversion = 1\nperson = "a"\ncamera = "b"\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "key 'person' is missing"),
        ("not toml", "not valid TOML"),
        (GOOD.replace("track-profile", "other"), "format"),
        (GOOD.replace("version = 1", "version = 2"), "version"),
        (GOOD + "age = 3\n", "unknown key 'age'"),
        (GOOD + "[ranges]\njawOpen = 0.0\n", "ranges.jawOpen = 0.0"),
        (GOOD + "[ranges]\njawopen = 0.5\n", "not one of the 52 ARKit names"),
        (GOOD + "[gains]\njawOpen = 1e9\n", "gains.jawOpen"),
        (GOOD + "[blinks.eyeBlinkLeft]\nopen = 0.1\n", "blinks.eyeBlinkLeft.full"),
        (GOOD + "[blinks.eyeBlinkLeft]\nopen = 0.1\nfull = 2.0\n", "blinks.eyeBlinkLeft.full = 2.0"),
        (GOOD + "[blinks.jawOpen]\nopen = 0.1\nfull = 0.5\n", "jawOpen"),
        (GOOD + "gaze = [0.0, nan, 0.0, 0.0]\n", "gaze"),
        (GOOD + '[neutral]\npoints = ["1, 2, 3"]\n', "must be 136 finite numbers"),
        (GOOD + '[neutral]\nirises = ["1, 2, 3, x"]\n', "4 finite numbers"),
        (
            GOOD + '[neutral]\nirises = ["1, 2, 3, 4"]\nheads = ["1,2,3,4,5,6", "1,2,3,4,5,6"]\n',
            "same frames",
        ),
        (GOOD + '[model]\nkind = "landmarks"\nsha256 = "xyz"\n', "model.sha256"),
    ],
)
def test_what_is_no_profile_is_refused_in_a_sentence(tmp_path, text, words):
    path = tmp_path / "p.toml"
    path.write_text(text)
    with pytest.raises(InputError) as refused:
        read_profile(path)
    assert words in str(refused.value)
    assert str(path) in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(places, "profile_folder", lambda: tmp_path)
    return tmp_path


def test_each_person_and_camera_has_a_file(folder):
    assert profile_path(None, "camera 0") == folder / "me.camera-0.toml"
    assert profile_path("anna", "http://host/x?y") == folder / "anna.http-host-x-y.toml"
    assert profile_path("here/p.toml", "camera 0").name == "p.toml"
    assert person_of(folder / "anna.camera-0.toml") == "anna"
    titles = ["USB摄像头", "USB相机", "Веб-камера", "カメラ", "映.mp4", "像.mp4"]
    assert len({profile_path(None, title) for title in titles}) == len(titles)
    with pytest.raises(InputError, match="neither a file"):
        profile_path("../anna", "camera 0")


NAMES = ("left_eye", "right_eye", "mouth")
SOURCES = st.one_of(
    st.integers(0, 9).map("camera {}".format),
    st.text("abc/.:-", min_size=1, max_size=120).map("http://{}".format),
)


@given(st.dictionaries(st.sampled_from(NAMES), SOURCES, min_size=1), st.randoms(use_true_random=False))
def test_a_profile_hangs_on_no_order_of_the_cameras(titles, random):
    names = list(titles)
    random.shuffle(names)
    assert profile_path("a", camera_key({name: titles[name] for name in names})) == profile_path(
        "a", camera_key(titles)
    )


@pytest.mark.parametrize("half", ["", "#left"])
def test_a_webcam_is_the_same_by_its_number_and_its_device(half):
    spelled = [{"mouth": f"{title}{half}"} for title in ("camera 2", "/dev/video2")]
    assert camera_key(spelled[0]) == camera_key(spelled[1])
    assert camera_key({"camera": f"/dev/video2{half}"}) == f"camera 2{half}"


def test_a_camera_whose_name_is_no_text_has_a_profile(folder):
    titles = {"camera": os.fsdecode(b"caf\xe9")}
    path = known_path("anna", titles)
    write_profile(path, Profile(person="anna", camera=camera_key(titles)))
    assert known_path("anna", titles) == path
    assert read_profile(path).camera == "caf\\udce9"
    assert path != known_path("anna", {"camera": os.fsdecode(b"caf\xe8")})


def test_other_cameras_are_other_profiles():
    left, mouth = "http://10.0.0.2:81/" + "a" * 80, "camera 1"
    found = [
        {"left_eye": left, "mouth": mouth},
        {"left_eye": mouth, "mouth": left},
        {"left_eye": left, "right_eye": mouth},
        {"left_eye": left + "b", "mouth": mouth},
    ]
    assert len({profile_path("a", camera_key(titles)) for titles in found}) == len(found)
    assert all(len(profile_path("a", camera_key(titles)).name) < 110 for titles in found)


@pytest.mark.parametrize(
    ("titles", "former"),
    [
        ({"right_eye": "camera 1", "left_eye": "camera 0"}, "anna.camera-1-camera-0.toml"),
        ({"camera": "http://h/" + "a" * 99}, f"anna.http-h-{'a' * 73}.toml"),
        ({"camera": "/dev/video2"}, "anna.dev-video2.toml"),
        ({"camera": "USB摄像头"}, None),
    ],
)
def test_a_profile_of_before_is_found_until_there_is_a_new_one(folder, titles, former):
    new = profile_path("anna", camera_key(titles))
    assert known_path("anna", titles) == new
    if former is not None:
        write_profile(folder / former, Profile(person="anna", camera="x"))
        assert known_path("anna", titles) == folder / former
    write_profile(new, Profile(person="anna", camera="x"))
    assert known_path("anna", titles) == new
    assert known_path("here/p.toml", titles).name == "p.toml"


@pytest.mark.parametrize("command", [["list"], ["show", "eve"]])
def test_a_profile_writes_nothing_to_the_terminal_but_text(folder, command):
    """A title of the window, or what else a terminal would act on."""
    write_profile(folder / "eve.x.toml", Profile(person="eve", camera="\x1b]0;yours\x07camera \x9b31m"))
    done = CliRunner().invoke(app, ["profiles", *command])
    assert done.exit_code == 0
    assert "camera" in done.stdout
    assert not {"\x1b", "\x07", "\x9b"} & set(done.stdout)


def test_stored_profiles_are_found_by_their_person(folder):
    assert stored_profiles() == {}
    with pytest.raises(InputError, match="no profile 'anna'"):
        stored_path("anna")
    for camera in ("camera 0", "camera 1"):
        write_profile(profile_path("anna", camera), Profile(person="anna", camera=camera))
    write_profile(profile_path("ben", "camera 0"), Profile(person="ben", camera="camera 0"))
    (folder / "broken.toml").write_text("x = [")
    found = stored_profiles()
    assert list(found) == ["anna.camera-0", "anna.camera-1", "ben.camera-0", "broken"]
    assert [name for name, profile in found.items() if profile is None] == ["broken"]
    assert stored_path("ben") == folder / "ben.camera-0.toml"
    with pytest.raises(InputError, match="2 profiles"):
        stored_path("anna")


def test_blinks_are_listed_and_shown(folder):
    blinks = {"eyeBlinkLeft": Ends(open=0.1, full=0.55)}
    write_profile(folder / "anna.x.toml", Profile(person="anna", camera="x", blinks=blinks))
    listed, shown = (
        CliRunner().invoke(app, ["profiles", *words]).stdout for words in (["list"], ["show", "anna"])
    )
    assert listed.split() == ["anna.x", "x", "blinks"]
    assert shown.splitlines()[1].split() == ["blink", "eyeBlinkLeft", "0.55", "(open", "0.10)"]


def test_of_a_damaged_profile_it_is_said_what_removes_it(folder):
    (folder / "anna.x.toml").write_text("x = [")
    listed, shown = (CliRunner().invoke(app, ["profiles", *words]) for words in (["list"], ["show", "anna"]))
    for told in (listed.stdout, str(shown.exception)):
        assert "`track profiles delete anna.x` removes it" in told


def test_a_file_that_is_no_profile_is_not_deleted(folder):
    other = folder / "pyproject.toml"
    other.write_text('[project]\nname = "mine"\n')
    with pytest.raises(InputError, match=r"unknown key 'project'.*is not deleted"):
        disposable_path(str(other))
    done = CliRunner().invoke(app, ["profiles", "delete", str(other)])
    assert done.exit_code != 0
    assert other.read_text() == '[project]\nname = "mine"\n'


def test_profiles_are_deleted_by_name_even_where_they_are_damaged_and_by_file_where_they_are_whole(folder):
    (folder / "anna.x.toml").write_text("x = [")
    write_profile(folder / "ben.x.toml", Profile(person="ben", camera="x"))
    for name in ("anna.x", str(folder / "ben.x.toml")):
        assert CliRunner().invoke(app, ["profiles", "delete", name]).exit_code == 0
    assert list(folder.iterdir()) == []

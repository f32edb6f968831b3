"""A guided minute: own ends of ranges from takes of faces, as `calibrate` writes and `predict --person` takes them."""

import json
import shutil
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.formats.film import encode_film
from regress.cli import app
from regress.errors import InputError
from regress.runtime.headset.guided import minute
from regress.runtime.headset.guided.gaze import HALF_APART_M
from regress.runtime.headset.person.person import (
    FULL_GAIN,
    OwnEnds,
    OwnEye,
    Person,
    kept_openness,
    packed_picture,
    read_person,
    seen_as,
    write_person,
)
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.sample import EyeMeasures

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
CAMERAS = [
    word
    for name in ("left_eye", "right_eye", "mouth")
    for word in (f"--{name.replace('_', '-')}", TAKE / name)
]
SHUT, REST = "90-93", "0-9"
"""Frames of the sample in which both eyes are shut, and of a face at rest."""
BLINKS = ["eyeBlinkLeft", "eyeBlinkRight"]


def eyes_of(openness: tuple[float, float]) -> EyeMeasures:
    return EyeMeasures(openness_mm=np.full(2, 5.0), openness=np.array(openness), pupil=np.full(2, 0.4))


readings = st.dictionaries(st.sampled_from(BLENDSHAPES), st.floats(0, 0.4), max_size=20)


@given(readings, readings, st.floats(0, 1))
def test_rest_reads_nothing_own_full_movements_read_one_and_order_stays(rest, spans, lids):
    full = {name: min(rest.get(name, 0.0) + 0.3 + span, 1.0) for name, span in spans.items()}
    ends = OwnEnds(rest, full, np.full(2, lids))
    at_rest = np.array([rest.get(name, 0.0) for name in BLENDSHAPES])
    np.testing.assert_allclose(ends.apply(at_rest, eyes_of((1.0, 1.2))), 0, atol=1e-9)
    moved = np.array([full.get(name, 1.0) for name in BLENDSHAPES])
    read = ends.apply(moved, eyes_of((0.0, 0.0)))
    span = moved - at_rest
    whole = np.flatnonzero((span >= (1 - at_rest) / FULL_GAIN) | np.isin(BLENDSHAPES, BLINKS))
    np.testing.assert_allclose(read[whole], 1)
    # shorter ranges are stretched by no more than that
    others = ~np.isin(BLENDSHAPES, BLINKS)
    assert (read <= FULL_GAIN * span / (1 - at_rest) + 1e-9)[others].all()
    halfway = ends.apply((at_rest + moved) / 2, None)
    assert (halfway <= ends.apply(moved, None) + 1e-12).all()


def test_lids_say_what_the_network_does_not_and_a_lost_camera_says_nothing():
    ends = OwnEnds({}, {}, np.array([1.0, 1.0]))
    said = ends.apply(np.zeros(52), eyes_of((0.05, np.nan)))
    assert said[BLENDSHAPE_INDEX["eyeBlinkLeft"]] == pytest.approx(0.95)
    assert said[BLENDSHAPE_INDEX["eyeBlinkRight"]] == 0
    assert np.isnan(ends.apply(np.full(52, np.nan), None)).all()
    assert np.isnan(OwnEye(rest_mm=8.0).openness(4.0))
    assert OwnEye(rest_mm=8.0, shut_mm=2.0).openness(5.0) == 0.5


@given(st.floats(-100, 100))
def test_a_distance_of_lids_that_is_kept_is_taken_back(tmp_path_factory, openness_mm: float):
    path = tmp_path_factory.mktemp("kept") / "anna.json"
    eye = OwnEye(rest_mm=kept_openness(openness_mm))
    write_person(path, Person(eyes={"left_eye": eye}))
    assert read_person(path).eyes == {"left_eye": eye}


@pytest.fixture(scope="module")
def person(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("person") / "anna.json"
    words = ["headset", "calibrate", *CAMERAS, "--rest", REST, "--shut", SHUT, "--out", path]
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.output
    return path


def test_calibrate_is_told_of_the_cameras_that_predict_is_told_of(run, tmp_path: Path):
    """Ends of ranges are those of the network that will read them: rest reads nothing then."""
    told, files = ("--headset", "tracking3"), {}
    for name, words in (("told", told), ("untold", ())):
        files[name] = tmp_path / f"{name}.json"
        options = [*CAMERAS, *words, "--rest", REST, "--jaw-open", SHUT, "--out", files[name]]
        code, _, said = run("headset", "calibrate", "headset-any", *options)
        assert code == 0, said
    rests = {name: read_person(path).rest for name, path in files.items()}
    assert rests["told"] != rests["untold"]
    words = ["headset", "predict", "headset-any", *CAMERAS, "--out", tmp_path / "w.csv"]
    residue = {}
    for name, path in files.items():
        code, _, said = run(*words, *told, "--person", path)
        assert code == 0
        assert ("was made with another --placement or --headset" in said) == (name == "untold")
        table = np.genfromtxt(tmp_path / "w.csv", delimiter=",", names=True)
        at_rest = np.array([table[name][:10] for name in BLENDSHAPES if not name.startswith("eyeLook")])
        residue[name] = np.median(at_rest, axis=1).max()
    assert residue["told"] < residue["untold"]


def test_where_one_looks_at_rest_is_ones_own(run, tmp_path: Path, monkeypatch):
    """In these frames a look reads most, and no face is refused for it."""
    monkeypatch.setattr(minute, "HIGHEST_REST", 0.0)
    code, _, said = run("headset", "calibrate", *CAMERAS, "--rest", "20-29", "--out", tmp_path / "anna.json")
    assert code == 2
    assert "is a resting face" in said
    assert "eyeLook" not in said


@pytest.mark.parametrize("high", [1, 2, 4])
def test_a_few_shapes_that_read_high_at_rest_count_as_rest_and_are_named(
    run, tmp_path: Path, person: Path, monkeypatch, high: int
):
    at_rest = sorted(read_person(person).rest.items(), key=lambda pair: -pair[1])
    assert not any(name in BLINKS for name, _ in at_rest[:4])
    monkeypatch.setattr(minute, "HIGHEST_REST", (at_rest[high - 1][1] + at_rest[high][1]) / 2)
    out = tmp_path / "anna.json"
    code, _, said = run("headset", "calibrate", *CAMERAS, "--rest", REST, "--out", out)
    assert code == 0, said
    named = [name for name, _ in at_rest if f"rest: the network reads {name} " in said]
    assert set(named) == {name for name, _ in at_rest[:high]}
    assert "it counts as rest" in said


@pytest.mark.parametrize("reading", [0.55, 0.66, 0.9])
def test_what_reads_high_at_rest_reads_nothing_behind_the_minute(tmp_path: Path, reading: float):
    own = Person(rest={"mouthSmileLeft": reading})
    write_person(tmp_path / "anna.json", own)
    ends = OwnEnds.of(read_person(tmp_path / "anna.json"), {})
    weights = np.zeros(52)
    column = BLENDSHAPE_INDEX["mouthSmileLeft"]
    weights[column] = reading
    assert ends.apply(weights, None)[column] == 0
    weights[column] = 1.0
    assert ends.apply(weights, None)[column] == 1


def weights_of(run, tmp_path: Path, *options: object) -> np.ndarray:
    table = tmp_path / "w.csv"
    code, _, said = run("headset", "predict", *CAMERAS, "--out", table, *options)
    assert code == 0, said
    return np.genfromtxt(table, delimiter=",", names=True)


def test_shut_is_one_rest_is_nothing_and_the_table_has_eyes(run, tmp_path: Path, person: Path):
    before = weights_of(run, tmp_path)
    after = weights_of(run, tmp_path, "--person", person)
    for side in ("Left", "Right"):
        blink = after[f"eyeBlink{side}"]
        assert np.median(blink[90:94]) >= 0.9
        assert np.median(blink[:10]) <= 0.05
        assert np.corrcoef(blink, before[f"eyeBlink{side}"])[0, 1] > 0.9
    rest = np.array([[after[name][row] for name in BLENDSHAPES if "Look" not in name] for row in range(10)])
    assert np.median(rest, axis=0).max() <= 0.05
    for side in ("left", "right"):
        openness = after[f"{side}_eye_openness"]
        assert np.median(openness[:10]) == pytest.approx(1, abs=0.1)
        assert np.nanmax(openness[90:94]) < 0.3
        pupil = after[f"{side}_eye_pupil"]
        assert 0.2 < np.nanmedian(pupil) < 0.8
    vergence = after["right_eye_yaw_deg"] - after["left_eye_yaw_deg"]
    assert vergence.min() >= -1e-4  # six decimals of degrees
    assert "left_eye_openness" not in (before.dtype.names or ())


def test_a_persons_file_is_read_as_it_was_written(person: Path, tmp_path: Path):
    own = read_person(person)
    write_person(tmp_path / "again.json", own)
    assert (tmp_path / "again.json").read_bytes() == person.read_bytes()
    assert set(own.neutral) == {"left_eye", "right_eye", "mouth"}
    assert own.full["eyeBlinkLeft"] > 0.6


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"rest": {"jawOpen": 0.95}}, "jawOpen"),
        ({"rest": {"jaw": 0.1}}, "'jaw' is not one of the 52 ARKit names"),
        ({"eyes": {"left_eye": {"rest_mm": -1}}}, "rest_mm"),
        ({"eyes": {"third_eye": {}}}, "the model has no camera 'third_eye'"),
        (
            {"neutral": {"left_eye": "none", "right_eye": "", "mouth": ""}},
            "the neutral picture of left_eye of --person is none",
        ),
        ({"network_sha256": "0" * 64}, "another network"),
        ({"more": 1}, "more"),
        ({"version": 3}, "version"),
    ],
)
def test_files_of_other_things_are_refused(run, tmp_path: Path, person: Path, change: dict, said: str):
    damaged = tmp_path / "damaged.json"
    damaged.write_text(json.dumps(json.loads(person.read_text()) | change))
    code, _, told = run("headset", "predict", *CAMERAS, "--out", tmp_path / "w.csv", "--person", damaged)
    assert (code, said in told) == (2, True), told
    assert not (tmp_path / "w.csv").exists()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--shut", SHUT], "--rest is needed"),
        (["--rest", SHUT], "eyeBlink"),
        (["--rest", "900-950"], "--rest 900-950: the take has frames 0-99"),
        (["--rest", "9-0"], "--rest 9-0: 9-0 runs backwards; write 0-9"),
        (["--rest", "0-5000"], "--rest 0-5000: the take has frames 0-99"),
        (["--rest", "nowhere"], "no folder with left_eye"),
        (["--rest", REST, "--looked-at", "3:0:0"], "give --look too"),
        (["--rest", REST, "--look", REST, "--looked-at", "30:0:0"], "no frame of --look has this number"),
    ],
)
def test_a_minute_that_is_none_is_refused(run, tmp_path: Path, options: list[str], said: str):
    out = tmp_path / "anna.json"
    code, _, told = run("headset", "calibrate", *CAMERAS, *options, "--out", out)
    assert (code, said in told) == (2, True), told
    assert not out.exists()


def test_folders_of_faces_are_takes_and_what_is_not_seen_is_said(run, tmp_path: Path):
    for face, numbers in (("rest", range(4)), ("shut", range(4, 8))):
        for camera in ("left_eye", "right_eye", "mouth"):
            folder = tmp_path / face / camera
            folder.mkdir(parents=True)
            for path in sorted((TAKE / camera).iterdir())[numbers.start : numbers.stop]:
                (folder / path.name).write_bytes(path.read_bytes())
    out = tmp_path / "anna.json"
    code, _, said = run(
        "headset", "calibrate", "--rest", tmp_path / "rest", "--shut", tmp_path / "shut", "--out", out
    )
    assert code == 0, said
    # the eyes were open: nothing is made of it
    assert "its range stays as it is" in said
    assert f"{out}: only the face at rest was learned from" in said
    assert read_person(out).full == {}
    assert all(eye.shut_mm is None and eye.lids == 0 for eye in read_person(out).eyes.values())


def test_a_table_beside_a_film_is_no_film_and_two_films_are_asked_about(run, tmp_path: Path):
    folder = tmp_path / "rest"
    folder.mkdir()
    frames = (
        cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) for path in sorted((TAKE / "left_eye").iterdir())[:5]
    )
    encode_film(
        folder / "left_eye.mp4", (cv2.cvtColor(frame, cv2.COLOR_GRAY2BGR) for frame in frames), fps=30
    )
    (folder / "left_eye.csv").write_text("frame,time_s\n")
    words = ["headset", "calibrate", "--rest", folder, "--out", tmp_path / "anna.json"]
    code, _, said = run(*words)
    assert code == 0, said
    shutil.copy(folder / "left_eye.mp4", folder / "left_eye.avi")
    code, _, said = run(*words)
    assert (code, "left_eye.avi and left_eye.mp4 are of one camera; keep one" in said) == (2, True), said


def test_cameras_that_count_for_themselves_are_calibrated_from_the_start(run, tmp_path: Path):
    for camera, first in (("left_eye", 0), ("mouth", 1000)):
        folder = tmp_path / "rest" / camera
        folder.mkdir(parents=True)
        for number, path in enumerate(sorted((TAKE / camera).iterdir())[:4]):
            (folder / f"{first + number}.png").write_bytes(path.read_bytes())
    words = ["headset", "calibrate", "--rest", tmp_path / "rest", "--out", tmp_path / "anna.json"]
    code, _, said = run(*words)
    assert (code, "--from-start" in said) == (2, True), said
    code, _, said = run(*words, "--from-start")
    assert code == 0, said


def test_a_neutral_picture_that_no_file_holds_is_told(tmp_path: Path):
    noise = np.random.default_rng(0).integers(0, 256, (800, 600), dtype=np.uint8)
    with pytest.raises(
        InputError, match=r"the neutral picture of mouth takes .* a network of smaller pictures"
    ):
        write_person(tmp_path / "anna.json", Person(neutral={"mouth": packed_picture(noise)}))
    assert not (tmp_path / "anna.json").exists()


@pytest.mark.parametrize("face", ["shut", "look"])
def test_an_eye_that_a_face_s_takes_lack_stays_as_it_is(face: str, run, tmp_path: Path):
    for each, numbers in (("rest", range(4)), ("shut", range(4, 8)), ("look", range(8, 12))):
        for camera in ("left_eye", "right_eye"):
            folder = tmp_path / each / camera
            folder.mkdir(parents=True)
            for path in sorted((TAKE / camera).iterdir())[numbers.start : numbers.stop]:
                (folder / path.name).write_bytes(path.read_bytes())
    shutil.rmtree(tmp_path / face / "right_eye")
    out = tmp_path / "anna.json"
    words = [word for each in ("rest", "shut", "look") for word in (f"--{each}", tmp_path / each)]
    code, _, said = run("headset", "calibrate", *words, "--out", out)
    assert code == 0, said
    person = read_person(out)
    right = person.eyes["right_eye"]
    assert right.rest_mm is not None
    assert (right.shut_mm, right.traced is None) == (None, face == "look")


def test_a_gaze_is_told_and_one_of_other_targets_is_asked_about(run, tmp_path: Path):
    words = [
        "headset",
        "calibrate",
        *CAMERAS,
        "--rest",
        REST,
        "--look",
        "10-80",
        "--out",
        tmp_path / "p.json",
    ]
    code, _, said = run(*words)
    assert (code, "gaze of left_eye is centred, gaze of right_eye is centred" in said) == (0, True), said
    wrong = ["12:30:20", "20:-30:-20", "35:30:-20", "50:-30:20", "65:0:0"]
    code, _, said = run(*words, *(word for each in wrong for word in ("--looked-at", each)))
    assert code == 0, said
    off_deg = read_person(tmp_path / "p.json").eyes["left_eye"].error_deg
    assert off_deg > 8
    assert f"look: left_eye is off its targets by {off_deg:.0f} degrees even so" in said
    assert f"gaze of left_eye is off its targets by {off_deg:.1f} degrees" in said


def test_near_targets_turn_both_eyes_inwards(run, tmp_path: Path):
    """How far away they lie decides where each eye must look; far is what nobody has to say."""
    targets = (word for each in ("10:0:0", "40:0:0", "70:0:0") for word in ("--looked-at", each))
    words = ["headset", "calibrate", *CAMERAS, "--rest", REST, "--look", "10-80", *targets]
    eyes = {}
    for name, more in (("unsaid", ()), ("far", ("--distance-m", 1000)), ("near", ("--distance-m", 0.3))):
        code, _, said = run(*words, *more, "--out", tmp_path / f"{name}.json")
        assert code == 0, said
        eyes[name] = read_person(tmp_path / f"{name}.json").eyes
    inward_deg = np.degrees(np.arctan(HALF_APART_M / 0.3))
    for camera, sign in (("left_eye", -1), ("right_eye", 1)):
        (*_, far_deg), pitch = eyes["far"][camera].traced
        (*_, near_deg), same_pitch = eyes["near"][camera].traced
        assert near_deg - far_deg == pytest.approx(sign * inward_deg, abs=0.01)
        assert pitch == pytest.approx(same_pitch)
    assert eyes["unsaid"] == eyes["far"]
    code, _, said = run(*words, "--distance-m", 0, "--out", tmp_path / "no.json")
    assert code == 2
    assert "--distance-m" in said


def test_a_person_without_anything_changes_nothing():
    weights = np.linspace(0, 1, 52)
    np.testing.assert_allclose(OwnEnds.of(Person(), {}).apply(weights, None), weights)
    with pytest.raises(InputError, match=r"nowhere\.json"):
        read_person("nowhere.json")


def test_a_placement_is_looked_through_and_another_models_is_refused(run, tmp_path: Path, person: Path):
    words = ["headset", "calibrate", *CAMERAS, "--rest", REST, "--shut", SHUT, "--out", tmp_path / "p.json"]
    place = tmp_path / "placement.toml"
    place.write_text("version = 1\n[cameras.left_eye]\nsize = 0.8\nlow = 20.0\nhigh = 200.0\n")
    code, _, said = run(*words, "--placement", place)
    assert code == 0, said
    assert read_person(tmp_path / "p.json").neutral["left_eye"] != read_person(person).neutral["left_eye"]
    for more, otherwise in ((("--placement", place), False), ((), True)):
        predict = (
            "headset",
            "predict",
            *CAMERAS,
            "--person",
            tmp_path / "p.json",
            "--out",
            tmp_path / "w.csv",
        )
        code, _, said = run(*predict, *more)
        assert code == 0, said
        assert ("was made with another --placement or --headset" in said) == otherwise
    (tmp_path / "w.csv").unlink()
    place.write_text(f'headset = "drawn"\n{place.read_text()}')
    for order in (words, ["headset", "predict", *CAMERAS, "--out", tmp_path / "w.csv"]):
        code, _, said = run(*order, "--placement", place)
        assert (code, said.count("\n"), "found with another network" in said) == (2, 1, True), said
    assert not (tmp_path / "w.csv").exists()


@pytest.mark.parametrize("other", [{"stretch": 2.0}, {"cut": (0.0, 0.1, 0.0, 0.1)}])
def test_a_person_knows_of_stretch_and_cut_and_older_files_still_fit(other: dict):
    plain = {"left_eye": CameraPlacement(x=0.4)}
    changed = {"left_eye": CameraPlacement(x=0.4, **other)}
    assert seen_as(changed, None) != seen_as(plain, None)
    # as persons' files have it that were written before placements had a stretch and a cut
    assert seen_as(plain, None).startswith("b12c293bc702df7f")

"""A headset's session: neutral pictures through the profile, and what the network traces, for the page."""

import base64
import csv
import itertools
import struct
import zlib
from dataclasses import replace

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.runtime.headset.person.person import OwnEye
from regress.runtime.sample import EyeMeasures, Sample
from regress.runtime.writers.csv_table import EYE_COLUMNS
from tests.track.session.test_chaos import FPS, HEADSET, headset_frames, headset_session
from track.errors import InputError
from track.messages import Command
from track.profile.neutral import NeutralFace
from track.profile.profile import Profile, read_profile, write_profile
from track.session.ranges import Ranges, by_lids
from track.session.showing import Outcome
from track.sinks.targets import open_sink, parse_target


def _chunk(name: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


HUGE = base64.b64encode(
    b"\x89PNG\r\n\x1a\n"
    + _chunk(b"IHDR", struct.pack(">IIBBBBB", 20_000, 20_000, 8, 0, 0, 0, 0))
    + _chunk(b"IDAT", zlib.compress(bytes(20_001 * 100)))
    + _chunk(b"IEND", b"")
).decode()
"""A picture of some kB that wants 0.4 GB."""


def test_a_neutral_face_is_the_same_after_a_profile_s_file(tmp_path):
    """PNG loses nothing, so answers are equal to the last digit."""
    plain = headset_session()
    stored = read_profile(write_profile(tmp_path / "p.toml", plain.profile))
    assert stored == plain.profile
    other = headset_session()
    other.pipeline.use_neutral(stored.neutral)
    for sample in headset_frames()[:20]:
        plain.answer(sample)
        other.answer(sample)
    np.testing.assert_array_equal(plain.sinks[0].weights, other.sinks[0].weights)


def test_a_recording_s_columns_stay_where_no_picture_comes(tmp_path):
    """Before the first picture, and between two: openness and pupils have cells there too, which are empty."""
    session = headset_session()
    session.sinks.append(open_sink(parse_target(f"csv:{tmp_path / 'a.csv'}"), pytest.fail))
    nothing = Sample(time_s=-0.1, pictures={})
    for sample in (nothing, *headset_frames()[:3], replace(nothing, time_s=0.5)):
        session.answer(sample)
    session.close()
    with open(tmp_path / "a.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert {len(row) for row in rows} == {len(rows[0])}
    eyes = [rows[0].index(name) for name in EYE_COLUMNS]
    assert [all(row[column] for column in eyes) for row in rows[1:]] == [False, True, True, True, False]


def test_points_are_traced_where_somebody_looks():
    session = headset_session()
    first = session.answer(headset_frames()[0])[0]
    assert session.moment(first).points == {}
    session.ask(Command(verb="picture", value=True))
    second = session.answer(headset_frames()[1])[0]
    moment = session.moment(second)
    assert set(moment.points) == set(moment.pictures) == set(HEADSET)
    for name, points in moment.points.items():
        height, width = moment.pictures[name].shape
        inside = ((points > -5) & (points < [width + 5, height + 5])).all(axis=1)
        assert inside.mean() > 0.9


@pytest.mark.parametrize("ends", ["failed", "cancelled"])
def test_a_neutral_face_that_is_not_found_leaves_the_known_one(ends):
    clock = itertools.count(1)
    session, calibrated = headset_session(), headset_session()
    shut = headset_frames()[90]
    session.ask(Command(verb="calibrate", value="neutral"))
    session.answer(replace(shut, time_s=0.0))
    assert session.adjusting.calibrating
    if ends == "cancelled":
        session.ask(Command(verb="cancel"))
    while session.adjusting.calibrating:  # by pictures that come once in two seconds
        session.answer(replace(shut, time_s=2.0 * next(clock)))
    assert session.adjusting.step.state == ends
    start_s = 2.0 * next(clock)
    for row in range(2 * FPS):
        sample = replace(shut, time_s=start_s + row / FPS)
        answers = [each.answer(sample)[0].weights for each in (session, calibrated)]
    np.testing.assert_allclose(*answers, atol=1e-3)


@pytest.mark.parametrize("first", ["all", "neutral"])
def test_a_calibration_in_place_of_one_that_still_runs_has_the_known_neutral_face(first):
    session, calibrated = headset_session(), headset_session()
    for row, sample in enumerate(headset_frames()[90 : 90 + 2 * FPS]):
        if row < 2:
            session.ask(Command(verb="calibrate", value=(first, "pucker")[row]))
        answers = [each.answer(sample)[0].weights for each in (session, calibrated)]
    assert session.adjusting.step.name == "pucker"
    np.testing.assert_allclose(*answers, atol=1e-3)


@pytest.mark.parametrize(
    ("neutral", "words"),
    [
        (NeutralFace(detector="mediapipe"), "takes a headset's pictures"),
        (NeutralFace(pictures={"chin": "AAAA"}), "no neutral picture of left_eye, right_eye, mouth"),
        (
            NeutralFace(pictures=dict.fromkeys(HEADSET, "AAAAA")),
            "left_eye of the profile is none, and the model",
        ),
        (NeutralFace(pictures=dict.fromkeys(HEADSET, "é")), "left_eye of the profile is none, and the model"),
        (
            NeutralFace(pictures=dict.fromkeys(HEADSET, HUGE)),
            "left_eye of the profile is 20000 x 20000, and the model",
        ),
        (
            NeutralFace(pictures=dict.fromkeys(HEADSET, "AAAA")),
            "left_eye of the profile is none, and the model takes 96 x 96",
        ),
    ],
)
def test_a_neutral_face_of_something_else_is_refused(neutral, words):
    with pytest.raises(InputError, match=words):
        headset_session().pipeline.use_neutral(neutral)


def test_a_guided_minute_gives_rest_ends_lids_and_a_new_seat_keeps_them(tmp_path):
    session = headset_session()
    frames = headset_frames()
    shut = [frames[row] for row in (90, 91, 92, 93)]
    rest = list(frames[:10])

    clock = itertools.count()

    def later(samples):
        return [replace(sample, time_s=next(clock) / FPS) for sample in samples]

    def answered(samples):
        found = []
        for sample in later(samples):
            for stage in session.pipeline.stages.values():
                sample = stage.step(sample)
            found.append(sample)
        return tuple(found)

    session.adjusting.take(Outcome(name="neutral", samples=answered(rest)))
    session.adjusting.take(
        Outcome(name="eyes_shut", samples=answered(shut), ranges={"eyeBlinkLeft": 0.9, "eyeBlinkRight": 0.9})
    )
    session.adjusting.take(Outcome(name="look_around", samples=answered(rest), ranges={}))
    profile = read_profile(write_profile(tmp_path / "anna.toml", session.profile))
    assert profile == session.profile
    assert set(profile.eyes) == {"left_eye", "right_eye"}
    assert all(0 < eye.shut_mm < 0.5 * eye.rest_mm for eye in profile.eyes.values())
    assert profile.gaze is not None
    assert not any(name.startswith("eyeLook") for name in profile.rests)
    at_rest = [session.answer(sample)[0] for sample in later(rest)]
    looks = np.array([name.startswith("eyeLook") for name in BLENDSHAPES])
    assert np.median([each.weights for each in at_rest], axis=0)[~looks].max() <= 0.05
    assert np.median([each.eyes.openness for each in at_rest]) == pytest.approx(1, abs=0.1)
    closed = [session.answer(sample)[0] for sample in later(shut)]
    assert np.max([each.eyes.openness for each in closed[1:]]) < 0.3
    # the same person in another seat: the neutral face is new, own full movements stay
    session.adjusting.take(Outcome(name="neutral", samples=answered(rest)))
    assert session.profile.ranges == profile.ranges


def test_a_blink_that_the_network_does_not_read_is_what_lids_say():
    eyes = {"left_eye": OwnEye(rest_mm=9.0, shut_mm=1.0), "right_eye": OwnEye(rest_mm=9.0, shut_mm=8.0)}
    profile = Profile(person="anna", camera="three", eyes=eyes)
    np.testing.assert_array_equal(by_lids(profile), [True, False])
    seen = Sample(
        weights=np.zeros(52),
        eyes=EyeMeasures(openness_mm=np.ones(2), openness=np.array([0.1, 0.1]), pupil=np.full(2, 0.4)),
    )
    said = Ranges(profile.factors(), profile.at_rest(), by_lids(profile)).step(seen).weights
    assert said[BLENDSHAPES.index("eyeBlinkLeft")] == pytest.approx(0.9)
    assert said[BLENDSHAPES.index("eyeBlinkRight")] == 0
    assert not by_lids(profile.model_copy(update={"ranges": {"eyeBlinkLeft": 0.8}})).any()


@pytest.mark.parametrize("spelled", ["left_eye", "eye_l", "eye_left", "lefteye", "l_eye"])
def test_lids_are_of_the_side_that_a_camera_s_name_says(spelled):
    """However it is spelled, as networks have it; the other eye's network goes on reading its blink."""
    shut = OwnEye(shut_mm=1.0, rest_mm=10.0)
    other = spelled.replace("left", "right").replace("l_", "r_").replace("_l", "_r")
    profile = Profile(person="anna", camera="eyes", eyes={spelled: shut, other: OwnEye(rest_mm=10.0)})
    np.testing.assert_array_equal(by_lids(profile), [True, False])
    np.testing.assert_array_equal(by_lids(profile.model_copy(update={"eyes": {other: shut}})), [False, True])


def test_a_slow_cameras_picture_stays_the_same_array_in_grey():
    """By that one that stands is told from one that hangs, of cameras in colour too."""
    stage = headset_session().pipeline.stages["grey"]
    colour = np.random.default_rng(0).integers(0, 255, (96, 96, 3), dtype=np.uint8)
    grey = [
        stage.step(Sample(pictures={"mouth": picture}, time_s=0.0)).pictures["mouth"]
        for picture in (colour, colour, colour.copy())
    ]
    assert grey[0].ndim == 2
    assert grey[0] is grey[1]
    assert grey[2] is not grey[1]


def test_bars_are_told_once_beside_what_else_is_to_be_said():
    """A program between camera and `track` puts them there, and all of a picture is then half of a face."""
    said = []
    session = headset_session(said)
    for sample in headset_frames()[:60]:
        barred = {name: np.pad(picture, ((16, 16), (0, 0))) for name, picture in sample.pictures.items()}
        session.answer(replace(sample, pictures=barred))
    for name in HEADSET:
        (told,) = [line for line in said if line.startswith(f"{name}: its pictures have bars")]
        assert "--placement" in told
        shape = [line for line in said if line.startswith(f"{name}: ") and "another shape than" in line]
        assert len(shape) == 1, "which the bars make it"


def test_pictures_that_are_not_square_are_seen_whole_and_told_once():
    """Most webcams give 4 : 3, and nobody has placed one at the first start."""
    said = []
    session = headset_session(said)
    for sample in headset_frames()[:60]:
        wide = {
            name: np.pad(picture, ((0, 0), (16, 16)), mode="edge")
            for name, picture in sample.pictures.items()
        }
        session.answer(replace(sample, pictures=wide))
    assert all(sample.weights is not None for sample in session.sinks[0].samples)
    for name in HEADSET:
        (told,) = [line for line in said if line.startswith(f"{name}: ")]
        assert told.startswith(
            f"{name}: 128x96 is another shape than the network's; all of each picture is seen"
        )

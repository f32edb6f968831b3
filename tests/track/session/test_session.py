"""A session over a talking face: answers, commands, calibration, profiles."""

import threading
import weakref
from contextlib import suppress
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from threadpoolctl import threadpool_info

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.heads.fit import FACING
from regress.runtime.model import load_model
from regress.runtime.ready_made import model_folder
from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import LOOKS, look_weights
from regress.runtime.stages.head import angles_of
from regress.runtime.stages.stage import Chain, Stage
from tests.track.session.faces import Given, Kept, calibrated_profile, frames, new_session, talking_face
from track.errors import InputError, OutputError
from track.messages import Command
from track.profile.neutral import NeutralFace, lines_of
from track.profile.profile import Profile
from track.session.gaze import poses_of
from track.session.ranges import HeadCentre
from track.sinks.recording import Recording, free_names
from track.sinks.tables import open_take

NOISE = np.random.default_rng(0).normal(size=(68, 2))


def test_answers_without_a_filter_are_those_of_predict():
    session = new_session(filter_name="none", profile=calibrated_profile())
    for sample in frames(0, 300):
        session.answer(sample)
    (kept,) = session.sinks
    neutral = session.profile.neutral.frames("points")
    model = load_model(model_folder("landmarks-default")).calibrate(neutral)
    expected = model.predict(talking_face().points[:300])
    back = 8  # frames that the face is faded to at first
    looks = [index for name, index in BLENDSHAPE_INDEX.items() if name.startswith("eyeLook")]
    others = np.setdiff1d(np.arange(52), looks)
    np.testing.assert_allclose(kept.weights[back:, others], expected[back:, others], atol=2e-5)


def test_the_mirror_exchanges_sides_and_the_profile_remembers():
    stored: list[Profile] = []
    plain, mirrored = new_session(filter_name="none"), new_session(filter_name="none", keep=stored.append)
    mirrored.ask(Command(verb="mirror", value=True))
    for sample in frames(100, 140):
        plain.answer(sample)
        mirrored.answer(sample)
    left, right = BLENDSHAPE_INDEX["mouthSmileLeft"], BLENDSHAPE_INDEX["mouthSmileRight"]
    np.testing.assert_allclose(plain.sinks[0].weights[:, left], mirrored.sinks[0].weights[:, right])
    assert stored[-1].mirror


def test_a_gain_multiplies_and_ends_at_one():
    plain, louder = (new_session(filter_name="none", profile=calibrated_profile()) for _ in range(2))
    louder.ask(Command(verb="gain", shape="jawOpen", value=1.7))
    for sample in frames(0, 400):
        plain.answer(sample)
        louder.answer(sample)
    jaw = BLENDSHAPE_INDEX["jawOpen"]
    expected = np.minimum(plain.sinks[0].weights[30:, jaw] * 1.7, 1)
    np.testing.assert_allclose(louder.sinks[0].weights[30:, jaw], expected, atol=1e-9)
    assert plain.sinks[0].weights[:, jaw].max() > 0.2


def test_a_gain_is_that_of_the_side_that_is_seen():
    """Behind a mirror the page shows the person's right smile as the left one, whose slider it is."""
    stored: list[Profile] = []
    seen, louder = (
        new_session(filter_name="none", profile=calibrated_profile(), mirror=True, keep=stored.append)
        for _ in range(2)
    )
    louder.ask(Command(verb="gain", shape="mouthSmileLeft", value=1.7))
    louder.ask(Command(verb="gain", shape="jawOpen", value=0.5))
    for sample in frames(0, 400):
        seen.answer(sample)
        louder.answer(sample)
    expected = seen.sinks[0].weights[30:]
    expected[:, BLENDSHAPE_INDEX["mouthSmileLeft"]] *= 1.7
    expected[:, BLENDSHAPE_INDEX["jawOpen"]] *= 0.5
    np.testing.assert_allclose(louder.sinks[0].weights[30:], np.minimum(expected, 1), atol=1e-9)
    answer = louder.sinks[0].samples[-1]
    assert louder.moment(answer).settings["gains"] == {"mouthSmileLeft": 1.7, "jawOpen": 0.5}
    assert stored[-1].gains == {"mouthSmileRight": 1.7, "jawOpen": 0.5}
    louder.ask(Command(verb="mirror", value=False))
    louder.answer(sample)
    assert louder.moment(answer).settings["gains"] == {"mouthSmileRight": 1.7, "jawOpen": 0.5}


def test_calibration_finds_the_neutral_face_and_keeps_it():
    stored: list[Profile] = []
    said: list[str] = []
    session = new_session(said=said, keep=stored.append)
    session.ask(Command(verb="calibrate", value="neutral"))
    still = frames(0, 60)
    states = []
    time_s = 0.0
    while session.adjusting.step is None or session.adjusting.calibrating:
        sample = still[int(time_s * 30) % 60]
        session.answer(frames_at(sample, time_s))
        states.append(session.adjusting.step.state)
        time_s += 1 / 30
        assert time_s < 20
    assert [state for state, before in zip(states, [None, *states], strict=False) if state != before] == [
        "countdown",
        "recording",
        "done",
    ]
    assert stored[-1].neutral is not None
    assert stored[-1].model == session.pipeline.mark
    assert said == ["calibration: done"]


def test_calibration_by_points_holds_no_pictures_and_keeps_their_size():
    """Sixty of 1920 x 1080 pixels would take 370 MB."""
    session = new_session()
    session.ask(Command(verb="calibrate", value="neutral"))
    still, given, time_s, held = frames(0, 60), [], 0.0, 0
    while session.adjusting.step is None or session.adjusting.calibrating:
        picture = np.zeros((48, 64, 3), np.uint8)
        given.append(weakref.ref(picture))
        sample = frames_at(still[int(time_s * 30) % 60], time_s)
        session.answer(replace(sample, pictures={"camera": picture}))
        session.sinks[0].samples.clear()
        del picture, sample
        held = max(held, sum(each() is not None for each in given))
        time_s += 1 / 30
        assert time_s < 20
    assert held <= 2
    assert session.profile.neutral.picture == (64, 48)


def test_who_moves_is_asked_once_more_and_nothing_is_kept():
    stored: list[Profile] = []
    session = new_session(keep=stored.append)
    session.ask(Command(verb="calibrate", value="neutral"))
    texts = set()
    for sample in frames(120, 900):  # talks all the time
        session.answer(sample)
        step = session.adjusting.step
        if step.state == "again":
            texts.add(step.text)
    assert any(text.startswith("You moved") and text.endswith("once more") for text in texts)
    assert session.adjusting.step.state == "failed"
    assert stored == []


def test_a_blink_does_not_look_away_behind_a_look_that_was_centred():
    """Irises of shut eyes are not known, and 0 less the centre looked up from a camera above the screen."""
    centre = np.array([0.1, -0.2, 0.1, -0.2])
    shut = frames(0, 1)[0]
    points = shut.points.copy()
    for top, low in ((37, 41), (38, 40), (43, 47), (44, 46)):
        points[top] = points[low] = (points[top] + points[low]) / 2
    irises = np.array([points[42:48].mean(axis=0), points[36:42].mean(axis=0)])
    picture = {"camera": np.zeros((480, 640), np.uint8)}
    shut = replace(shut, points=points, irises=irises, pictures=picture)
    for profile in (Profile(person="a", camera="b"), calibrated_profile()):
        session = new_session(filter_name="none", profile=profile.model_copy(update={"gaze": tuple(centre)}))
        for row in range(30):  # what fades in has faded
            answer = session.answer(replace(shut, time_s=row / 30))[0]
        np.testing.assert_allclose(answer.gaze, 0, atol=1e-12)


def test_one_look_is_straight_ahead_from_then_on():
    """Eyes that read 0.2 while they look into the camera read 0 there, and the looks follow."""
    stored: list[Profile] = []
    session = new_session(filter_name="none", keep=stored.append)
    session.pipeline.stages = {"given": Given()}
    looking = replace(frames(0, 1)[0], weights=np.zeros(52), gaze=np.array([0.2, -0.1, 0.2, -0.1]))
    session.ask(Command(verb="recentre"))
    for row in range(60):
        answer = session.answer(replace(looking, time_s=row / 30))[0]
    np.testing.assert_allclose(stored[-1].gaze, [0.2, -0.1, 0.2, -0.1])
    np.testing.assert_allclose(answer.gaze, 0, atol=1e-12)
    aside = replace(looking, time_s=3.0, gaze=looking.gaze + np.array([0.3, 0, 0.3, 0]))
    answer = session.answer(aside)[0]
    np.testing.assert_allclose(answer.weights[LOOKS], look_weights(np.array([0.3, 0, 0.3, 0])), atol=1e-9)


@pytest.mark.parametrize("fps", [10, 30, 120, 200])
def test_a_blink_within_the_look_is_not_straight_ahead(fps: int):
    """Through lids that are shut for .2 s the gaze reads down, at any frame rate."""
    stored: list[Profile] = []
    session = new_session(filter_name="none", keep=stored.append)
    session.pipeline.stages = {"given": Given()}
    looking = replace(frames(0, 1)[0], weights=np.zeros(52), gaze=np.zeros(4))
    session.ask(Command(verb="recentre"))
    for row in range(fps):
        time_s = row / fps
        gaze = np.array([0.0, -0.5, 0.0, -0.5]) if time_s < 0.2 else np.zeros(4)
        session.answer(replace(looking, time_s=time_s, gaze=gaze))
    np.testing.assert_allclose(stored[-1].gaze, 0, atol=1e-12)


angles = st.tuples(*[st.floats(-0.7, 0.7)] * 3).map(np.array)


@given(angles, angles)
def test_a_head_before_a_screen_turns_as_it_does_before_a_camera_there(ahead: np.ndarray, turn: np.ndarray):
    """The camera beside the screen sees every turn behind that of a head which looks at the screen."""
    zeros = np.zeros((2, 3))
    straight, turned = FACING @ poses_of(np.concatenate([zeros, np.stack([ahead, turn])], axis=1)).rotation
    seen = np.concatenate([[0.1, 0.2, 0.6], angles_of(FACING @ straight @ turned[None])[0]])
    shown = HeadCentre(ahead).step(Sample(weights=np.zeros(52), head=seen)).head
    np.testing.assert_allclose(shown, [0.1, 0.2, 0.6, *turn], atol=1e-9)


@pytest.mark.parametrize(
    "gaze", [None, np.array([0.2, -0.1, 0.2, -0.1])], ids=["a head alone", "with a gaze"]
)
def test_one_look_is_straight_ahead_for_the_head_too(gaze: np.ndarray | None):
    stored: list[Profile] = []
    said: list[str] = []
    session = new_session(filter_name="none", keep=stored.append, said=said)
    session.pipeline.stages = {"given": Given()}
    beside = replace(
        frames(0, 1)[0], weights=np.zeros(52), gaze=gaze, head=np.array([0, 0, 0.6, 0.3, -0.2, 0.05])
    )
    session.ask(Command(verb="recentre"))
    for row in range(60):
        answer = session.answer(replace(beside, time_s=row / 30))[0]
    np.testing.assert_allclose(answer.head, [0, 0, 0.6, 0, 0, 0], atol=1e-12)
    np.testing.assert_allclose(stored[-1].head, [0.3, -0.2, 0.05])
    assert (stored[-1].gaze is None) == (gaze is None)
    assert said[-1].startswith("the head is centred" if gaze is None else "the eyes and the head are centred")


def test_the_page_s_recording_is_opened_and_closed():
    made: list[Kept] = []

    def new_recording() -> Kept:
        made.append(Kept())
        return made[-1]

    session = new_session(new_recording=new_recording)
    session.answer(frames(0, 1)[0])
    session.ask(Command(verb="record", value=True))
    for sample in frames(1, 5):
        session.answer(sample)
    assert session.moment(session.sinks[0].samples[-1]).settings["recording"]
    session.ask(Command(verb="record", value=False))
    session.answer(frames(5, 6)[0])
    session.close()
    assert [len(each.samples) for each in made] == [4]
    assert made[0].closed
    assert len(session.sinks) == 1


def test_what_came_of_what_was_asked_for_is_told_on_the_page_too():
    said: list[str] = []
    session = new_session(new_recording=full, said=said)
    told = {}
    commands = (Command(verb="record", value=True), Command(verb="calibrate", value="ears"))
    for command, sample in zip(commands, frames(0, 2), strict=True):
        session.ask(command)
        (answer,) = session.answer(sample)
        told |= dict(session.moment(answer).said)
    assert list(told.values()) == said
    assert list(told) == [1, 2]
    assert "no space left" in told[1]


class Slow(Kept):
    """Takes its time to be whole, as on a disk that is busy."""

    def __init__(self) -> None:
        super().__init__()
        self.disk = threading.Event()

    def close(self) -> None:
        assert self.disk.wait(60)
        super().close()


def test_a_recording_that_takes_its_time_to_be_whole_holds_no_frame_up():
    made, said = [Slow()], []
    session = new_session(new_recording=made.copy().pop, said=said)
    for value, sample in zip((True, False), frames(0, 2), strict=True):
        session.ask(Command(verb="record", value=value))
        session.answer(sample)
    assert not made[0].closed
    made[0].disk.set()
    session.close()
    assert made[0].closed
    assert said[-1] == "recorded kept"


def test_takes_that_follow_each_other_at_once_are_all_written(tmp_path, monkeypatch):
    """The second begins while the first is not whole yet, and the third is under way at the end."""
    monkeypatch.chdir(tmp_path)
    disk, said = threading.Event(), []
    keep = Recording.keep
    monkeypatch.setattr(Recording, "keep", lambda take: disk.wait(60) and keep(take))
    session = new_session(new_recording=partial(open_take, free_names(), said.append), said=said)
    for sample, value in zip(frames(0, 5), (True, False, True, False, True), strict=True):
        session.ask(Command(verb="record", value=value))
        session.answer(sample)
    disk.set()
    session.close()
    names = [f"track-00{number}.csv" for number in (1, 2, 3)]
    assert sorted(path.name for path in tmp_path.iterdir()) == names
    assert [sentence for sentence in said if sentence.startswith("recorded")] == [
        f"recorded csv to {name}" for name in names
    ]


def full() -> Kept:
    raise OutputError("track-001.csv: no space left")


class Full(Kept):
    def close(self) -> None:
        full()


@pytest.mark.parametrize("new_recording", [full, Full])
def test_a_recording_of_the_page_that_cannot_be_written_stops_nothing(new_recording):
    said = []
    session = new_session(new_recording=new_recording, said=said)
    for value, sample in zip((True, False), frames(0, 2), strict=True):
        session.ask(Command(verb="record", value=value))
        (answer,) = session.answer(sample)
        recording = session.moment(answer).settings["recording"]
    session.close()
    assert [sentence for sentence in said if "no space left" in sentence] == ["track-001.csv: no space left"]
    assert not recording
    assert len(session.sinks) == 1


class Filling(Kept):
    """A disk that is full after two rows, and then still is."""

    def send(self, sample: Sample) -> None:
        if len(self.samples) == 2:
            full()
        super().send(sample)

    def close(self) -> None:
        full()


def test_a_disk_that_gets_full_ends_the_recording_of_the_page_and_nothing_else():
    said = []
    session = new_session(new_recording=Filling, said=said)
    session.ask(Command(verb="record", value=True))
    for sample in frames(0, 6):
        (answer,) = session.answer(sample)
    assert not session.moment(answer).settings["recording"]
    session.close()
    assert [sentence for sentence in said if "no space left" in sentence] == [
        "kept ends here, and the rest goes on: track-001.csv: no space left"
    ]
    assert len(session.sinks[0].samples) == 6


def test_a_disk_that_gets_full_ends_one_recording_of_the_command_line_and_is_told_at_the_end_again():
    said = []
    session = new_session(said=said)
    kept = session.sinks[0]
    session.sinks.append(Filling())
    for sample in frames(0, 6):
        session.answer(sample)
    assert session.sinks == [kept]
    with pytest.raises(OutputError, match=r"track-001\.csv: no space left"):  # the exit code says it as well
        session.close()
    assert kept.closed
    assert len(kept.samples) == 6
    assert said == ["kept ends here, and the rest goes on: track-001.csv: no space left"]


@pytest.mark.parametrize(
    "command",
    [
        Command(verb="calibrate", value="ears"),
        Command(verb="dance"),
        Command(verb="gain", value=1.0),
        Command(verb="cancel"),
        Command(verb="record", value=False),
    ],
)
def test_commands_that_mean_nothing_stop_nothing(command):
    session = new_session()
    session.ask(command)
    assert len(session.answer(frames(0, 1)[0])) == 1


@pytest.mark.parametrize(
    "points",
    [np.zeros((68, 2)), np.full((68, 2), 5.0), np.stack([np.arange(68.0)] * 2, axis=1), NOISE * 1e7],
    ids=["nothing", "one point", "a line", "noise"],
)
def test_a_neutral_face_that_is_none_is_refused_or_costs_nothing_else(points):
    """A profile is a file that may come from anywhere."""
    neutral = NeutralFace(detector="points", points=lines_of(points[None], places=2))
    session = new_session()
    with suppress(InputError):
        session.pipeline.use_neutral(neutral)
    for sample in frames(0, 3):
        irises = sample.points[[37, 44]]
        assert len(session.answer(replace(sample, head=None, irises=irises))) == 1


def test_what_is_measured_has_each_stage():
    session = new_session()
    for sample in frames(0, 40):
        session.answer(sample)
    summary = session.summary()
    assert summary.frames == summary.faces == 40
    assert set(summary.cpu_ms) == {*session.pipeline.stages, "person", "sinks"}
    assert summary.seconds == pytest.approx(39 / 30, abs=1e-3)


def test_the_stages_are_those_of_a_chain():
    """Frame by frame through the session's loop is what a chain of the same stages gives."""
    session, other = new_session(), new_session()
    chain = Chain(other.pipeline.stages.values())
    for sample in frames(0, 60):
        session.answer(sample)
        last = chain.step(sample)
    np.testing.assert_allclose(session.sinks[0].weights[-1], last.weights)


def test_no_thread_of_blas_waits_beside_a_session():
    """Of small products others only spin: 44 ms of processor time a frame in place of 15."""
    threads = []

    class Counting(Stage):
        def step(self, sample: Sample) -> Sample:
            threads.extend(each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas")
            return sample

    class Film:
        left = frames(0, 3)

        def read(self, within_s: float | None = None) -> Sample | None:
            return self.left.pop(0) if self.left else None

        def now_s(self) -> float:
            return 0.0

    session = new_session()
    session.pipeline.stages = {"counting": Counting(), **session.pipeline.stages}
    session.run(Film())
    assert threads
    assert set(threads) == {1}


def frames_at(sample, time_s):
    """The same frame at another time."""
    return replace(sample, time_s=time_s)

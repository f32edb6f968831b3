"""One person before the cameras: takes frames as they come, answers each, and does what the person asks meanwhile."""

import queue
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from regress.runtime.sample import Sample
from regress.runtime.stages.output import Mirror
from track.errors import InputError, OutputError
from track.messages import Command, Moment, Step
from track.profile.profile import LARGEST_GAIN, SMALLEST_RANGE, Profile
from track.session.calibration import Calibration, Outcome, faces_of
from track.session.fading import Fading
from track.session.fault_telling import FaultTelling
from track.session.measures import Measures
from track.session.pipeline import Pipeline
from track.session.ranges import GazeCentre, Ranges, by_lids, middle_of
from track.session.undisturbed import undisturbed
from track.sinks.sink import Sink

TICK_S = 1 / 30
"""Between answers while no picture comes, so that avatars go to rest in small steps."""

CENTRE_FRAMES = 15
"""Frames of one look, half a second, whose median gaze is taken for straight ahead."""

MOST_COMMANDS = 1000
"""Waiting for the next frame: a person on the page sends some a second, whoever sends more is not listened to."""


class Pictures(Protocol):
    """What a session takes frames from: `track.sources.Capture`."""

    def read(self, within_s: float | None = None) -> Sample | None:
        """The next moment; None where there are no more."""

    def now_s(self) -> float:
        """What the clock of samples' times shows."""


class Screen(Protocol):
    """What shows a session to a person: `track.page.Page`."""

    def publish(self, moment: Moment) -> None:
        """Take a moment without waiting."""


@dataclass(frozen=True, kw_only=True)
class Summary:
    """How a session went.

    Parameters
    ----------
    frames, faces
        Frames that came, and those with a face.
    seconds
        By the frames' own times.
    fps
        At the end.
    latency_ms
        From a picture's time to the last sink, p50, p95 and p99; none of films that are read at any speed.
    cpu_ms
        Of each stage.
    faults
        How often each was told.
    """

    frames: int
    faces: int
    seconds: float
    fps: float
    latency_ms: Mapping[str, float]
    cpu_ms: Mapping[str, Mapping[str, float]]
    faults: Mapping[str, int]


class Session:
    """Frames in, answers out.

    Parameters
    ----------
    pipeline
        From pictures to weights.
    sinks
        Take every answer.
    profile
        Of the person and camera; `keep` is given each new one.
    say
        Told what a person should know, a sentence each.
    keep
        Stores a profile that has changed, and returns at once: it is called between two frames.
    new_recording
        Opens a recording, each time that the page asks for one.
    mirror
        Goes before the profile's.
    timed
        Whether frames' times are those of now, so that a latency means something.
    """

    def __init__(
        self,
        *,
        pipeline: Pipeline,
        sinks: Sequence[Sink],
        profile: Profile,
        say: Callable[[str], None],
        keep: Callable[[Profile], None] = lambda profile: None,
        new_recording: Callable[[], Sink] | None = None,
        mirror: bool | None = None,
        timed: bool = True,
    ) -> None:
        self.pipeline, self.sinks, self.profile = pipeline, list(sinks), profile
        self._say, self._keep = say, keep
        self._ranges = Ranges(profile.factors(), profile.at_rest(), by_lids(profile))
        self._centre = GazeCentre(np.zeros(4) if profile.gaze is None else np.array(profile.gaze))
        self._mirror, self._mirrored = Mirror(), profile.mirror if mirror is None else mirror
        self._fading = Fading()
        self.measures, self._telling = Measures(), FaultTelling(say)
        self._commands: queue.Queue[Command] = queue.Queue(MOST_COMMANDS)
        self._calibration: Calibration | None = None
        self._step: Step | None = None
        self._looks: list[np.ndarray] | None = None
        self._new_recording, self._recording = new_recording, None
        self._finishing = ThreadPoolExecutor(max_workers=1, thread_name_prefix="recording")
        self._pictures_wanted, self._timed, self._stopped = False, timed, False
        self._faces, self._first_s, self._last_s = 0, None, 0.0
        if profile.told_cameras and pipeline.listens:
            pipeline.use_cameras(profile.told_cameras)
        if profile.placement:
            pipeline.use_placement(profile.placement)
        pipeline.use_eyes(profile.eyes)
        if profile.neutral is not None:
            pipeline.use_neutral(profile.neutral)

    def ask(self, command: Command) -> None:
        """Take a command, from any thread; it is done before the next frame."""
        try:
            self._commands.put_nowait(command)
        except queue.Full:
            return

    def stop(self) -> None:
        """End `run` after this frame; from any thread or signal."""
        self._stopped = True

    @property
    def step_of_calibration(self) -> Step | None:
        """Where calibration is; None where there was none."""
        return self._step

    @property
    def calibrating(self) -> bool:
        """Whether a calibration is under way."""
        return self._calibration is not None

    def run(
        self, pictures: Pictures, screen: Screen | None = None, *, seconds: float | None = None
    ) -> Summary:
        """Answer frames until there are no more, or it is stopped, or so many seconds have passed."""
        with undisturbed():
            self._run(pictures, screen, seconds)
        return self.summary()

    def _run(self, pictures: Pictures, screen: Screen | None, seconds: float | None) -> None:
        until_s = None if seconds is None else time.monotonic() + seconds
        while not self._stopped and (until_s is None or time.monotonic() < until_s):
            sample = pictures.read(TICK_S if self._fading.under_way else None)
            if sample is None:
                break
            for answer in self.answer(sample, pictures.now_s if self._timed else None):
                if screen is not None:
                    screen.publish(self.moment(answer))

    def answer(self, sample: Sample, now_s: Callable[[], float] | None = None) -> list[Sample]:
        """What goes to the sinks for a frame: one sample, or as many as a filter that looks ahead gives."""
        self._obey()
        came = bool(sample.pictures) or sample.points is not None
        samples = [sample]
        if came:
            for name, stage in self.pipeline.stages.items():
                with self.measures.stage(name):
                    samples = [ready for given in samples for ready in stage.feed(given)]
        answers = [self._finished(each) for each in samples]
        for answer in answers:
            with self.measures.stage("sinks"):
                for sink in self.sinks:
                    sink.send(answer)
        if came:
            self.measures.frame(time.monotonic(), None if now_s is None else now_s() - sample.time_s)
        return answers

    def moment(self, sample: Sample) -> Moment:
        """What the page shows of an answer."""
        fps, latency_ms = self.measures.shown(time.monotonic())
        return Moment(
            sample=sample,
            pictures=dict(sample.pictures or {}) if self._pictures_wanted else {},
            points=self.pipeline.points(sample) if self._pictures_wanted else {},
            fps=fps,
            latency_ms=latency_ms,
            faults=self._telling.now,
            step=self._step,
            settings={
                "mirror": self._mirrored,
                "recording": self._recording is not None,
                "calibrated": self.profile.neutral is not None,
                "profile": self.profile.person,
                "gains": dict(self.profile.gains),
            },
        )

    def summary(self) -> Summary:
        """How it went up to now."""
        seconds = 0.0 if self._first_s is None else self._last_s - self._first_s
        return Summary(
            frames=self.measures.frames,
            faces=self._faces,
            seconds=seconds,
            fps=self.measures.fps,
            latency_ms=self.measures.latency_ms(),
            cpu_ms=self.measures.cpu_ms(),
            faults=dict(self._telling.counts),
        )

    def _finished(self, sample: Sample) -> Sample:
        """A frame behind the pipeline, as the person and the avatar want it."""
        if sample.weights is None:
            sample = replace(sample, weights=np.full(len(self._ranges.factors), np.nan))
        self._first_s = sample.time_s if self._first_s is None else self._first_s
        self._last_s = sample.time_s
        self._faces += not np.isnan(sample.weights).any()
        if self._looks is not None:
            self._look(sample)
        if self._calibration is not None:
            self._calibrate(sample)
        self._telling.step(sample.time_s, self.pipeline.sentences(sample))
        with self.measures.stage("person"):
            sample = self._ranges.step(self._centre.step(sample))
            if self._mirrored:
                sample = self._mirror.step(sample)
            return self._fading.step(sample)

    def _calibrate(self, sample: Sample) -> None:
        calibration = self._calibration
        self._step = calibration.step(sample.time_s, sample, self.pipeline.signature(sample))
        for outcome in calibration.outcomes():
            self._take(outcome)
        if calibration.finished:
            self._calibration = None
            if calibration.name == "neutral" and not calibration.kept:
                self._use_known_neutral()
            self._say(f"calibration: {self._step.text.lower()}")

    def _use_known_neutral(self) -> None:
        """What was known before a calibration that gave no neutral face."""
        if self.profile.neutral is not None:
            self.pipeline.use_neutral(self.profile.neutral)

    def _take(self, outcome: Outcome) -> None:
        """Use what calibration found from the next frame on, and keep it."""
        if outcome.ranges is None:
            neutral = self.pipeline.neutral_of(outcome.samples)
            self.pipeline.use_neutral(neutral)
            # what was read without this neutral face is no range of it, but of the same person in another seat
            kept = (
                self.profile.ranges
                if self.profile.neutral and self.profile.model == self.pipeline.mark
                else {}
            )
            self._change(
                neutral=neutral,
                ranges=kept if neutral.pictures else {},
                rests=self.pipeline.rests_of(outcome.samples),
                eyes=self.pipeline.eyes_with(self.profile.eyes, outcome.name, outcome.samples),
                model=self.pipeline.mark,
                gaze=None,
            )
        elif outcome.name == "look_around":
            self._change(gaze=middle_of([sample.gaze for sample in outcome.samples]))
        else:
            readings = {
                name: min(max(reading, SMALLEST_RANGE), 1.0) for name, reading in outcome.ranges.items()
            }
            self._change(
                ranges={**self.profile.ranges, **readings},
                eyes=self.pipeline.eyes_with(self.profile.eyes, outcome.name, outcome.samples),
                model=self.pipeline.mark,
            )

    def _change(self, **changes: object) -> None:
        self.profile = self.profile.model_copy(update=changes)
        self._ranges.factors, self._ranges.rests = self.profile.factors(), self.profile.at_rest()
        self._ranges.by_lids = by_lids(self.profile)
        self.pipeline.use_eyes(self.profile.eyes)
        self._centre.centre = np.zeros(4) if self.profile.gaze is None else np.array(self.profile.gaze)
        self._keep(self.profile)

    def _look(self, sample: Sample) -> None:
        if sample.gaze is None or np.isnan(sample.gaze).any():
            return
        self._looks.append(sample.gaze)
        if len(self._looks) == CENTRE_FRAMES:
            self._change(gaze=tuple(float(angle) for angle in np.median(self._looks, axis=0)))
            self._looks = None
            self._say("the eyes are centred on where they looked")

    def _record(self, wanted: bool) -> None:
        """Begin or end the page's recording; one that cannot be written takes nothing else along."""
        try:
            if wanted and self._recording is None and self._new_recording is not None:
                self._recording = self._new_recording()
                self.sinks.append(self._recording)
                self._say(f"recording {self._recording.title}")
            elif not wanted and self._recording is not None:
                recording, self._recording = self._recording, None
                self.sinks.remove(recording)
                self._finishing.submit(self._finish, recording)
        except OutputError as error:
            self._say(str(error))

    def _finish(self, recording: Sink) -> None:
        """Give the page's recording its name, in another thread: a disk takes a frame's time and more."""
        try:
            recording.close()
            self._say(f"recorded {recording.title}")
        except OutputError as error:
            self._say(str(error))

    def close(self) -> None:
        """Let sinks and stages go: recordings are written whole, each whether or not another one can be."""
        with ExitStack() as closing:
            closing.callback(self.pipeline.close)
            closing.callback(self._finishing.shutdown)
            for sink in self.sinks:
                closing.callback(sink.close)

    def _obey(self) -> None:
        while True:
            try:
                command = self._commands.get_nowait()
            except queue.Empty:
                return
            try:
                self._do(command)
            except InputError as error:
                self._say(str(error))

    def _do(self, command: Command) -> None:
        verb, value = command.verb, command.value
        if verb == "calibrate":
            asked = "all" if value is None or value is True else str(value)
            names = faces_of(asked, self.pipeline.faces)
            self._calibration = Calibration(names, least=self.pipeline.least_movement)
            if "neutral" in names:
                self.pipeline.forget_neutral()
        elif verb == "cancel" and self._calibration is not None:
            self._step, self._calibration = self._calibration.cancel(), None
            self._use_known_neutral()
        elif verb == "mirror":
            self._mirrored = bool(value)
            self._change(mirror=self._mirrored)
        elif verb == "gain" and command.shape is not None and isinstance(value, (int, float)):
            gain = float(np.clip(value, 0.0, LARGEST_GAIN))
            self._change(gains={**self.profile.gains, command.shape: gain})
        elif verb == "recentre":
            self._looks = []
        elif verb == "record":
            self._record(bool(value))
        elif verb == "picture":
            self._pictures_wanted = bool(value)

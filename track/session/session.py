"""One person before the cameras: takes frames as they come, answers each, and does what the person asks meanwhile."""

import queue
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Protocol

import numpy as np

from regress.runtime.sample import NO_EYES, Sample
from regress.runtime.stages.stage import Chain
from track.errors import InputError, OutputError
from track.messages import Command, Moment, Step
from track.profile.profile import LARGEST_GAIN, Profile
from track.session.calibration import Calibration, Outcome
from track.session.faces import faces_of
from track.session.fault_telling import FaultTelling
from track.session.measures import Measures, Summary
from track.session.outcomes import learnt
from track.session.person import Person
from track.session.pipeline import Pipeline
from track.session.recordings import Recordings
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


class Session:
    """Frames in, answers out.

    Parameters
    ----------
    pipeline
        From pictures to weights.
    sinks
        Take every answer.
    profile
        Of the person and camera, as it is used.
    kept
        What the profile's file holds, where options go before that; `keep` is given each new one of it.
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
        kept: Profile | None = None,
        keep: Callable[[Profile], None] = lambda profile: None,
        new_recording: Callable[[], Sink] | None = None,
        mirror: bool | None = None,
        timed: bool = True,
    ) -> None:
        self.pipeline, self.sinks, self.profile = pipeline, list(sinks), profile
        self._say, self._keep, self._kept = say, keep, profile if kept is None else kept
        self._person = Person(profile, mirrored=profile.mirror if mirror is None else mirror)
        self.measures, self._telling = Measures(), FaultTelling(say)
        self._commands: queue.Queue[Command] = queue.Queue(MOST_COMMANDS)
        self._calibration: Calibration | None = None
        self._step: Step | None = None
        self._looks: list[np.ndarray] | None = None
        self._recordings = Recordings(self.sinks, new_recording, say)
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
            sample = pictures.read(TICK_S if self._person.settling else None)
            if sample is None:
                break
            self._show(self.answer(sample, pictures.now_s if self._timed else None), screen)
        self._show(self.finish(), screen)

    def _show(self, answers: Sequence[Sample], screen: Screen | None) -> None:
        for answer in answers if screen is not None else ():
            screen.publish(self.moment(answer))

    def answer(self, sample: Sample, now_s: Callable[[], float] | None = None) -> list[Sample]:
        """What goes to the sinks for a frame: one sample, or as many as a filter that looks ahead gives."""
        self._obey()
        if not sample.pictures and sample.points is None:
            return [*self.finish(), *self._sent([sample])]
        samples = [sample]
        for name, stage in self.pipeline.stages.items():
            with self.measures.stage(name):
                samples = [ready for given in samples for ready in stage.feed(given)]
        answers = self._sent(samples)
        self.measures.frame(time.monotonic(), None if now_s is None else now_s() - sample.time_s)
        return answers

    def finish(self) -> list[Sample]:
        """What a filter that looks ahead still holds goes to the sinks: no other picture is there for it."""
        return self._sent(Chain(self.pipeline.stages.values()).finish())

    def _sent(self, samples: Sequence[Sample]) -> list[Sample]:
        answers = [self._finished(each) for each in samples]
        for answer in answers:
            with self.measures.stage("sinks"):
                for sink in list(self.sinks):
                    self._send(sink, answer)
        return answers

    def _send(self, sink: Sink, answer: Sample) -> None:
        try:
            sink.send(answer)
        except OutputError as error:
            if not self._recordings.give_up(sink, error):
                raise

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
                "mirror": self._person.mirrored,
                "recording": self._recordings.under_way,
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
        if self._calibration is not None:
            self._calibrate(sample)
        if sample.weights is None:
            eyes = NO_EYES if self.pipeline.measures_eyes else None
            sample = replace(sample, weights=self._person.unknown(), eyes=eyes)
        self._first_s = sample.time_s if self._first_s is None else self._first_s
        self._last_s = sample.time_s
        self._faces += not np.isnan(sample.weights).any()
        if self._looks is not None:
            self._look(sample)
        self._telling.step(sample.time_s, self.pipeline.sentences(sample))
        with self.measures.stage("person"):
            return self._person.step(sample)

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
        """Use what calibration found from the next frame on, and keep it beside all that it was found with."""
        kept = outcome.ranges is None or self._neutral_is_kept
        self._use(learnt(outcome, self.profile, self.pipeline))
        if kept:
            self._kept = self.profile
            self._keep(self._kept)
        else:
            self._say(f"{outcome.name} is not kept: it was read without the neutral face of the profile")

    @property
    def _neutral_is_kept(self) -> bool:
        """Whether what is read now is read beside the neutral face that the profile's file has."""
        return self.profile.neutral == self._kept.neutral

    def _change(self, **changes: object) -> None:
        """Use other values from the next frame on, and keep them; of the file nothing else changes."""
        self._use(changes)
        self._kept = self._kept.model_copy(update=changes)
        self._keep(self._kept)

    def _use(self, changes: Mapping[str, object]) -> None:
        self.profile = self.profile.model_copy(update=changes)
        self._person.use(self.profile)
        self.pipeline.use_eyes(self.profile.eyes)

    def _look(self, sample: Sample) -> None:
        if sample.gaze is None or np.isnan(sample.gaze).any():
            return
        self._looks.append(sample.gaze)
        if len(self._looks) == CENTRE_FRAMES:
            gaze = tuple(float(angle) for angle in np.median(self._looks, axis=0))
            if self._neutral_is_kept:
                self._change(gaze=gaze)
            else:
                self._use({"gaze": gaze})
            self._looks = None
            self._say("the eyes are centred on where they looked")

    def close(self) -> None:
        """Let sinks and stages go: recordings are written whole, each whether or not another one can be."""
        with ExitStack() as closing:
            closing.callback(self.pipeline.close)
            closing.callback(self._recordings.close)
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
            self._person.mirrored = bool(value)
            self._change(mirror=self._person.mirrored)
        elif verb == "gain" and command.shape is not None and isinstance(value, (int, float)):
            gain = float(np.clip(value, 0.0, LARGEST_GAIN))
            self._change(gains={**self.profile.gains, command.shape: gain})
        elif verb == "recentre":
            self._looks = []
        elif verb == "record":
            self._recordings.record(bool(value))
        elif verb == "picture":
            self._pictures_wanted = bool(value)

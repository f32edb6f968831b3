"""One person before the cameras: takes frames as they come, answers each, and does what the person asks meanwhile."""

import queue
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Protocol

import numpy as np

from regress.runtime.sample import NO_EYES, Sample
from regress.runtime.stages.stage import Chain
from track.errors import InputError, OutputError
from track.messages import Command, Moment
from track.profile.profile import Profile
from track.session.adjusting import Adjusting
from track.session.fault_telling import FaultTelling
from track.session.measures import Measures, Summary
from track.session.pipeline import Pipeline
from track.session.recordings import Recordings
from track.session.told import Told
from track.session.undisturbed import undisturbed
from track.sinks.sink import Sink

TICK_S = 1 / 30
"""Between answers while no picture comes, so that avatars go to rest in small steps."""

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
    own_blinks
        Whether blinks are stretched by the person's own ones, where the profile says nothing of them.
    keep_found
        Whether the profile is given what was found of them, and of a neutral face, without being asked for.
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
        own_blinks: bool = False,
        keep_found: bool = False,
        timed: bool = True,
    ) -> None:
        self.pipeline, self.sinks, self._told = pipeline, list(sinks), Told(say)
        self.adjusting = Adjusting(
            pipeline,
            profile,
            kept=kept,
            keep=keep,
            mirror=mirror,
            own_blinks=own_blinks,
            keep_found=keep_found,
            say=self._told,
            say_end=say,
        )
        self.measures, self._telling = Measures(), FaultTelling(say)
        self._commands: queue.Queue[Command] = queue.Queue(MOST_COMMANDS)
        self._recordings = Recordings(self.sinks, new_recording, self._told)
        self._pictures_wanted, self._timed, self._stopped = False, timed, False
        self._faces, self._first_s, self._last_s = 0, None, 0.0

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
    def profile(self) -> Profile:
        """Of the person and camera, as it is used now."""
        return self.adjusting.profile

    def run(
        self, pictures: Pictures, screen: Screen | None = None, *, seconds: float | None = None
    ) -> Summary:
        """Answer frames until there are no more, or it is stopped, or so many seconds have passed."""
        with undisturbed():
            self._run(pictures, screen, seconds)
        return self.summary()

    def _run(self, pictures: Pictures, screen: Screen | None, seconds: float | None) -> None:
        until_s = None if seconds is None else time.perf_counter() + seconds
        while not self._stopped and (until_s is None or time.perf_counter() < until_s):
            sample = pictures.read(TICK_S if self.adjusting.person.settling else None)
            if sample is None:
                break
            self._show(self.answer(sample, pictures.now_s if self._timed else None), screen)
            if self._recordings.lost is not None and not self.sinks and screen is None:
                break  # nobody is left to take an answer
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
        ages_s = () if now_s is None else [now_s() - each.time_s for each in answers]
        self.measures.frame(time.perf_counter(), ages_s)
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
            self._recordings.give_up(sink, error)

    def moment(self, sample: Sample) -> Moment:
        """What the page shows of an answer."""
        fps, latency_ms = self.measures.shown(time.perf_counter())
        return Moment(
            sample=sample,
            pictures=dict(sample.pictures or {}) if self._pictures_wanted else {},
            points=self.pipeline.points(sample) if self._pictures_wanted else {},
            fps=fps,
            latency_ms=latency_ms,
            faults=self._telling.now,
            step=self.adjusting.step,
            said=self._told.newest,
            settings={
                "mirror": self.adjusting.person.mirrored,
                "recording": self._recordings.under_way,
                "calibrating": self.adjusting.calibrating,
                "calibrated": self.profile.neutral is not None,
                "profile": self.profile.person,
                "gains": self.adjusting.gains_shown,
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
        self.adjusting.watch(sample)
        person = self.adjusting.person
        if sample.weights is None:
            eyes = NO_EYES if self.pipeline.measures_eyes else None
            sample = replace(sample, weights=person.unknown(), eyes=eyes)
        self._first_s = sample.time_s if self._first_s is None else self._first_s
        self._last_s = sample.time_s
        self._faces += not np.isnan(sample.weights).any()
        self._telling.step(sample.time_s, self.pipeline.sentences(sample))
        with self.measures.stage("person"):
            return person.step(sample, unseen=self.pipeline.unseen_eyes(sample))

    def close(self) -> None:
        """Let sinks and stages go: recordings are written whole, each whether or not another one can be.

        Raises
        ------
        OutputError
            Where a recording that was asked for from the beginning could not be written, or not to its end.
        """
        with ExitStack() as closing:
            closing.callback(self._raise_lost)
            closing.callback(self.pipeline.close)
            closing.callback(self._recordings.close)
            self._recordings.record(False)  # told where it is, as it may have got another name
            for sink in self.sinks:
                closing.callback(sink.close)

    def _raise_lost(self) -> None:
        if self._recordings.lost is not None:
            raise self._recordings.lost

    def _obey(self) -> None:
        while True:
            try:
                command = self._commands.get_nowait()
            except queue.Empty:
                return
            try:
                self._do(command)
            except InputError as error:
                self._told(str(error))

    def _do(self, command: Command) -> None:
        if command.verb == "record":
            self._recordings.record(bool(command.value))
        elif command.verb == "picture":
            self._pictures_wanted = bool(command.value)
        else:
            self.adjusting.do(command)

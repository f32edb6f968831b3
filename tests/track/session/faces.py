"""A talking face with known weights, camera stand-ins, and sinks that remember, for the tests of sessions."""

from functools import cache
from pathlib import Path

import numpy as np

from regress.runtime.inputs import Frames, read_frames
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage
from track.profile.profile import Profile
from track.session.landmarks import LandmarkPipeline
from track.session.session import Session
from track.sinks.sink import Sink

SAMPLES = Path(__file__).resolve().parents[3] / "docs" / "samples"


@cache
def talking_face() -> Frames:
    """A minute at 30 frames a second; at rest for the first two."""
    return read_frames(SAMPLES / "talking-face.csv")


@cache
def _samples() -> list[Sample]:
    return talking_face().samples()


HEAD = np.array([0.0, 0.0, 0.6, 0.0, 0.0, 0.0])


def frames(start: int, stop: int, *, first_s: float | None = None) -> list[Sample]:
    """Samples as a capture gives them, with points, and with a head, which need not be fitted then: that takes 3 ms."""
    samples = _samples()[start:stop]
    shift = 0.0 if first_s is None else first_s - samples[0].time_s
    return [
        Sample(label=each.label, time_s=each.time_s + shift, points=each.points, head=HEAD, pictures={})
        for each in samples
    ]


class Given(Stage):
    """A detector for samples that have points already."""

    def step(self, sample: Sample) -> Sample:
        return sample


class Kept(Sink):
    """A sink that remembers."""

    title = "kept"
    kept = True

    def __init__(self) -> None:
        self.samples: list[Sample] = []
        self.closed = False

    def send(self, sample: Sample) -> None:
        self.samples.append(sample)

    def close(self) -> None:
        self.closed = True

    @property
    def weights(self) -> np.ndarray:
        return np.array([each.weights for each in self.samples])

    @property
    def times_s(self) -> np.ndarray:
        return np.array([each.time_s for each in self.samples])


def new_session(
    *, filter_name: str = "groups", auto: bool = False, said: list[str] | None = None, **wishes: object
) -> Session:
    """A session of points, with one sink that remembers."""
    pipeline = LandmarkPipeline(
        "landmarks-default", detector=Given(), detector_name="points", filter_name=filter_name, auto=auto
    )
    return Session(
        pipeline=pipeline,
        sinks=[Kept()],
        profile=wishes.pop("profile", None) or Profile(person="anna", camera="camera 0"),
        say=(said if said is not None else []).append,
        **wishes,
    )


def calibrated_profile() -> Profile:
    """The talking person's, of the two seconds at rest."""
    pipeline = new_session().pipeline
    return Profile(person="anna", camera="camera 0", neutral=pipeline.neutral_of(frames(0, 60)))

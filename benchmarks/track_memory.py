"""What a session keeps in an hour: memory of the process while an hour's frames pass in ten minutes, with faults.

    python benchmarks/track_memory.py                # landmarks: the talking face of docs/samples, six times as quick
    python benchmarks/track_memory.py --headset      # the three cameras of docs/samples/headset

All is as in `track run`: a capture with its threads, networks, VMC, a recorded table, and the page with a tab that
wants pictures. Four times a minute of the hour the face is gone for 2 s, every six minutes each camera is unplugged,
and every minute a gain is set. Figures of one run stand in docs/measurements/live.md.
"""

import argparse
import json
import os
import tempfile
import time
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
from track_latency import SAMPLES, headset_pictures, page_of

from regress.runtime.inputs import read_frames
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage
from track.messages import Command
from track.profile.keeper import ProfileKeeper
from track.profile.profile import Profile
from track.session.headset import HeadsetPipeline
from track.session.landmarks import LandmarkPipeline
from track.session.session import Session
from track.sinks.targets import open_sink, parse_target
from track.sources import Capture, Picture, Source

HOUR_S, FPS = 3600, 30

GONE_EVERY_S, GONE_S = 15.0, 2.0
"""Of the hour: how often and how long no face is there."""

UNPLUGGED_EVERY_S = 360.0
"""Of the hour."""


class Hurried(Source):
    """A camera that gives an hour's pictures in less, one after the other."""

    def __init__(
        self, title: str, pictures: list[Picture], gone: Picture, hurry: float, start_s: float
    ) -> None:
        self.title = title
        self._pictures, self._gone, self._hurry, self._start_s = pictures, gone, hurry, start_s
        self._number = int(self._now_s() * FPS)

    def read(self) -> Picture | None:
        """The next picture in its time; None where the cable is pulled."""
        self._number = max(self._number + 1, int(self._now_s() * FPS))
        due_s = self._number / FPS
        time.sleep(max(0.0, (due_s - self._now_s()) / self._hurry))
        if due_s % UNPLUGGED_EVERY_S < 1 / FPS:
            return None
        picture = self._pictures[self._number % len(self._pictures)]
        if due_s % GONE_EVERY_S < GONE_S:
            picture = self._gone
        return Picture(time_s=time.monotonic(), pixels=picture.pixels, points=picture.points)

    def now_s(self) -> float:
        return time.monotonic()

    def close(self) -> None:
        """Nothing is held."""

    def _now_s(self) -> float:
        return (time.monotonic() - self._start_s) * self._hurry


class Given(Stage):
    """A detector for points that are there; like MediaPipe it knows where the head is, so that no fit is needed."""

    def step(self, sample: Sample) -> Sample:
        return replace(sample, head=np.array([0.0, 0.0, 0.6, 0.0, 0.0, 0.0]))


class Watched:
    """A capture that notes the memory of this process at each minute of the hour, and sets a gain now and then."""

    def __init__(self, capture: Capture, session: Session, hurry: float, start_s: float) -> None:
        self._capture, self._session, self.now_s = capture, session, capture.now_s
        self._hurry, self._start_s = hurry, start_s
        self.resident_mb: list[float] = []

    def read(self, within_s: float | None = None) -> Sample | None:
        """The next moment."""
        if (time.monotonic() - self._start_s) * self._hurry >= 60 * (len(self.resident_mb) + 1):
            self.resident_mb.append(resident_mb())
            self._session.ask(Command(verb="gain", shape="jawOpen", value=1 + len(self.resident_mb) % 3))
        return self._capture.read(within_s)


def resident_mb() -> float:
    """Memory of this process that is in use just now (Linux)."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


def pictures_of(headset: bool) -> tuple[dict[str, list[Picture]], dict[str, Picture]]:
    """By camera its pictures, and the one that shows no face."""
    if headset:
        names = ("left_eye", "right_eye", "mouth")
        pictures = {
            name: [Picture(time_s=0.0, pixels=each) for each in headset_pictures(name)] for name in names
        }
        return pictures, {name: Picture(time_s=0.0, pixels=np.zeros((96, 96), np.uint8)) for name in names}
    points = read_frames(SAMPLES.parent / "talking-face.csv").points
    gone = Picture(time_s=0.0, points=np.full((68, 2), np.nan))
    return {"camera": [Picture(time_s=0.0, points=each) for each in points]}, {"camera": gone}


def measure(headset: bool, minutes: float) -> dict[str, object]:
    """Run an hour in so many minutes."""
    hurry = HOUR_S / (60 * minutes)
    if headset:
        pipeline = HeadsetPipeline("headset-tracking3", filter_name="groups")
    else:
        pipeline = LandmarkPipeline(
            "landmarks-default", detector=Given(), detector_name="points", filter_name="groups"
        )
    pictures, gone = pictures_of(headset)
    said: list[str] = []
    with ExitStack() as closing:
        place = Path(closing.enter_context(tempfile.TemporaryDirectory()))
        keeper = ProfileKeeper(place / "nobody.toml", said.append)
        closing.callback(keeper.close)
        sinks = [open_sink(parse_target(to), said.append) for to in ("vmc", f"csv:{place / 'take.csv'}")]
        profile = Profile(person="nobody", camera="virtual")
        session = Session(pipeline=pipeline, sinks=sinks, profile=profile, say=said.append, keep=keeper.keep)
        closing.callback(session.close)
        start_s = time.monotonic()
        capture = Capture(
            {
                name: lambda name=name: Hurried(name, pictures[name], gone[name], hurry, start_s)
                for name in pictures
            }
        )
        closing.callback(capture.close)
        screen = closing.enter_context(page_of(session, tuple(pictures)))
        watched = Watched(capture, session, hurry, start_s)
        summary = session.run(watched, screen, seconds=60 * minutes - (time.monotonic() - start_s))
    memory = watched.resident_mb
    return {
        "frames": summary.frames,
        "with_a_face": summary.faces,
        "told": len(said),
        "resident_mb_at_minute_6": memory[5],
        "resident_mb_at_minute_30": memory[len(memory) // 2],
        "resident_mb_at_minute_59": memory[-1],
        "growth_mb_of_the_last_half": memory[-1] - memory[len(memory) // 2],
    }


def main() -> None:
    """Measure, and print a table or JSON."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--headset", action="store_true", help="the sample of docs/samples/headset")
    parser.add_argument("--minutes", type=float, default=10.0, help="in which the hour passes")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    found = measure(arguments.headset, arguments.minutes)
    if arguments.json:
        print(json.dumps(found))
        return
    for name, value in found.items():
        print(f"{name:<30} {value if not isinstance(value, float) else round(value, 2)}")


if __name__ == "__main__":
    main()

"""A session behind a real capture: a camera that is pulled out and comes back with another clock."""

import time
from dataclasses import dataclass, field

import numpy as np

from tests.track.session.faces import calibrated_profile, new_session, talking_face
from track.session.fading import BACK_S, REST_S
from track.sources import CameraFault, Capture, Picture, Source
from track.sources.capture import EMPTY_AFTER_S

FPS = 30
GONE_AFTER, LASTS = 45, 150


@dataclass
class Script:
    """Where the face is, how often the camera was opened, and how long the machine let it sleep each time."""

    row: int = 59
    opened: int = 0
    slept_s: list[float] = field(default_factory=list)


class Pulled(Source):
    """Gives points of a talking face; is gone after a while, and its clock begins anew when it is there again."""

    title = "camera 0"

    def __init__(self, script: Script) -> None:
        self._script, self._start_s = script, time.perf_counter()
        script.opened += 1

    def read(self) -> Picture | None:
        self._script.row += 1
        if self._script.row == 60 + GONE_AFTER:
            return None
        since_s = time.perf_counter()
        time.sleep(1 / FPS)
        self._script.slept_s.append(time.perf_counter() - since_s)
        return Picture(time_s=self.now_s(), points=talking_face().points[self._script.row])

    def now_s(self) -> float:
        """Seconds since it was opened."""
        return time.perf_counter() - self._start_s

    def close(self) -> None:
        """Nothing is held."""


def test_a_camera_that_comes_back_with_another_clock():
    said: list[str] = []
    script = Script()
    session = new_session(profile=calibrated_profile(), said=said)
    (kept,) = session.sinks
    with Capture({"camera": lambda: Pulled(script)}, pauses_s=(1.2,)) as capture:
        until_s = time.perf_counter() + 120
        while script.row < 60 + LASTS and time.perf_counter() < until_s:
            session.run(capture, seconds=0.2)
    assert script.opened == 2
    assert said.count(f"camera has {CameraFault.UNPLUGGED.value}") == 1
    times_s, weights = kept.times_s, kept.weights
    assert (np.diff(times_s) > 0).all()
    away = [bool(sample.faults) for sample in kept.samples]
    first, last = away.index(True), len(away) - 1 - away[::-1].index(True)
    assert np.abs(weights[last - 2]).max() < 0.02  # at rest long before it is back
    fading = (times_s > times_s[first - 1]) & (times_s < times_s[first - 1] + REST_S)
    held_up = FPS * np.mean(script.slept_s)  # a busy machine wakes threads late
    assert fading.sum() >= 10 / held_up, "to rest in small steps, though no picture comes"
    back = times_s >= times_s[last] + BACK_S + 0.1
    assert np.abs(weights[back]).max() > 0.2
    empty = [each.points is None for each, seen in zip(kept.samples, back, strict=True) if seen]
    assert not any(empty) or max(script.slept_s) > EMPTY_AFTER_S

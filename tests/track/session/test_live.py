"""A session behind a real capture: a camera that is pulled out and comes back with another clock."""

import time

import numpy as np

from tests.track.session.faces import calibrated_profile, new_session, talking_face
from track.session.fading import BACK_S, REST_S
from track.sources import CameraFault, Capture, Picture, Source

FPS = 30
GONE_AFTER, LASTS = 45, 150


class Pulled(Source):
    """Gives points of a talking face; is gone after a while, and its clock begins anew when it is there again."""

    title = "camera 0"

    def __init__(self, script: dict[str, int]) -> None:
        self._script, self._start_s = script, time.monotonic()
        script["opened"] = script.get("opened", 0) + 1

    def read(self) -> Picture | None:
        row = self._script["row"] = self._script.get("row", 59) + 1
        if row == 60 + GONE_AFTER:
            return None
        time.sleep(1 / FPS)
        return Picture(time_s=self.now_s(), points=talking_face().points[row])

    def now_s(self) -> float:
        """Seconds since it was opened."""
        return time.monotonic() - self._start_s

    def close(self) -> None:
        """Nothing is held."""


def test_a_camera_that_comes_back_with_another_clock():
    said: list[str] = []
    script: dict[str, int] = {}
    session = new_session(profile=calibrated_profile(), said=said)
    (kept,) = session.sinks
    with Capture({"camera": lambda: Pulled(script)}, pauses_s=(1.2,)) as capture:
        until_s = time.monotonic() + 20
        while script.get("row", 0) < 60 + LASTS and time.monotonic() < until_s:
            session.run(capture, seconds=0.2)
    assert script["opened"] == 2
    assert said.count(f"camera has {CameraFault.UNPLUGGED.value}") == 1
    times_s, weights = kept.times_s, kept.weights
    assert (np.diff(times_s) > 0).all()
    gone = [bool(sample.faults) or sample.points is None for sample in kept.samples]
    first, last = gone.index(True), len(gone) - 1 - gone[::-1].index(True)
    assert np.abs(weights[last - 2]).max() < 0.02  # at rest long before it is back
    fading = (times_s > times_s[first - 1]) & (times_s < times_s[first - 1] + REST_S)
    assert fading.sum() >= 10, "to rest in small steps, though no picture comes"
    back = times_s >= times_s[last] + BACK_S + 0.1
    assert np.abs(weights[back]).max() > 0.2
    assert not any(np.array(gone)[back])

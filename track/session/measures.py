"""What a session takes: processor time of each stage, frames a second, and from a picture's time to the sinks."""

import time
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice

import numpy as np

REMEMBERED = 600
"""Frames over which figures are taken: 20 s at 30 a second."""

LATELY_S = 2.0
"""Over which frames are counted."""


SHOWN_EVERY_S = 0.25
"""Between two looks at the figures that a person reads: of 600 frames they take 0.2 ms, a frame's filter takes 0.05."""


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


class Measures:
    """Figures of the last frames; memory does not grow.

    Parameters
    ----------
    remembered
        As `REMEMBERED`.
    """

    def __init__(self, remembered: int = REMEMBERED) -> None:
        self._remembered = remembered
        self._cpu_s: dict[str, deque[float]] = {}
        self._latency_s: deque[float] = deque(maxlen=remembered)
        self._times_s: deque[float] = deque(maxlen=REMEMBERED)
        self.frames = 0
        self._shown: tuple[float, dict[str, float]] = 0.0, {}
        self._shown_s = -np.inf

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Measure what this thread does inside."""
        start = time.thread_time()
        yield
        if name not in self._cpu_s:
            self._cpu_s[name] = deque(maxlen=self._remembered)
        self._cpu_s[name].append(time.thread_time() - start)

    def frame(self, now_s: float, latencies_s: Iterable[float] = ()) -> None:
        """Count a frame that came; what went out with it is older where a filter looks ahead."""
        self.frames += 1
        self._times_s.append(now_s)
        self._latency_s.extend(latencies_s)

    def shown(self, now_s: float) -> tuple[float, dict[str, float]]:
        """Frames a second and latency in ms of the last frames, for who looks on: new ones each `SHOWN_EVERY_S`."""
        if now_s - self._shown_s >= SHOWN_EVERY_S:
            lately = deque(islice(reversed(self._latency_s), REMEMBERED))
            self._shown, self._shown_s = (self._fps(now_s), quantiles_ms(lately)), now_s
        return self._shown

    @property
    def fps(self) -> float:
        """Frames a second before the last frame."""
        return self._fps(self._times_s[-1]) if self._times_s else 0.0

    def _fps(self, now_s: float) -> float:
        """Frames a second, lately; 0 where none came."""
        lately = [each for each in self._times_s if each > now_s - LATELY_S]
        if len(lately) < 2:
            return 0.0
        span = lately[-1] - lately[0]
        return (len(lately) - 1) / span if span > 0 else 0.0

    def latency_ms(self) -> dict[str, float]:
        """p50, p95 and p99 in ms; empty where pictures' times say nothing of now."""
        return quantiles_ms(self._latency_s)

    def cpu_ms(self) -> dict[str, dict[str, float]]:
        """Of each stage p50, p95 and p99 in ms."""
        return {name: quantiles_ms(taken) for name, taken in self._cpu_s.items()}


def quantiles_ms(seconds: deque[float]) -> dict[str, float]:
    """p50, p95 and p99 in ms, rounded to a microsecond; empty of nothing."""
    if not seconds:
        return {}
    values = np.quantile(np.array(seconds), [0.5, 0.95, 0.99]) * 1e3
    return {name: round(float(value), 3) for name, value in zip(("p50", "p95", "p99"), values, strict=True)}

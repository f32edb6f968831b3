"""A camera that does what a test wants: unplugged, frozen, dark, silent, or with a clock that goes back."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from regress.runtime.sample import Sample
from track.errors import CameraError
from track.session.fault_telling import FaultTelling
from track.sources import Picture, Source


def noise(number: int) -> np.ndarray:
    """Another picture for every number, as a sensor gives it: (48, 64, 3) uint8."""
    return np.random.default_rng(number).integers(60, 200, (48, 64, 3), dtype=np.uint8)


def told(samples: list[Sample]) -> list[str]:
    """What a session tells of these samples' faults, by name and word."""
    lines: list[str] = []
    telling = FaultTelling(lines.append)
    for sample in samples:
        telling.step(sample.time_s, {name: f"{name}: {fault.name}" for name, fault in sample.faults.items()})
    return lines


@dataclass
class Switches:
    """What a camera does just now; tests change it while the camera runs."""

    plugged: bool = True
    frozen: bool = False
    dark: bool = False
    silent: bool = False
    light: float = 1.0
    clock_s: float = 0.0
    fps: float = 60.0
    tries_s: list[float] = field(default_factory=list)
    given: int = 0
    given_s: list[float] = field(default_factory=list)


class VirtualCamera(Source):
    """Gives ``picture(number)`` at ``fps``; its tries to open are noted."""

    def __init__(
        self,
        switches: Switches,
        picture: Callable[[int], np.ndarray] = noise,
        *,
        title: str = "virtual camera",
    ) -> None:
        switches.tries_s.append(time.perf_counter())
        if not switches.plugged:
            raise CameraError("it is not plugged in")
        self.title, self._switches, self._picture, self.closed = title, switches, picture, False
        self._due_s = time.perf_counter()

    def read(self) -> Picture | None:
        assert not self.closed
        self._due_s = max(self._due_s + 1 / self._switches.fps, time.perf_counter())
        time.sleep(max(0.0, self._due_s - time.perf_counter()))
        until_s = time.perf_counter() + 3
        while self._switches.silent and time.perf_counter() < until_s:
            time.sleep(0.01)
        if not self._switches.plugged or self._switches.silent:
            return None
        self._switches.given += not self._switches.frozen
        pixels = np.clip(self._picture(self._switches.given) * self._switches.light, 0, 255).astype(np.uint8)
        pixels = np.zeros_like(pixels) if self._switches.dark else pixels
        self._switches.given_s.append(time.perf_counter())
        return Picture(time_s=self._switches.given_s[-1] + self._switches.clock_s, pixels=pixels)

    def close(self) -> None:
        self.closed = True

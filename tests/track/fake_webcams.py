"""Webcams that OpenCV would open: they heed what a driver heeds, and note in which order they were asked."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import cv2
import numpy as np

NAMES = {
    getattr(cv2, f"CAP_PROP_{name}"): name
    for name in (
        "FOURCC FRAME_WIDTH FRAME_HEIGHT FPS AUTO_EXPOSURE EXPOSURE GAIN CONVERT_RGB ORIENTATION_AUTO".split()
    )
}
"""OpenCV's properties without what all begin with."""


@dataclass
class FakeCapture:
    """Stands for `cv2.VideoCapture`.

    ``fails`` says of the number of a read whether it gives nothing; ``raw`` makes what is read where nothing is
    converted.
    """

    backend: str = "V4L2"
    size: tuple[int, int] = (640, 480)
    sizes: tuple[tuple[int, int], ...] = ((640, 480), (400, 400))
    gap_s: float = 0.0
    refuses: tuple[str, ...] = ()
    fourcc: str = "YUYV"
    fails: Callable[[int], bool] = lambda _: False
    raw: Callable[[], np.ndarray] | None = None
    asked: list[tuple[str, float]] = field(default_factory=list)
    reads: int = 0
    released: bool = False

    def __post_init__(self) -> None:
        self._wished: dict[str, float] = {}

    def getBackendName(self) -> str:
        return self.backend

    def isOpened(self) -> bool:
        return not self.released

    def get(self, name: int) -> float:
        values = {"FRAME_WIDTH": self.size[0], "FRAME_HEIGHT": self.size[1]}
        values["FOURCC"] = cv2.VideoWriter.fourcc(*self.fourcc)
        return float(values.get(NAMES.get(name), 0))

    def set(self, name: int, value: float) -> bool:
        assert not self.reads, "a camera that streams may refuse another mode"
        self.asked.append((NAMES[name], value))
        self._wished[NAMES[name]] = value
        size = (self._wished.get("FRAME_WIDTH"), self._wished.get("FRAME_HEIGHT"))
        if size in self.sizes:
            self.size = size
        return NAMES[name] not in self.refuses

    def read(self) -> tuple[bool, np.ndarray | None]:
        time.sleep(self.gap_s)
        self.reads += 1
        if self.released or self.fails(self.reads):
            return False, None
        if self.raw is not None and self._wished.get("CONVERT_RGB") == 0:
            return True, self.raw()
        width, height = self.size
        return True, np.full((height, width, 3), 60 + self.reads % 100, np.uint8)

    def release(self) -> None:
        self.released = True

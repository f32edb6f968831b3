"""Records animations: an avatar that moves (.glb), and one for any VRM avatar (.vrma).

Frames go to the disk as they come; at the end they are read again and become keyframes. A frame without a face, or
whose time does not rise, becomes none.
"""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from importlib import resources
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.errors import FacegenError
from facegen.files import output_errors, write_whole
from facegen.formats.gltf_animation import AnimatedAvatar, animate_avatar
from facegen.formats.gltf_container import MOST_BYTES
from facegen.formats.vrm_animation import vrm_animation
from regress.runtime.sample import Sample
from regress.runtime.stages.retargeting.target_file import read_retargeting
from regress.runtime.writers.csv_table import csv_lines
from track.sinks.axes import quaternion
from track.sinks.recording import Clock, Recording
from track.sinks.rows import Rows
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target

MOST_FRAMES = 1_000_000
"""Of one recording: nine hours at 30 a second, 0.5 GB on the disk and up to 3 GB of memory when they become keyframes.

A file of `MOST_BYTES` may hold fewer (`_most_frames`): a .vrma with all expressions holds six hours.
"""

_SOON_FRAMES = 1000
"""That become an animation at once; before more it is said what takes so long."""

_CLOCKS_BYTES = 8
"""Of a frame, where head and gaze come and go and have times of their own."""

OUR_AVATAR = resources.files("track") / "page" / "static" / "head.glb"

VRMA_SETS = {"both": ("vrm1", "perfect_sync"), "vrm1": ("vrm1",), "perfect-sync": ("perfect_sync",)}
"""Expressions by what a person asks for: an avatar that has VRM's and Perfect Sync moves twice by both."""

_WIDTHS = (1, len(BLENDSHAPES), 4, 6)
"""Numbers of a frame: time, weights, gaze, head."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Take:
    """What was recorded.

    Parameters
    ----------
    time_s : (n,) float64
        Rising, from 0.
    weights : (n, 52) float64
        Of ARKit's shapes.
    gaze, head : (n, 4) and (n, 6) float64
        As samples have them; rows of NaN where they are not known.
    title
        The file's name without its ending.
    """

    time_s: np.ndarray
    weights: np.ndarray
    gaze: np.ndarray
    head: np.ndarray
    title: str


class AnimationSink(Sink):
    """A take that becomes an animation when it ends.

    Parameters
    ----------
    target
        With a file.
    made
        Bytes of the file, of the whole take.
    tell
        Takes a sentence where nothing was recorded, or no more is.

    Raises
    ------
    InputError, OutputError
        Where the file cannot be written.
    """

    def __init__(self, target: Target, made: Callable[[Take], bytes], tell: Tell) -> None:
        self.title = target.title
        self._made, self._tell, self._most = made, tell, _most_frames(made)
        self._recording, self._clock = Recording(target.path), Clock()
        self._rows_path = self._recording.part.with_name("rows")
        with output_errors(target.path):
            self._rows = Rows(self._rows_path)
        self._last_s, self._told_most = np.float32(-1), False

    def send(self, sample: Sample) -> None:
        """Keep a sample's numbers."""
        time_s = self._clock.of(sample)
        if not has_face(sample) or not np.float32(time_s) > self._last_s or self._told_most:
            return
        if self._rows.count >= self._most:
            self._told_most = True
            self._tell(f"{self.title}: {self._most:,} frames are recorded, and no more; the rest goes on")
            return
        self._last_s = np.float32(time_s)
        gaze = np.full(4, np.nan) if sample.gaze is None else sample.gaze
        head = np.full(6, np.nan) if sample.head is None else sample.head
        with output_errors(self._recording.path):
            self._rows.add(np.concatenate([[time_s], sample.weights, gaze, head]).astype("<f8").tobytes())

    def close(self) -> None:
        """Make the animation of what was recorded; of nothing there is none.

        A take is not lost where that cannot be done, or is stopped by Ctrl-C: its numbers become a table.
        """
        with output_errors(self._recording.path):
            self._rows.close()
        if not self._rows.count:
            self._recording.drop()
            self._tell(f"{self.title}: no face was recorded, so there is no file")
            return
        if self._rows.count > _SOON_FRAMES:
            self._tell(f"writing {self.title}")
        try:
            with output_errors(self._recording.path):
                self._recording.part.write_bytes(self._made(self._take()))
        except BaseException as error:  # Ctrl-C among them
            rescued = f"the recorded weights are in {self._rescued()}"
            self._recording.drop()
            if isinstance(error, FacegenError):
                raise type(error)(f"{error}; {rescued}") from error
            self._tell(f"{self.title} is not made; {rescued}")
            raise
        self._recording.keep()
        self.kept = True

    def _take(self) -> Take:
        numbers = np.fromfile(self._rows_path, "<f8").reshape(-1, sum(_WIDTHS))
        time, weights, gaze, head = np.split(numbers, np.cumsum(_WIDTHS)[:-1], axis=1)
        return Take(time_s=time[:, 0], weights=weights, gaze=gaze, head=head, title=self._recording.path.stem)

    def _rescued(self) -> Path:
        """A table of a take of which no animation is made; where there is no place for one, its numbers as they lie."""
        path = self._recording.path
        self._recording.part.unlink(missing_ok=True)
        table = path.with_name(f"{path.stem}-weights.csv")
        try:
            return write_whole(table, "".join(csv_lines(_samples(self._take()), BLENDSHAPES)))
        except BaseException:  # Ctrl-C once more, and a disk that is full: a name takes no time and no space
            table = path.with_name(f"{path.stem}-weights.f64")
            os.replace(self._rows_path, table)
            return table


def _samples(take: Take) -> Iterator[Sample]:
    """Rows of a take, one by one: as many samples at once would take more memory than the table."""
    for row, (time_s, weights) in enumerate(zip(take.time_s, take.weights, strict=True)):
        yield Sample(
            label=str(row), time_s=float(time_s), weights=weights, gaze=take.gaze[row], head=take.head[row]
        )


def _most_frames(made: Callable[[Take], bytes]) -> int:
    """Frames that an animation may have, so that its file can be opened again."""
    small, large = (len(made(_still(count))) for count in (1, 101))
    frame_bytes = (large - small) / 100 + _CLOCKS_BYTES
    return max(0, min(MOST_FRAMES, int((MOST_BYTES - large) / frame_bytes)))


def _still(count: int, title: str = "still") -> Take:
    """A face at rest."""
    return Take(
        time_s=np.arange(float(count)),
        weights=np.zeros((count, len(BLENDSHAPES))),
        gaze=np.zeros((count, 4)),
        head=np.zeros((count, 6)),
        title=title,
    )


def open_sink(target: Target, tell: Tell) -> Sink:
    """An animation that is being recorded; an avatar that cannot be moved is refused before."""
    if target.name == "vrma":
        return AnimationSink(target, partial(_vrma, names=target.options.get("names", "both")), tell)
    avatar = Path(target.options.get("avatar", str(OUR_AVATAR)))
    moved = partial(_moving, avatar=avatar, names=target.options.get("names"))
    made = moved(_still(1, target.path.stem))
    if made.missing:
        tell(f"{avatar} has no morph target for {', '.join(made.missing)}")
    if made.headless:
        tell(f"{avatar} has no bone called head that can be turned: the head's pose is left out")
    if made.compressed:
        tell(
            f"{avatar} is compressed, which hides whether morph targets turn its eyes: their bones are left alone; "
            "export it without compression"
        )
    return AnimationSink(target, lambda take: moved(take).content, tell)


def _moving(take: Take, *, avatar: Path, names: str | None) -> AnimatedAvatar:
    shapes, weights = BLENDSHAPES, take.weights
    if names is not None:
        retargeting = read_retargeting(names)
        shapes, weights = retargeting.names, retargeting.apply(weights)
    return animate_avatar(
        avatar,
        shapes,
        weights,
        take.time_s,
        title=take.title,
        head_rad=_held(take.head[:, 3:]),
        gaze_rad=_held(take.gaze),
    )


def _held(rows: np.ndarray) -> np.ndarray:
    """Rows (n, k) with the last known one where one is not known; NaN before the first."""
    known = np.isfinite(rows).all(axis=1)
    last = np.maximum.accumulate(np.where(known, np.arange(len(rows)), 0))
    return rows[last]


def _vrma(take: Take, *, names: str) -> bytes:
    weights: dict[str, dict[str, np.ndarray]] = {"vrm1": {}, "perfect_sync": {}}
    for name in VRMA_SETS[names]:
        retargeting = read_retargeting(name)
        columns = zip(retargeting.names, retargeting.apply(take.weights).T, strict=True)
        # a gaze is no expression there
        weights[name] = {shape: column for shape, column in columns if not shape.startswith("look")}
    middle = (take.gaze[:, :2] + take.gaze[:, 2:]) / 2
    return vrm_animation(
        take.time_s,
        presets=weights["vrm1"],
        customs=weights["perfect_sync"],
        head=np.array([quaternion(*angles) for angles in take.head[:, 3:]]),
        gaze=np.array([quaternion(*angles) for angles in middle]),
        title=take.title,
    )

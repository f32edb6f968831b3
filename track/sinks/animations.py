"""Records animations: an avatar that moves (.glb), and one for any VRM avatar (.vrma).

Frames go to the disk as they come; at the end they are read again and become keyframes. A frame without a face, or
whose time does not rise, becomes none.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib import resources
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.errors import FacegenError
from facegen.files import output_errors, write_whole
from facegen.formats.gltf_animation import AnimatedAvatar, animate_avatar
from facegen.formats.vrm_animation import vrm_animation
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample
from regress.runtime.stages.retargeting.target_file import read_retargeting
from regress.runtime.writers.csv_table import weights_csv
from track.sinks.axes import quaternion
from track.sinks.recording import Clock, Recording
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target

MOST_FRAMES = 1_000_000
"""Of one recording: nine hours at 30 a second, 0.5 GB on the disk and as much of memory when they become keyframes."""

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
        self._made, self._tell = made, tell
        self._recording, self._clock = Recording(target.path), Clock()
        self._rows_path = self._recording.part.with_name("rows")
        with output_errors(target.path):
            self._rows = open(self._rows_path, "w+b")
        self._count, self._last_s = 0, np.float32(-1)

    def send(self, sample: Sample) -> None:
        """Keep a sample's numbers."""
        time_s = self._clock.of(sample)
        if not has_face(sample) or not np.float32(time_s) > self._last_s or self._count > MOST_FRAMES:
            return
        self._count += 1
        if self._count > MOST_FRAMES:
            self._tell(f"{self.title}: {MOST_FRAMES:,} frames are recorded, and no more; the rest goes on")
            return
        self._last_s = np.float32(time_s)
        gaze = np.full(4, np.nan) if sample.gaze is None else sample.gaze
        head = np.full(6, np.nan) if sample.head is None else sample.head
        with output_errors(self._recording.path):
            self._rows.write(np.concatenate([[time_s], sample.weights, gaze, head]).astype("<f8").tobytes())

    def close(self) -> None:
        """Make the animation of what was recorded; of nothing there is none."""
        with output_errors(self._recording.path):
            self._rows.flush()
            self._rows.seek(0)
            numbers = np.fromfile(self._rows, "<f8").reshape(-1, sum(_WIDTHS))
            self._rows.close()
            self._rows_path.unlink()
        if not len(numbers):
            self._recording.drop()
            self._tell(f"{self.title}: no face was recorded, so there is no file")
            return
        time, weights, gaze, head = np.split(numbers, np.cumsum(_WIDTHS)[:-1], axis=1)
        take = Take(time_s=time[:, 0], weights=weights, gaze=gaze, head=head, title=self._recording.path.stem)
        try:
            with output_errors(self._recording.path):
                self._recording.part.write_bytes(self._made(take))
        except FacegenError as error:
            self._recording.drop()
            raise type(error)(f"{error}; the recorded weights are in {self._rescued(take)}") from error
        self._recording.keep()

    def _rescued(self, take: Take) -> Path:
        """A table of a take of which no animation can be made, as of an avatar that has changed meanwhile."""
        path = self._recording.path.with_name(f"{self._recording.path.stem}-weights.csv")
        samples = [
            Sample(label=str(row), time_s=float(time_s), weights=weights)
            for row, (time_s, weights) in enumerate(zip(take.time_s, take.weights, strict=True))
        ]
        write_whole(path, weights_csv(Prediction(samples=samples)))
        return path


def open_sink(target: Target, tell: Tell) -> Sink:
    """An animation that is being recorded; an avatar that cannot be moved is refused before."""
    if target.name == "vrma":
        return AnimationSink(target, partial(_vrma, names=target.options.get("names", "both")), tell)
    avatar = Path(target.options.get("avatar", str(OUR_AVATAR)))
    moved = partial(_moving, avatar=avatar, names=target.options.get("names"))
    still = Take(
        time_s=np.zeros(1),
        weights=np.zeros((1, len(BLENDSHAPES))),
        gaze=np.zeros((1, 4)),
        head=np.zeros((1, 6)),
        title=target.path.stem,
    )
    made = moved(still)
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

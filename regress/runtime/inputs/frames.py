"""Frames of landmarks, whatever file they came from."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.faults import face_faults
from regress.runtime.inputs.orders import split_irises
from regress.runtime.inputs.people import people_of
from regress.runtime.inputs.times import LATEST_S, TIMES, go_on
from regress.runtime.sample import Sample

MOST_FRAMES = 1_000_000
"""Of one file or folder: nine hours at 30 a second, and 1.1 GB of points."""


FEWEST_PX = 3.0
"""A face's extent, below which its points are in another unit than pixels."""

_REACH = (-0.5, 1.5)
"""Of shares: a face at a picture's edge has points outside."""

_BEYOND_CORNER = 0.2
"""Share of points left of a picture, and of those above it, from which on both tell of a middle at 0."""


@dataclass(frozen=True, kw_only=True)
class Frames:
    """Landmarks of n frames.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Pixels, y down, iBUG order; NaN where a frame has no face.
    labels
        What each frame is called: a frame number or a file's name.
    time_s : (n,) float64 or None
        Seconds, where the file tells.
    source
        The file or folder.
    irises : (n, 2, 2) float64 or None
        Centres of the irises, the subject's left eye first, where the file has them; NaN where they are not seen.
    numbers : (n,) int64 or None
        Of the pictures that the faces are of, none less than the one before, where the file counts them.
    faces : tuple of str or None
        Who each face is, where pictures of a film have several; or the folder of a film of its own.
    picture_names : tuple of str or None
        What the picture that each is of is called, where pictures have several faces with labels of their own.
    picture_px
        Width and height of the pictures, where the file tells and all have the same.
    odd_times
        What the file calls numbers that have a time's name and do not go on as times do.
    """

    points: np.ndarray
    labels: tuple[str, ...]
    time_s: np.ndarray | None
    source: str
    irises: np.ndarray | None = None
    numbers: np.ndarray | None = None
    faces: tuple[str, ...] | None = None
    picture_names: tuple[str, ...] | None = None
    picture_px: tuple[int, int] | None = None
    odd_times: str | None = None

    @property
    def usable(self) -> np.ndarray:
        """(n,) bool: frames whose every point is a number."""
        return np.isfinite(self.points).all(axis=(1, 2))

    @property
    def kind_of_takes(self) -> str:
        """What people call a take, where there are several: faces of pictures, or folders (`of_folders`)."""
        return "folder" if self.picture_names is None else "face"

    @property
    def shares(self) -> bool:
        """Whether points are shares of a picture's width and height, 0 to 1, and no pixels: all are, or none is."""
        faces = self._sound_faces()
        return len(faces) > 0 and are_shares(faces)

    @property
    def extent(self) -> float:
        """Width or height of the middle one of the faces, whichever is larger; NaN where there is none."""
        faces = self._sound_faces()
        return float(np.median(np.ptp(faces, axis=1).max(axis=1))) if len(faces) else np.nan

    def _sound_faces(self) -> np.ndarray:
        """Points (k, 68, 2) of faces; a lost one's zeros do not say in which unit the others are."""
        return self.points[[fault is None for fault in face_faults(self.points)]]

    def in_pixels(self, picture_px: tuple[int, int]) -> "Frames":
        """The frames with points in pixels of pictures of this size, of points that are shares of it."""
        irises = None if self.irises is None else pixels_of(self.irises, picture_px)
        return replace(self, points=pixels_of(self.points, picture_px), irises=irises, picture_px=picture_px)

    def take(self, rows: np.ndarray | list[int]) -> "Frames":
        """Some of the frames."""
        return Frames(
            points=self.points[rows],
            labels=tuple(self.labels[row] for row in rows),
            time_s=None if self.time_s is None else self.time_s[rows],
            source=self.source,
            irises=None if self.irises is None else self.irises[rows],
            numbers=None if self.numbers is None else self.numbers[rows],
            faces=_rows_of(self.faces, rows),
            picture_names=_rows_of(self.picture_names, rows),
            picture_px=self.picture_px,
            odd_times=self.odd_times,
        )

    def takes(self) -> dict[str | None, np.ndarray]:
        """Rows (k,) of each face, in the order of their first ones; where pictures have one face, all rows of None."""
        if self.faces is None:
            return {None: np.arange(len(self.labels))}
        rows: dict[str | None, list[int]] = {}
        for row, face in enumerate(self.faces):
            rows.setdefault(face, []).append(row)
        return {face: np.array(each) for face, each in rows.items()}

    def at_rate(self, fps: float) -> "Frames":
        """The frames with times of a camera of so many pictures a second.

        Pictures that a file counts but leaves out take their time all the same, and faces of one picture share theirs.
        """
        counted = np.arange(len(self.labels)) if self.numbers is None else self.numbers - self.numbers[0]
        return replace(self, time_s=counted / fps)

    def samples(self) -> list[Sample]:
        """The frames one by one, as the stages take them."""
        times = [None] * len(self.labels) if self.time_s is None else self.time_s.tolist()
        eyes = [None] * len(self.labels) if self.irises is None else self.irises
        return [
            Sample(label=label, time_s=time, points=points, irises=irises)
            for label, time, points, irises in zip(self.labels, times, self.points, eyes, strict=True)
        ]


def _rows_of(names: tuple[str, ...] | None, rows: np.ndarray | list[int]) -> tuple[str, ...] | None:
    return None if names is None else tuple(names[row] for row in rows)


def are_shares(points: np.ndarray) -> bool:
    """Whether most of points (..., 2) lie in a picture or about it, as shares of it: no face in pixels is so small.

    Points about a middle at 0 are small as well, as in metres: many are negative in x, and many in y.
    """
    least, most = _REACH
    small = np.mean(((points >= least) & (points <= most)).all(axis=-1)) > 0.5
    negative = (points < 0).reshape(-1, 2).mean(axis=0)
    return bool(small and negative.min() < _BEYOND_CORNER)


def pixels_of(shares: np.ndarray, picture_px: tuple[int, int]) -> np.ndarray:
    """Points (..., 2) in pixels, whose (0, 0) is the first one's centre, of shares of a picture's width and height."""
    return shares * picture_px - 0.5


def of_pictures(
    frames: Frames, pictures: Sequence[int], names: Sequence[str], faces: Sequence[str] | None = None
) -> Frames:
    """The frames with the pictures they are of, in whose order they are; a take each where some have several faces.

    Parameters
    ----------
    frames
        Without ``numbers`` and ``faces``.
    pictures
        Place among all pictures of the one that each is of; pictures without a face count, as time passes in them.
    names
        What these pictures are called.
    faces
        Who each is; by default the nearest to who was there before, counted from 1.
    """
    frames = replace(frames, numbers=np.array(pictures, dtype=np.int64))
    if len(set(pictures)) == len(pictures):
        return frames
    faces = faces or people_of(frames.points, pictures, first=1)
    return replace(frames, faces=tuple(faces), picture_names=tuple(names))


def of_folders(frames: Frames, folders: Sequence[str]) -> Frames:
    """The frames as a take for each of the folders that they lie in: films, and people, of their own."""
    return frames if len(set(folders)) < 2 else replace(frames, faces=tuple(folders))


def timed(frames: Frames, told: Mapping[str, np.ndarray], *, sure: bool = False) -> Frames:
    """The frames with the first times that go on from frame to frame in the longest take; without, where none do.

    Parameters
    ----------
    frames
        Without times.
    told
        Numbers (n,) of each frame by a name in `TIMES`, the first choice first.
    sure
        Whether they are times, whatever they hold.

    Raises
    ------
    InputError
        Where a time is beyond `LATEST_S`.
    """
    rows = max(frames.takes().values(), key=len)
    for name, numbers in told.items():
        if not sure and not go_on(numbers[rows]):
            continue
        time_s = numbers * TIMES[name]
        if (np.abs(time_s) > LATEST_S).any():
            raise InputError(f"{frames.source}: a {name} is beyond {LATEST_S:g} s")
        return replace(frames, time_s=time_s)
    return replace(frames, odd_times=next(iter(told), None))


def stacked(faces: Iterable[np.ndarray], path: Path) -> tuple[np.ndarray, np.ndarray | None]:
    """Points (n, 68, 2), and irises (n, 2, 2) where some face has them, of faces (68 or 70, 2), taken as they come.

    ``path`` begins the sentence of an error.

    Raises
    ------
    InputError
        Where there are more than `MOST_FRAMES`.
    """
    kept = list(islice(faces, MOST_FRAMES + 1))
    if len(kept) > MOST_FRAMES:
        raise InputError(f"{path} holds more than {MOST_FRAMES:,} faces; give them in parts")
    if len({len(face) for face in kept}) > 1:
        kept = [np.concatenate([face, np.full((2, 2), np.nan)])[: LANDMARK_COUNT + 2] for face in kept]
    return split_irises(np.stack(kept))

"""Reads a folder that ``facegen pack --format arrays`` wrote: pictures memory-mapped, labels in memory."""

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, VIEW_POINTS
from regress.errors import InputError
from regress.learning.headset.geometry import FaceGeometry
from regress.runtime.headset.model import CameraInput

VERSION = 3
"""Of arrays.json."""

_ONE_REGION = ("neutral", "upper_face", "lower_face")


@dataclass(frozen=True, kw_only=True)
class HeadsetArrays:
    """Frames of a headset's cameras with exact labels.

    Parameters
    ----------
    description
        Content of arrays.json.
    cameras
        In its order.
    pictures : dict of (n, height, width) uint8
        By camera; memory-mapped.
    points : dict of (n, P, 2) float32
        By camera: pixels of ``VIEW_POINTS``, NaN where the picture does not show them.
    sample, person, session, clip, frame : (n,) int
        A session is one seat of the headset on its wearer; stills are clips of one frame.
    time_s : (n,) float
        Seconds from the clip's start.
    split, component : (n,) str
    neutral : (n,) bool
    weights : (n, 52) float32
        In ``BLENDSHAPES`` order.
    gaze : (n, 4) float32
        Left yaw and pitch, right yaw and pitch: radians, head frame.
    face
        The rig's face skin.
    """

    description: dict[str, Any]
    cameras: tuple[CameraInput, ...]
    pictures: dict[str, np.ndarray]
    points: dict[str, np.ndarray]
    sample: np.ndarray
    person: np.ndarray
    session: np.ndarray
    clip: np.ndarray
    frame: np.ndarray
    time_s: np.ndarray
    split: np.ndarray
    component: np.ndarray
    neutral: np.ndarray
    weights: np.ndarray
    gaze: np.ndarray
    face: FaceGeometry

    def rows(self, split: str) -> np.ndarray:
        """Row numbers of a split."""
        return np.flatnonzero(self.split == split)

    def clip_starts(self) -> np.ndarray:
        """(n,) bool: rows whose frame does not follow that of the row before."""
        follows = np.diff(self.frame.astype(np.int64)) == 1
        for column in (self.person, self.session, self.clip):
            follows &= column[1:] == column[:-1]
        return np.concatenate([[True], ~follows])

    def frames_a_second(self) -> float:
        """Of clips: from the times of frames that follow one another."""
        return 1 / float(np.median(np.diff(self.time_s)[~self.clip_starts()[1:]]))

    def neutral_rows(self, *, other_seat: bool = False) -> np.ndarray:
        """(n,) int64: for each row a neutral row of its person, -1 where there is none.

        Parameters
        ----------
        other_seat
            False: of the row's own session, another row than itself where there is one; True: of the person's
            next other session.
        """
        neutral_row = np.full(len(self.person), -1)
        neutral_of: dict[int, dict[int, list[int]]] = {}
        for row in np.flatnonzero(self.neutral):
            seats = neutral_of.setdefault(int(self.person[row]), {})
            seats.setdefault(int(self.session[row]), []).append(int(row))
        for row, (person, session) in enumerate(zip(self.person, self.session, strict=True)):
            seats = neutral_of.get(int(person), {})
            if other_seat:
                others = sorted(seats, key=lambda seat: (seat <= session, seat))
                choice = [seats[seat][0] for seat in others if seat != session]
            else:
                own = seats.get(int(session), [])
                choice = [other for other in own if other != row] or own
            if choice:
                neutral_row[row] = choice[0]
        return neutral_row

    def kept_rows(self, split: str, *, withhold: str = "none", people: int = 0) -> np.ndarray:
        """Rows of a split without those that training is to go without.

        Parameters
        ----------
        withhold
            One of ``regress.learning.headset.recipe.WITHHOLDINGS``.
        people
            Keep the first so many people only; 0 means all.

        Raises
        ------
        InputError
            Where nothing is left.
        """
        keep = self.split == split
        if withhold == "combined":
            blink = self.weights[:, [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]]
            keep &= ~((self.weights[:, BLENDSHAPE_INDEX["jawOpen"]] > 0.25) & (blink.max(axis=1) > 0.2))
        elif withhold == "regions":
            keep &= self.neutral | np.isin(self.component, _ONE_REGION)
        if people:
            keep &= np.isin(self.person, np.unique(self.person[keep])[:people])
        if not keep.any():
            raise InputError(
                f"the {split} split has no row with withhold {withhold!r}; it has components "
                f"{', '.join(np.unique(self.component[self.split == split])) or 'none'}"
            )
        return np.flatnonzero(keep)


def read_arrays(folder: str | os.PathLike[str]) -> HeadsetArrays:
    """Read labels and map pictures of a folder written by ``facegen pack --format arrays``.

    Raises
    ------
    InputError
        Where a file is missing, cannot be read, or does not agree with arrays.json.
    """
    folder = Path(folder)
    path = folder / "arrays.json"
    if not path.is_file():
        raise InputError(f"{path} does not exist; facegen pack DATASET --format arrays writes it")
    try:
        description = json.loads(path.read_text())
        cameras = tuple(
            CameraInput(name=entry["name"], width=entry["width"], height=entry["height"])
            for entry in description["cameras"]
        )
        version, count = description["version"], description["rows"]
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path} does not describe arrays: {error}") from error
    if version != VERSION:
        raise InputError(
            f"{path} has version {version!r}; this version reads {VERSION}: pack the dataset again with facegen pack"
        )
    try:
        table = pq.read_table(folder / "labels.parquet")
        with np.load(folder / "face.npz", allow_pickle=False) as face:
            geometry = FaceGeometry(displacement=face["displacement"], rest=face["rest"])
        return HeadsetArrays(
            description=description,
            cameras=cameras,
            pictures={camera.name: _pictures(folder, camera, count) for camera in cameras},
            face=geometry,
            weights=_lists(table, "weights", len(BLENDSHAPES)),
            points={
                camera.name: _lists(table, f"points_{camera.name}", 2 * len(VIEW_POINTS)).reshape(
                    count, -1, 2
                )
                for camera in cameras
            },
            gaze=_lists(table, "gaze", 4),
            split=np.asarray(table["split"].to_pylist(), dtype=str),
            component=np.asarray(table["component"].to_pylist(), dtype=str),
            **{
                name: table[name].to_numpy()
                for name in ("sample", "person", "session", "clip", "frame", "time_s", "neutral")
            },
        )
    except (OSError, ValueError, KeyError, pa.ArrowException) as error:
        raise InputError(f"{folder} is not a complete folder of arrays: {error}") from error


def _pictures(folder: Path, camera: CameraInput, count: int) -> np.ndarray:
    path = folder / f"{camera.name}.npy"
    pictures = np.load(path, mmap_mode="r", allow_pickle=False)
    needed = (count, camera.height, camera.width)
    if pictures.shape != needed or pictures.dtype != np.uint8:
        raise InputError(f"{path} holds {pictures.dtype} {pictures.shape}; arrays.json says uint8 {needed}")
    return pictures


def _lists(table: pa.Table, name: str, width: int) -> np.ndarray:
    column = table[name].combine_chunks()
    values = np.asarray(column.flatten(), dtype=np.float32)
    if len(values) != width * len(table):
        raise InputError(f"column {name} of labels.parquet does not hold {width} numbers a row")
    return values.reshape(-1, width)

"""Reads a folder that ``facegen pack --format arrays`` wrote: pictures memory-mapped, labels in memory."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from annotated_types import Interval, Len

from facegen.archives import load_npy, load_npz
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLINK_INDICES, CAMERA_TERMS, VIEW_POINTS
from regress.errors import InputError
from regress.learning.headset.geometry import FaceGeometry
from regress.learning.labels import Columns, read_labels
from regress.runtime.documents import checked, read_document
from regress.runtime.headset.network.model import MOST_CAMERAS, MOST_FPS, CameraInput

VERSION = 3
"""Of arrays.json."""

MOST_ROWS = 100_000_000
"""Of a folder: their weights alone are 20 GB."""

MOST_DOCUMENT_BYTES = 2**20
"""Of arrays.json: it is a page long."""

_METRES = 10.0
"""Any vertex of a face is nearer to the eyes than this, whatever moves it."""

_SINGLE = {
    **dict.fromkeys(("sample", "person", "session", "clip", "frame"), "whole"),
    "time_s": "number",
    "neutral": "truth",
    **dict.fromkeys(("split", "component"), "word"),
}
"""Columns with one value a row, and what it is."""

_ONE_REGION = ("neutral", "upper_face", "lower_face")


@dataclass(frozen=True, kw_only=True)
class HeadsetArrays:
    """Frames of a headset's cameras with exact labels.

    Parameters
    ----------
    folder
        Where they lie.
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
    camera_terms : dict of (n, 14) float32
        By camera: ``CAMERA_TERMS``; nothing of arrays that older versions packed.
    weights : (n, 52) float32
        In ``BLENDSHAPES`` order.
    gaze : (n, 4) float32
        Left yaw and pitch, right yaw and pitch: radians, head frame.
    face
        The rig's face skin.
    """

    folder: Path
    description: dict[str, Any]
    cameras: tuple[CameraInput, ...]
    pictures: dict[str, np.ndarray]
    points: dict[str, np.ndarray]
    camera_terms: dict[str, np.ndarray]
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

    @property
    def drawn(self) -> bool:
        """Whether people wear headsets that were drawn for them, and what is told of each row's cameras counts."""
        return bool(self.description.get("drawn")) and bool(self.camera_terms)

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
        """Of clips: from the times of frames that follow one another.

        Raises
        ------
        InputError
            Where time stands still in them, runs back, or no camera is so fast or slow.
        """
        step_s = float(np.median(np.diff(self.time_s)[~self.clip_starts()[1:]]))
        if not 1 / MOST_FPS <= step_s <= MOST_FPS:
            raise InputError(
                f"{self.folder / 'labels.parquet'}: frames follow one another by {step_s:g} s in time_s, and clips of "
                f"up to {MOST_FPS:,} frames a second are needed"
            )
        return 1 / step_s

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
            blink = self.weights[:, BLINK_INDICES]
            keep &= ~((self.weights[:, BLENDSHAPE_INDEX["jawOpen"]] > 0.25) & (blink.max(axis=1) > 0.2))
        elif withhold == "regions":
            keep &= self.neutral | np.isin(self.component, _ONE_REGION)
        if people:
            keep &= np.isin(self.person, np.unique(self.person[keep])[:people])
        if not keep.any():
            raise InputError(
                f"{self.folder}: the {split} split has no row with withhold {withhold!r}; it has components "
                f"{', '.join(np.unique(self.component[self.split == split])) or 'none'}"
            )
        return np.flatnonzero(keep)


@dataclass(frozen=True, kw_only=True)
class _Description:
    """What is read of arrays.json; every other key is for people."""

    cameras: Annotated[tuple[CameraInput, ...], Len(1, MOST_CAMERAS)]
    rows: Annotated[int, Interval(ge=1, le=MOST_ROWS)]
    headset: str
    seed: int | None = None
    dataset_hash: str = ""
    rig: str = ""
    licence: str | list[str] = ""
    drawn: bool = False
    camera_terms: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse cameras of one name."""
        names = [camera.name for camera in self.cameras]
        if len(set(names)) < len(names):
            raise ValueError(f"two cameras have the same name, of {', '.join(names)}")
        if self.camera_terms not in ((), CAMERA_TERMS):
            raise ValueError("camera_terms are not those of this version")


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
        if (folder / "dataset.json").is_file():
            raise InputError(
                f"{folder} is a dataset, and this takes its arrays; facegen pack {folder} --format arrays --out FOLDER "
                f"writes them"
            )
        raise InputError(
            f"{path} does not exist; a folder of arrays is what facegen pack DATASET --format arrays writes"
        )
    document = read_document(path, most_bytes=MOST_DOCUMENT_BYTES)
    version = document.get("version")
    if version != VERSION:
        raise InputError(
            f"{path} has version {version!r}; this version reads {VERSION}: {pack_again(folder)}"
        )
    try:
        about = checked(_Description, document)
    except InputError as error:
        raise InputError(f"{path} does not describe arrays: {error}") from error
    # pictures first: their files cannot be smaller than what arrays.json claims, and then nor can labels be larger
    pictures = {camera.name: _pictures(folder, camera, about.rows) for camera in about.cameras}
    points = {f"points_{name}": 2 * len(VIEW_POINTS) for name in pictures}
    terms = {f"camera_{name}": len(CAMERA_TERMS) for name in pictures if about.camera_terms}
    columns = Columns(
        single=_SINGLE,
        lists={"weights": len(BLENDSHAPES), "gaze": 4, **points, **terms},
        gaps=frozenset(points),
    )
    labels = read_labels(
        folder / "labels.parquet",
        columns,
        most_rows=about.rows,
        damaged=pack_again(folder),
    )
    if len(labels["sample"]) != about.rows:
        raise InputError(
            f"{folder / 'labels.parquet'} has {len(labels['sample']):,} rows; arrays.json says {about.rows:,}"
        )
    labels |= {name: np.asarray(labels[name], dtype=np.float32) for name in columns.lists}
    return HeadsetArrays(
        folder=folder,
        description=document,
        cameras=about.cameras,
        pictures=pictures,
        face=_face(folder / "face.npz"),
        points={name: labels.pop(f"points_{name}").reshape(about.rows, -1, 2) for name in pictures},
        camera_terms={name.removeprefix("camera_"): labels.pop(name) for name in terms},
        **labels,
    )


def pack_again(folder: Path) -> str:
    """What to do about a folder that is too old or damaged: ``facegen pack`` changes no file that is there."""
    return f"pack the dataset again with facegen pack, into another folder or after {folder} is deleted"


def _face(path: Path) -> FaceGeometry:
    arrays = load_npz(path)
    lacking = [name for name in ("displacement", "rest") if name not in arrays]
    if lacking:
        raise InputError(f"{path} lacks the array {lacking[0]}; {pack_again(path.parent)}")
    displacement, rest = arrays["displacement"], arrays["rest"]
    shapes = {"displacement": (len(BLENDSHAPES), len(rest), 3), "rest": (len(rest), 3)} if rest.ndim else {}
    for name, array in (("displacement", displacement), ("rest", rest)):
        if array.shape != shapes.get(name) or not array.size:
            raise InputError(
                f"{path} has {name} of the shape {array.shape}; (52, V, 3) and (V, 3) are needed"
            )
        if array.dtype.kind != "f" or not (np.abs(array) <= _METRES).all():
            raise InputError(f"{path} has numbers in {name} that are no places within {_METRES:g} m")
    return FaceGeometry(displacement=displacement, rest=rest)


def _pictures(folder: Path, camera: CameraInput, count: int) -> np.ndarray:
    path = folder / f"{camera.name}.npy"
    pictures = load_npy(path, mmap=True)
    needed = (count, camera.height, camera.width)
    if pictures.shape != needed or pictures.dtype != np.uint8:
        raise InputError(f"{path} holds {pictures.dtype} {pictures.shape}; arrays.json says uint8 {needed}")
    return pictures

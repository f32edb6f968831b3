"""Plays weights on a rig, and draws its frames with the NumPy renderer."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache

import cv2
import numpy as np
import pyarrow as pa

from facegen.errors import InputError
from facegen.preview.looks import Look, draw_look
from facegen.preview.person import dressed_person
from facegen.preview.portraits import portrait
from facegen.rigs import Rig, evaluate
from facegen.sampling.gaze import axes_from_weights
from facegen.sampling.people import people_of
from facegen.store import Dataset, column_array

WINDOW_M = (-0.150, 0.165, 0.150, -0.150)
"""Left, top, right and bottom of the pictures: room for a head with hair that turns."""
FACE_M = (-0.094, 0.066, 0.094, -0.130)
"""The same of pictures in which a mouth is large enough to be read, of a face that looks ahead."""
EARS_M, JAW_M = -0.100, -0.090
"""How far back and how far down a head reaches whose face must not be cut."""
_SEEN, _HIDDEN = (0, 190, 255), (255, 255, 255)


@cache
def default_look() -> Look:
    """Of who plays weights of nobody that a dataset knows."""
    return draw_look(8, female=True, ancestry=np.array([0.0, 0.0, 1.0]))


@dataclass(frozen=True, kw_only=True, eq=False)
class Performance:
    """n frames of one face.

    Attributes
    ----------
    rig
        Whose face.
    identity
        (K,) coefficients.
    weights
        (n, 52) blendshape weights.
    gaze
        (n, 2, 3) unit optical axes in the head frame, subject's left eye first.
    rotation
        (n, 3, 3) of the head in its own frame.
    time_s
        (n,) seconds.
    title
        What it is.
    look
        Whose colours and hair; None for the plain colours of figures.
    """

    rig: Rig
    identity: np.ndarray
    weights: np.ndarray
    gaze: np.ndarray
    rotation: np.ndarray
    time_s: np.ndarray
    title: str
    look: Look | None = field(default_factory=default_look)

    @property
    def fps(self) -> float:
        """Frames a second, by the median step of time; 30 for a single frame.

        Raises
        ------
        InputError
            If times do not ascend.
        """
        if len(self.time_s) < 2:
            return 30.0
        step_s = float(np.median(np.diff(self.time_s)))
        if not step_s > 0:
            raise InputError(
                f"{self.title}: its times do not ascend, so a film of it has no rate; give --fps"
            )
        return 1.0 / step_s

    def rows(self, numbers: Sequence[int]) -> "Performance":
        """Some of the frames.

        Raises
        ------
        InputError
            If they are none.
        """
        index = np.asarray(numbers, dtype=np.int64)
        if not len(index):
            raise InputError(f"{self.title}: --frames chooses none of its {len(self.time_s)} frames")
        kept = {name: getattr(self, name)[index] for name in ("weights", "gaze", "rotation", "time_s")}
        return Performance(rig=self.rig, identity=self.identity, title=self.title, look=self.look, **kept)


_PLAYED = (
    "sample",
    "person",
    "session",
    "component",
    "camera_from_head",
    "identity",
    "weights",
    "gaze",
    "time_s",
)
"""Columns of a sample that a film of it needs."""


def clip_of_dataset(dataset: Dataset, clip: int) -> Performance:
    """A clip of a dataset, by its number.

    Raises
    ------
    InputError
        If there is no such clip, or it has not been made.
    """
    clips = dataset.keypoints(["sample", "clip"])
    numbers = clips["sample"].to_numpy()[clips["clip"].to_numpy() == clip]
    if not len(numbers):
        raise InputError(
            f"{dataset.folder.path}: has no clip {clip}; there are clips {clips['clip'][0]}-{clips['clip'][-1]}"
        )
    table = pa.concat_tables(dataset.rows(numbers, _PLAYED))
    rig = dataset.rig_of(table["sample"][0].as_py())
    person, session, kind = (table.column(name)[0].as_py() for name in ("person", "session", "component"))
    head_in_camera = column_array(table, "camera_from_head").reshape(-1, 4, 4)[:, :3, :3]
    return Performance(
        rig=rig,
        identity=column_array(table, "identity")[0, : rig.components].astype(np.float64),
        weights=column_array(table, "weights").astype(np.float64),
        gaze=column_array(table, "gaze").astype(np.float64),
        rotation=np.diag([1.0, -1.0, -1.0])
        @ head_in_camera,  # from OpenCV's camera back to y up, z to the viewer
        time_s=column_array(table, "time_s"),
        look=_look_of(dataset, int(person)),
        title=f"clip {clip}: {kind}, person {person}, session {session}",
    )


def _look_of(dataset: Dataset, person: int) -> Look:
    """Colours that go with a person of a dataset."""
    drawn = people_of(dataset.spec, dataset.rigs[0], np.array([person]))
    return draw_look(
        person,
        female=bool(drawn.female[0]),
        age_years=float(drawn.age_years[0]),
        ancestry=drawn.ancestry[0],
    )


def play_weights(rig: Rig, weights: np.ndarray, time_s: np.ndarray, *, title: str) -> Performance:
    """Weights (n, 52) on a rig's mean face; where they are NaN, the face stays as it was."""
    if np.isinf(weights).any():
        raise InputError(
            f"{title}: frame {np.isinf(weights).any(axis=1).argmax()} has a weight that is not finite"
        )
    known = ~np.isnan(weights).any(axis=1)
    if not known.any():
        raise InputError(f"{title}: no row has all weights")
    latest = np.maximum.accumulate(np.where(known, np.arange(len(weights)), np.flatnonzero(known)[0]))
    weights = weights[latest]
    return Performance(
        rig=rig,
        identity=np.zeros(rig.components),
        weights=weights,
        gaze=axes_from_weights(weights),
        rotation=np.tile(np.eye(3), (len(weights), 1, 1)),
        time_s=time_s,
        title=title,
    )


def pictures(
    performance: Performance,
    *,
    height_px: int,
    landmarks: bool = True,
    window_m: tuple[float, float, float, float] = WINDOW_M,
) -> Iterator[np.ndarray]:
    """RGB pictures (height, width, 3) uint8 of every frame, width and height even."""
    step_m = (window_m[1] - window_m[3]) / height_px
    look = performance.look
    person = None if look is None else dressed_person(performance.rig, performance.identity, look)
    for row in range(len(performance.weights)):
        one = slice(row, row + 1)
        face = evaluate(
            performance.rig, performance.identity[None], performance.weights[one], performance.gaze[one]
        )
        drawn = portrait(
            performance.rig,
            face,
            0,
            performance.gaze[row],
            rotation=performance.rotation[row],
            window_m=window_m,
            step_m=step_m,
            person=person,
        )
        picture = np.ascontiguousarray(np.round(drawn.picture * 255).astype(np.uint8))
        # films need even sizes
        picture = picture[: picture.shape[0] // 2 * 2, : picture.shape[1] // 2 * 2].copy()
        if landmarks:
            _draw_landmarks(picture, drawn.landmarks, drawn.seen)
        yield picture


def face_window(performance: Performance) -> tuple[float, float, float, float]:
    """`FACE_M` for all frames of a face that turns: moved, and made larger where need be, so that no ear is cut."""
    left, top, right, bottom = FACE_M
    head = performance.rig.vertices + np.tensordot(performance.identity, performance.rig.identity, 1)
    head = head[(head[:, 2] > EARS_M) & (head[:, 1] > JAW_M) & (head[:, 1] < top)]
    across = head @ performance.rotation[:, 0].T
    low, high = float(across.min()), float(across.max())
    middle, scale = (low + high) / 2, max(1.0, 1.03 * (high - low) / (right - left))
    return middle + scale * left, scale * top, middle + scale * right, scale * bottom


def _draw_landmarks(picture: np.ndarray, points: np.ndarray, seen: np.ndarray) -> None:
    """Dots over a picture, in place; hidden ones are white."""
    radius = max(len(picture) / 300, 1.0)
    for (x, y), visible in zip(points, seen, strict=True):
        center = round(x * 16), round(y * 16)  # sixteenths of a pixel
        colour = _SEEN if visible else _HIDDEN
        cv2.circle(picture, center, round(radius * 16), colour, cv2.FILLED, cv2.LINE_AA, 4)

"""Reads and writes recordings of the Live Link Face app: one row a frame, 52 blendshapes and nine angles, by name.

The header's second column is ``BlendShapeCount`` or ``BlendshapeCount``; JawRight and MouthRight stand before
their left partners, which is why columns are never read by number.
"""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.errors import FormatError
from facegen.formats.csv_rows import CsvRows, numbers_in

TIMECODE_RATE = 60
"""The app counts 60 timecode frames a second, also where it writes 30 rows a second (seen in two takes)."""

_SWAPPED = {
    "jawLeft": "jawRight",
    "jawRight": "jawLeft",
    "mouthLeft": "mouthRight",
    "mouthRight": "mouthLeft",
}

_SHAPE_COLUMNS: tuple[str, ...] = tuple(_SWAPPED.get(name, name) for name in BLENDSHAPES)
"""Our names in the app's order of columns, which has these two pairs the other way round."""

ROTATIONS: tuple[str, ...] = tuple(
    f"{what}{angle}" for what in ("Head", "LeftEye", "RightEye") for angle in ("Yaw", "Pitch", "Roll")
)
"""The last nine columns: angles of head and eyes."""

_TIMECODE = re.compile(r"(\d{1,9}):(\d{1,9}):(\d{1,9})([:;])(\d{1,9}(?:\.\d{1,20})?)")

_SLOWER_RATES = (24, 25, 30)
"""What else apps count, by the largest number of a frame: of 60 a second all but takes of two rows a second pass 30."""

_LONG_S, _DIFFERENT = 2, 12
"""Seconds of a take, and numbers of frames that it must have, before its timecode is taken to count slower than 60."""

_DROPPED_S = 1 / 15
"""Of each minute but every tenth, what drop-frame timecode, ``HH:MM:SS;FF``, leaves out: four numbers of 60 a second,
or two of 30, so that 59.94 and 29.97 frames a second keep step with the clock (SMPTE ST 12-1)."""


@dataclass(frozen=True, kw_only=True)
class LiveLinkTake:
    """One recording.

    Parameters
    ----------
    weights : (n, 52) float64
        In ``BLENDSHAPES`` order and as recorded: some devices give -0.02 to 1.4. Empty cells are NaN.
    timecodes
        As in the file, ``HH:MM:SS:FF.mmm``, or ``HH:MM:SS;FF.mmm`` of drop-frame timecode.
    time_s : (n,) float64
        Seconds from the first row.
    """

    weights: np.ndarray
    timecodes: tuple[str, ...]
    time_s: np.ndarray


def read_live_link(path: str | os.PathLike[str], *, fps: float | None = None) -> LiveLinkTake:
    """Read a Live Link Face CSV.

    Parameters
    ----------
    path
        The file; columns may stand in any order and be spelled with or without a capital.
    fps
        Rows a second. Without it the time comes from the timecodes, whose frames count 60 a second, or 24, 25 or 30
        where none of two seconds or more is larger.

    Raises
    ------
    FormatError
        Where a blendshape's column is missing, a row is too short or a cell is no number.
    """
    with CsvRows(path) as table:
        return take_of_rows(table, fps=fps)


def take_of_rows(table: CsvRows, *, fps: float | None = None) -> LiveLinkTake:
    """A recording of a file that is open already: a pipe cannot be opened again."""
    path = table.path
    columns = {name.lower(): column for name, column in table.columns.items()}
    missing = [name for name in BLENDSHAPES if name.lower() not in columns]
    if missing or "timecode" not in columns:
        lacking = missing[0] if missing else "Timecode"
        raise FormatError(
            f"{path} is not a Live Link Face recording: column {lacking} is missing"
            + (f" and {len(missing) - 1} more" if len(missing) > 1 else "")
        )
    picked = [columns[name.lower()] for name in BLENDSHAPES]
    weights, timecodes = [], []
    for row in table:
        try:
            weights.append(numbers_in(row, picked))
        except ValueError as error:
            raise FormatError(f"{path}: a weight is not a number ({error})") from error
        timecodes.append(row[columns["timecode"]].strip())
    time_s = _timecode_seconds(timecodes, path) if fps is None else np.arange(len(weights)) / fps
    return LiveLinkTake(weights=np.array(weights), timecodes=tuple(timecodes), time_s=time_s)


def live_link_csv(weights: np.ndarray, time_s: np.ndarray, *, rotations: np.ndarray | None = None) -> str:
    """Text of a recording as the app writes it: 63 columns in its order, ten decimals.

    Parameters
    ----------
    weights : (n, 52) float
        In ``BLENDSHAPES`` order; a row with NaN is a frame without a face, and its cells stay empty.
    time_s : (n,) float
        Seconds from 00:00:00, finite and not negative; kept to a thousandth of a timecode frame (17 microseconds).
    rotations : (n, 9) float, optional
        `ROTATIONS` of every frame, in the app's unit; 0 without.
    """
    order = [BLENDSHAPES.index(name) for name in _SHAPE_COLUMNS]
    angles = np.zeros((len(weights), len(ROTATIONS))) if rotations is None else rotations
    values = np.concatenate([np.asarray(weights, dtype=np.float64)[:, order], angles], axis=1)
    names = [name[0].upper() + name[1:] for name in _SHAPE_COLUMNS]
    lines = [",".join(["Timecode", "BlendShapeCount", *names, *ROTATIONS])]
    for time, row in zip(time_s, values, strict=True):
        known = not np.isnan(row).any()
        cells = [f"{value:.10f}" if known else "" for value in row]
        lines.append(",".join([_timecode(float(time)), str(values.shape[1]), *cells]))
    return "\n".join(lines) + "\n"


def _timecode(time_s: float) -> str:
    frames, thousandths = divmod(round(time_s * TIMECODE_RATE * 1000), 1000)
    seconds, frame = divmod(frames, TIMECODE_RATE)
    minutes, second = divmod(seconds, 60)
    hours, minute = divmod(minutes, 60)
    return f"{hours % 24:02d}:{minute:02d}:{second:02d}:{frame:02d}.{thousandths:03d}"


def _timecode_seconds(timecodes: Sequence[str], path: Path) -> np.ndarray:
    minutes, whole, frames = np.empty((3, len(timecodes)))
    dropping = np.zeros(len(timecodes), dtype=bool)
    for row, timecode in enumerate(timecodes):
        match = _TIMECODE.fullmatch(timecode)
        if match is None:
            raise FormatError(f"{path}: row {row + 2} has timecode {timecode!r}; HH:MM:SS:FF.mmm is needed")
        hours, minutes[row], whole[row], frames[row] = (float(match[group]) for group in (1, 2, 3, 5))
        minutes[row] += hours * 60
        dropping[row] = match[4] == ";"
    rate = _rate(minutes * 60 + whole, np.floor(frames))
    seconds = minutes * 60 + whole + frames / rate
    dropped_s = _DROPPED_S * (minutes - minutes // 10)
    seconds = np.where(dropping, (seconds - dropped_s) * 1.001, seconds)
    day = 24 * 3600
    # A take across midnight starts again at 00:00:00.
    seconds += day * np.cumsum(np.concatenate([[0], np.diff(seconds) < -day / 2]))
    return seconds - seconds[0]


def _rate(seconds: np.ndarray, frames: np.ndarray) -> int:
    """Timecode frames a second of whole seconds (n,) and the frames (n,) in them."""
    if np.ptp(seconds) < _LONG_S or len(np.unique(frames)) < _DIFFERENT:
        return TIMECODE_RATE
    return next((rate for rate in _SLOWER_RATES if frames.max() < rate), TIMECODE_RATE)

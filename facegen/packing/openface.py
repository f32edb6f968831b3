"""Packs CSV files as OpenFace writes them, one a session: what a detector says of a face, to try programs on.

Points are whole pixels, as most detectors report them. Clips of a session follow one another as in one recording.
"""

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa

from facegen.conventions import LANDMARK_COUNT
from facegen.packing.livelink import check_clips, runs
from facegen.packing.plan import Options, PackFile, PackFormat
from facegen.store import Dataset, column_array

COLUMNS = (
    *("frame", "timestamp", "confidence", "success"),
    *(f"{axis}_{point}" for axis in "xy" for point in range(LANDMARK_COUNT)),
)


def session_parts(dataset: Dataset, samples: Sequence[int], _options: Options) -> list[PackFile]:
    """One file a session, named by person and session.

    Raises
    ------
    InputError
        If the dataset has no clips but stills.
    InvalidData
        If a shard is damaged.
    """
    check_clips(dataset, "openface")
    numbers = np.asarray(samples, np.int64)
    table = pa.concat_tables(dataset.rows(numbers, ["person", "session"]))
    person, session = (table.column(name).to_numpy() for name in ("person", "session"))
    return [
        PackFile(
            name=f"person-{person[rows.start]:05d}-session-{session[rows.start]:05d}.csv",
            samples=numbers[rows].tolist(),
        )
        for rows in runs(session)
    ]


def write_session(dataset: Dataset, part: PackFile, _options: Options, path: Path) -> None:
    """Write one session; a frame without a face has success 0 and zeros for points."""
    table = pa.concat_tables(dataset.rows(part.samples, ["detected_2d", "time_s", "clip"]))
    points = column_array(table, "detected_2d")
    times = _running(table.column("time_s").to_numpy(), table.column("clip").to_numpy())
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for frame, (time_s, face) in enumerate(zip(times, points, strict=True), start=1):
            seen = int(np.isfinite(face).all())
            pixels = np.rint(face.T.ravel()).astype(int) if seen else [0] * 2 * LANDMARK_COUNT
            writer.writerow([frame, f"{time_s:.3f}", seen, seen, *pixels])


def _running(time_s: np.ndarray, clip: np.ndarray) -> np.ndarray:
    """Seconds from the start of the recording: a clip begins one frame after the one before it ends."""
    step = np.diff(time_s)
    usual = np.median(step[step > 0]) if (step > 0).any() else 0.0
    step[np.diff(clip) != 0] = usual
    return np.concatenate([[0.0], np.cumsum(step)])


OPENFACE = PackFormat(
    description="OpenFace CSV of detected landmarks, one file a session, of sequences and playbacks",
    rendered=False,
    options=frozenset(),
    shard_size=0,
    parts=session_parts,
    write=write_session,
)

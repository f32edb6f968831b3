"""Makes a table of a recording: one row for each state, as Parquet."""

from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPES
from facegen.files import output_errors, refuse_ending, refuse_sources, whole_file
from room.protocol import Flag, decode
from room.recording.lines import Came, Event, Heading, Tick
from room.recording.reader import read_recording

ROWS = 10_000
"""Rows that are held before they are written: five megabytes."""

_WHO = ("id", "name", "avatar")
_BODY = {
    "head_m": ("head_x", "head_y", "head_z"),
    "rotation": ("rotation_x", "rotation_y", "rotation_z", "rotation_w"),
    "gaze": ("left_eye_yaw", "left_eye_pitch", "right_eye_yaw", "right_eye_pitch"),
    "floor_m": ("x", "z"),
    "weights": BLENDSHAPES,
}
"""Columns of each field of `room.protocol.message.Message` that holds several numbers."""
_HANDS = {
    f"{side}_hand": tuple(
        f"{side}_hand_{axis}"
        for axis in ("x", "y", "z", "rotation_x", "rotation_y", "rotation_z", "rotation_w")
    )
    for side in ("left", "right")
}
"""Columns of each hand; empty where it was not seen, as in recordings of before there were hands."""

SCHEMA = pa.schema(
    [
        ("time_s", pa.float64()),
        *((name, pa.string()) for name in _WHO),
        ("sequence", pa.uint16()),
        ("sender_ms", pa.uint32()),
        *((flag.name.lower(), pa.bool_()) for flag in Flag),
        ("animation", pa.uint8()),
        ("heading", pa.float32()),
        *((column, pa.float32()) for columns in (_BODY | _HANDS).values() for column in columns),
    ]
)
"""Seconds since the recording began, metres and radians."""


def write_table(recording: Path, out: Path) -> int:
    """Write a recording as a table, and give its rows.

    Raises
    ------
    InputError, FormatError
        If the recording cannot be read, or ``out`` does not end in .parquet or is the recording.
    OutputError
        If the table cannot be written.
    """
    refuse_ending(out, ".parquet", what="a table")
    refuse_sources(out, [recording])
    lines = read_recording(recording)
    heading = next(lines)
    assert isinstance(heading, Heading)
    told = {"room": heading.room, "began_s": str(heading.began_s), "hertz": str(heading.hertz)}
    schema, total, held = SCHEMA.with_metadata(told), 0, []
    with (
        output_errors(out),
        whole_file(out) as unfinished,
        pq.ParquetWriter(unfinished, schema, compression="zstd") as writer,
    ):
        for row in _rows(lines):
            held.append(row)
            total += 1
            if len(held) == ROWS:
                writer.write_table(pa.Table.from_pylist(held, schema))
                held.clear()
        writer.write_table(pa.Table.from_pylist(held, schema))
    return total


def _rows(lines: Iterator[Heading | Event]) -> Iterator[dict[str, object]]:
    people: dict[int, Came] = {}
    for line in lines:
        if isinstance(line, Came):
            people[line.number] = line
        if not isinstance(line, Tick):
            continue
        for number, state in line.states:
            message = decode(state)
            yield {
                "time_s": line.time_ms / 1000,
                **{name: getattr(people[number], name) for name in _WHO},
                "sequence": message.sequence,
                "sender_ms": message.time_ms,
                **{flag.name.lower(): bool(message.flags & flag) for flag in Flag},
                "animation": message.animation,
                "heading": message.heading,
                **{
                    column: value
                    for field, columns in _BODY.items()
                    for column, value in zip(columns, getattr(message, field), strict=True)
                },
                **{
                    column: value
                    for field, columns in _HANDS.items()
                    if (hand := getattr(message, field))
                    for column, value in zip(columns, hand, strict=True)
                },
            }

"""A recording's table has hands where a headset showed them, and empty columns elsewhere."""

import asyncio

import pytest

from room.protocol import Flag
from tests.room.guests import open_room
from tests.room.recordings import make_recorder

pq = pytest.importorskip("pyarrow.parquet")

LEFT = (0.25, 1.125, 0.5, 0.0, 0.0, 0.0, 1.0)


def test_hands_are_in_the_table_and_who_shows_none_has_empty_columns(tmp_path):
    from room.recording.table import write_table

    path = tmp_path / "meeting.jsonl"

    async def run() -> None:
        recorder = make_recorder(path)
        async with open_room(recorder=recorder) as place:
            ada = await place.guest(recorded=True)
            await ada.move(sequence=0)
            await ada.move(sequence=1, flags=Flag.HANDS, left_hand=LEFT)
            await ada.until(lambda: (ada.number, 1) in ada.sequences)
            recorder.settle()

    asyncio.run(run())
    write_table(path, tmp_path / "meeting.parquet")
    without, shown = pq.read_table(tmp_path / "meeting.parquet").to_pylist()
    assert {name: shown[name] for name in shown if name.startswith("left_hand")} == {
        **{f"left_hand_{axis}": value for axis, value in zip("xyz", LEFT, strict=False)},
        **{f"left_hand_rotation_{axis}": value for axis, value in zip("xyzw", LEFT[3:], strict=True)},
    }
    assert all(shown[name] is None for name in shown if name.startswith("right_hand"))
    assert all(without[name] is None for name in without if "_hand_" in name)
    assert (without["hands"], shown["hands"]) == (False, True)

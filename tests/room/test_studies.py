"""docs/room-studies.md counts what people did: they meet, the room records, and its code blocks read the table."""

import math
import os
import re
import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from facegen.conventions import BLENDSHAPES
from room.errors import InputError
from room.protocol import Flag, Message, encode
from room.protocol.answers import Person
from room.protocol.tick import pack
from room.recording.table import write_table
from room.server.live_room import HERTZ
from tests.room.recordings import make_recorder

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "room-studies.md"
SNIPPETS = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)

HALF_S = 2.0
YAW = math.radians(45)


def _person(number: int, name: str) -> Person:
    said = {"visit": "", "moderator": False, "present": True, "voice": True, "muted": False, "face": "page"}
    consents = {"recorded": name != "Eve", "replayed": False}
    return Person(number=number, id=f"{number:016}", name=name, avatar="plain", **said, **consents)


def _meet(path: Path) -> None:
    """Ada looks at Ben by her body; Ben first away, then at her; Cy at Ada by head and eyes, then at nobody.

    Ada speaks in the first half, Ben in the second. Dan, who looks at Ada, is not tracked; Eve declines. The room says
    all this thirty times a second, by a clock that is played.
    """
    recorder, time_ms = make_recorder(path), 0
    recorder._now = lambda: time_ms
    recorder.roster(_person(number, name) for number, name in enumerate(("Ada", "Ben", "Cy", "Dan", "Eve")))
    for step in range(round(2 * HALF_S * HERTZ)):
        time_ms = round(1000 * step / HERTZ)
        first = step < HALF_S * HERTZ
        seen = {"sequence": step, "time_ms": time_ms}
        speaks = Flag.TRACKED | Flag.SPEAKING
        turned = (0.0, math.sin(YAW / 2), 0.0, math.cos(YAW / 2)) if first else (0.0, 0.0, 0.0, 1.0)
        states = [
            Message(**seen, floor_m=(0, -1), heading=0.0, flags=speaks if first else Flag.TRACKED),
            Message(
                **seen,
                floor_m=(0, 1),
                heading=0.0 if first else math.pi,
                flags=Flag.TRACKED if first else speaks,
            ),
            # Ada is at -90 degrees from Cy: half a turn of the body, 45 degrees of the head and 45 of the eyes
            Message(
                **seen,
                floor_m=(2, -1),
                heading=math.pi,
                rotation=turned,
                gaze=(YAW, 0, YAW, 0) if first else (0.0,) * 4,
                flags=Flag.TRACKED,
            ),
            Message(**seen, floor_m=(0, -3), heading=0.0),
            Message(**seen, floor_m=(1, 0), heading=0.0, flags=speaks),
        ]
        recorder.tick(pack([*enumerate(map(encode, states))], time_ms=time_ms))
        recorder.settle()
    recorder.close()


@pytest.fixture(scope="module")
def told(tmp_path_factory) -> dict[str, object]:
    """What the page's blocks leave behind."""
    folder = tmp_path_factory.mktemp("study")
    _meet(folder / "lab.jsonl")
    command = (sys.executable, "-m", "room", "export", "lab.jsonl", "--out", "lab.parquet")
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(ROOT)}
    )
    assert done.returncode == 0, done.stderr
    assert pq.read_metadata(folder / "lab.parquet").num_rows > 100 * HALF_S
    names: dict[str, object] = {}
    code = "\n".join(SNIPPETS).replace('"lab.parquet"', repr(str(folder / "lab.parquet")))
    exec(compile(code, str(PAGE), "exec"), names)
    return names


def test_who_looks_at_whom(told):
    assert len(SNIPPETS) == 2
    looks = told["looks"].to_dict()
    assert looks.pop(("Ada", "Ben")) == pytest.approx(2 * HALF_S, abs=0.1)
    assert looks.pop(("Ben", "Ada")) == pytest.approx(HALF_S, abs=0.1)
    assert looks.pop(("Ben", "Dan")) == pytest.approx(HALF_S, abs=0.1), "who stands behind Ada"
    assert looks.pop(("Cy", "Ada")) == pytest.approx(HALF_S, abs=0.1)
    assert looks == {}


def test_who_speaks_when(told):
    turns = told["turns"]
    assert [name for name, _ in turns.index] == ["Ada", "Ben"]
    (ada_from, ada_to), (ben_from, ben_to) = turns.to_numpy()
    assert ada_to - ada_from == pytest.approx(HALF_S, abs=0.1)
    assert ben_from == pytest.approx(ada_to, abs=0.1)
    assert ben_to - ben_from == pytest.approx(HALF_S, abs=0.1)


def test_the_table_has_a_name_for_every_number(told):
    table = told["table"]
    assert set(table["name"]) == {"Ada", "Ben", "Cy", "Dan"}
    numbers = table.select_dtypes("number")
    hands = [name for name in numbers if name.startswith(("left_hand", "right_hand"))]
    assert numbers[hands].isna().all(axis=None)  # nobody of these wears a headset
    assert numbers.drop(columns=hands).notna().all(axis=None)
    assert {*BLENDSHAPES, "x", "z", "heading", "rotation_w", "left_eye_yaw"} <= set(numbers)
    assert table.time_s.is_monotonic_increasing


def test_a_table_is_not_written_over_a_recording_nor_for_one_that_is_not_there(tmp_path):
    recording, table = tmp_path / "lab.jsonl", tmp_path / "lab.parquet"
    table.write_text("the last one")
    with pytest.raises(InputError, match="is no file"):
        write_table(recording, table)
    assert table.read_text() == "the last one"
    recording.write_text("kept")
    table.unlink()
    os.link(recording, table)
    with pytest.raises(InputError, match="is also what is read"):
        write_table(recording, table)
    assert table.read_text() == "kept"


@pytest.mark.parametrize("out", ["lab.csv", "lab"])
def test_a_table_of_another_kind_is_refused(out, tmp_path):
    command = (sys.executable, "-m", "room", "export", tmp_path / "lab.jsonl", "--out", tmp_path / out)
    done = subprocess.run(
        command, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(ROOT)}
    )
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert not (tmp_path / out).exists()

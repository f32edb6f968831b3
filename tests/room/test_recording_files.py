"""Files of recordings: they are read from every mark, cut off anywhere, and refused where they are none."""

import base64
import json
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from room.errors import FormatError, InputError
from room.protocol import Message, encode
from room.protocol.answers import Person
from room.protocol.tick import pack
from room.recording import check_recording, follow_recording, read_recording
from room.recording.lines import Came, Gone
from tests.room.recordings import make_recorder, recorded, states

GOOD = '{"kind":"recording","version":1,"room":"lab","began_s":1,"hertz":30,"shapes":SHAPES}\n'


CAME = '{"kind":"came","time_ms":5,"number":0,"id":"0123456789abcdef","name":"Ada","avatar":"plain"}\n'


BAD = {
    "nothing": "",
    "no recording": "hello\n",
    "another version": GOOD.replace('"version":1', '"version":2'),
    "other shapes": GOOD.replace("SHAPES", '["jawOpen"]'),
    "no heading": CAME,
    "a heading again": GOOD + GOOD,
    "a state of nobody": GOOD + '{"kind":"tick","time_ms":1,"states":[[0,"AAAA"]]}\n',
    "a state that is none": GOOD + CAME + '{"kind":"tick","time_ms":5,"states":[[0,"AAAA"]]}\n',
    "no base64": GOOD + CAME + '{"kind":"tick","time_ms":5,"states":[[0,"?"]]}\n',
    "back in time": GOOD + CAME + '{"kind":"gone","time_ms":4,"number":0}\n',
    "a name that turns the line": GOOD + CAME.replace("Ada", "\\u202eAda"),
    "nobody moves": GOOD + CAME,
    "more people than a room has": GOOD
    + "".join(CAME.replace('"number":0', f'"number":{number}') for number in range(1001))
    + f'{{"kind":"tick","time_ms":5,"states":[[0,"{base64.b64encode(encode(Message())).decode()}"]]}}\n',
}


@pytest.mark.parametrize(("most", "fewest"), [(100_000, 6), (10, 2)])
def test_a_recording_can_be_followed_from_every_mark(most, fewest, tmp_path, monkeypatch):
    path = recorded(tmp_path / "meeting.jsonl")
    monkeypatch.setattr("room.recording.reader.MARKS_MS", 50)
    monkeypatch.setattr("room.recording.reader.MOST_MARKED", most)
    lines = list(read_recording(path))[1:]
    survey = check_recording(path)
    assert fewest <= len(survey.marks) <= most
    for mark in survey.marks:
        rest = list(follow_recording(path, mark))
        before = lines[: len(lines) - len(rest)]
        assert [*before, *rest] == lines
        assert rest[0].time_ms == mark.time_ms
        there: dict[int, Came] = {}
        for line in before:
            if isinstance(line, Came):
                there[line.number] = line
            if isinstance(line, Gone):
                del there[line.number]
        assert mark.cast == there


def test_a_recording_of_ever_other_people_takes_no_more_memory_than_it_may(tmp_path, monkeypatch):
    """2 MB could hold a cast of a thousand for each of ten thousand seconds, all of them different."""
    monkeypatch.setattr("room.recording.reader.MOST_MARKED", 5_000)
    state = base64.b64encode(encode(Message())).decode()
    lines = [GOOD.replace("SHAPES", json.dumps(BLENDSHAPES))]
    lines += [CAME.replace('"number":0', f'"number":{number}') for number in range(300)]
    for second in range(1, 500):
        lines.append(
            CAME.replace('"time_ms":5', f'"time_ms":{1000 * second}').replace("Ada", f"Ada {second}")
        )
        lines.append(f'{{"kind":"tick","time_ms":{1000 * second},"states":[[0,"{state}"]]}}\n')
    path = tmp_path / "meeting.jsonl"
    path.write_text("".join(lines))
    marks = check_recording(path).marks
    assert sum({id(mark.cast): len(mark.cast) for mark in marks}.values()) <= 5_000
    gaps = [after.time_ms - before.time_ms for before, after in pairwise(marks)]
    assert len(marks) > 5
    assert max(gaps[:-1]) <= 3 * min(gaps[:-1]), "spread over the whole"


@pytest.mark.parametrize("content", BAD.values(), ids=BAD.keys())
def test_what_is_no_recording_is_refused_with_its_line(content, tmp_path):
    path = tmp_path / "meeting.jsonl"
    path.write_text(content.replace("SHAPES", json.dumps(BLENDSHAPES)))
    with pytest.raises(FormatError, match=r"meeting\.jsonl") as error:
        check_recording(path)
    assert "\n" not in str(error.value)


@settings(deadline=None, max_examples=40)
@given(share=st.floats(0, 1))
def test_whatever_was_cut_off_the_rest_is_read(share, tmp_path_factory):
    path = tmp_path_factory.mktemp("cut") / "meeting.jsonl"
    recorder = make_recorder(path)
    ada = Person(
        **{"number": 3, "id": "0" * 16, "name": "Ada", "avatar": "plain", "visit": "", "moderator": False},
        **{
            "present": True,
            "voice": False,
            "muted": False,
            "face": "page",
            "recorded": True,
            "replayed": False,
        },
    )
    recorder.roster([ada])
    for step in range(5):
        recorder.tick(pack([(3, encode(Message(sequence=step))), (4, encode(Message()))], time_ms=0))
    recorder.close()
    whole = path.read_bytes()
    first = whole.index(b"\n") + 1
    cut = first + round(share * (len(whole) - first))
    path.write_bytes(whole[:cut])
    assert len(list(read_recording(path))) == whole[:cut].count(b"\n")
    assert [state.sequence for _, state in states(path)] == list(range(max(0, whole[:cut].count(b"\n") - 2)))


def test_a_folder_or_nothing_is_no_recording(tmp_path):
    for path in (tmp_path, tmp_path / "nothing"):
        with pytest.raises(InputError, match="no file"):
            check_recording(path)

"""The texts of a meeting: what is allowed comes back as it went, and all else is refused by a sentence."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from room.errors import FormatError
from room.protocol.texts import MOST_TEXT_BYTES, Chat, Join, read_join, read_said

KEY, SECRET = "k" * 22, "s" * 22
JOIN = {"kind": "join", "key": KEY, "secret": SECRET, "name": "Ada"}


def test_a_join_is_read():
    assert read_join(json.dumps(JOIN)) == Join(key=KEY, secret=SECRET, name="Ada")


@pytest.mark.parametrize(
    "change",
    [
        {"kind": "chat"},
        {"version": 2},
        {"key": "k" * 21},
        {"key": None},
        {"secret": "short"},
        {"secret": "s" * 21 + "\n"},
        {"secret": "s" * 65},
        {"name": ""},
        {"name": "   "},
        {"name": "a" * 41},
        {"name": "\u2060"},
        {"name": "\u3164"},
        {"name": "\u2800\u2800"},
        {"name": "\ufe0f\u0301"},
        {"name": 7},
        {"avatar": "../../etc/passwd"},
        {"avatar": "https://elsewhere.example/a.glb"},
        {"role": "moderator"},
        {"moderator": True},
    ],
    ids=str,
)
def test_a_join_is_refused(change):
    with pytest.raises(FormatError):
        read_join(json.dumps(JOIN | change))


@pytest.mark.parametrize(
    ("name", "seen"),
    [
        ("two\nlines", "two lines"),
        ("right\u202eleft", "rightleft"),
        ("right\u061cleft", "rightleft"),
        ("two\u2028lines", "two lines"),
        ("two\x85lines", "two lines"),
        ("Ada\u200b", "Ada"),
        ("\ufeffAda", "Ada"),
        *(
            (f"An{sign}na{sign}", "Anna")
            for sign in "\u00ad\u034f\u115f\u2800\u3164\uffa0\u200c\u200d\ufe0f\U000e0041"
        ),
        ("Anna\u200c\u200d\u200c", "Anna"),
        ("\u0645\u06cc\u200c\u062e", "\u0645\u06cc\u200c\u062e"),
        (
            "\U0001f469\u200d\U0001f52c \u2764\ufe0f 1\ufe0f\u20e3",
            "\U0001f469\u200d\U0001f52c \u2764\ufe0f 1\ufe0f\u20e3",
        ),
    ],
)
def test_of_a_name_there_is_what_is_seen(name, seen):
    """As of what people write: they paste what they cannot see."""
    assert read_join(json.dumps(JOIN | {"name": name})).name == seen


@pytest.mark.parametrize(
    "said",
    [
        {"kind": "join", "key": KEY, "secret": SECRET, "name": "Ada"},
        {"kind": "welcome"},
        {"kind": "chat"},
        {"kind": "chat", "text": "a" * 501},
        {"kind": "chat", "text": "x", "number": 3},
        {"kind": "voice", "open": "yes"},
        {"kind": "description", "to": -1, "type": "offer", "sdp": ""},
        {"kind": "description", "to": 65536, "type": "offer", "sdp": ""},
        {"kind": "description", "to": 1.5, "type": "offer", "sdp": ""},
        {"kind": "candidate", "to": 1, "candidate": "c" * 1025},
        {"kind": "candidate", "to": 1, "candidate": "", "line": 65},
        {"kind": "moderate", "action": "own"},
        {"kind": "description", "to": 1, "type": "offer", "sdp": "s" * MOST_TEXT_BYTES},
        [],
        "chat",
        None,
    ],
    ids=lambda said: str(said)[:60],
)
def test_what_nobody_may_say_is_refused(said):
    with pytest.raises(FormatError):
        read_said(json.dumps(said))


@pytest.mark.parametrize(
    "text", ["", "{", "[" * 10_000, '{"kind":' * 1000, "NaN", "\0", '{"kind": "chat", "text": "\\ud800"}']
)
def test_what_is_no_json_is_refused(text):
    with pytest.raises(FormatError):
        read_said(text)


@given(st.text(max_size=200))
def test_any_text_is_a_line_of_chat_or_refused(text):
    try:
        said = read_said(json.dumps({"kind": "chat", "text": text}))
    except FormatError:
        return
    assert isinstance(said, Chat)
    assert said.text == said.text.strip()
    assert set(said.text) <= set(text) | {" "}
    assert not any(ord(character) < 32 for character in said.text)


@pytest.mark.parametrize(
    ("pasted", "line"),
    [
        ("C:\\\u200emeeting", "C:\\meeting"),  # Windows' own window of a file's properties puts that there
        ("two\nlines\u2028and a third", "two lines and a third"),
        ("a\u200bb\ufeff", "ab"),
        ("\u202eback", "back"),
        ("family \U0001f469\u200d\U0001f467", "family \U0001f469\u200d\U0001f467"),
        ("\u200b", ""),
    ],
)
def test_what_people_paste_into_a_line_ends_no_connection(pasted, line):
    assert read_said(json.dumps({"kind": "chat", "text": pasted})).text == line

"""Text of strangers is read within bounds, and one sentence says what is wrong with it."""

import contextlib
import json
import os
import threading
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.documents import (
    MOST_JSON_BYTES,
    MOST_TOML_BYTES,
    last_lines,
    load_json,
    load_toml,
    parse_json,
    read_bytes,
)
from facegen.errors import FormatError, InputError

DIGITS = "1" * 5000
DEEP = 100_000

DAMAGED_JSON = {
    "cut": ('{"a": [1, 2', r"is not JSON: Expecting .*, in line 1, column \d+"),
    "empty": ("", "is not JSON: Expecting value"),
    "deep": ("[" * DEEP, "nested too deeply"),
    "deep and whole": ('{"a":' * DEEP + "1" + "}" * DEEP, "nested too deeply"),
    "digits": (f'{{"a": {DIGITS}}}', "a number has too many digits"),
}
DAMAGED_TOML = {
    "cut": ("a = [1, 2", "is not valid TOML"),
    "deep": ("a = " + "[" * 30_000, "nested too deeply"),
    "deep tables": ("a = " + "{a = " * 12_000, "nested too deeply"),
    "digits": (f"a = {DIGITS}", "a number has too many digits"),
    "dots": (".".join("a" * 30_000) + " = 1", "a key of over 100 parts"),
    "dots of a table": ("[" + ".".join("a" * 30_000) + "]", "a key of over 100 parts"),
    "large": ("a = 1\n" + "#" * MOST_TOML_BYTES, f"has 65,542 bytes, but at most {MOST_TOML_BYTES:,}"),
}


@pytest.mark.parametrize("damage", DAMAGED_JSON)
def test_damaged_json_is_told(tmp_path, damage):
    text, sentence = DAMAGED_JSON[damage]
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(FormatError, match=rf"a\.json: .*{sentence}"):
        load_json(tmp_path / "a.json")


@pytest.mark.parametrize("damage", DAMAGED_TOML)
def test_damaged_toml_is_told(tmp_path, damage):
    text, sentence = DAMAGED_TOML[damage]
    (tmp_path / "a.toml").write_text(text)
    with pytest.raises(FormatError, match=rf"a\.toml: .*{sentence}"):
        load_toml(tmp_path / "a.toml")


@pytest.mark.parametrize("load", [load_json, load_toml])
def test_other_encodings_folders_and_absent_files_are_told(tmp_path, load):
    path = tmp_path / "a"
    path.write_bytes("größe = 1".encode("latin-1"))
    with pytest.raises(FormatError, match=r"is not UTF-8 text \(byte 3 of 9\)"):
        load(path)
    path.write_bytes("a = 1".encode("utf-16"))
    with pytest.raises(FormatError, match="is not UTF-8 text"):
        load(path)
    for name in (tmp_path, tmp_path / "none", tmp_path / ("a" * 300), "a\0b"):
        with pytest.raises(InputError, match=r"cannot be read \(\w+"):
            load(name)


def test_a_byte_order_mark_is_no_fault(tmp_path):
    (tmp_path / "a").write_bytes(b"\xef\xbb\xbf{}")
    assert load_json(tmp_path / "a") == {}


def test_a_large_file_is_refused_unread_and_a_pipe_once_it_is_too_long(tmp_path):
    path = tmp_path / "large.json"
    path.touch()
    os.truncate(path, MOST_JSON_BYTES + 1)
    with pytest.raises(FormatError, match=r"has 33,554,433 bytes, but at most 33,554,432 are read here"):
        load_json(path)
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for content, most in ((b"12345", 5), (b"123456", 5)):
        writer = threading.Thread(target=pipe.write_bytes, args=(content,))
        writer.start()
        if len(content) > most:
            with pytest.raises(FormatError, match="has more bytes, but at most 5"):
                read_bytes(pipe, most_bytes=most)
        else:
            assert read_bytes(pipe, most_bytes=most) == content
        writer.join()


@given(st.recursive(st.none() | st.booleans() | st.integers() | st.text(), st.lists, max_leaves=10))
def test_json_reads_as_it_was_written(value):
    assert parse_json(json.dumps(value), where="a") == value


@given(st.text())
def test_any_text_is_json_or_a_sentence(text):
    with contextlib.suppress(FormatError):
        parse_json(text, where="a")


@given(
    st.dictionaries(st.from_regex(r"[a-z]{1,5}", fullmatch=True), st.floats(allow_nan=False) | st.booleans())
)
def test_toml_reads_as_its_own_parser_reads_it(table):
    text = "".join(f"{key} = {json.dumps(value)}\n" for key, value in table.items()).replace(
        "Infinity", "inf"
    )
    path = f"/dev/fd/{_handle_of(text)}"
    assert load_toml(path) == tomllib.loads(text)


def _handle_of(text: str) -> int:
    reader, writer = os.pipe()
    os.write(writer, text.encode())
    os.close(writer)
    return reader


def test_the_end_of_a_log_of_any_length(tmp_path):
    log = tmp_path / "task.log"
    with open(log, "wb") as file:
        file.write(b"first\n")
        file.seek(40 * 1024**3)  # a hole: nothing is stored
        file.write(b"\nlast but \xff one\nlast\n")
    assert last_lines(log, 2) == ["last but \ufffd one", "last"]


def test_only_regular_files_are_logs(tmp_path):
    os.mkfifo(tmp_path / "pipe.log")
    for name in (tmp_path / "pipe.log", tmp_path, "/dev/zero", tmp_path / "none.log"):
        with pytest.raises(InputError):
            last_lines(name, 3)

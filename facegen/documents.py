"""Reads text, JSON and TOML that strangers wrote: within bounds, and one sentence for whatever is wrong with it.

For both programs. Nothing but the standard library (before Python 3.11, ``tomli`` reads TOML).
"""

import json
import os
import re
import stat
from pathlib import Path
from typing import Any, BinaryIO

from facegen.errors import FormatError, InputError

MOST_JSON_BYTES = 32 * 1024**2
"""Of JSON that describes a thing: a model's, a rig's, a dataset's record. Tables of frames have bounds of their own."""

MOST_TOML_BYTES = 64 * 1024
"""Six times the largest file that comes with facegen; beyond it the parser's time grows with the square of a key."""

MOST_PIPE_BYTES = 64 * 1024**2
"""Of a pipe or a device, whatever the bound of a file: its end cannot be seen, and some have none."""

_PIECE_BYTES = 1024**2

MOST_KEY_PARTS = 100
"""Parts of a dotted key in TOML: 32,000 cost 16 s, and the deepest key of ours has five."""


def read_bytes(path: str | os.PathLike[str], *, most_bytes: int) -> bytes:
    """Content of a file.

    Parameters
    ----------
    path
        A regular file, or a pipe that somebody writes to.
    most_bytes
        A larger file is refused before it is read.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is larger.
    """
    path = Path(path)
    try:
        with open(path, "rb") as file:
            size = os.fstat(file.fileno())
            if not stat.S_ISREG(size.st_mode):
                most_bytes = min(most_bytes, MOST_PIPE_BYTES)
            content = b"" if size.st_size > most_bytes else _content(file, most_bytes)
    except (OSError, ValueError) as error:  # ValueError: a name with a NUL in it
        raise unreadable(path, error) from None
    if size.st_size > most_bytes or len(content) > most_bytes:
        total = f" {size.st_size:,}" if stat.S_ISREG(size.st_mode) else " more"
        raise FormatError(f"{path}: has{total} bytes, but at most {most_bytes:,} are read here")
    return content


def _content(file: BinaryIO, most_bytes: int) -> bytes:
    """At most one byte more than asked for; as a read allocates what it asks for, of a pipe piece by piece."""
    pieces, left = [], most_bytes + 1
    while left and (piece := file.read(min(left, _PIECE_BYTES))):
        pieces.append(piece)
        left -= len(piece)
    return b"".join(pieces)


def last_lines(path: str | os.PathLike[str], count: int) -> list[str]:
    """The last lines of a log, however long it is: of its last MiB, what is no UTF-8 replaced.

    Raises
    ------
    InputError
        If it is no regular file, or cannot be read.
    """
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):  # a pipe would be waited for, a device never ends
            raise InputError(f"{path}: is no regular file, so no log")
        with open(path, "rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(max(0, size - _PIECE_BYTES))
            return file.read(_PIECE_BYTES).decode(errors="replace").splitlines()[-count:]
    except OSError as error:
        raise unreadable(path, error) from None


def unreadable(path: str | os.PathLike[str], error: Exception) -> InputError:
    """Sentence for a file that the system refuses to open or read."""
    reason = os.strerror(error.errno) if isinstance(error, OSError) and error.errno else str(error)
    return InputError(f"{path}: cannot be read ({reason})")


def read_text(path: str | os.PathLike[str], *, most_bytes: int) -> str:
    """Text of a file in UTF-8, with or without a byte order mark.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is larger than ``most_bytes``, or is not UTF-8.
    """
    content = read_bytes(path, most_bytes=most_bytes)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FormatError(f"{path}: is not UTF-8 text (byte {error.start + 1} of {len(content)})") from None


def load_json(path: str | os.PathLike[str], *, most_bytes: int = MOST_JSON_BYTES) -> Any:
    """Read a JSON file.

    Returns
    -------
    dict, list, str, float, int, bool or None
        Whatever the file says; the caller checks it against a typed record.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is too large, or no JSON that can be taken in.
    """
    return parse_json(read_text(path, most_bytes=most_bytes), where=str(path))


def parse_json(text: str | bytes, *, where: str) -> Any:
    """Parse JSON; ``where`` begins the sentence of an error.

    Raises
    ------
    FormatError
        If the text is no JSON, is nested too deeply, or has a number of more digits than Python converts (4,300).
    """
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise FormatError(
            f"{where}: is not JSON: {error.msg}, in line {error.lineno}, column {error.colno}"
        ) from None
    except UnicodeDecodeError:
        raise FormatError(f"{where}: is not JSON: it is not UTF-8 text") from None
    except (RecursionError, ValueError) as error:
        raise FormatError(f"{where}: is not JSON that can be taken in: {_reason(error)}") from None


def load_toml(path: str | os.PathLike[str], *, most_bytes: int = MOST_TOML_BYTES) -> dict[str, Any]:
    """Read a TOML file.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is too large, or no TOML that can be taken in.
    """
    try:
        import tomllib
    except ModuleNotFoundError:  # Python 3.10
        import tomli as tomllib

    text = read_text(path, most_bytes=most_bytes)
    if any(piece.count(".") >= MOST_KEY_PARTS for piece in re.split(r"[=,{}\[\]\n]", text)):
        raise FormatError(f"{path}: has a key of over {MOST_KEY_PARTS} parts between dots")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise FormatError(f"{path}: is not valid TOML: {error}") from None
    except (RecursionError, ValueError) as error:
        raise FormatError(f"{path}: is not TOML that can be taken in: {_reason(error)}") from None


def _reason(error: Exception) -> str:
    return "it is nested too deeply" if isinstance(error, RecursionError) else "a number has too many digits"

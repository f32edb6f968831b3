"""Opens and closes glTF files: the binary container's chunks, and how much JSON is taken in.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 4 the binary container.
"""

import json
import stat
import struct
from pathlib import Path
from typing import Any

from facegen.documents import parse_json, read_bytes, unreadable
from facegen.errors import FormatError

MOST_BYTES = 512 * 1024**2
"""Of a file with its buffers: avatars with textures have up to 200 MB."""

MOST_RECORDS = 200_000
"""Braces that open in the JSON: avatars have up to 20,000; each becomes a kilobyte and 50 us of a reader."""

MOST_VALUES = 5_000_000
"""Commas in the JSON: each stands for a number or a text of a list, 40 bytes."""

MOST_CHUNKS = 1_000
"""Of a file: two are usual, and each empty one would cost 8 bytes there and a hundred here."""

BIN = b"BIN\0"
_MAGIC, _JSON = b"glTF", b"JSON"

Chunks = list[tuple[bytes, bytes]]
"""Kind and content of each chunk after the JSON."""


def open_glb(path: Path) -> tuple[dict[str, Any], Chunks]:
    """The JSON document of a binary file, and the chunks after it.

    Raises
    ------
    InputError
        The file cannot be read.
    FormatError
        There is no such file, or it is no binary glTF 2.0 file, is damaged, or too large.
    """
    return parse_glb(read_gltf_bytes(path), str(path))


def parse_glb(
    content: bytes, where: str, *, most_json_bytes: int = MOST_BYTES
) -> tuple[dict[str, Any], Chunks]:
    """The same of bytes that are at hand already.

    Parameters
    ----------
    content
        The whole file.
    where
        Begins the sentence of an error.
    most_json_bytes
        Of the document; it is not parsed where it is longer.

    Raises
    ------
    FormatError
        It is no binary glTF 2.0 file, is damaged, or too large.
    """
    if not is_binary(content):
        raise FormatError(f"{where} is not a binary glTF 2.0 file (.glb or .vrm)")
    chunks, place = [], 12
    while place < len(content):
        if place + 8 > len(content):
            raise FormatError(f"{where} is damaged: {len(content) - place} bytes stand behind its last chunk")
        length, kind = struct.unpack_from("<I4s", content, place)
        if place + 8 + length > len(content):
            raise FormatError(f"{where} is cut off: a chunk of {length} bytes begins at {place}")
        chunks.append((kind, content[place + 8 : place + 8 + length]))
        place += 8 + length
        if len(chunks) > MOST_CHUNKS:
            raise FormatError(f"{where} has more than {MOST_CHUNKS:,} chunks; two are usual")
    if not chunks or chunks[0][0] != _JSON:
        raise FormatError(f"{where} is damaged: its first chunk is not a glTF document")
    if len(chunks[0][1]) > most_json_bytes:
        raise FormatError(
            f"{where} has a document of {len(chunks[0][1]):,} bytes; up to {most_json_bytes:,} are read"
        )
    check_amount(chunks[0][1], where)
    document = parse_json(chunks[0][1], where=where)
    if not isinstance(document, dict):
        raise FormatError(f"{where} is damaged: its first chunk is not a glTF document")
    return document, chunks[1:]


def read_gltf_bytes(path: Path) -> bytes:
    """Bytes of a file, binary or text.

    Raises
    ------
    InputError
        The file cannot be read.
    FormatError
        There is no such file, or it is too large.
    """
    try:
        kind = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        raise FormatError(f"{path} does not exist; a glTF file (.glb, .vrm or .gltf) is needed") from None
    except OSError as error:
        raise unreadable(path, error) from None
    if not stat.S_ISREG(kind):
        raise FormatError(f"{path} is no regular file; a glTF file (.glb, .vrm or .gltf) is needed")
    return read_bytes(path, most_bytes=MOST_BYTES)


def is_binary(content: bytes) -> bool:
    """Whether a file begins as binary files of version 2 do."""
    return content[:4] == _MAGIC and content[4:8] == struct.pack("<I", 2)


def json_of(content: bytes) -> bytes:
    """The JSON in a file's bytes, binary or text, as far as it is there."""
    if not is_binary(content):
        return content
    return content[20 : 20 + struct.unpack_from("<I", content.ljust(16, b"\0"), 12)[0]]


def check_amount(text: bytes, path: Path | str) -> None:
    """Refuse JSON that takes a reader gigabytes and minutes, before it is parsed.

    Raises
    ------
    FormatError
        It has more than `MOST_RECORDS` or `MOST_VALUES`.
    """
    for what, sign, most in (("records", b"{", MOST_RECORDS), ("values", b",", MOST_VALUES)):
        if text.count(sign) > most:
            raise FormatError(f"{path} has {text.count(sign):,} {what} in its JSON; up to {most:,} are read")


def glb_bytes(document: dict[str, Any], chunks: Chunks, path: Path) -> bytes:
    """Bytes of a binary file; ``path`` begins the sentence of an error.

    Raises
    ------
    FormatError
        The document holds infinity or NaN, which JSON does not know, or all is too large for the container.
    """
    try:
        text = json.dumps(document, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    except ValueError as error:
        raise FormatError(
            f"{path} holds a number that is infinite or NaN, which glTF does not know"
        ) from error
    encoded = text.encode(errors="backslashreplace")  # half a surrogate pair becomes its escape again
    padded_chunks = [
        (_JSON, padded(encoded, b" ")),
        *((kind, padded(content, b"\0")) for kind, content in chunks),
    ]
    body = b"".join(struct.pack("<I4s", len(content), kind) + content for kind, content in padded_chunks)
    return _MAGIC + struct.pack("<II", 2, 12 + len(body)) + body


def padded(content: bytes, filler: bytes) -> bytes:
    """Content up to a whole number of four bytes."""
    return content + filler * (-len(content) % 4)

"""Adds numbers to a glTF document, behind what its buffer has."""

import base64
from pathlib import Path
from typing import Any

import numpy as np

from facegen.errors import FormatError
from facegen.formats.gltf_container import BIN, MOST_BYTES, padded

_FLOAT = 5126


class Additions:
    """Accessors more in a document, whose data wait for a buffer.

    Parameters
    ----------
    document
        Of the file; it is changed.
    path
        Begins the sentence of an error.
    """

    def __init__(self, document: dict[str, Any], path: Path) -> None:
        self._path = path
        self._lists = {
            key: list(records(document, key, path)) for key in ("bufferViews", "accessors", "buffers")
        }
        document.update(self._lists)
        self._views: list[dict[str, Any]] = []
        self._data = bytearray()

    def check_room(self, count: int) -> None:
        """Refuse more float32 than a file takes, before they are made."""
        if len(self._data) + 4 * count > MOST_BYTES:
            raise FormatError(
                f"an animation of {self._path} would take more than {MOST_BYTES:,} bytes; give the take in parts"
            )

    def accessor(self, values: np.ndarray, kind: str = "SCALAR", **bounds: list[float]) -> int:
        """Index of a new accessor to scalars, or to rows of another kind."""
        views, accessors = self._lists["bufferViews"], self._lists["accessors"]
        view = {"byteOffset": len(self._data), "byteLength": values.nbytes}
        self._views.append(view)
        self._data += values.tobytes()
        views.append(view)
        accessors.append(
            {
                "bufferView": len(views) - 1,
                "componentType": _FLOAT,
                "count": values.size if kind == "SCALAR" else len(values),
                "type": kind,
            }
            | bounds
        )
        return len(accessors) - 1

    def stored(self, chunks: list[tuple[bytes, bytes]]) -> list[tuple[bytes, bytes]]:
        """The file's chunks with the data behind its binary one, or in a buffer of their own without one."""
        buffers = self._lists["buffers"]
        start = 0
        if chunks and chunks[0][0] == BIN and buffers and "uri" not in buffers[0]:
            length = buffers[0].get("byteLength")
            if not isinstance(length, int) or not 0 <= length <= len(chunks[0][1]):
                raise FormatError(
                    f"{self._path} is damaged: its buffer claims {length} of its {len(chunks[0][1])} bytes"
                )
            buffer, old = 0, padded(chunks[0][1][:length], b"\0")
            start, data = len(old), old + bytes(self._data)
            chunks = [(BIN, data), *chunks[1:]]
            buffers[0]["byteLength"] = len(data)
        else:
            buffer = len(buffers)
            uri = "data:application/octet-stream;base64," + base64.b64encode(self._data).decode()
            buffers.append({"uri": uri, "byteLength": len(self._data)})
        for view in self._views:
            view["buffer"] = buffer
            view["byteOffset"] += start
        return chunks


def records(record: dict[str, Any], key: str, path: Path) -> list[dict[str, Any]]:
    """A list of records under a key; none where it is absent or null.

    Raises
    ------
    FormatError
        It is something else.
    """
    found = record.get(key) or []
    if not isinstance(found, list) or not all(isinstance(one, dict) for one in found):
        raise FormatError(f"{path} is damaged: its {key} are no list of records")
    return found

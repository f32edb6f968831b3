"""Writes morph-target animations into an avatar's .glb file, of which nothing else changes.

The file's JSON is edited as it stands and its binary chunk is only added to: a library with a class for each
part of the format drops what its classes do not know, and avatars (VRM) are full of extensions.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 3.11 animations (channels with the path ``weights``, one output
   value a target and keyframe), 4 the binary container. Targets' names stand in ``mesh.extras.targetNames``.
"""

import base64
import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from facegen.errors import FormatError

_MAGIC, _JSON, _BIN = b"glTF", b"JSON", b"BIN\0"
_FLOAT = 5126


@dataclass(frozen=True, kw_only=True, eq=False)
class AnimatedAvatar:
    """An avatar file with an animation more.

    Attributes
    ----------
    content
        Bytes of the .glb file.
    missing
        Names that no mesh of the avatar has, in their order.
    """

    content: bytes
    missing: tuple[str, ...]


def animate_avatar(
    path: Path, names: tuple[str, ...], weights: np.ndarray, time_s: np.ndarray, *, title: str
) -> AnimatedAvatar:
    """Add one animation that moves every mesh with known morph targets, interpolated linearly.

    Names match without regard to case and underscores, and ``_L``/``_R`` means ``Left``/``Right``. Targets
    without a weight keep what the file gives them at rest.

    Parameters
    ----------
    path
        The avatar: a .glb (or .vrm) file.
    names
        What the columns of weights are called.
    weights : (n, k) float
        Rows with NaN become no keyframe.
    time_s : (n,) float
        Seconds, not negative, in order.
    title
        What the animation is called.

    Raises
    ------
    FormatError
        The file is no .glb file, has no morph target of these names, or no row has weights.
    """
    document, chunks = _open(path)
    known = ~np.isnan(weights).any(axis=1)
    times = time_s[known].astype("<f4")
    if not len(times) or times[0] < 0 or not (np.diff(times) > 0).all():
        raise FormatError(f"no animation for {path}: rows with weights need times that start at 0 s and grow")
    columns = {_key(name): weights[known, column] for column, name in enumerate(names)}
    animation: dict[str, Any] = {"name": title, "channels": [], "samplers": []}
    file = _Additions(document)
    clock = file.accessor(times, min=[float(times[0])], max=[float(times[-1])])
    matched: set[str] = set()
    for index, node in enumerate(document.get("nodes", [])):
        mesh = document["meshes"][node["mesh"]] if "mesh" in node else {}
        keys = [_key(name) for name in _target_names(mesh)]
        moved = columns.keys() & set(keys)
        if not moved:
            continue
        matched |= moved
        rest = node.get("weights") or mesh.get("weights") or [0.0] * len(keys)
        values = np.stack(
            [columns.get(key, np.full(len(times), at)) for key, at in zip(keys, rest, strict=True)], axis=1
        )
        animation["channels"].append(
            {"sampler": len(animation["samplers"]), "target": {"node": index, "path": "weights"}}
        )
        animation["samplers"].append(
            {"input": clock, "output": file.accessor(values.astype("<f4")), "interpolation": "LINEAR"}
        )
    if not matched:
        raise FormatError(
            f"{path} has no morph target called {names[0]}, {names[1]} or like any other of the {len(names)} "
            "shapes; a retargeting to its own names may help"
        )
    document.setdefault("animations", []).append(animation)
    chunks = file.stored(chunks)
    return AnimatedAvatar(
        content=_closed(document, chunks),
        missing=tuple(name for name in names if _key(name) not in matched),
    )


class _Additions:
    """Accessors more, whose data wait for a buffer."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._document = document
        self._views: list[dict[str, Any]] = []
        self._data = b""

    def accessor(self, values: np.ndarray, **bounds: list[float]) -> int:
        """Index of a new accessor to scalars."""
        views = self._document.setdefault("bufferViews", [])
        accessors = self._document.setdefault("accessors", [])
        view = {"byteOffset": len(self._data), "byteLength": values.nbytes}
        self._views.append(view)
        self._data += values.tobytes()
        views.append(view)
        accessors.append(
            {"bufferView": len(views) - 1, "componentType": _FLOAT, "count": values.size, "type": "SCALAR"}
            | bounds
        )
        return len(accessors) - 1

    def stored(self, chunks: list[tuple[bytes, bytes]]) -> list[tuple[bytes, bytes]]:
        """The file's chunks with the data behind its binary one, or in a buffer of their own without one."""
        buffers = self._document.setdefault("buffers", [])
        start = 0
        if chunks and chunks[0][0] == _BIN and buffers and "uri" not in buffers[0]:
            buffer, old = 0, _padded(chunks[0][1][: buffers[0]["byteLength"]], b"\0")
            start, data = len(old), old + self._data
            chunks = [(_BIN, data), *chunks[1:]]
            buffers[0]["byteLength"] = len(data)
        else:
            buffer = len(buffers)
            uri = "data:application/octet-stream;base64," + base64.b64encode(self._data).decode()
            buffers.append({"uri": uri, "byteLength": len(self._data)})
        for view in self._views:
            view["buffer"] = buffer
            view["byteOffset"] += start
        return chunks


def _open(path: Path) -> tuple[dict[str, Any], list[tuple[bytes, bytes]]]:
    """The JSON document and the chunks after it, as (kind, content)."""
    if not path.is_file():
        raise FormatError(f"{path} does not exist; an avatar's .glb file is needed")
    data = path.read_bytes()
    if data[:4] != _MAGIC or struct.unpack_from("<I", data.ljust(8, b"\0"), 4)[0] != 2:
        raise FormatError(f"{path} is not a binary glTF 2.0 file (.glb or .vrm)")
    chunks, place = [], 12
    try:
        while place < len(data):
            length, kind = struct.unpack_from("<I4s", data, place)
            if place + 8 + length > len(data):
                raise FormatError(f"{path} is cut off: a chunk of {length} bytes begins at {place}")
            chunks.append((kind, data[place + 8 : place + 8 + length]))
            place += 8 + length
        document = json.loads(chunks[0][1])
    except (struct.error, IndexError, ValueError) as error:
        raise FormatError(f"{path} is damaged: {error}") from error
    if chunks[0][0] != _JSON or not isinstance(document, dict):
        raise FormatError(f"{path} is damaged: its first chunk is not a glTF document")
    return document, chunks[1:]


def _closed(document: dict[str, Any], chunks: list[tuple[bytes, bytes]]) -> bytes:
    text = json.dumps(document, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()
    padded = [(_JSON, _padded(text, b" ")), *((kind, _padded(content, b"\0")) for kind, content in chunks)]
    body = b"".join(struct.pack("<I4s", len(content), kind) + content for kind, content in padded)
    return _MAGIC + struct.pack("<II", 2, 12 + len(body)) + body


def _padded(content: bytes, filler: bytes) -> bytes:
    return content + filler * (-len(content) % 4)


def _target_names(mesh: dict[str, Any]) -> list[str]:
    """Names of a mesh's morph targets; some exporters keep them with the first primitive."""
    first = (mesh.get("primitives") or [{}])[0]
    for place in (mesh, first):
        names = (place.get("extras") or {}).get("targetNames")
        if names and len(names) == len(first.get("targets", [])):
            return list(map(str, names))
    return []


def _key(name: str) -> str:
    lower = name.lower()
    for short, long in (("_l", "_left"), ("_r", "_right")):
        if lower.endswith(short):
            lower = lower.removesuffix(short) + long
    return lower.replace("_", "")

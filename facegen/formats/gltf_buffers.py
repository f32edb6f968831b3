"""Reads the buffers of a glTF file: its binary chunk, data URIs, and files beside it."""

import base64
import binascii
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote

from facegen.documents import read_bytes
from facegen.errors import FormatError
from facegen.formats.gltf_container import MOST_BYTES


def read_buffers(gltf: Any, folder: Path) -> list[bytes]:
    """Bytes of each buffer.

    Parameters
    ----------
    gltf
        What pygltflib read.
    folder
        Of the file: what it names lies there or below.

    Raises
    ------
    FormatError
        A buffer lies elsewhere, is no regular file, no base64 or absent, or they are too large together.
    """
    found: list[bytes] = []
    left = MOST_BYTES
    for number, buffer in enumerate(gltf.buffers):
        if buffer.uri is None:
            if number:
                raise FormatError(f"buffer {number} has no uri, and the binary chunk is buffer 0's")
            content = gltf.binary_blob()
            if content is None:
                raise FormatError(f"buffer {number} has no uri, and the file no binary chunk")
        elif not isinstance(buffer.uri, str):
            raise FormatError(f"buffer {number} has no text for its uri")
        elif buffer.uri.startswith("data:"):
            content = _decoded(buffer.uri, number)
        else:
            content = read_bytes(_beside(folder, buffer.uri, number), most_bytes=max(left, 0))
            left -= len(content)
        found.append(content)
    return found


def _decoded(uri: str, number: int) -> bytes:
    head, _, data = uri.partition(",")
    if not head.endswith(";base64"):
        raise FormatError(f"buffer {number} is a data URI that is not base64")
    try:
        return base64.b64decode(data)
    except (binascii.Error, ValueError) as error:
        raise FormatError(f"buffer {number} is no base64 ({error})") from error


def _beside(folder: Path, uri: str, number: int) -> Path:
    """A file below the folder: an avatar that somebody sent opens no other file of this machine."""
    name = PurePosixPath(unquote(uri))
    path = folder / name
    if "://" in uri or "\\" in uri or name.is_absolute() or ".." in name.parts or not path.is_file():
        raise FormatError(f"buffer {number} is {uri!r}, which is no file below {folder}")
    return path

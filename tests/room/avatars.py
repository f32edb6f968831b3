"""Small avatars for tests, whole or with a fault."""

import copy
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

from facegen.formats.gltf_container import BIN, glb_bytes

POINTS = struct.pack("<9f", 0, 0, 0, 0.5, 0, 0, 0, 1.7, 0)


def png(width: int, height: int, *, whole: bool = True) -> bytes:
    """A grey picture, or the header of one alone."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        return (
            struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
        )

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
    lines = zlib.compress((b"\0" + b"\x80" * width) * height) if whole else b""
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", lines) + chunk(b"IEND", b"")


PICTURE = png(4, 4)
BINARY = POINTS + PICTURE


def document() -> dict:
    """A triangle of 1.7 m with one shape and a texture."""
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(BINARY)}],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(POINTS)},
            {"buffer": 0, "byteOffset": len(POINTS), "byteLength": len(PICTURE)},
        ],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 3,
                "type": "VEC3",
                "min": [0, 0, 0],
                "max": [0.5, 1.7, 0],
            },
            {"componentType": 5126, "count": 3, "type": "VEC3"},
        ],
        "images": [{"bufferView": 1, "mimeType": "image/png"}],
        "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "meshes": [
            {
                "primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}], "material": 0}],
                "extras": {"targetNames": ["jawOpen"]},
            }
        ],
        "nodes": [{"name": "Head", "mesh": 0, "children": [1]}, {"name": "LeftEye"}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }


def avatar(change: Callable[[dict], object] = lambda _: None, binary: bytes = BINARY) -> bytes:
    """A file, after something was done to its document."""
    made = copy.deepcopy(document())
    made["buffers"][0]["byteLength"] = len(binary)
    change(made)
    return glb_bytes(made, [(BIN, binary)], Path("avatar"))


def textured(picture: bytes) -> bytes:
    """With another texture."""
    return avatar(lambda made: made["bufferViews"][1].update(byteLength=len(picture)), POINTS + picture)

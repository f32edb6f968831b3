"""Damages glTF: its JSON as a tree, the lengths of its chunks, and accessors that claim what no buffer holds."""

import json
import struct
from collections.abc import Callable
from random import Random

from tests.hostile.mutators.trees import JSON


def _split(data: bytes) -> tuple[bytes, bytes]:
    length = struct.unpack("<I", data[12:16])[0]
    return data[20 : 20 + length], data[20 + length :]


def _join(document: bytes, rest: bytes) -> bytes:
    document += b" " * (-len(document) % 4)
    body = struct.pack("<I4s", len(document), b"JSON") + document + rest
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def in_glb(change: Callable[[bytes, Random], bytes]) -> Callable[[bytes, Random], bytes]:
    """A change of JSON as one of the first chunk, lengths right."""

    def damage(data: bytes, random: Random) -> bytes:
        document, rest = _split(data)
        return _join(change(document, random), rest)

    return damage


def claims(document: bytes, random: Random) -> bytes:
    """Accessors, views and targets that say something else."""
    tree = json.loads(document)
    kind = random.choice(("accessor", "view", "sparse", "weights", "node", "target", "skin", "cycle", "uri"))
    if kind == "accessor":
        accessor = random.choice(tree["accessors"])
        accessor["count"] = random.choice(
            (0, -1, 10**8, 10**12, accessor["count"] + 1, accessor["count"] * 1000, 1.5)
        )
        if random.random() < 0.5:
            accessor.pop("bufferView", None)
    elif kind == "view":
        view = random.choice(tree["bufferViews"])
        view[random.choice(("byteOffset", "byteLength", "byteStride", "buffer"))] = random.choice(
            (-1, 0, 3, 10**9, 2**40)
        )
    elif kind == "sparse":
        accessor = random.choice(tree["accessors"])
        accessor["sparse"] = {
            "count": random.choice((0, 1, 10**8)),
            "indices": {
                "bufferView": random.choice((0, 99)),
                "componentType": random.choice((5121, 5125, 7)),
            },
            "values": {"bufferView": 0},
        }
    elif kind == "weights":
        random.choice(tree["meshes"])["weights"] = random.choice(([], [0.5], [1.0] * 1_000, "x", [None] * 52))
    elif kind == "node":
        key = random.choice(("mesh", "children", "matrix", "scale", "weights", "rotation"))
        random.choice(tree["nodes"])[key] = random.choice((99, -1, [0], [99], [0.0] * 16, [1.0] * 3, "x", {}))
    elif kind == "target":
        mesh = random.choice(tree["meshes"])
        mesh["extras"] = {
            "targetNames": random.choice(([], ["jawOpen"], ["x" * 100_000], [1] * 52, "jawOpen", None))
        }
    elif kind == "skin":
        tree["skins"] = [{"joints": random.choice(([], [99], "x"))}]
        random.choice(tree["nodes"])["skin"] = random.choice((0, 9))
    elif kind == "cycle":
        for number, node in enumerate(tree["nodes"]):
            node["children"] = [(number + 1) % len(tree["nodes"])]
    else:
        tree["buffers"][0]["uri"] = random.choice(
            ("/etc/passwd", "../x.bin", "data:;base64,AAAA", "http://x/y", "", 5)
        )
    return json.dumps(tree).encode()


GLTF = JSON | {"claims": claims}
GLB = {f"{name}": in_glb(change) for name, change in GLTF.items()}


def chunks(data: bytes, random: Random) -> bytes:
    """Headers that lie of version, lengths and kinds."""
    damaged = bytearray(data)
    place = random.choice((0, 4, 8, 12, 16, 20 + struct.unpack("<I", data[12:16])[0]))
    value = random.choice((0, 1, 2**31, 2**32 - 1, len(data), len(data) + 4, struct.unpack("<I", b"JSON")[0]))
    struct.pack_into("<I", damaged, min(place, len(damaged) - 4), value)
    return bytes(damaged)


GLB["chunks"] = chunks

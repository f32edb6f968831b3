"""A place of a floor, a wall and a screen, for tests that look at people alone.

The server's own place has steel, and what it mirrors takes nine seconds of a processor for each page, without a
graphics card.
"""

import struct
from pathlib import Path

from facegen.formats.gltf_container import BIN, glb_bytes
from room.places import Place

FLOOR = (-4, 0, -4, 0, 0, 4, 4, 0, -4)
WALL_Z_M = -4.0
WALL = (-4, 0, WALL_Z_M, 4, 0, WALL_Z_M, 0, 6, WALL_Z_M)
SCREEN = (-1, 1, 3.9, 1, 1, 3.9, 0, 2, 3.9)
MESHES = (FLOOR, WALL, SCREEN)
"""One triangle each: x, y and z of its corners."""

SPOTS = ((0, -2.2), (2.2, 0), (0, 2.2), (-2.2, 0))
"""Where newcomers stand: x and z."""

POINTS = b"".join(struct.pack("<9f", *corners) for corners in MESHES)
DOCUMENT = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [*range(len(MESHES) + len(SPOTS))]}],
    "nodes": [
        {"mesh": 0},
        {"mesh": 1},
        {"mesh": 2, "name": "screen.1"},
        *(
            {"name": f"place.{number}", "translation": [x, 0, z]}
            for number, (x, z) in enumerate(SPOTS, start=1)
        ),
    ],
    "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, "doubleSided": True}],
    "meshes": [
        {"primitives": [{"attributes": {"POSITION": at}, "material": 0}]} for at in range(len(MESHES))
    ],
    "accessors": [
        {
            **{"bufferView": 0, "byteOffset": 36 * at, "componentType": 5126, "count": 3, "type": "VEC3"},
            **{
                "min": [min(corners[axis::3]) for axis in range(3)],
                "max": [max(corners[axis::3]) for axis in range(3)],
            },
        }
        for at, corners in enumerate(MESHES)
    ],
    "bufferViews": [{"buffer": 0, "byteLength": len(POINTS)}],
    "buffers": [{"byteLength": len(POINTS)}],
}

BARE = {"": Place(content=glb_bytes(DOCUMENT, [(BIN, POINTS)], Path("bare.glb")))}
"""For every room of a server."""

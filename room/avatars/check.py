"""Decides whether others' browsers can be asked to load somebody's avatar."""

from facegen.formats.gltf_container import parse_glb
from room.errors import FormatError
from room.gltf import Bounds, check_gltf
from room.gltf.extensions import VRM

MOST_AVATAR_BYTES = 32 * 1024**2
"""Of a file: avatars with textures of 2,048 pixels have 10 to 30 MB, and everybody in the room loads it."""

MOST_DOCUMENT_BYTES = 4 * 1024**2
"""Of its JSON: ours have 0.1 MB, a VRM with many springs has 1. Four of the worst kind are parsed in a second,
so that no server does it in the process of its rooms (`room.avatars.examiner`)."""

MOST_TRIANGLES = 200_000
"""As drawn: avatars for social worlds have 10,000 to 70,000, and a room has many of them."""

MOST_DRAWN = 256
"""Primitives that are drawn one by one; ours have 11, and each costs a browser some microseconds a picture."""

MOST_NODES = 4_000
"""Bones with hair and clothes are 100 to 600; each is moved in every picture."""

_BOUNDS = Bounds(triangles=MOST_TRIANGLES, parts=MOST_DRAWN, nodes=MOST_NODES, extensions=VRM)


def check_avatar(content: bytes) -> None:
    """Refuse what is no avatar that others can load.

    Parameters
    ----------
    content
        A .glb or .vrm, whole.

    Raises
    ------
    FormatError
        With one sentence for its owner: what was found, what is allowed, what to do.
    """
    if len(content) > MOST_AVATAR_BYTES:
        raise FormatError(
            f"this avatar has {len(content):,} bytes, and at most {MOST_AVATAR_BYTES:,} are shown to others; "
            "export it with smaller textures"
        )
    document, chunks = parse_glb(content, "this avatar", most_json_bytes=MOST_DOCUMENT_BYTES)
    check_gltf(document, chunks, where="this avatar", bounds=_BOUNDS)

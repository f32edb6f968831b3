"""Reads the place in which people meet, by the name of one that comes with the server or out of a .glb file."""

from dataclasses import dataclass
from pathlib import Path

from facegen.documents import read_bytes
from facegen.formats.gltf_container import open_glb
from room.errors import FormatError, InputError
from room.places.check import check_place
from room.places.names import missing

PLAIN = "meeting"
"""Where people meet unless somebody says otherwise."""

BUILT_IN = ("meeting", "operating")
"""Places that come with the server."""

FOLDER = Path(__file__).parents[1] / "server" / "static" / "places"
"""Where they lie; ``make room-places`` makes them again."""

MOST_PLACE_BYTES = 32 * 1024**2
"""Of a file: ours have 1 to 2 MB, and everybody who comes in waits for it."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """A place that pages may be asked to load.

    Parameters
    ----------
    content
        The .glb, whole.
    word
        What people will miss there, as a sentence for whoever made it; empty where nothing is missing.
    """

    content: bytes
    word: str = ""


def read_place(wish: str) -> Place:
    """Read a place, and check that others' browsers can be asked to load it.

    Parameters
    ----------
    wish
        One of `BUILT_IN`, or the path of a .glb file.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is no .glb file, is damaged, names what lies outside, acts by itself, or is too large.
    """
    path = FOLDER / f"{wish}.glb" if wish in BUILT_IN else Path(wish)
    if path.suffix.lower() != ".glb":
        names = " or ".join(BUILT_IN)
        raise InputError(
            f"--place {wish}: there is no place of this name; {names}, or a file that ends with .glb"
        )
    try:
        content = read_bytes(path, most_bytes=MOST_PLACE_BYTES)
    except FileNotFoundError:
        raise InputError(
            f"{path} does not exist; a place is a .glb file, or {' or '.join(BUILT_IN)}"
        ) from None
    document, chunks = open_glb(path)
    if not chunks:
        raise FormatError(f"{path} has no binary part, and so nothing to look at")
    check_place(document, chunks, where=str(path))
    return Place(content=content, word=missing(document))

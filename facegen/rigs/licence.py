"""Finds the text of a rig's licence, which goes along with what is made of the rig."""

from facegen.documents import read_text
from facegen.rigs.record import rigs_folder

MOST_LICENCE_BYTES = 65_536
"""Of the licence text that goes with a rig: ten times MIT's, and longer than any."""


def licence_text(name: str) -> str:
    """The text beside the built rig ``name``, or nothing where nobody gave one.

    Raises
    ------
    InputError
        It is longer than what is read, or no text.
    """
    path = rigs_folder() / f"{name}.LICENSE"
    return read_text(path, most_bytes=MOST_LICENCE_BYTES) if path.is_file() else ""

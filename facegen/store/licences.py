"""Writes the licences and credits of what data derive from, which go along with all that is made of these data."""

import os

from facegen.documents import read_bytes
from facegen.rigs import licence_text
from facegen.spec import Spec
from facegen.store.dataset import Dataset
from facegen.store.folder import LICENCES, DatasetFolder, commit_file
from facegen.store.stage import staging

MOST_LICENCES_BYTES = 1_048_576
"""Of a dataset's licences: those of sixteen rigs."""

UNKNOWN = "unknown"
"""Whose a recording is, or under which licence, where its spec does not say."""


def recording_of(spec: Spec) -> dict:
    """What ``dataset.json`` says of the recording that everyone plays; nothing where none is played."""
    if spec.playback is None:
        return {}
    credit, licence = spec.playback.credit or UNKNOWN, spec.playback.licence or UNKNOWN
    return {"recording": {"credit": credit, "licence": licence}}


def licences(dataset: Dataset) -> bytes:
    """Text of ``LICENSE.txt``: the dataset's own, or where there is none yet, what follows from its rigs and its spec.

    Raises
    ------
    InputError
        If a text is longer than what is read.
    """
    path = dataset.folder.licences_txt
    if path.is_file():
        return read_bytes(path, most_bytes=MOST_LICENCES_BYTES)
    return licences_of_sources(dataset).encode()


def licences_of_sources(dataset: Dataset) -> str:
    """Licences, credits and texts of a dataset's rigs, and of the recording that its people play.

    Raises
    ------
    InputError
        If the text of a rig's licence is longer than what is read.
    """
    parts = [
        "What these data derive from, and its licences. Keep this file with them and with what is made of them."
    ]
    for rig in dataset.rigs:
        parts.append(
            f"Heads: the rig {rig.name!r}, {rig.version}\nSource: {rig.source}\nLicence: {rig.licence}"
        )
        if text := licence_text(rig.name).strip():
            parts.append(text)
    for recording in recording_of(dataset.spec).values():
        parts.append(
            f"Movement: a recording of a person\nWhose: {recording['credit']}\nLicence: {recording['licence']}"
        )
    return "\n\n".join(parts) + "\n"


def put_licences(content: bytes, folder: DatasetFolder) -> None:
    """Write ``LICENSE.txt`` into a folder of what derives from a dataset, where it has none.

    Raises
    ------
    OutputError
        If the folder cannot be written.
    """
    if os.path.lexists(folder.licences_txt):
        return
    with staging(folder, "licences") as stage:
        (stage / LICENCES).write_bytes(content)
        commit_file(stage / LICENCES, folder.licences_txt)

"""Begins the folder of a pack by its ``pack.json``, and refuses a folder that holds anything else."""

from facegen.errors import InputError
from facegen.files import output_errors
from facegen.formats.litter import is_litter
from facegen.store import DatasetFolder, commit_file, read_json, staging, write_json

ABOUT = "pack.json"

_UNTOLD = 1
"""Version of a pack whose ``pack.json`` tells none, as those of facegen 1.0."""


def check_place(folder: DatasetFolder, description: dict) -> bool:
    """Say whether a folder holds a begun pack of this very description; writes nothing.

    Raises
    ------
    InputError
        If it holds another pack, one of another version, or anything else.
    """
    about = folder.path / ABOUT
    # looked into first: an equal run beside this one may begin the pack meanwhile
    with output_errors(folder.path):
        full = folder.path.is_dir() and any(
            entry.name != "tmp" and not is_litter(entry.name) for entry in folder.path.iterdir()
        )
    if about.is_file():
        _check_equal(folder, {"version": _UNTOLD} | read_json(about), description)
        return True
    if full:
        raise InputError(f"{folder.path}: is not empty and holds no pack; choose another folder")
    return False


def begin_place(folder: DatasetFolder, description: dict) -> None:
    """Write ``pack.json``, unless it is there.

    Raises
    ------
    InputError
        As `check_place`.
    OutputError
        If the folder cannot be written.
    """
    if check_place(folder, description):
        return
    with output_errors(folder.path):
        folder.path.mkdir(parents=True, exist_ok=True)
    with staging(folder, "begin") as stage:
        write_json(stage / ABOUT, description)
        commit_file(stage / ABOUT, folder.path / ABOUT)


def _check_equal(folder: DatasetFolder, found: dict, description: dict) -> None:
    if found | {"version": description["version"]} != description:
        raise InputError(f"{folder.path}: holds another pack; choose another folder, or delete this one")
    if found != description:
        raise InputError(
            f"{folder.path}: was packed by another version of facegen, whose files of the format "
            f"{description['format']!r} differ; choose another folder, or delete this one"
        )

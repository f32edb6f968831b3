"""Finds headset files by name and reads them; says in one sentence what is wrong with one."""

import os
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from facegen.assets import assets_folder
from facegen.documents import load_toml
from facegen.errors import InputError, MissingAsset
from facegen.headsets.headset import Headset
from facegen.refusals import refusal

_ADAPTER = TypeAdapter(Headset)


def headset_folder() -> Path:
    """Folder of the headsets that come with the project; a new one is a new file there, or a path."""
    return assets_folder() / "headsets"


def list_headsets() -> tuple[str, ...]:
    """Names of the headsets that come with the project, sorted."""
    return tuple(sorted(path.stem for path in headset_folder().glob("*.toml")))


def load_headset(name_or_path: str | Path) -> Headset:
    """The headset of that name, or of the TOML file at that path.

    Raises
    ------
    MissingAsset
        Where there is no such headset.
    FormatError
        Where the file is not TOML that can be taken in.
    InputError
        Where a key is unknown or missing, or a value impossible; the message names the key's path.
    """
    path = headset_path(name_or_path)
    return parse_headset(load_toml(path), source=path.name)


def parse_headset(content: dict, *, source: str) -> Headset:
    """A headset from the content of a TOML file; ``source`` names it in errors."""
    try:
        return _ADAPTER.validate_python(content)
    except ValidationError as error:
        raise InputError(f"{source}: {refusal(error, Headset)}") from None


def headset_path(name_or_path: str | Path) -> Path:
    """Where the headset's file is: names are looked up in `headset_folder`, what ends in .toml is a path."""
    path = Path(name_or_path)
    named = path.suffix != ".toml"
    if named:
        path = headset_folder() / f"{name_or_path}.toml"
    if not os.path.isfile(path):  # False for names that no file can have, too
        if not named:
            raise MissingAsset(f"{path}: there is no such file; give the path of a headset's .toml file")
        known = ", ".join(list_headsets())
        here = f"known are {known}" if known else f"none are in {headset_folder()}, which a clone has"
        raise MissingAsset(
            f"there is no headset {str(name_or_path)!r}; {here}, or give the path of a .toml file"
        )
    return path

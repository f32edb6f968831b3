"""Reads what describes a built rig: ``NAME.json``, beside the arrays of ``NAME.npz``."""

import os
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from facegen.assets import assets_folder
from facegen.conventions import BLENDSHAPES
from facegen.documents import load_json
from facegen.errors import FormatError, InputError, MissingAsset
from facegen.refusals import refusal
from facegen.rigs.versions import VERSIONS

RIG_FORMAT = 1
"""Version of the files. A reader refuses others: a rig is built anew in seconds."""

_BUILT_FROM = {"ict": " --path CLONE (a clone of ICT-FaceKit; the shipped specs want --modes 24 as well)"}
"""What `facegen rig build` must be told of a rig, beside its name."""

_Count = Annotated[int, Field(ge=1, le=10_000_000)]


class _Record(BaseModel):
    """What `load_rig` relies on in ``NAME.json``; further keys are for people."""

    model_config = ConfigDict(strict=True, extra="allow")

    name: str
    format: Annotated[int, Field(ge=RIG_FORMAT, le=RIG_FORMAT)]
    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
    licence: str
    source: str
    version: str
    vertices: _Count
    faces: _Count
    cage_vertices: _Count
    identity_components: Annotated[int, Field(ge=0, le=10_000)]
    traits: list[Literal["one", "female", "age", "african", "asian"]]
    missing: list[Literal[BLENDSHAPES]]


def rigs_folder() -> Path:
    """Where built rigs lie: the environment's FACEGEN_RIGS, else ``blender_assets/build``."""
    return Path(os.environ.get("FACEGEN_RIGS") or assets_folder() / "build")


def built_rigs(folder: Path | None = None) -> list[str]:
    """Names of the rigs of which both files lie in a folder; default `rigs_folder`."""
    folder = Path(folder) if folder is not None else rigs_folder()
    return sorted(file.stem for file in folder.glob("*.npz") if os.path.isfile(file.with_suffix(".json")))


def made_again(name: str) -> str:
    """What to do about a rig whose files are not what was written."""
    if name in VERSIONS:
        return f"build it again with: facegen rig build {name} --force{_BUILT_FROM.get(name, '')}"
    return f"add it again with: facegen rig add FILE --landmarks JSON --name {name} --force"


def read_record(name: str, folder: Path | None = None) -> dict:
    """Content of ``NAME.json``.

    Raises
    ------
    MissingAsset
        No rig of this name has been built.
    InputError
        The file is not one that `save_rig` wrote.
    """
    folder = Path(folder) if folder is not None else rigs_folder()
    path = folder / f"{name}.json"
    if not os.path.isfile(path) or not os.path.isfile(path.with_suffix(".npz")):
        built = ", ".join(built_rigs(folder)) or "none"
        known = name in VERSIONS
        cure = (
            f"make it with: facegen rig build {name}{_BUILT_FROM.get(name, '')}"
            if known
            else "make one of your own head with: facegen rig add"
        )
        raise MissingAsset(f"There is no rig {name!r} in {folder} (built: {built}); {cure}")
    again = made_again(name)
    try:
        record = load_json(path)
    except FormatError as error:
        raise FormatError(f"{error}; {again}") from None
    if isinstance(record, dict) and type(record.get("format")) is int and record["format"] != RIG_FORMAT:
        raise InputError(f"{path} has format {record['format']}, this version reads {RIG_FORMAT}; {again}")
    try:
        _Record.model_validate(record)
    except ValidationError as error:
        raise FormatError(f"{path} is damaged ({refusal(error, _Record)}); {again}") from None
    return record

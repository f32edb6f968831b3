"""Checks what a model's folder holds before a new model replaces it, and replaces it in one step."""

import hashlib
import os
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from facegen.documents import read_bytes
from facegen.files import output_errors, staging, swap_folders, sweep, sync, write_whole
from facegen.formats.litter import is_litter
from regress.errors import InputError, OutputError
from regress.runtime.documents import read_document


@dataclass(frozen=True, kw_only=True)
class ModelKind:
    """One of the kinds of model folder.

    Parameters
    ----------
    name
        As ``model.json`` has it under ``kind``; where it has none, it is of ``KEYPOINTS``.
    title
        For people.
    keys
        That every ``model.json`` of this kind has.
    numbers
        The file beside ``model.json``.
    """

    name: str
    title: str
    keys: frozenset[str]
    numbers: str


KEYPOINTS = ModelKind(
    name="keypoints",
    title="a model of 68 points",
    keys=frozenset({"schema", "blendshapes", "weights_sha256"}),
    numbers="weights.npz",
)
HEADSET = ModelKind(
    name="headset",
    title="a model of headset pictures",
    keys=frozenset({"version", "headset", "network_sha256"}),
    numbers="network.onnx",
)

LICENCES = "LICENSE.txt"
"""Licences and credits of what a model learned from, as they lay beside the data."""

MOST_LICENCES_BYTES = 1_048_576
"""Of such a file: as many as `facegen` reads of a dataset's."""

_MADE_OF_IT = ("report.html", "exports", LICENCES)
"""What lies beside a model, some of it put there by `make`: of the old model, so it goes with it."""


def check_place(folder: str | os.PathLike[str], kind: ModelKind) -> None:
    """Say early that a model cannot be written there: training takes minutes.

    An empty folder will do, and so will one with a model of this kind and nothing else but its report and exports.

    Raises
    ------
    OutputError
        Where the folder holds anything that would be lost, or nobody may write beside it.
    """
    folder = Path(folder)
    if folder.name in ("", ".."):
        raise OutputError(f"the model cannot be written to {folder}, which has no name; choose another --out")
    if folder.exists():
        _check_old(folder, kind)
    parent = folder.absolute().parent
    while not parent.exists():
        parent = parent.parent
    if not (parent.is_dir() and os.access(parent, os.W_OK)):
        raise OutputError(f"the model cannot be written to {folder}: {parent} is not a writable folder")


def licences_beside(data: str | os.PathLike[str]) -> dict[str, bytes]:
    """The file ``LICENSE.txt`` of a folder of data or of a model, for the folder of a model that is made of it.

    Raises
    ------
    InputError
        Where it is longer than what is read.
    """
    path = Path(data) / LICENCES
    return {LICENCES: read_bytes(path, most_bytes=MOST_LICENCES_BYTES)} if path.is_file() else {}


def write_folder(folder: Path, kind: ModelKind, files: Mapping[str, bytes]) -> None:
    """Write a model's folder whole: into a private folder beside it, then in one step into its place.

    Where the system can exchange two names (Linux, macOS), there is no moment without a model. A link to a folder
    stays a link; folder and files keep their modes. What killed writers left is removed.

    Parameters
    ----------
    folder
        A model of the same kind there is replaced.
    files
        Content by name.

    Raises
    ------
    OutputError
        Where the place cannot be written, or holds anything that would be lost.
    """
    check_place(folder, kind)
    with output_errors(folder):
        place = Path(os.path.realpath(folder))
        place.parent.mkdir(parents=True, exist_ok=True)
        prefix = _stage(place)
        with staging(place.parent, prefix) as stage:
            sweep(place.parent, f"{prefix}-*")
            new = stage / "new"
            new.mkdir()
            for name, content in files.items():
                write_whole(new / name, content)
            if place.exists():
                _keep_modes(place, new)
            sync(new)
            _put(new, place, aside=stage / "old")
            sync(place.parent)


def _stage(place: Path) -> str:
    """Begins the names of half-made models; nobody else's hidden folder begins so, however long the model's name is."""
    return f".model-{hashlib.sha256(os.fsencode(place.name)).hexdigest()[:12]}"


def _keep_modes(old: Path, new: Path) -> None:
    shutil.copymode(old, new)
    for path in new.iterdir():
        if (old / path.name).is_file():
            shutil.copymode(old / path.name, path)


def _put(new: Path, place: Path, *, aside: Path) -> None:
    """Give a folder its place; what stands there lies behind one of the other names afterwards."""
    if not place.exists():
        new.rename(place)
    elif not swap_folders(new, place):
        place.rename(aside)  # a folder cannot be renamed over a full one
        try:
            new.rename(place)
        except BaseException:
            aside.rename(place)
            raise


def _check_old(folder: Path, kind: ModelKind) -> None:
    try:
        names = sorted(path.name for path in folder.iterdir()) if folder.is_dir() else None
    except OSError as error:
        raise OutputError(f"{folder} cannot be looked into: {error.strerror or error}") from error
    names = None if names is None else [name for name in names if not is_litter(name)]
    if names == []:
        return
    if names is None or "model.json" not in names:
        raise OutputError(f"{folder} exists and is not a model folder; choose another --out")
    old = _kind_of(folder / "model.json")
    if old is None:
        raise OutputError(f"{folder / 'model.json'} is of no model that regress wrote; choose another --out")
    if old is not kind:
        raise OutputError(f"{folder} is {old.title}, and {kind.title} would replace it; choose another --out")
    others = [name for name in names if name not in ("model.json", kind.numbers, *_MADE_OF_IT)]
    if others:
        raise OutputError(
            f"{folder} holds {', '.join(others)} beside its model, which would be lost; move that away, or choose "
            f"another --out"
        )


def _kind_of(path: Path) -> ModelKind | None:
    """Of the model that a model.json describes; None where it is not of this package."""
    try:
        document = read_document(path)
    except InputError:
        return None
    name = document.get("kind", KEYPOINTS.name)
    return next(
        (kind for kind in (KEYPOINTS, HEADSET) if kind.name == name and kind.keys <= document.keys()), None
    )

"""Builds facegen's rigs where a build is missing or old, and adds a user's own head."""

import re
import shutil
from pathlib import Path

from facegen.errors import InputError, MissingAsset
from facegen.rigs.anny import ANNY
from facegen.rigs.builder import RigBuilder, RigSources
from facegen.rigs.files import save_rig
from facegen.rigs.gltf_head import AddedHead, build_head
from facegen.rigs.ict import ICT
from facegen.rigs.record import read_record, rigs_folder
from facegen.rigs.versions import VERSIONS

RIGS: dict[str, RigBuilder] = {"anny": ANNY, "ict": ICT}
"""Every rig that facegen builds; a new one is a module, a line here and its build in `VERSIONS`."""


def build_rig(
    name: str,
    *,
    path: Path | None = None,
    wheel: Path | None = None,
    folder: Path | None = None,
    modes: int | None = None,
    force: bool = False,
) -> tuple[Path, bool]:
    """Build rig ``name`` unless it is there already.

    Parameters
    ----------
    name
        One of `RIGS`.
    path
        Folder of its sources, for those that are built from one.
    wheel
        Wheel of its sources, of which a copy is kept for avatars; downloaded where not given.
    folder
        Where to write; default `facegen.rigs.files.rigs_folder`.
    modes
        Identity modes to take, for those that are built from a folder: any clone then gives the same file.
    force
        Build even if the same version is there.

    Returns
    -------
    tuple
        Path of the .npz and whether it was built now.

    Raises
    ------
    InputError
        Unknown name or unusable sources.
    """
    if name not in RIGS:
        raise InputError(f"There is no rig {name!r} to build; facegen builds {' and '.join(RIGS)}")
    folder = Path(folder) if folder is not None else rigs_folder()
    npz = folder / f"{name}.npz"
    if not force and path is None and wheel is None and _up_to_date(name, folder, modes):
        return npz, False
    if modes is not None and path is None:
        raise InputError(
            f"Rig {name!r} of {modes} modes is not in {folder}; --modes is for one that is built from a folder, "
            "as ict from a clone of ICT-FaceKit: say where it lies with --path DIR"
        )
    sources = RigSources(path=path, wheel=wheel, downloads=folder / "download", modes=modes)
    save_rig(RIGS[name].build(sources), folder)
    if path is not None and (path / "LICENSE").is_file():  # ICT's terms ask that it goes with the shapes
        shutil.copyfile(path / "LICENSE", folder / f"{name}.LICENSE")
    return npz, True


def add_rig(
    file: Path,
    landmarks: Path | None,
    *,
    name: str | None = None,
    folder: Path | None = None,
    force: bool = False,
) -> tuple[Path, AddedHead]:
    """Make a rig without identities of a user's glTF head.

    Parameters
    ----------
    file
        A .glb, .gltf or .vrm file with ARKit morph targets.
    landmarks
        JSON file that marks it up (`facegen.rigs.markup.HeadMarkup`); None asks for what the file holds.
    name
        Of the rig; default the file's, in lower case.
    folder
        Where to write; default `facegen.rigs.files.rigs_folder`.
    force
        Replace a rig of this name.

    Returns
    -------
    tuple
        Path of the .npz, and the rig with the names of what was left out.

    Raises
    ------
    InputError
        Unusable files, or a name that is taken or not allowed.
    """
    folder = Path(folder) if folder is not None else rigs_folder()
    name = name if name is not None else re.sub("[^a-z0-9]+", "_", file.stem.lower()).strip("_")
    if name in RIGS or not re.fullmatch("[a-z0-9][a-z0-9_-]*", name):
        raise InputError(
            f"A rig cannot be called {name!r}: lower-case letters, digits, - and _ are allowed, and not the names "
            f"of facegen's own rigs ({', '.join(RIGS)}); choose one with --name"
        )
    if (folder / f"{name}.npz").exists() and not force:
        raise InputError(
            f"There is a rig {name!r} in {folder}; choose another --name, or replace it with --force"
        )
    added = build_head(file, landmarks, name=name)
    return save_rig(added.rig, folder), added


def _up_to_date(name: str, folder: Path, modes: int | None) -> bool:
    try:
        record = read_record(name, folder)
    except (MissingAsset, InputError):
        return False
    return record["version"] == VERSIONS[name] and modes in (None, record["identity_components"])

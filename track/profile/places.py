"""Where profiles lie: one file a person and camera in the user's configuration folder, or any file that is named."""

import hashlib
import re
from collections.abc import Mapping
from pathlib import Path

from track.errors import InputError
from track.profile.profile import Profile, read_profile

ENDING = ".toml"

DEFAULT_PERSON = "me"
"""Whose profile is taken where nobody says."""

_LONGEST = 80
"""Characters of a camera's title in a file's name."""

_DEVICE = re.compile(r"(?:/dev/video|camera )0*(\d+)(?=#|$)")
"""One webcam, by its device or its number."""

_PERSON = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")


def profile_folder() -> Path:
    """The folder of all profiles, which need not exist."""
    import platformdirs

    return Path(platformdirs.user_config_dir("track", appauthor=False)) / "profiles"


def camera_key(titles: Mapping[str, str]) -> str:
    """What a profile's file is called after: what each camera is, whatever order and spelling they were given in.

    Parameters
    ----------
    titles
        By the camera's name: ``"camera"`` where it is the only one and has none.
    """
    sources = {name: _DEVICE.sub(r"camera \1", title) for name, title in sorted(titles.items())}
    key = " ".join(title if name == "camera" else f"{name}={title}" for name, title in sources.items())
    return key.encode(errors="backslashreplace").decode()  # a file's name may be no text


def known_path(named: str | None, titles: Mapping[str, str]) -> Path:
    """`profile_path` of these cameras; the file of before names stood in it, where only that is there.

    Raises
    ------
    InputError
        As `profile_path`.
    """
    path = profile_path(named, camera_key(titles))
    if path.parent != profile_folder() or path.is_file():
        return path
    former = path.with_name(f"{person_of(path)}.{_as_former_name(' '.join(titles.values()))}{ENDING}")
    return former if former.is_file() else path


def profile_path(named: str | None, camera: str) -> Path:
    """The file that ``--profile`` stands for: a name of a person, or a file by its ending.

    Parameters
    ----------
    named
        None for `DEFAULT_PERSON`.
    camera
        What `camera_key` gives.

    Raises
    ------
    InputError
        Where it is neither.
    """
    named = named or DEFAULT_PERSON
    if named.endswith(ENDING):
        return Path(named)
    if not _PERSON.fullmatch(named):
        raise InputError(
            f"--profile {named[:60]!r} is neither a file ending with {ENDING} nor a name of up to 64 letters, digits, "
            f"'_' and '-'"
        )
    return profile_folder() / f"{named}.{_as_name(camera)}{ENDING}"


def person_of(path: Path) -> str:
    """Whose profile a file is by its name."""
    return path.name.removesuffix(ENDING).split(".")[0] or DEFAULT_PERSON


def stored_profiles() -> dict[str, Profile | None]:
    """Profiles of the folder by their names; None for those that cannot be read."""
    found: dict[str, Profile | None] = {}
    for path in sorted(profile_folder().glob(f"*{ENDING}")):
        try:
            found[path.name.removesuffix(ENDING)] = read_profile(path)
        except InputError:
            found[path.name.removesuffix(ENDING)] = None
    return found


def read_stored(path: Path) -> Profile:
    """Read a profile; of a damaged one in the folder it is said what removes it.

    Raises
    ------
    InputError
        Where it cannot be read.
    """
    try:
        return read_profile(path)
    except InputError as error:
        if path.parent != profile_folder():
            raise
        name = path.name.removesuffix(ENDING)
        raise InputError(f"{error}; `track profiles delete {name}` removes it") from error


def stored_path(name: str) -> Path:
    """The file of a stored profile by its name or its person's, or a file that is named itself.

    Raises
    ------
    InputError
        Where there is none, or a person has several.
    """
    if _names_itself(name):
        return Path(name)
    folder = profile_folder()
    names = sorted(path.name.removesuffix(ENDING) for path in folder.glob(f"*{ENDING}"))
    fitting = [each for each in names if each == name] or [
        each for each in names if each.split(".")[0] == name
    ]
    if len(fitting) == 1:
        return folder / f"{fitting[0]}{ENDING}"
    if fitting:
        raise InputError(f"{name} has {len(fitting)} profiles, name one of {', '.join(fitting)}")
    raise InputError(
        f"there is no profile {name!r} in {folder}; "
        + (f"there are {', '.join(names)}" if names else "`track calibrate` makes one")
    )


def disposable_path(name: str) -> Path:
    """The file of a profile that may be deleted, by all names that `stored_path` knows.

    Raises
    ------
    InputError
        Where there is none, a person has several, or a file that is named itself is no profile: a damaged one can go by
        its name in the folder alone.
    """
    path = stored_path(name)
    if _names_itself(name):
        try:
            read_profile(path)
        except InputError as error:
            raise InputError(
                f"{error}: that is no profile, and is not deleted; a damaged one goes by its name in {profile_folder()}"
            ) from error
    return path


def _names_itself(name: str) -> bool:
    """Whether a file is named, wherever it lies, and no profile of the folder."""
    return name.endswith(ENDING) and Path(name).is_file()


def _as_name(camera: str) -> str:
    """A camera's title as part of a file's name: in ASCII, and with a mark where letters are lost."""
    name = re.sub(r"[^A-Za-z0-9_-]+", "-", camera).strip("-").lower() or "camera"
    whole = camera.isascii() and len(name) <= _LONGEST
    return (
        name
        if whole
        else f"{name[:_LONGEST]}-{hashlib.sha256(camera.encode(errors='backslashreplace')).hexdigest()[:8]}"
    )


def _as_former_name(camera: str) -> str:
    """The same as it was before: without a mark where it was cut."""
    return _as_name(camera) if not camera.isascii() else _as_name(camera)[:_LONGEST]

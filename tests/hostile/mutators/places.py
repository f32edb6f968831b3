"""Puts something else where a file was, or the file under another name."""

import os
import shutil
from pathlib import Path
from random import Random


def _gone(path: Path) -> None:
    shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()


def missing(path: Path) -> None:
    """Nothing."""
    _gone(path)


def folder(path: Path) -> None:
    """A folder."""
    _gone(path)
    path.mkdir()


def dangling(path: Path) -> None:
    """A link to nothing."""
    _gone(path)
    path.symlink_to("nowhere")


def looped(path: Path) -> None:
    """A link to itself."""
    _gone(path)
    path.symlink_to(path.name)


def endless(path: Path) -> None:
    """A link to a device that never ends."""
    _gone(path)
    path.symlink_to("/dev/zero")


def closed(path: Path) -> None:
    """A file that nobody may read (root may)."""
    path.chmod(0)


def empty(path: Path) -> None:
    """Nothing in it, or no entries."""
    _gone(path)
    path.write_bytes(b"")


KINDS = (missing, folder, dangling, looped, endless, closed, empty)
"""A pipe is none: who reads one waits for its writer, as everywhere."""


def kind(path: Path, random: Random) -> None:
    """Another kind of file."""
    random.choice(KINDS)(path)


NAMES = (
    *(
        "²",
        "٣",
        "1" * 20,
        "9" * 200,
        "x" * 245,
        "a b",
        "-x",
        "--help",
        "é",
        "\udc80\udcff",
        "a\nb",
        "a\x1b[31mb",
        "'",
        '"',
    ),
    *(
        "$(id)",
        "{{x}}",
        "%s",
        "{0}",
        "..x",
        ".x",
        "nul",
        "a" * 100 + "²",
        "1e9",
        "00000000000000000000000001",
        "*",
        "[a]",
    ),
)


def name(path: Path, random: Random) -> Path:
    """Another name, the ending kept."""
    chosen = random.choice(NAMES)
    new = path.with_name(f"{chosen}{path.suffix}")
    while len(os.fsencode(new.name)) > 255:
        chosen = chosen[:-1]
        new = path.with_name(f"{chosen}{path.suffix}")
    path.rename(new)
    return new

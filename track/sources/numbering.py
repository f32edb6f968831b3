"""Numbers in the names of a folder's pictures, which say what a camera lost between ``left_49`` and ``left_60``."""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from regress.runtime.headset.pictures.picture_file import PICTURES

_NUMBER = re.compile(r"(.*?)(\d+)\D*", re.DOTALL)
"""What stands before the last number of a file's name, and that number, before its ending."""

_THERE = 0.7
"""Least share of the numbers from the first to the last that are there: less has every second picture, or a clock's
times."""


def pictures_in(folder: Path) -> list[Path]:
    """Files whose names end as pictures' do, in no order; macOS writes ``._1.png`` beside 1.png on others' disks.

    Raises
    ------
    OSError
        Where the folder cannot be read.
    """
    return [
        file for file in folder.iterdir() if file.suffix.lower() in PICTURES and not file.name.startswith(".")
    ]


def last_number(file: Path) -> int:
    """Of a file whose folder has `numbers_of` its pictures."""
    return int(_NUMBER.fullmatch(file.stem)[2])


def numbers_of(files: Sequence[Path]) -> range | None:
    """Numbers from a folder's first picture to its last one; None where names do not count them."""
    found = [_NUMBER.fullmatch(file.stem) for file in files]
    if not found or not all(found) or len({match[1] for match in found}) > 1:
        return None
    numbers = {int(match[2]) for match in found}
    spanned = range(min(numbers), max(numbers) + 1)
    counted = len(numbers) == len(files) >= _THERE * (spanned.stop - spanned.start)
    return spanned if counted else None


def shared_numbers(folders: Iterable[Path]) -> range | None:
    """The same of folders that are read together; None where one has none, or they are of other pictures."""
    try:
        spanned = [numbers_of(pictures_in(folder)) for folder in folders]
    except OSError:
        return None  # who opens the folder says why
    if not spanned or None in spanned:
        return None
    if max(each.start for each in spanned) >= min(each.stop for each in spanned):
        return None
    return range(min(each.start for each in spanned), max(each.stop for each in spanned))

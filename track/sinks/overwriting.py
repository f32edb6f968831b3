"""Refuses recordings that would replace what the same run reads or writes: a face may have no other copy."""

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from facegen.files import refuse_sources
from track.errors import InputError
from track.sinks.targets import Target


def refuse_overwriting(
    targets: Iterable[tuple[str, Target]],
    *,
    read: Sequence[Path],
    folders: Sequence[tuple[Path, tuple[str, ...]]],
    written: Mapping[Path, str],
) -> None:
    """See that each recording has a name of its own; others are replaced, as a person asks for it.

    Parameters
    ----------
    targets
        Each with the option that names it.
    read
        Files; those that are not there cannot be replaced.
    folders
        Whose files with these endings are read.
    written
        Whole paths of other files, each with the option that names it.

    Raises
    ------
    InputError
        Where a recording is one of them, or two have one name.
    """
    others = dict(written)
    for option, target in targets:
        if not target.is_file:
            continue
        path = target.path
        inside = [folder / path.name for folder, endings in folders if path.suffix.lower() in endings]
        refuse_sources(path, [*read, *inside], option=option)
        whole = Path(os.path.realpath(path))
        if whole in others:
            raise InputError(f"{option} {path} is also what {others[whole]} writes; give another name")
        others[whole] = option

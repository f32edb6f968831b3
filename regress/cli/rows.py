"""Rows of a recording that can be used, and word of the others."""

from facegen.console import say
from regress.errors import InputError
from regress.runtime.inputs import Frames, emptied, row_faults, told


def sound_rows(frames: Frames, *, strictly: bool = False, strict: bool = False) -> Frames:
    """The frames with NaN for those that cannot be used, of which a person is told.

    Parameters
    ----------
    frames
        As read.
    strictly
        Whether each must have a time of its own, as smoothing needs.
    strict
        Whether one that cannot be used is an error.

    Raises
    ------
    InputError
        Where ``strict`` and a row is faulty, or where all are.
    """
    faults = row_faults(frames, strictly=strictly)
    found = told(faults)
    if found and strict:
        raise InputError(f"{frames.source}: {'; '.join(found)}; without --strict their cells stay empty")
    if None not in faults:
        raise InputError(f"{frames.source} holds no usable frame: {'; '.join(found)}")
    for line in found:
        say(f"{frames.source}: {line}")
    return emptied(frames, faults)

"""Which rows of a recording show a face at rest: named by a person, found, or those of another file."""

from pathlib import Path

import numpy as np

from facegen.console import say
from regress.cli.rows import sound_rows
from regress.errors import InputError
from regress.runtime.inputs import Frames, read_frames
from regress.runtime.inputs.frames import FEWEST_PX
from regress.runtime.model import Model
from regress.runtime.stages.neutral import estimate_neutral, frame_rate

SHARES = (
    "points lie between 0 and 1, as shares of a picture's width and height; --picture WIDTHxHEIGHT makes pixels of "
    "them, without it the picture is taken for a square"
)
"""Said of points in such a unit."""


_MOST_LINES = 10
"""Of folders or faces, of each of which there is something to say: of more it is summed up."""


def in_pixels(frames: Frames, picture_px: tuple[int, int] | None) -> Frames:
    """The frames in pixels; where no picture is known of shares, a person is told.

    Raises
    ------
    InputError
        Where a picture is known, and points are neither shares of it nor its pixels.
    """
    if not frames.shares:
        if picture_px is not None:
            refuse_other_units(frames.extent, frames.source)
        return frames
    if picture_px is None:
        say(f"{frames.source}: {SHARES}")
        return frames
    return frames.in_pixels(picture_px)


def refuse_other_units(extent: float, source: str) -> None:
    """Raise an InputError where a face's extent is none in pixels."""
    if extent < FEWEST_PX:
        raise InputError(
            f"{source}: faces are {extent:.3g} wide or high, so points are neither pixels nor shares of the picture "
            "from 0 to 1; --picture needs one of these, so write pixels"
        )


def neutral_faces(model: Model, frames: Frames, neutral: str) -> dict[str | None, Frames | None]:
    """Neutral frames of each of the faces in a recording (`Frames.takes`), where they are named or found.

    Parameters
    ----------
    model
        That is to be calibrated.
    frames
        Rows that cannot be used have NaN for their points.
    neutral
        ``"none"``; ``"auto"``; ``"first"``, each face's first usable frame; what `named_rows` takes; or a file, which
        is of every face.

    Raises
    ------
    InputError
        Where it is none of these, or no named frame has a face.
    """
    takes = {face: frames.take(rows) for face, rows in frames.takes().items()}
    if neutral == "none":
        return dict.fromkeys(takes)
    if neutral == "auto":
        return _found_faces(model, takes, frames)
    if neutral == "first":
        firsts = {face: np.flatnonzero(take.usable)[:1] for face, take in takes.items()}
        return {face: takes[face].take(rows) if len(rows) else None for face, rows in firsts.items()}
    named = {face: named_rows(take, neutral) for face, take in takes.items()}
    if any(named.values()):
        seen = {face: [row for row in rows if takes[face].usable[row]] for face, rows in named.items()}
        named = seen if any(seen.values()) else named  # of none, the networks say so themselves
        without = [face for face, rows in named.items() if not rows]
        if len(without) > _MOST_LINES:
            say(
                f"{frames.source}: weights of {len(without)} of {len(named)} {frames.kind_of_takes}s are not "
                "calibrated: --neutral names no usable frame of them"
            )
        for face in without if len(without) <= _MOST_LINES else ():
            say(
                f"{frames.source}: weights{_called(frames, face)} are not calibrated: --neutral names no usable "
                "frame of it"
            )
        return {face: takes[face].take(rows) if rows else None for face, rows in named.items()}
    first, last = frames.labels[0], frames.labels[-1]
    calm = neutral_file(neutral, frames.source, labels=f" ({first} to {last})")
    return dict.fromkeys(takes, in_pixels(calm, frames.picture_px))


def named_rows(take: Frames, neutral: str) -> list[int]:
    """Rows of one face's frame that is named by its label, or of frames FIRST-LAST.

    A picture of a film has the same name for all of its faces; ``NUMBER/FACE`` is one of them.
    """
    return (
        _rows_of(take.labels, neutral)
        or _rows_of(take.picture_names or (), neutral)
        or _rows_between(take, neutral)
    )


def neutral_file(neutral: str, source: str, *, labels: str = "") -> Frames:
    """Neutral frames of a file of their own; ``source`` and ``labels`` say what else could have been named.

    Raises
    ------
    InputError
        Where there is no such file, or no usable frame in it.
    """
    if not Path(neutral).exists():
        raise InputError(
            f"--neutral {neutral!r} is neither a frame of {source}{labels}, nor a file; first, auto and none are "
            "allowed too"
        )
    return sound_rows(read_frames(neutral))


def _found_faces(
    model: Model, takes: dict[str | None, Frames], frames: Frames
) -> dict[str | None, Frames | None]:
    """Neutral frames of each take, where they are found; a line each says so, or one of many."""
    found: dict[str | None, Frames | None] = {}
    sentences = []
    for face, take in takes.items():
        found[face] = None
        if not take.usable.any():
            continue
        estimate, called = (
            estimate_neutral(model, take.points, frame_rate(take.time_s)),
            _called(frames, face),
        )
        if estimate.sure:
            found[face] = take.take(estimate.frames)
            sentences.append(f"neutral face found{called}: {estimate.reason}")
        else:
            sentences.append(f"no neutral face found{called}, weights are not calibrated: {estimate.reason}")
    if len(sentences) > _MOST_LINES:
        sure = sum(each is not None for each in found.values())
        sentences = [
            f"neutral faces found of {sure} of {len(takes)} {frames.kind_of_takes}s, weights of the others are not "
            "calibrated"
        ]
    for sentence in sentences:
        say(f"{frames.source}: {sentence}")
    return found


def _called(frames: Frames, face: str | None) -> str:
    return "" if face is None else f" of {frames.kind_of_takes} {face}"


def _rows_between(take: Frames, named: str) -> list[int]:
    """Rows of pictures that are called by numbers, from one to another; some, and the ends too, may be left out."""
    ends, names = named.split("-"), take.picture_names or take.labels
    called = take.numbers is not None and names[:1] == (str(take.numbers[0]),)
    if not called or len(ends) != 2 or not all(end.isdecimal() for end in ends):
        return []
    first, last = map(int, ends)
    return np.flatnonzero((first <= take.numbers) & (take.numbers <= last)).tolist()


def _rows_of(labels: tuple[str, ...], named: str) -> list[int]:
    if named in labels:
        return [labels.index(named)]
    # labels may have dashes of their own
    for dash in (place for place, letter in enumerate(named) if letter == "-"):
        first, last = named[:dash], named[dash + 1 :]
        if first in labels and last in labels:
            return list(range(labels.index(first), labels.index(last) + 1))
    return []

"""Reads a recording line by line; a last line that a killed server did not finish is left out."""

import itertools
from collections.abc import Generator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, Field, TypeAdapter, ValidationError

from facegen.conventions import BLENDSHAPES
from facegen.refusals import refusal
from room.errors import FormatError, InputError
from room.protocol import check
from room.recording.lines import (
    MOST_AT_ONCE,
    MOST_LINE_BYTES,
    MOST_RECORDING_BYTES,
    Came,
    Event,
    Gone,
    Heading,
    Tick,
)

_HEADING = TypeAdapter(Heading)
_EVENT: TypeAdapter[Event] = TypeAdapter(Annotated[Event, Field(discriminator="kind")])


MARKS_MS = 1000
"""Between two places from which a recording can be followed: 36,000 in ten hours."""

MOST_MARKED = 100_000
"""Such places, and names of those who are there as it changes between them; with more the places lie further apart."""


@dataclass(frozen=True, kw_only=True)
class Mark:
    """A place in the file from which it can be followed: the line there, its time, and who is there before it."""

    time_ms: int
    offset: int
    line: int
    cast: Mapping[int, Came]


@dataclass(frozen=True, kw_only=True)
class Survey:
    """What a recording has, once it was read whole."""

    path: Path
    heading: Heading
    begins_ms: int
    ends_ms: int
    marks: tuple[Mark, ...]


def read_recording(path: Path) -> Generator[Heading | Event, None, None]:
    """Give the heading, then what happened, in its order.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is too large, or a line is none: also one that goes back in time, or a state of nobody.
    """
    for _, _, line in _read(path):
        yield line


def follow_recording(path: Path, mark: Mark) -> Generator[Event, None, None]:
    """Give what happened from a mark on.

    Raises
    ------
    InputError, FormatError
        As `read_recording`.
    """
    for _, _, line in _read(path, mark):
        assert not isinstance(line, Heading)
        yield line


def _read(path: Path, mark: Mark | None = None) -> Generator[tuple[int, int, Heading | Event], None, None]:
    """Give each line with its place and number.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is too large, or a line is none: also one that goes back in time, or a state of nobody.
    """
    try:
        if not path.is_file():
            raise InputError(f"{path}: is no file; name a recording of `room serve --record`")
        if path.stat().st_size > MOST_RECORDING_BYTES:
            raise FormatError(
                f"{path}: has {path.stat().st_size:,} bytes, and at most {MOST_RECORDING_BYTES:,}"
            )
        with path.open("rb") as file:
            people: set[int] = set(mark.cast) if mark else set()
            before = mark.time_ms if mark else 0
            file.seek(mark.offset if mark else 0)
            for number in itertools.count(mark.line if mark else 1):
                offset = file.tell()
                content = file.readline(MOST_LINE_BYTES + 1)
                if len(content) > MOST_LINE_BYTES:
                    raise FormatError(f"{path}, line {number}: is longer than {MOST_LINE_BYTES:,} bytes")
                if not content.endswith(b"\n"):  # the end, or what a killed server left of a line
                    if number == 1:
                        raise FormatError(f"{path}: is empty; a recording begins with a line that says so")
                    return
                try:
                    line = (_HEADING if number == 1 else _EVENT).validate_json(content)
                except ValidationError as error:
                    known = Heading if number == 1 else BaseModel
                    raise FormatError(f"{path}, line {number}: {refusal(error, known)}") from None
                if isinstance(line, Heading):
                    if line.shapes != BLENDSHAPES:
                        raise FormatError(f"{path}, line 1: its shapes are not the 52 of this version")
                else:
                    if line.time_ms < before:
                        raise FormatError(f"{path}, line {number}: is earlier than the line before it")
                    before = line.time_ms
                    _follow(people, line, f"{path}, line {number}")
                yield offset, number, line
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error})") from None


def check_recording(path: Path) -> Survey:
    """Read a recording whole, and say what it has.

    Raises
    ------
    InputError, FormatError
        As `read_recording`; also if nobody is in it.
    """
    lines = _read(path)
    _, _, heading = next(lines)
    assert isinstance(heading, Heading)
    marks = _Marks()
    cast: dict[int, Came] = {}
    ticks = ends = 0
    for offset, number, line in lines:
        assert not isinstance(line, Heading)
        marks.pass_by(offset, number, line.time_ms, cast)
        match line:
            case Came():
                cast[line.number] = line
            case Gone():
                cast.pop(line.number, None)
            case Tick():
                ticks += 1
                ends = line.time_ms
    if not ticks:
        raise FormatError(f"{path}: nobody moves in it; nobody agreed to be recorded")
    return Survey(
        path=path, heading=heading, begins_ms=marks.marks[0].time_ms, ends_ms=ends, marks=tuple(marks.marks)
    )


class _Marks:
    """Takes marks while a recording is read, and no more than memory should hold of anybody's file."""

    def __init__(self) -> None:
        self.marks: list[Mark] = []
        self._every_ms, self._size = MARKS_MS, 0

    def pass_by(self, offset: int, line: int, time_ms: int, cast: dict[int, Came]) -> None:
        """Come to a line; ``cast`` is who is there before it."""
        if self.marks and time_ms < self.marks[-1].time_ms + self._every_ms:
            return
        # marks share what did not change between them
        same = bool(self.marks) and self.marks[-1].cast == cast
        known = self.marks[-1].cast if same else dict(cast)
        self.marks.append(Mark(time_ms=time_ms, offset=offset, line=line, cast=known))
        self._size += 1 if same else 1 + len(cast)
        while self._size > MOST_MARKED and len(self.marks) > 1:
            self._thin()

    def _thin(self) -> None:
        """Leave every other mark out, and go on as seldom."""
        self.marks = self.marks[::2]
        self._every_ms *= 2
        casts = {id(mark.cast): len(mark.cast) for mark in self.marks}
        self._size = len(self.marks) + sum(casts.values())


def _follow(people: set[int], event: Event, where: str) -> None:
    """Hold a line against who is there.

    Raises
    ------
    FormatError
        If it is of nobody, or of one more than a room has, or a state is none.
    """
    match event:
        case Came():
            people.add(event.number)
            if len(people) > MOST_AT_ONCE:
                raise FormatError(f"{where}: has more than {MOST_AT_ONCE:,} people at one time")
        case Gone():
            people.discard(event.number)
        case Tick():
            for number, state in event.states:
                if number not in people:
                    raise FormatError(f"{where}: has a state of number {number}, who is not there")
                try:
                    check(state)
                except FormatError as error:
                    raise FormatError(f"{where}: {error}") from None

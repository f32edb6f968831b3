"""The table of sources, and the choice among them by what a person wrote; a new one is a module and a line here."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from track.sources.capture import Capture
from track.sources.films import Film
from track.sources.source import Source
from track.sources.webcams import WebcamSource


@dataclass(frozen=True, kw_only=True)
class Pace:
    """How kept pictures are given.

    Parameters
    ----------
    fast
        Every picture, as fast as they are taken; else at their own pace, as a camera would.
    fps
        Pictures a second, of a folder and of lines without times.
    """

    fast: bool = False
    fps: float = 30.0


@dataclass(frozen=True, kw_only=True)
class SourceKind:
    """One kind of source.

    Parameters
    ----------
    description
        For people: what is written to have it.
    matches
        Whether a text means it.
    open
        Opens it.
    """

    description: str
    matches: Callable[[str], bool]
    open: Callable[[str, Pace], Source]


SOURCES: dict[str, SourceKind] = {
    "film": SourceKind(
        description="a film's file",
        matches=lambda text: Path(text).is_file(),
        open=lambda text, pace: Film(Path(text), fast=pace.fast),
    ),
    "webcam": SourceKind(
        description="a webcam's number, or a part of its name",
        matches=lambda text: True,
        open=lambda text, pace: WebcamSource(text),
    ),
}
"""Tried in this order."""


def open_source(text: str, pace: Pace | None = None) -> Source:
    """Open what a text names.

    Raises
    ------
    CameraError
        Where it cannot be opened; a sentence says what can be done.
    """
    kind = next(kind for kind in SOURCES.values() if kind.matches(text))
    return kind.open(text, pace or Pace())


def open_capture(texts: Mapping[str, str], pace: Pace | None = None) -> Capture:
    """Open several cameras by their names, each from what a text names, and begin to read them.

    Raises
    ------
    CameraError
        Where one cannot be opened.
    """
    return Capture({name: _opener(text, pace) for name, text in texts.items()})


def _opener(text: str, pace: Pace | None) -> Callable[[], Source]:
    return lambda: open_source(text, pace)

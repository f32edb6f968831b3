"""The table of sources, and the choice among them by what a person wrote; a new one is a module and a line here."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from regress.runtime.headset.halves import split_half
from track.errors import CameraError
from track.sources.addresses import AddressSource, is_address, without_secrets
from track.sources.capture import Capture
from track.sources.films import Film
from track.sources.folders import Folder
from track.sources.lines import Lines
from track.sources.numbering import shared_numbers
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
    again
        Whether films and folders begin again when they are over.
    numbers
        From the first to the last number of folders that are read together (`track.sources.numbering`).
    """

    fast: bool = False
    fps: float = 30.0
    again: bool = False
    numbers: range | None = None


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
    live
        Whether what it shows is there once, for whoever opens it.
    """

    description: str
    matches: Callable[[str], bool]
    open: Callable[[str, Pace], Source]
    live: bool = False


_NUMBER = re.compile(r"(?:/dev/video)?0*(\d+)")
"""A webcam's number, or its device on Linux."""


SOURCES: dict[str, SourceKind] = {
    "lines": SourceKind(
        description="- for lines of 68 points on standard input",
        matches=lambda text: text == "-",
        open=lambda text, pace: Lines(fast=pace.fast, fps=pace.fps),
    ),
    "address": SourceKind(
        description="an address of MJPEG over HTTP, or RTSP",
        matches=is_address,
        open=lambda text, pace: AddressSource(text),
        live=True,
    ),
    "folder": SourceKind(
        description="a folder of pictures",
        matches=lambda text: _there(text, Path.is_dir),
        open=lambda text, pace: Folder(
            Path(text), fast=pace.fast, fps=pace.fps, again=pace.again, numbers=pace.numbers
        ),
    ),
    "film": SourceKind(
        description="a film's file",
        matches=lambda text: _there(text, Path.is_file),
        open=lambda text, pace: Film(Path(text), fast=pace.fast, again=pace.again),
    ),
    "webcam": SourceKind(
        description="a webcam's number, or a part of its name",
        matches=lambda text: True,
        open=lambda text, pace: WebcamSource(text),
        live=True,
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
    if text.strip() == "":
        raise CameraError(
            f"a camera has no name; give {', or '.join(each.description for each in SOURCES.values())}"
        )
    return _kind_of(text).open(text, pace or Pace())


def open_capture(texts: Mapping[str, str], pace: Pace | None = None) -> Capture:
    """Open several cameras by their names, each from what a text names, and begin to read them.

    ``0#left`` is the left half of camera 0's pictures.

    Raises
    ------
    CameraError
        Where one cannot be opened, or two are the same camera.
    """
    # two cameras may be halves of one source, which is opened once
    halves = {
        name: (text, "") if _there(text, Path.exists) else split_half(text) for name, text in texts.items()
    }
    _refuse_same(halves)
    folders = [Path(text) for text, _ in halves.values() if _kind_of(text) is SOURCES["folder"]]
    pace = replace(pace or Pace(), numbers=shared_numbers(folders))
    if not any(half for _, half in halves.values()):
        return Capture({name: _opener(text, pace) for name, text in texts.items()})
    return Capture({text: _opener(text, pace) for text, _ in halves.values()}, halves=halves)


def _refuse_same(halves: Mapping[str, tuple[str, str]]) -> None:
    """Refuse two names of one live source, which opens once and shows the same to both; of films it may be wanted."""
    named: dict[tuple[str, str], list[str]] = {}
    for name, (text, half) in halves.items():
        if _kind_of(text).live:
            number = _NUMBER.fullmatch(text.strip())
            named.setdefault((f"camera {number[1]}" if number else text, half), []).append(name)
    for (text, half), names in named.items():
        if len(names) > 1:
            told = f"{', '.join(names[:-1])} and {names[-1]} are the same, {_shown(text)}"
            left, right = (f"{name}={_shown(halves[name][0])}" for name in names[:2])
            raise CameraError(
                f"{told}#{half}; give each another half or camera"
                if half
                else f"{told}; give each another camera, or its half where one shows both eyes side by side: "
                f"{left}#left {right}#right"
            )


def _shown(text: str) -> str:
    return without_secrets(text) if is_address(text) else text


def _kind_of(text: str) -> SourceKind:
    return next(kind for kind in SOURCES.values() if kind.matches(text))


def _opener(text: str, pace: Pace) -> Callable[[], Source]:
    return lambda: open_source(text, pace)


def _there(text: str, test: Callable[[Path], bool]) -> bool:
    """Whether a file or folder of this name is there; what can be no name is none."""
    try:
        return test(Path(text))
    except (OSError, ValueError):
        return False

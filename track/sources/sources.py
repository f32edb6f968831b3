"""The table of sources, and the choice among them by what a person wrote; a new one is a module and a line here."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from facegen.redaction import without_secrets
from regress.runtime.headset.pictures.halves import split_half
from track.errors import CameraError
from track.sources.addresses import AddressSource, is_address
from track.sources.camera_memory import CameraMemory
from track.sources.camera_mode import CameraMode, split_mode
from track.sources.capture import Capture
from track.sources.films import Film
from track.sources.folders import Folder
from track.sources.lines import Lines
from track.sources.numbering import shared_numbers
from track.sources.source import Source
from track.sources.video_nodes import same_camera
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
        Opens it; the memory is of the camera that this text means, from one opening to the next.
    live
        Whether what it shows is there once, for whoever opens it.
    """

    description: str
    matches: Callable[[str], bool]
    open: Callable[[str, Pace, CameraMemory], Source]
    live: bool = False


SOURCES: dict[str, SourceKind] = {
    "lines": SourceKind(
        description="- for lines of 68 points on standard input",
        matches=lambda text: text == "-",
        open=lambda text, pace, memory: Lines(fast=pace.fast, fps=pace.fps),
    ),
    "address": SourceKind(
        description="an address of MJPEG over HTTP, or RTSP",
        matches=is_address,
        open=lambda text, pace, memory: AddressSource(text),
        live=True,
    ),
    "folder": SourceKind(
        description="a folder of pictures",
        matches=lambda text: _there(text, Path.is_dir),
        open=lambda text, pace, memory: Folder(
            Path(text), fast=pace.fast, fps=pace.fps, again=pace.again, numbers=pace.numbers
        ),
    ),
    "film": SourceKind(
        description="a film's file",
        matches=lambda text: _there(text, Path.is_file),
        open=lambda text, pace, memory: Film(Path(text), fast=pace.fast, again=pace.again),
    ),
    "webcam": SourceKind(
        description="a webcam's number, or a part of its name",
        matches=lambda text: True,
        open=lambda text, pace, memory: WebcamSource(text, memory=memory),
        live=True,
    ),
}
"""Tried in this order."""


def open_source(text: str, pace: Pace | None = None, *, say: Callable[[str], None] | None = None) -> Source:
    """Open what a text names.

    Parameters
    ----------
    text
        As a person wrote it; a webcam's mode may stand behind it (`track.sources.camera_mode`).
    pace
        Of kept pictures.
    say
        Takes sentences about a camera that gives something else than was asked.

    Raises
    ------
    CameraError
        Where it cannot be opened; a sentence says what can be done.
    """
    source, mode = (text, CameraMode()) if _there(text, Path.exists) else _with_mode(text)
    return _open(source, pace or Pace(), CameraMemory(mode=mode, say=say))


def open_capture(
    texts: Mapping[str, str], pace: Pace | None = None, *, say: Callable[[str], None] | None = None
) -> Capture:
    """Open several cameras by their names, each from what a text names, and begin to read them.

    ``0#left`` is the left half of camera 0's pictures, ``0,fps=120#left`` of its pictures in a mode.

    Raises
    ------
    CameraError
        Where one cannot be opened, is asked for in two modes, or two are the same camera.
    """
    parts = _spelt_alike({name: _parts(text) for name, text in texts.items()})
    # two cameras may be halves of one source, which is opened once
    halves = {name: (source, half) for name, (source, half, _) in parts.items()}
    _refuse_same(halves)
    folders = [Path(source) for source, _ in halves.values() if _kind_of(source) is SOURCES["folder"]]
    pace = replace(pace or Pace(), numbers=shared_numbers(folders))
    modes = _modes({name: (source, mode) for name, (source, _, mode) in parts.items()})

    def opener(name: str) -> Callable[[], Source]:
        source, memory = halves[name][0], CameraMemory(mode=modes[name], say=say)
        return lambda: _open(source, pace, memory)

    if not any(half for _, half in halves.values()):
        return Capture({name: opener(name) for name in texts})
    return Capture({source: opener(name) for name, (source, _) in halves.items()}, halves=halves)


def _open(source: str, pace: Pace, memory: CameraMemory) -> Source:
    if source.strip() == "":
        raise CameraError(
            f"a camera has no name; give {', '.join(each.description for each in SOURCES.values())}"
        )
    return _kind_of(source).open(source, pace, memory)


def _parts(text: str) -> tuple[str, str, CameraMode]:
    """A source, the half of its pictures that is meant, and its mode; what is a file's name is one as it stands."""
    if _there(text, Path.exists):
        return text, "", CameraMode()
    source, half = split_half(text)
    if _there(source, Path.exists):
        return source, half, CameraMode()
    source, mode = _with_mode(source)
    return source, half, mode


def _spelt_alike(parts: Mapping[str, tuple[str, str, CameraMode]]) -> dict[str, tuple[str, str, CameraMode]]:
    """Parts whose webcams are spelt as where they come first: 0 and /dev/video0 are opened once."""
    first: list[str] = []
    alike = {}
    for name, (source, half, mode) in parts.items():
        if _kind_of(source) is SOURCES["webcam"]:
            found = [other for other in first if same_camera(source, other)]
            first += [] if found else [source]
            source = (found or [source])[0]
        alike[name] = source, half, mode
    return alike


def _with_mode(text: str) -> tuple[str, CameraMode]:
    """A source, and the mode behind it, which webcams alone can have."""
    source, mode = split_mode(text)
    if not mode:
        return source, mode
    if _kind_of(source) is not SOURCES["webcam"]:
        raise CameraError(
            f"{without_secrets(source) if is_address(source) else source} is no webcam, and webcams alone have a mode: "
            "leave out what stands behind the comma, or write %2C for an address' own"
        )
    whole, half = split_half(source)
    if half:
        raise CameraError(
            f"the half {half!r} stands before the mode of camera {whole}; put it last: 0,fps=60#{half}"
        )
    return source, mode


def _modes(asked: Mapping[str, tuple[str, CameraMode]]) -> dict[str, CameraMode]:
    """Each camera's mode; one that asks for none has that of the other name for the same webcam."""
    modes = {}
    for name, (source, mode) in asked.items():
        same = {
            other: theirs for other, (its, theirs) in asked.items() if theirs and same_camera(source, its)
        }
        others = [other for other in same if mode and same[other] != mode]
        if others:
            raise CameraError(
                f"{name} and {others[0]} ask for camera {source} in two modes, and it has one at a time; "
                "give both the same"
            )
        modes[name] = next(iter(same.values()), mode)
    return modes


def _refuse_same(halves: Mapping[str, tuple[str, str]]) -> None:
    """Refuse two names of one live source, which opens once and shows the same to both; of films it may be wanted."""
    named: dict[tuple[str, str], list[str]] = {}
    for name, (text, half) in halves.items():
        if _kind_of(text).live:
            named.setdefault((text, half), []).append(name)
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


def _there(text: str, test: Callable[[Path], bool]) -> bool:
    """Whether a file or folder of this name is there; what can be no name is none."""
    try:
        return test(Path(text))
    except (OSError, ValueError):
        return False

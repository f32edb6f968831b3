"""Runs a session for a command: opens what was asked for, lets Ctrl-C end it, and closes everything."""

import contextlib
import math
import signal
import threading
import webbrowser
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from facegen.console import ProgressCall, counted, progress
from track.cli.opening import Wishes, camera_texts, is_headset, open_cameras, open_pipeline, open_profile
from track.errors import InputError
from track.profile.keeper import ProfileKeeper
from track.profile.profile import write_profile

if TYPE_CHECKING:
    from track.messages import Moment
    from track.session.measures import Summary
    from track.session.session import Screen, Session
    from track.sinks.sink import Sink
    from track.sources import Capture

RECORDINGS = {".csv": "csv", ".glb": "gltf", ".vrma": "vrma"}
"""Sinks by a recording's ending."""

NAMED = ("csv:", "gltf:")
"""Sinks that take any other avatar's names."""


@dataclass(frozen=True, kw_only=True)
class RunOptions:
    """What was asked for besides cameras and model; names are those of the options of ``track run``."""

    to: Sequence[str] = ()
    record: Sequence[Path] = ()
    retarget: str | None = None
    mirror: bool | None = None
    own_blinks: bool = True
    page: bool = True
    browser: bool = True
    avatar: Path | None = None
    host: str = "127.0.0.1"
    port: int = 0
    seconds: float | None = None


def run_session(wishes: Wishes, options: RunOptions, say: Callable[[str], None]) -> "Summary":
    """Run until the end, and say how it went."""
    texts = camera_texts(wishes.cameras, headset=is_headset(wishes))
    with contextlib.ExitStack() as closing:
        sinks = open_sinks(options, say, closing)
        session, capture = open_session(wishes, texts, sinks, say, closing, options=options, must_keep=False)
        screen = _open_page(options, session, texts, say, closing) if options.page else None
        with ended_by_signals(session, capture), contextlib.ExitStack() as showing:
            if screen is None and wishes.fast and capture.length_s is not None:
                screen = _Progress(capture, showing.enter_context(progress(unit="s")))
            summary = session.run(capture, screen, seconds=options.seconds)
        if options.page and capture.over:
            *others, last = capture.titles.values()
            told = f"{', '.join(others)} and {last} are" if others else f"{last} is"
            say(f"{told} over, and so is the page; --loop plays again and again")
        say(how_it_went(summary))
        return summary


class _Progress:
    """Shows how much of a film has been read."""

    def __init__(self, capture: "Capture", told: ProgressCall) -> None:
        self._told, self._length_s, self._title = (
            told,
            math.ceil(capture.length_s),
            ", ".join(capture.titles.values()),
        )
        self._shown_s = 0

    def publish(self, moment: "Moment") -> None:
        """Once a second of the film."""
        done_s = min(math.ceil(moment.sample.time_s), self._length_s)
        if done_s > self._shown_s:
            self._shown_s = done_s
            self._told(self._title, done_s, self._length_s)


def how_it_went(summary: "Summary") -> str:
    """A session in a sentence."""
    told = f"{counted(summary.frames, 'frame')}, a face in {summary.faces:,}"
    if summary.frames and summary.latency_ms:
        told += f"; {summary.fps:.0f} a second, {summary.latency_ms['p50']:.0f} ms from picture to avatar"
    return told


def open_session(
    wishes: Wishes,
    texts: dict[str, str],
    sinks: "list[Sink]",
    say: Callable[[str], None],
    closing: contextlib.ExitStack,
    *,
    options: RunOptions,
    must_keep: bool = True,
) -> "tuple[Session, Capture]":
    """A session and its cameras, which ``closing`` lets go.

    ``must_keep`` says whether a profile that cannot be written ends the session; else it is told once.
    """
    from track.session.session import Session

    pipeline = open_pipeline(wishes, texts, say)
    closing.callback(pipeline.close)
    capture = open_cameras(wishes, texts)
    closing.callback(capture.close)
    profile, stored, path = open_profile(wishes, pipeline, capture.titles, say)
    if must_keep:
        keep = partial(write_profile, path)
    else:
        keeper = ProfileKeeper(path, say)
        closing.callback(keeper.close)
        keep = keeper.keep
    session = Session(
        pipeline=pipeline,
        sinks=sinks,
        profile=profile,
        say=say,
        kept=stored,
        keep=keep,
        new_recording=lambda: _open(f"csv:{_free_name()}", say),
        mirror=options.mirror,
        own_blinks=options.own_blinks,
        keep_blinks=capture.endless,
        timed=not wishes.fast,
    )
    closing.callback(session.close)
    return session, capture


def open_sinks(
    options: RunOptions, say: Callable[[str], None], closing: contextlib.ExitStack
) -> "list[Sink]":
    """Sinks as they were written.

    Raises
    ------
    InputError, OutputError
        Where one is not known, or its place cannot be used.
    """
    written = list(options.to)
    for path in options.record:
        if path.suffix not in RECORDINGS:
            raise InputError(f"--record {path}: a recording ends with {', '.join(RECORDINGS)}")
        written.append(f"{RECORDINGS[path.suffix]}:{path}")
    if options.retarget is not None:
        written = [f"{each},names={options.retarget}" if each.startswith(NAMED) else each for each in written]
    sinks = []
    for each in written:
        sinks.append(_open(each, say, closing))
        say(f"sending {sinks[-1].title}{', in place of the file that is there' * _replaces(each)}")
    return sinks


def _open(written: str, say: Callable[[str], None], closing: contextlib.ExitStack | None = None) -> "Sink":
    """A sink; where it is a file, ``closing`` says at its end that the file is there."""
    from track.sinks.targets import open_sink, parse_target

    target = parse_target(written)
    sink = open_sink(target, say)

    def tell_whole(error: type[BaseException] | None, *_: object) -> None:
        if error is None and target.path.is_file():
            say(f"recorded {target.title}")

    if closing is not None:
        closing.push(tell_whole)
    return sink


def _replaces(written: str) -> bool:
    """Whether a sink writes to a name that a file has."""
    from track.sinks.targets import parse_target

    target = parse_target(written)
    return target.port is None and target.path.is_file()


def _free_name() -> Path:
    """The first of ``track-001.csv``, ``track-002.csv`` … that is not there yet."""
    return next(path for number in range(1, 10**6) if not (path := Path(f"track-{number:03d}.csv")).exists())


def _open_page(
    options: RunOptions,
    session: "Session",
    texts: dict[str, str],
    say: Callable[[str], None],
    closing: contextlib.ExitStack,
) -> "Screen":
    from track.page import Page

    if options.avatar is not None:
        from facegen.formats.gltf import read_gltf

        read_gltf(options.avatar)  # a broken one is told here, and not in the browser alone
    page = Page(
        session.ask,
        options.host,
        options.port,
        cameras=tuple(texts),
        steps=session.pipeline.faces,
        avatar=options.avatar,
    )
    closing.callback(page.close)
    say(f"the page is at {page.url}; pictures stay on this machine")
    if options.browser:
        threading.Thread(target=webbrowser.open, args=(page.url,), daemon=True).start()
    return page


@contextlib.contextmanager
def ended_by_signals(session: "Session", capture: "Capture") -> Iterator[None]:
    """Let the first Ctrl-C or SIGTERM end the session after its frame; the next one stops at once, as ever."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def end(_number: int, _frame: object) -> None:
        session.stop()
        capture.stop()
        for number, handler in before.items():
            signal.signal(number, handler)

    for number in before:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)

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
from track.cli.opening import Wishes, camera_texts, is_headset, open_cameras, open_pipeline
from track.cli.opening_profile import open_profile
from track.cli.sending import check_files, named_targets, open_sinks, paths_of
from track.profile.keeper import ProfileKeeper
from track.profile.profile import write_profile

if TYPE_CHECKING:
    from track.messages import Moment
    from track.session.measures import Summary
    from track.session.session import Screen, Session
    from track.sinks.sink import Sink
    from track.sources import Capture


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
    # the page goes last: until all recordings are written somebody waits there
    with contextlib.ExitStack() as pages, contextlib.ExitStack() as closing:
        targets = named_targets(options.to, options.record, options.retarget)
        check_files(targets, wishes, texts, options.avatar)
        with contextlib.ExitStack() as opened:
            sinks = open_sinks(targets, say, closing, opened)
            session, capture = open_session(
                wishes, texts, sinks, say, closing, options=options, must_keep=False
            )
            opened.pop_all()  # they are the session's now
        screen = _open_page(options, session, texts, say, pages) if options.page else None
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
    from track.sinks.recording import free_names
    from track.sinks.tables import open_take

    pipeline = open_pipeline(wishes, texts, say)
    closing.callback(pipeline.close)
    capture = open_cameras(wishes, texts, say)
    closing.callback(capture.close)
    profile, stored, path = open_profile(wishes, pipeline, capture.keys, say)
    if must_keep:
        keep = partial(write_profile, path)
    else:
        keeper = ProfileKeeper(path, say, known=stored)
        closing.callback(keeper.close)
        keep = keeper.keep
    session = Session(
        pipeline=pipeline,
        sinks=sinks,
        profile=profile,
        say=say,
        kept=stored,
        keep=keep,
        new_recording=partial(
            open_take, free_names(paths_of(named_targets(options.to, options.record))), say
        ),
        mirror=options.mirror,
        own_blinks=options.own_blinks,
        keep_found=capture.endless,
        timed=not wishes.fast,
    )
    closing.callback(session.close)
    return session, capture


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
    say(
        f"the page is at {page.url}; "
        + ("who has this link sees the pictures" if page.is_shared else "pictures stay on this machine")
    )
    if options.browser:
        threading.Thread(target=webbrowser.open, args=(page.url,), daemon=True).start()
    return page


ENDING = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
)
"""Ctrl-C, a polite kill, and a terminal that is closed: on Windows, where that is a break, five seconds are left."""


@contextlib.contextmanager
def ended_by_signals(*running: "Session | Capture") -> Iterator[None]:
    """Let the first `ENDING` signal end what runs, after its frame; the next one stops at once, as ever."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in ENDING}
    # `nohup` and shells' background jobs ignore what they are not to be ended by
    before = {number: handler for number, handler in before.items() if handler is not signal.SIG_IGN}

    def end(_number: int, _frame: object) -> None:
        for each in running:
            each.stop()
        for number, handler in before.items():
            signal.signal(number, handler)

    for number in before:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)

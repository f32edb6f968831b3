"""Two people with films before their fake cameras and bursts of speech in their fake microphones, who meet by the page.

All is measured in the two pages: what each says to the room, and what of it comes to the other one, is seen and is
heard there.
"""

import asyncio
import itertools
import json
import re
import time
from collections.abc import Sequence
from contextlib import AsyncExitStack
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np

from facegen.conventions import BLENDSHAPES
from room.places import Place
from tests.browser import Tab, chromium
from tests.room.guests import open_room
from tests.room.page import AWAKE, CONNECTED, EARS, HEARD, LINGERS_S, SHOWN, hears_from, other
from tests.room.speech import SILENT_S, VOICED_S, write_bursts

NAMES = ("Ada", "Ben")

BURST_S = VOICED_S + SILENT_S
"""From one burst in the microphone to the next."""

CAMERA_HZ = 30
"""At which Chromium's fake camera plays a film of JPEGs, whatever film it was before."""

MOST_FILM_S = 60.0
"""Of a film, from its first picture; it then begins anew."""

READY_S = 120.0
"""The detector's 8 MB are compiled twice at once, on a machine that may have other work."""

MOVED = 0.1
"""A shape whose weights span this much has moved; what noise does to a resting face stays below."""

MEDIAPIPE_SAYS = re.compile(r"W\d{4} |INFO: ")
"""How lines begin that the detector writes to the console by itself."""

WHERE = {"z": -2.2, "heading": 0}

COME_IN = """(() => {
  const form = document.querySelector('#join');
  form.elements.name.value = %s;
  form.elements.camera.checked = true;
  form.requestSubmit();
})()"""

WATCH = """void (() => {
  const watched = (globalThis.watched = { sent: [], came: [], pictures: [], stands: [] });
  const { line } = meeting, { camera } = meeting.presence;
  const short = (weights) => Array.from(weights, (weight) => Math.round(1e5 * weight) / 1e5);
  const { move } = line, { state } = line.handlers, { hear } = camera;
  line.move = (message) => {
    const before = line.sequence;
    move.call(line, message);
    if (line.sequence !== before) watched.sent.push([line.sequence, Date.now(), message.flags, short(message.weights)]);
  };
  line.handlers.state = (number, message) => {
    state(number, message);
    if (number === meeting.own.number) return;
    watched.came.push([message.sequence, Date.now(), message.flags, short(message.weights)]);
  };
  camera.hear = (message) => {
    hear.call(camera, message);
    watched.pictures.push([message.kind, message.ms ?? 0]);
  };
  setInterval(() => watched.stands.push(%s.figure.avatar.influences()), 100);
})()"""
"""Keeps each state that a page sends and gets, what its camera found, and how it shows the other."""


@dataclass(frozen=True, kw_only=True)
class Direction:
    """What one person does, and what the other one has of it.

    Parameters
    ----------
    faces, pictures
        In how many of the camera's pictures that the page looked at a face was found.
    detect_ms
        Of each, from the picture to its weights.
    seconds
        Of watching.
    sent, tracked, arrived
        States that were said, those of them that came from the camera, and those of all that came over.
    differences
        Between weights said and weights that came over, of all shapes of all states.
    later_ms
        From saying a state to its arrival, of each.
    spans_sent, spans_arrived, spans_shown
        How far each shape moved: as said, as it came over, and on the avatar in the other page. The last one leaves out
        shapes that the avatar has not.
    on_ms, off_ms
        From the sound's begin and end at the microphone to the sign on the other page.
    begins, ends
        Of bursts, which should each have changed the sign.
    ears
        Energy at the other's ear on this person's side over that at the ear behind, for each side.
    """

    faces: int
    pictures: int
    detect_ms: list[float]
    seconds: float
    sent: int
    tracked: int
    arrived: int
    differences: np.ndarray
    later_ms: list[float]
    spans_sent: dict[str, float]
    spans_arrived: dict[str, float]
    spans_shown: dict[str, float]
    on_ms: list[float]
    off_ms: list[float]
    begins: int
    ends: int
    ears: dict[str, float] = field(default_factory=dict)

    def moved(self) -> list[str]:
        """Shapes that moved, the farthest first."""
        return sorted(
            (name for name, span in self.spans_sent.items() if span >= MOVED),
            key=lambda name: -self.spans_sent[name],
        )


def write_film(source: Path, path: Path) -> None:
    """A film as Chromium's fake camera takes it: JPEGs behind each other, thirty for each second of the source."""
    film = cv2.VideoCapture(str(source))
    rate = film.get(cv2.CAP_PROP_FPS) or CAMERA_HZ
    with path.open("wb") as out:
        written, index = 0, 0
        while written < MOST_FILM_S * CAMERA_HZ:
            there, picture = film.read()
            if not there:
                break
            index += 1
            content = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, 95])[1].tobytes()
            while written < index * CAMERA_HZ / rate:
                out.write(content)
                written += 1
    film.release()
    if not written:
        raise ValueError(f"{source}: is no film that OpenCV reads")


async def meet(
    films: tuple[Path, Path],
    *,
    seconds: float,
    folder: Path,
    faces: int = 0,
    places: dict[str, Place] | None = None,
) -> tuple[Direction, Direction]:
    """Let two browsers meet, and say what the second one had of the first one, and the other way round.

    They are watched for so many seconds, and longer where a page has not found so many faces by then.
    """
    write_bursts(folder / "speech.wav")
    async with AsyncExitStack() as stack:
        place = await stack.enter_async_context(open_room(places=places))
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"

        async def come(name: str, film: Path) -> Tab:
            write_film(film, folder / f"{name}.mjpeg")
            options = (
                f"--use-file-for-fake-video-capture={folder / f'{name}.mjpeg'}",
                f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}",
            )
            browser = await stack.enter_async_context(chromium(*AWAKE, *options))
            tab = await stack.enter_async_context(browser.open(link))
            await tab.look(width=480, height=360)
            await tab.until("document.querySelector('#join select[name=avatar]')?.value")
            await tab.ask(COME_IN % json.dumps(name))
            await tab.until("globalThis.meeting?.own", READY_S)
            await tab.ask("void (meeting.stage.drawing = false)")
            return tab

        tabs = await asyncio.gather(*map(come, NAMES, films))
        await ready(tabs)
        for tab, seen in zip(tabs, reversed(NAMES), strict=True):
            await tab.ask(HEARD)
            await tab.ask(SHOWN % other(seen))
            await tab.ask(WATCH % other(seen))
        start_s = time.monotonic()
        await asyncio.sleep(seconds)
        for tab in tabs:
            await tab.until(
                f"watched.pictures.filter(([kind]) => kind === 'face').length >= {faces}", READY_S
            )
        seconds = time.monotonic() - start_s
        kept = [await tab.ask("({ ...watched, heard, shown })") for tab in tabs]
        ears = await sides(tabs)
        complaints = [each for tab in tabs for each in tab.complaints if not MEDIAPIPE_SAYS.match(each)]
        assert complaints == [], complaints
    return tuple(
        direction(kept[speaker], kept[1 - speaker], seconds, ears[1 - speaker]) for speaker in (0, 1)
    )


async def ready(tabs: Sequence[Tab]) -> None:
    """Wait until both see, hear and know each other, and have said what their neutral face is."""
    for tab in tabs:
        await tab.until(
            "meeting.known.size === 2 && "
            "[...meeting.known.values()].every(({ person, figure }) => figure?.avatar.name === person.avatar)",
            READY_S,
        )
        await tab.until(CONNECTED, READY_S)
        await tab.until("meeting.voice.loopback.used", READY_S)
        await tab.until("meeting.presence.camera.found", READY_S)
        await tab.ask("document.querySelector('#neutral').click()")
    for tab in tabs:
        await tab.until("meeting.presence.camera.found.calibrated", READY_S)


async def sides(tabs: Sequence[Tab]) -> list[dict[str, float]]:
    """For each listener and each side on which the other stands, energy at that ear over energy at the other."""
    found: list[dict[str, float]] = [{}, {}]
    for tab in tabs:
        await tab.ask(EARS)
    for x in (2.0, -2.0):
        stands = (0.0, x)
        for tab, own in zip(tabs, stands, strict=True):
            await tab.ask(f"void Object.assign(meeting.presence.walk, {json.dumps({'x': own, **WHERE})})")
        for tab, own, others in zip(tabs, stands, reversed(stands), strict=True):
            await tab.until(hears_from(own, others))
        await asyncio.sleep(LINGERS_S)
        heard = await asyncio.gather(*(tab.ask("listen()") for tab in tabs))
        # who looks along z has larger x on the left: where one has the other there, the other has one on the right
        for listener, (left, right) in enumerate(heard):
            side = "left" if (x > 0) == (listener == 0) else "right"
            found[listener][side] = left / right if side == "left" else right / left
    return found


def spans(weights: list[list[float]]) -> dict[str, float]:
    """How far each shape moved."""
    return dict(zip(BLENDSHAPES, np.ptp(np.array(weights), axis=0).tolist(), strict=True))


def delays_ms(heard: list, shown: list, *, begin: bool) -> tuple[list[float], int]:
    """From each begin or end of a sound to the sign's, and how many there were.

    The first one may be that of a burst in whose middle listening began, and the last one may be still under way. A
    sign that comes or goes after the next burst's sound belongs to the next burst, and this one's was missed.
    """
    changes = list(itertools.pairwise(at for loud, at in heard if loud is begin))[1:]
    later = (
        [at - changed for on, at in shown if on is begin and changed <= at < following]
        for changed, following in changes
    )
    return [min(each) for each in later if each], len(changes)


def direction(said: dict, had: dict, seconds: float, ears: dict[str, float]) -> Direction:
    """What of one person came to the other."""
    sent = {sequence: (at, flags, weights) for sequence, at, flags, weights in said["sent"]}
    came = {sequence: (at, weights) for sequence, at, _, weights in had["came"] if sequence in sent}
    assert came, "nothing came over"
    # at its end each page was asked at its own time
    first, last = min(came), max(came)
    sent = {sequence: kept for sequence, kept in sent.items() if first <= sequence <= last}
    differences = [np.subtract(came[sequence][1], sent[sequence][2]) for sequence in came]
    on_ms, begins = delays_ms(said["heard"], had["shown"], begin=True)
    off_ms, ends = delays_ms(said["heard"], had["shown"], begin=False)
    pictures = [kind for kind, _ in said["pictures"] if kind in ("face", "nobody")]
    return Direction(
        faces=pictures.count("face"),
        pictures=len(pictures),
        detect_ms=[ms for kind, ms in said["pictures"] if kind == "face"],
        seconds=seconds,
        sent=len(sent),
        tracked=sum(bool(flags & 2) for _, flags, _ in sent.values()),
        arrived=len(came),
        differences=np.abs(differences),
        later_ms=[came[sequence][0] - sent[sequence][0] for sequence in came],
        spans_sent=spans([weights for _, _, weights in sent.values()]),
        spans_arrived=spans([weights for _, weights in came.values()]),
        spans_shown={
            name: float(np.ptp([each[name] for each in had["stands"]])) for name in had["stands"][0]
        },
        on_ms=on_ms,
        off_ms=off_ms,
        begins=begins,
        ends=ends,
        ears=ears,
    )

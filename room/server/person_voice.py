"""Puts one person's voice on Janus and brings them the others': two lines, one up and one down, that Janus holds.

Each voice stays by itself, as it comes from its own avatar's head: Janus passes Opus on and mixes nothing.
"""

import asyncio
from collections.abc import Callable
from itertools import islice

from room.protocol.answers import Answer, Engine, Heard, Signal
from room.protocol.texts import Candidate, Description
from room.server.janus import Body, EngineGone, Janus
from room.server.janus_words import Jsep, RoomWord, Word
from room.server.voice_room import VoiceRoom

MOST_VOICES = 64
"""Voices that one person is brought: 40 kbit/s each while somebody speaks. Those who came later wait until some go."""

MOST_WAITING = 256
"""What a page may say to its lines before they have taken it in: a line has ten addresses."""

NO_SUCH_ROOM = 426
ROOM_EXISTS = 427
"""Error codes of Janus's video room."""

AGAIN_S = 2.0
"""After Janus refused something, until it is tried anew."""


class PersonVoice:
    """One person's lines.

    Parameters
    ----------
    janus
        The instance of the room.
    room
        At Janus.
    id
        Of the person; the others' pages know by it whose voice it is.
    say
        Sends something to the person's page.
    """

    def __init__(self, janus: Janus, room: VoiceRoom, id: str, *, say: Callable[[Answer], None]) -> None:
        self._janus, self._room, self._id, self._say = janus, room, id, say
        self._up = self._down = 0
        self._feed: int | None = None
        self._there: dict[int, str] = {}
        self._have: set[int] = set()
        self._offered = False
        self._mids: tuple[str, ...] = ()
        self._muted = self._told_muted = False
        self._waiting: asyncio.Queue[Description | Candidate | Word] = asyncio.Queue(MOST_WAITING)
        self._task = asyncio.create_task(self._stay())

    def hear(self, said: Description | Candidate) -> None:
        """Take what the page says to a line; who says more than the line takes in is not heard."""
        if not self._waiting.full():
            self._waiting.put_nowait(said)

    def mute(self, muted: bool) -> None:
        """Have Janus pass this voice on to nobody, or to all again."""
        if muted != self._muted:
            self._muted = muted
            if not self._waiting.full():
                self._waiting.put_nowait(Word(janus="muted"))

    def close(self) -> None:
        """End both lines."""
        self._task.cancel()
        for handle in (self._up, self._down):
            if handle:
                self._janus.detach(handle)

    async def _stay(self) -> None:
        while True:
            try:
                await self._live()
            except EngineGone:
                for handle in (self._up, self._down):
                    self._janus.detach(handle)
                if not self._janus.up:
                    return  # the room begins it anew when Janus is back
            self._say(Engine(state="away"))
            await asyncio.sleep(AGAIN_S)

    async def _live(self) -> None:
        while not self._waiting.empty():  # what was said of the lines before would end or disturb these
            self._waiting.get_nowait()
        self._up = self._down = 0
        self._feed, self._there, self._have, self._offered = None, {}, set(), False
        self._mids, self._told_muted = (), False
        self._up = await self._janus.attach(self._told)
        joined = await self._enter()
        self._feed = joined.id
        self._note(joined)
        self._say(Engine(state="ready"))
        while True:
            await self._follow()
            match await self._waiting.get():
                case Description() as said if said.to == "up" and said.type == "offer":
                    await self._publish(said.sdp)
                case Description() as said if said.to == "down" and said.type == "answer" and self._down:
                    await self._request(self._down, {"request": "start"}, Jsep(type="answer", sdp=said.sdp))
                    self._offered = False
                case Candidate() as said:
                    await self._reach(said)
                case Word() as word:
                    self._note(word.room)
                    if word.janus in ("hangup", "detached") or word.room.videoroom == "destroyed":
                        raise EngineGone("Janus ended a line")

    def _told(self, word: Word) -> None:
        if word.janus in ("event", "hangup", "detached") and not self._waiting.full():
            self._waiting.put_nowait(word)

    async def _enter(self) -> RoomWord:
        """Join the room, which is made if it is not there: by the first who comes, and after Janus began anew."""
        join: Body = {
            "request": "join",
            "ptype": "publisher",
            "room": self._room.number,
            "pin": self._room.pin,
            "display": self._id,
        }
        word = (await self._janus.ask(self._up, join)).room
        if word.error_code == NO_SUCH_ROOM:
            made = (await self._janus.ask(self._up, self._creation())).room
            if made.error_code not in (None, ROOM_EXISTS):
                raise EngineGone(f"Janus makes no room: {made.error}")
            word = (await self._janus.ask(self._up, join)).room
        if word.error_code is not None:
            raise EngineGone(f"Janus lets nobody in: {word.error}")
        return word

    def _creation(self) -> Body:
        return {
            "request": "create",
            "room": self._room.number,
            "pin": self._room.pin,
            "secret": self._room.secret,
            "is_private": True,
            "permanent": False,
            "publishers": self._room.places,
            "audiocodec": "opus",
            "opus_fec": True,
            "opus_dtx": True,  # silence is not sent: of sixty people two or three speak
            "notify_joining": False,
        }

    async def _publish(self, sdp: str) -> None:
        if not _is_one_voice(sdp):
            raise EngineGone("a page offers something else than one voice")
        body: Body = {"request": "configure" if self._mids else "publish"}
        answer = await self._request(self._up, body, Jsep(type="offer", sdp=sdp))
        self._mids = tuple(stream.mid for stream in answer.room.streams) or self._mids
        if not self._mids:
            raise EngineGone("Janus tells of no voice")
        if answer.jsep:
            description = Description(to="up", type="answer", sdp=answer.jsep.sdp)
            self._say(Signal(sender="up", signal=description))
        self._told_muted = False

    async def _reach(self, said: Candidate) -> None:
        handle = self._up if said.to == "up" else self._down
        if not handle:
            return
        candidate: Body = {"completed": True}
        if said.candidate:
            candidate = {"candidate": said.candidate, "sdpMid": said.mid, "sdpMLineIndex": said.line}
        await self._janus.trickle(handle, candidate)

    def _note(self, word: RoomWord) -> None:
        """Keep who speaks into this room."""
        for publisher in word.publishers:
            mid = next((stream.mid for stream in publisher.streams if stream.type == "audio"), None)
            if mid is not None:
                self._there[publisher.id] = mid
        for gone in (word.leaving, word.unpublished):
            if isinstance(gone, int):
                self._there.pop(gone, None)

    async def _follow(self) -> None:
        """Have Janus bring what is wanted; the page answers one change before the next is offered."""
        if self._muted != self._told_muted and self._mids:
            await self._moderate()
        if self._offered:
            return
        wanted = dict(islice(self._there.items(), MOST_VOICES))
        come, gone = wanted.keys() - self._have, self._have - wanted.keys()
        if not come and not gone:
            return
        streams = [{"feed": feed, "mid": wanted[feed]} for feed in sorted(come)]
        if not self._down:
            self._down = await self._janus.attach(self._told)
            body: Body = {"request": "join", "ptype": "subscriber", "room": self._room.number}
            body |= {"pin": self._room.pin, "streams": streams}
        else:
            body = {"request": "update"}
            body |= {"subscribe": streams} if come else {}
            body |= {"unsubscribe": [{"feed": feed} for feed in sorted(gone)]} if gone else {}
        word = await self._request(self._down, body)
        self._have = set(wanted)
        if word.jsep:
            self._offered = True
            heard = {
                each.mid: each.feed_display for each in word.room.streams if each.active and each.feed_display
            }
            self._say(Heard(voices=heard))
            self._say(Signal(sender="down", signal=Description(to="down", type="offer", sdp=word.jsep.sdp)))

    async def _moderate(self) -> None:
        """Janus itself keeps a muted voice from all; a page need not be believed."""
        body: Body = {"request": "moderate", "room": self._room.number, "secret": self._room.secret}
        for mid in self._mids:  # the page names it; where Janus refuses, the line ends, muted or not
            await self._request(self._up, body | {"id": self._feed, "mid": mid, "mute": self._muted})
        self._told_muted = self._muted

    async def _request(self, handle: int, body: Body, jsep: Jsep | None = None) -> Word:
        word = await self._janus.ask(handle, body, jsep)
        if word.room.error_code is not None:
            raise EngineGone(f"Janus refuses: {word.room.error}")
        return word


def _is_one_voice(sdp: str) -> bool:
    """Whether a description offers one line of sound alone: a second one would speak on while the first is muted."""
    lines = [line for line in sdp.splitlines() if line.lstrip().startswith("m=")]
    return len(lines) == 1 and lines[0].startswith("m=audio ")

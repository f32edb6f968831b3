"""One person's lines to a Janus that is played here: whom they are brought, and what holds of lines that have ended."""

import asyncio
from collections.abc import Callable

from room.protocol.answers import Answer, Engine, Heard, Signal
from room.protocol.texts import Candidate, Description
from room.server.janus_words import Word
from room.server.person_voice import MOST_VOICES, PersonVoice
from room.server.voice_room import VoiceRoom
from tests.room.guests import SOON_S

ROOM = VoiceRoom(number=1, pin="p", secret="s", places=1000)


class Played:
    """A Janus with voices in its room, each by its number."""

    def __init__(self, voices: range) -> None:
        self.up, self.voices = True, list(voices)
        self.handles: dict[int, Callable[[Word], None]] = {}
        self.brought: set[int] = set()
        self.told: list[Answer] = []
        self.asked: list[str] = []
        self.attached = 0

    async def attach(self, heard: Callable[[Word], None]) -> int:
        self.attached += 1
        self.handles[self.attached] = heard
        return self.attached

    def detach(self, handle: int) -> None:
        self.handles.pop(handle, None)

    async def trickle(self, handle: int, candidate: dict) -> None:
        self.asked.append("trickle")

    async def ask(self, handle: int, body: dict, jsep: object = None) -> Word:
        kind = body["request"]
        self.asked.append(kind)
        if kind == "join" and body["ptype"] == "publisher":
            return _word(id=9000, publishers=[_publisher(voice) for voice in self.voices])
        if kind == "start":
            return _word()
        subscribed = body.get("streams", body.get("subscribe", []))
        self.brought |= {each["feed"] for each in subscribed}
        self.brought -= {each["feed"] for each in body.get("unsubscribe", [])}
        return _word(jsep={"type": "offer", "sdp": "v=0"})

    def leave(self, voice: int) -> None:
        self.voices.remove(voice)
        self.handles[min(self.handles)](_word(leaving=voice))

    async def until(self, true: Callable[[], object]) -> None:
        async with asyncio.timeout(SOON_S):
            while not true():
                await asyncio.sleep(0)


def _publisher(voice: int) -> dict:
    return {"id": voice, "streams": [{"type": "audio", "mid": "0"}]}


def _word(jsep: dict | None = None, **room: object) -> Word:
    return Word.model_validate({"janus": "event", "jsep": jsep, "plugindata": {"data": room}})


def test_who_waits_to_be_heard_is_heard_once_others_have_gone():
    async def run() -> None:
        janus = Played(range(MOST_VOICES + 2))
        voice = PersonVoice(janus, ROOM, "ada", say=janus.told.append)
        await janus.until(lambda: janus.brought == {*range(MOST_VOICES)})
        for gone in (3, 5):
            voice.hear(Description(to="down", type="answer", sdp="v=0"))
            janus.leave(gone)
        await janus.until(lambda: janus.brought == {*janus.voices})
        voice.close()

    asyncio.run(run())


def test_what_was_said_to_lines_that_have_ended_is_not_said_to_new_ones(monkeypatch):
    monkeypatch.setattr("room.server.person_voice.AGAIN_S", 0)

    async def run() -> None:
        janus = Played(range(2))
        voice = PersonVoice(janus, ROOM, "ada", say=janus.told.append)
        await janus.until(lambda: janus.brought)
        voice.hear(Description(to="up", type="offer", sdp="no offer at all"))
        for _ in range(3):  # of which each would end the next line
            voice.hear(Description(to="up", type="offer", sdp="no offer at all"))
            voice.hear(Candidate(to="up", candidate=""))

        def states() -> list[str]:
            return [each.state for each in janus.told if isinstance(each, Engine)]

        await janus.until(lambda: states() == ["ready", "away", "ready"])
        await janus.until(lambda: len([each for each in janus.told if isinstance(each, Heard)]) == 2)
        assert states() == ["ready", "away", "ready"]
        assert "trickle" not in janus.asked
        assert len([each for each in janus.told if isinstance(each, Signal)]) == 2
        voice.close()

    asyncio.run(run())

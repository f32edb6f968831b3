"""Opens the rooms of one process for the first who comes, ticks them, and closes them after the last."""

import asyncio
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

from room.avatars import AvatarStore
from room.errors import NotAllowed
from room.recording import Recorder, Survey
from room.server.avatar_transfer import AvatarTransfer
from room.server.janus import Janus
from room.server.limits import Limits
from room.server.live_room import HERTZ, LiveRoom
from room.server.metrics import Metrics
from room.server.replay import Replay
from room.server.room_voices import RoomVoices
from room.server.turn import Relays
from room.server.voice_room import instance_of, voice_room
from room.state.kept_rulings import KeptRulings
from room.state.meeting import MOST_BEYOND

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.redis_channels import RedisChannels


class LiveRooms:
    """The rooms in which somebody is.

    Parameters
    ----------
    secret
        From which the numbers and pins of an engine's rooms follow.
    limits
        What is allowed.
    relays
        What browsers are told for their voices.
    store
        Keeps the avatars that people bring.
    recorder
        Records its one room; None where nothing is recorded.
    replayed
        Recording that every room plays; None where people meet each other alone.
    channels
        Reach the other processes that carry the same rooms; None where this is the only one.
    engines
        Janus instances that share the rooms' voices; none where these go from page to page.
    """

    def __init__(
        self,
        secret: bytes,
        *,
        limits: Limits,
        relays: Relays,
        store: AvatarStore,
        recorder: Recorder | None,
        replayed: Survey | None,
        channels: "RedisChannels | None",
        engines: Sequence[Janus],
    ) -> None:
        self._secret, self._limits, self._relays, self._store = secret, limits, relays, store
        self._recorder, self._replayed = recorder, replayed
        self._channels, self._engines = channels, engines
        self._transfer = AvatarTransfer(channels, store) if channels else None
        self._rooms: dict[str, LiveRoom] = {}
        self._kept = KeptRulings()
        self._opening: dict[str, asyncio.Task[None]] = {}

    def get(self, name: str) -> LiveRoom | None:
        """The room of a name, while somebody is in it."""
        return self._rooms.get(name)

    def count(self, metrics: Metrics) -> None:
        """Say how many rooms and people there are."""
        metrics.rooms = len(self._rooms)
        metrics.people = sum(len(room.meeting.people) for room in self._rooms.values())

    def record(self, recorder: Recorder) -> None:
        """Record its one room, in which nobody is yet."""
        self._recorder = recorder

    def recorder_of(self, name: str) -> Recorder | None:
        """What records a room; None where nothing does."""
        recorder = self._recorder
        return recorder if recorder and recorder.room == name and recorder.open else None

    async def open(self, name: str) -> LiveRoom:
        """The room of a name, opened for the first who comes; others who come meanwhile wait for the same.

        Raises
        ------
        NotAllowed
            If there are too many rooms, or other processes that may have this one cannot be reached.
        """
        while (room := self._rooms.get(name)) is None:  # a tick may close it before the first is in
            if name not in self._opening:
                if len(self._rooms) + len(self._opening) >= self._limits.rooms:
                    raise NotAllowed(f"all {self._limits.rooms} rooms of this server are in use", again=True)
                opening = self._opening[name] = asyncio.create_task(self._open(name))
                opening.add_done_callback(lambda _: self._opening.pop(name))
            await asyncio.shield(self._opening[name])
        return room

    async def tick(self, metrics: Metrics) -> None:
        """Let all rooms tick, until this is cancelled; ``metrics`` counts the time by which they are late."""
        due = time.monotonic()
        while True:
            due += 1 / HERTZ
            await asyncio.sleep(due - time.monotonic())
            now = time.monotonic()
            metrics.late_s += now - due
            due = max(due, now - 1 / HERTZ)  # what was missed by more than a tick is not made up for
            for name, room in list(self._rooms.items()):
                room.tick(now=now)
                if room.empty:
                    self._kept.keep(name, room.meeting, now=now)
                    room.close()
                    del self._rooms[name]

    async def _open(self, name: str) -> None:
        voices = self._voices_of(name)
        room = LiveRoom(
            name,
            most_people=self._limits.people,
            relays=self._relays,
            store=self._store,
            recorder=self.recorder_of(name),
            replay=Replay(self._replayed) if self._replayed else None,
            channels=self._channels,
            transfer=self._transfer,
            voices=voices,
        )
        self._kept.restore(name, room.meeting, now=time.monotonic())
        try:
            await room.open()
        except NotAllowed:
            if voices:
                voices.close()  # Janus would else tell it of every end and beginning, for ever
            raise
        self._rooms[name] = room

    def _voices_of(self, name: str) -> RoomVoices | None:
        if not self._engines:
            return None
        # a person who comes back may stand in Janus's list a second time for a moment
        room = voice_room(self._secret, name, places=2 * (self._limits.people + MOST_BEYOND))
        return RoomVoices(instance_of(name, self._engines), room)

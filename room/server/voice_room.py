"""Says which room of which Janus has the voices of a room of ours, so that every server comes to the same one."""

import hashlib
import hmac
from collections.abc import Sequence
from dataclasses import dataclass

from room.server.janus import EngineGone, Janus


@dataclass(frozen=True, kw_only=True)
class VoiceRoom:
    """A room at Janus, as every server of the same keys names it.

    Parameters
    ----------
    number
        48 bits that nobody guesses.
    pin
        Without it nobody joins; no page is told it.
    secret
        Without it nobody changes the room.
    places
        Publishers.
    """

    number: int
    pin: str
    secret: str
    places: int


def voice_room(secret: bytes, name: str, *, places: int) -> VoiceRoom:
    """The room of Janus for a room of ours; follows from the secret of all keys, so that no server asks another."""
    mark = hmac.digest(secret, f"janus 1 {name}".encode(), hashlib.sha512).hex()
    return VoiceRoom(number=int(mark[:12], 16), pin=mark[12:44], secret=mark[44:76], places=places)


def instance_of(name: str, instances: Sequence[Janus]) -> Janus:
    """The instance of a room: each server comes to the same one, and one more takes rooms over from all alike.

    Rendezvous hashing (Thaler and Ravishankar, 1998, doi:10.1109/90.663936).
    """
    return max(instances, key=lambda each: hashlib.sha256(f"{each.url} {name}".encode()).digest())


async def clear(janus: Janus, room: VoiceRoom) -> None:
    """Have Janus forget a room that nobody is in, by any server."""
    try:
        handle = await janus.attach(lambda _: None)
        listed = await janus.ask(handle, {"request": "listparticipants", "room": room.number})
        if listed.room.error_code is None and not listed.room.participants:
            await janus.ask(handle, {"request": "destroy", "room": room.number, "secret": room.secret})
        janus.detach(handle)
    except EngineGone:  # it has forgotten all rooms by itself
        return

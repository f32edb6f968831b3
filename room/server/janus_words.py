"""Janus's own words, as far as rooms ask for them; only servers of rooms speak them, and no browser does.

References
----------
.. [1] https://janus.conf.meetecho.com/docs/rest.html (over WebSockets)
.. [2] https://janus.conf.meetecho.com/docs/videoroom.html
"""

from typing import Literal

from pydantic import BaseModel, ConfigDict


class _Read(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True)


class Jsep(_Read):
    """A session description, as Janus has it."""

    type: Literal["offer", "answer"]
    sdp: str


class Stream(_Read):
    """One voice, as its publisher sends it, or as a subscriber gets it."""

    type: str
    mid: str
    feed_id: int | None = None
    feed_display: str = ""
    active: bool = True


class Publisher(_Read):
    """Somebody who sends."""

    id: int
    display: str = ""
    streams: tuple[Stream, ...] = ()


class RoomWord(_Read):
    """What the video room, of which rooms use the sound alone, answers or tells."""

    videoroom: str = ""
    error_code: int | None = None
    error: str = ""
    id: int | None = None
    publishers: tuple[Publisher, ...] = ()
    streams: tuple[Stream, ...] = ()
    leaving: int | Literal["ok"] | None = None
    unpublished: int | Literal["ok"] | None = None
    participants: tuple[Publisher, ...] = ()


class _Data(_Read):
    id: int


class _Plugin(_Read):
    data: RoomWord


class _Fault(_Read):
    code: int
    reason: str


class Word(_Read):
    """Any message of Janus."""

    janus: str
    transaction: str | None = None
    sender: int | None = None
    data: _Data | None = None
    plugindata: _Plugin | None = None
    jsep: Jsep | None = None
    error: _Fault | None = None

    @property
    def room(self) -> RoomWord:
        """What the room says in it; nothing where it does not."""
        return self.plugindata.data if self.plugindata else RoomWord()

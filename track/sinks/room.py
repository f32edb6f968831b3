"""Moves somebody's face in a room: a connection of its own thread, which takes the newest state alone.

What is behind the link's ``#`` never is part of a request; it says once, in the first message, whose face this is
(room/protocol/texts.py). A room by https has a certificate that this machine trusts, or that of a file.
"""

import asyncio
import json
import threading

import numpy as np
from aiohttp import (
    ClientConnectorCertificateError,
    ClientError,
    ClientSession,
    ClientTimeout,
    ClientWebSocketResponse,
    Fingerprint,
    ServerFingerprintMismatch,
    WSMsgType,
)

from regress.runtime.sample import Sample
from track.sinks.axes import head_pose
from track.sinks.room_link import read_link
from track.sinks.room_state import TRACKED, face_state
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target

STATES_PER_S = 30
"""As many as a room passes on; it closes on who sends more than sixty."""

PAUSES_S = (0.5, 1.0, 2.0, 5.0)
"""Before each new try to come in; the last one from then on."""

_JOIN_S = 5.0
_PARTING_S = 0.25
"""In which an encrypted connection says that it ends; a loop that is closed before leaves its socket open."""


class RoomSink(Sink):
    """A face on its way to a room.

    Parameters
    ----------
    target
        With the person's link.
    tell
        Takes one sentence where the room does not let the face in, and one where nobody answers.

    Raises
    ------
    InputError
        Where the link is none of a person in a room, or its certificate's file holds none.
    """

    def __init__(self, target: Target, tell: Tell) -> None:
        link = read_link(target)
        self.title, self._address, self._file = link.title, link.address, link.certificate
        self._trusted = True if link.sha256 is None else Fingerprint(link.sha256)
        self._join = {
            "kind": "join",
            "version": 1,
            "key": link.key,
            "secret": link.secret,
            "name": "face",
            "role": "face",
        }
        self._tell, self._told = tell, False
        self._rest_m: np.ndarray | None = None
        self._sequence, self._newest = 0, b""
        self._loop = asyncio.new_event_loop()
        self._fresh, self._stopped = asyncio.Event(), asyncio.Event()
        self._thread = threading.Thread(target=self._run, name="room", daemon=True)
        self._thread.start()

    def send(self, sample: Sample) -> None:
        """Leave a sample's state to the connection; one that was not sent yet is forgotten."""
        pose = head_pose(sample.head)
        if self._rest_m is None and pose is not None:
            self._rest_m = pose.position  # where the head is seen first is where it rests
        seen = has_face(sample)
        gaze = sample.gaze
        self._sequence += 1
        self._newest = face_state(
            flags=TRACKED if seen else 0,
            sequence=self._sequence,
            time_ms=0 if sample.time_s is None else round(float(np.nan_to_num(sample.time_s)) * 1000),
            weights=sample.weights if seen else np.zeros(52),
            head_m=None if pose is None or not seen else pose.position - self._rest_m,
            rotation=None if pose is None or not seen else pose.rotation,
            gaze=None if gaze is None or not seen or np.isnan(gaze).any() else gaze,
        )
        self._wake(self._fresh)

    def close(self) -> None:
        """Leave the room; the page has the face again."""
        self._wake(self._stopped)
        self._thread.join(_JOIN_S)

    def _wake(self, event: asyncio.Event) -> None:
        try:
            self._loop.call_soon_threadsafe(event.set)
        except RuntimeError:  # the room has refused this face, and the loop is closed
            return

    def _run(self) -> None:
        try:
            self._loop.run_until_complete(self._stay())
        finally:
            if self._address.startswith("https:"):
                self._loop.run_until_complete(asyncio.sleep(_PARTING_S))
            self._loop.close()

    async def _stay(self) -> None:
        """Come in, again and again, until the room says that it makes no sense, or the sink is closed."""
        stopping = asyncio.ensure_future(self._stopped.wait())
        try:
            await self._come_again(stopping)
        finally:
            stopping.cancel()
            await asyncio.gather(stopping, return_exceptions=True)

    async def _come_again(self, stopping: "asyncio.Future[bool]") -> None:
        async with ClientSession(timeout=ClientTimeout(total=_JOIN_S)) as session:
            tries = 0
            while not self._stopped.is_set():
                meeting = asyncio.ensure_future(self._meet(session))
                await asyncio.wait({meeting, stopping}, return_when=asyncio.FIRST_COMPLETED)
                if not meeting.done():
                    meeting.cancel()
                    await asyncio.gather(meeting, return_exceptions=True)
                    return
                came_in, again = meeting.result()
                if not again:
                    return
                tries = 0 if came_in else tries + 1
                pause = PAUSES_S[min(tries, len(PAUSES_S) - 1)]
                await asyncio.wait({stopping}, timeout=pause)

    async def _meet(self, session: ClientSession) -> tuple[bool, bool]:
        """One connection; says whether it came in, and whether to try again."""
        sending: asyncio.Future[None] | None = None
        try:
            async with session.ws_connect(self._address, heartbeat=20, ssl=self._trusted) as socket:
                await socket.send_str(json.dumps(self._join))
                async for message in socket:
                    answer = _answer(message.data) if message.type is WSMsgType.TEXT else {}
                    if answer.get("kind") == "refused":
                        again = bool(answer.get("again"))
                        self._say(str(answer.get("text")), last=not again)
                        return sending is not None, again
                    if answer.get("kind") == "welcome" and sending is None:
                        self._told = False
                        sending = asyncio.ensure_future(self._send_states(socket))
        except ClientConnectorCertificateError as error:
            why = getattr(error.certificate_error, "verify_message", type(error.certificate_error).__name__)
            self._say(
                f"this machine does not trust the room's certificate ({why.strip('. ')}); copy the file of "
                "`room serve --cert` to here and name it behind the link, as in 'room:LINK,cert=FILE'",
                last=True,
            )
            return False, False
        except ServerFingerprintMismatch:
            self._say(f"the room has another certificate than {self._file}; copy its file again", last=True)
            return False, False
        except (ClientError, OSError, asyncio.TimeoutError, ValueError) as error:
            self._say(f"nobody answers ({type(error).__name__}); trying again")
        finally:
            if sending is not None:
                sending.cancel()
                await asyncio.gather(sending, return_exceptions=True)
        return sending is not None, True

    async def _send_states(self, socket: ClientWebSocketResponse) -> None:
        while not socket.closed:
            await self._fresh.wait()
            self._fresh.clear()
            await socket.send_bytes(self._newest)
            await asyncio.sleep(1 / STATES_PER_S)

    def _say(self, what: str, *, last: bool = False) -> None:
        """Tell it, unless something was told since the face was in; the ``last`` word always."""
        if last or not self._told:
            self._told = True
            self._tell(f"{self.title}: {what}")


def _answer(text: str) -> dict[str, object]:
    """What a room says, as far as it is an object.

    Raises
    ------
    ValueError
        Where it is no JSON that can be taken in.
    """
    try:
        answer = json.loads(text)
    except RecursionError:
        raise ValueError("nested too deeply") from None
    return answer if isinstance(answer, dict) else {}


def open_sink(target: Target, tell: Tell) -> Sink:
    """A face on its way to a room."""
    return RoomSink(target, tell)

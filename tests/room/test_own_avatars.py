"""An avatar that somebody brings: checked before it is shown, fetched with the key alone, forgotten with its person."""

import asyncio
import hashlib
import io

import pytest

from room.avatars import AvatarStore
from room.avatars.check import (
    MOST_AVATAR_BYTES,
)
from room.errors import FormatError
from room.protocol.answers import Changed, Left, Notice
from room.server.avatar_checks import AvatarChecks
from room.server.limits import MOST_UPLOADS_A_ROOM, UPLOADS_BURST
from tests.room.avatars import BINARY, avatar, textured
from tests.room.guests import Guest, Place, open_room
from tests.room.refused_avatars import REFUSED, nodes


def _bearer(place: Place, guest: Guest | None = None, key: str = "") -> dict[str, str]:
    key = key or place.keys.key(place.name, "guest")
    return {"Authorization": f"Bearer {key}" + (f".{guest.secret}" if guest else "")}


async def bring(place: Place, guest: Guest, content: object, **headers: str) -> tuple[int, str]:
    """Upload; the status, and the digest or the sentence."""
    address = f"{place.address}/room/{place.name}/avatar"
    async with place.session.post(address, data=content, headers=_bearer(place, guest) | headers) as answer:
        return answer.status, (await answer.json())["own"] if answer.ok else (await answer.text()).strip()


async def fetch(place: Place, digest: str, key: str = "") -> tuple[int, bytes]:
    address = f"{place.address}/room/{place.name}/avatar/{digest}"
    async with place.session.get(address, headers=_bearer(place, key=key)) as answer:
        return answer.status, await answer.read()


def dressed(guest: Guest, digest: str):
    return guest.told(Changed, lambda answer: answer.person.name == "Ada" and answer.person.own == digest)


def meet(run):
    """Ada and Ben in a room, and a moderator."""

    async def open_and_run() -> None:
        async with open_room() as place:
            ada, ben = await place.guest(), await place.guest(name="Ben")
            await run(place, ada, ben)

    asyncio.run(asyncio.wait_for(open_and_run(), 300))


def test_an_avatar_goes_to_those_with_the_key_and_goes_with_its_person():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        content = avatar()
        status, digest = await bring(place, ada, content)
        assert (status, digest) == (200, hashlib.sha256(content).hexdigest())
        await dressed(ben, digest)
        late = await place.guest(name="Cy")
        assert digest in {person.own for person in late.welcome.people}
        assert await fetch(place, digest) == (200, content)
        assert (await fetch(place, digest, key="k" * 22))[0] == 403
        assert (await fetch(place, "0" * 64))[0] == 404
        assert (await fetch(place, "..%2f..%2froom.html"))[0] == 404
        async with place.session.get(f"{place.address}/metrics") as answer:
            assert f"room_avatar_bytes {len(content)}\n" in await answer.text()
        await ada.say(kind="leave")
        await ben.told(Left)
        assert (await fetch(place, digest))[0] == 404

    meet(run)


def test_one_may_take_it_off_and_a_moderator_may_for_good():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        digest = (await bring(place, ada, avatar()))[1]
        await dressed(ben, digest)
        ben.answers.clear()
        await ada.say(kind="undress")
        await dressed(ben, "")
        assert (await fetch(place, digest))[0] == 404
        assert (await bring(place, ada, avatar()))[1] == digest
        await dressed(ben, digest)
        ben.answers.clear()
        await ben.say(kind="moderate", action="undress", number=ada.number)
        assert "only a moderator" in (await ben.told(Notice)).text
        chair = await place.guest(name="Chair", moderator=True)
        await chair.say(kind="moderate", action="undress", number=ada.number)
        await dressed(ben, "")
        assert (await fetch(place, digest))[0] == 404
        status, sentence = await bring(place, ada, avatar())
        assert status == 403
        assert "a moderator" in sentence
        await ada.say(kind="leave")
        await ben.told(Left)
        again = await place.guest(secret=ada.secret)
        assert (await bring(place, again, avatar()))[0] == 403, "the same person, whom one click brought back"

    meet(run)


def test_who_finds_no_place_for_an_avatar_goes_on_to_wear_the_last_one(monkeypatch):
    monkeypatch.setattr(
        "room.server.application.AvatarStore", lambda: AvatarStore(most_bytes=2 * len(avatar()))
    )

    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        digest = (await bring(place, ada, avatar()))[1]
        status, sentence = await bring(place, ada, avatar(nodes(200)))
        assert status == 507, "of 503 and 429 the page brings it again by itself, 32 MiB twice a minute"
        assert "smaller" in sentence
        assert (await place.guest(name="Cy")).welcome.people[0].own == digest
        assert (await fetch(place, digest))[0] == 200

    meet(run)


def test_avatars_are_checked_by_another_process(monkeypatch):
    """A parser of this one would halt all rooms."""
    monkeypatch.setattr("facegen.formats.gltf_container.parse_json", None)

    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        assert (await bring(place, ada, avatar()))[0] == 200
        assert (await bring(place, ada, textured(b"<svg>")))[0] == 422

    meet(run)


def test_one_process_checks_all_and_another_begins_where_it_was_lost(monkeypatch):
    async def run() -> None:
        checks = AvatarChecks()
        await checks.check(avatar())
        first = checks._process
        for fault in ("SVG", "springs of many joints", "nothing"):
            with pytest.raises(FormatError, match=REFUSED[fault][1]):
                await checks.check(REFUSED[fault][0])
        assert checks._process is first
        for gone in (0.0, 0.5):  # its end is noticed, or not yet
            checks._process.kill()
            await asyncio.sleep(gone)
            await checks.check(avatar())  # who comes next has no part in it
        second = checks._process
        asked = asyncio.create_task(checks.check(textured(b"<svg>")))
        await asyncio.sleep(0)
        asked.cancel()
        await asyncio.gather(asked, return_exceptions=True)
        await checks.check(avatar())  # and is not told of the other's fault
        assert second.returncode is not None
        monkeypatch.setattr("room.server.avatar_checks.CHECK_S", 0)
        with pytest.raises(FormatError, match="a simpler one"):
            await checks.check(avatar())
        monkeypatch.undo()
        await checks.check(avatar())
        third = checks._process
        await checks.close()
        assert third.returncode is not None

    asyncio.run(asyncio.wait_for(run(), 300))


def test_refusals_are_sentences_and_change_nothing():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        status, sentence = await bring(place, ada, BINARY)
        assert (status, sentence) == (422, "this avatar is not a binary glTF 2.0 file (.glb or .vrm)")
        status, sentence = await bring(place, ada, io.BytesIO(bytes(MOST_AVATAR_BYTES + 1)))
        assert status == 413
        assert "smaller textures" in sentence

        async def endless():
            for _ in range(MOST_AVATAR_BYTES // 2**20 + 2):
                yield bytes(2**20)

        assert (await bring(place, ada, endless()))[0] == 413, "a body that does not say how long it is"
        assert (await bring(place, ada, avatar(), Origin="https://elsewhere.example"))[0] == 403
        assert (await bring(place, ada, avatar(), Authorization=f"Bearer {'k' * 22}.{ada.secret}"))[0] == 403
        key = place.keys.key(place.name, "guest")
        assert (await bring(place, ada, avatar(), Authorization=f"Bearer {key}.{'s' * 22}"))[0] == 403, (
            "not there"
        )
        assert (await bring(place, ada, avatar(), Authorization=f"Bearer {key}"))[0] == 403, "of nobody"
        assert not ben.all(Changed) or all(not answer.person.own for answer in ben.all(Changed))

    meet(run)


def test_who_tries_again_and_again_waits():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        found = [await bring(place, ada, b"x") for _ in range(UPLOADS_BURST + 1)]
        assert [status for status, _ in found] == [422] * UPLOADS_BURST + [429]
        assert (await bring(place, ben, avatar()))[0] == 200, "others do not"

    meet(run)


def test_one_who_sends_slowly_keeps_nobody_else_from_it():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        begun, rest = asyncio.Event(), asyncio.Event()

        async def slow():
            yield b"x"
            begun.set()
            await rest.wait()

        first = asyncio.create_task(bring(place, ada, slow()))
        await begun.wait()
        await asyncio.sleep(0.1)  # it is on its way before the next one asks
        for _ in range(MOST_UPLOADS_A_ROOM - 1):
            status, sentence = await bring(place, ada, slow())
            assert (status, "another avatar of yours" in sentence) == (429, True)
        assert (await bring(place, ben, avatar()))[0] == 200
        rest.set()
        assert (await first)[0] == 422

    meet(run)


def test_a_room_whose_people_all_send_slowly_keeps_no_other_room_from_it():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        rest = asyncio.Event()

        async def slow(begun: asyncio.Event):
            yield b"x"
            begun.set()
            await rest.wait()

        sending = []
        for _ in range(MOST_UPLOADS_A_ROOM):
            begun = asyncio.Event()
            sending.append(asyncio.create_task(bring(place, await place.guest(), slow(begun))))
            await begun.wait()
        await asyncio.sleep(0.1)  # they are on their way before the next one asks
        assert (await bring(place, ada, avatar()))[0] == 503
        other = Place(place.address, place.keys, "other")
        try:
            assert (await bring(other, await other.guest(), avatar()))[0] == 200
        finally:
            await other.session.close()
        rest.set()
        assert {status for status, _ in await asyncio.gather(*sending)} == {422}

    meet(run)


def test_an_avatar_by_which_each_process_ends_is_refused(monkeypatch):
    monkeypatch.setattr("room.server.avatar_checks._BEGIN", "import sys; sys.stdin.buffer.read(4)")

    async def run() -> None:
        checks = AvatarChecks()
        for _ in range(2):
            with pytest.raises(FormatError, match="a simpler one"):
                await checks.check(avatar())
        await checks.close()

    asyncio.run(asyncio.wait_for(run(), 300))


def test_where_no_process_begins_the_avatar_comes_again_later(monkeypatch):
    async def no_more(*_: object, **__: object) -> None:
        raise BlockingIOError

    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        with monkeypatch.context() as full:
            full.setattr("asyncio.create_subprocess_exec", no_more)
            assert (await bring(place, ada, avatar()))[0] == 503
        assert (await bring(place, ada, avatar()))[0] == 200

    meet(run)


def test_an_avatar_that_breaks_off_is_no_fault_of_the_servers(caplog: pytest.LogCaptureFixture):
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        for _ in range(2):

            async def slow():
                yield b"x"
                await asyncio.Event().wait()

            first = asyncio.create_task(bring(place, ada, slow()))
            await asyncio.sleep(0.2)
            first.cancel()
            await asyncio.sleep(0.2)

    meet(run)
    assert not caplog.records, "each would be a traceback in the operator's log"

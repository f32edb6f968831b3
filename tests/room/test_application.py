"""What a room's server gives by HTTP: headers, numbers for operators, files; and relays with credentials that end."""

import asyncio
import gzip
import hashlib
import time
from pathlib import Path

import pytest
from aiohttp.test_utils import make_mocked_request
from yarl import URL

from room.server import Relays
from room.server.application import STATIC
from room.server.files import answer, hold
from room.server.limits import Bucket
from tests.room.guests import meeting, open_room


@meeting
async def test_every_answer_has_the_policy_of_contents(place):
    for path in ("/", "/health", "/room/meeting", "/room/..%2f", "/nothing", "/static/../keys.py"):
        async with place.session.get(place.address + path) as answer:
            policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'" in policy
            assert "unsafe-inline" not in policy
            assert "'unsafe-eval'" not in policy
            assert answer.headers["Referrer-Policy"] == "no-referrer"


@meeting
async def test_operators_see_numbers_and_no_names(place):
    ada = await place.guest(name="Adelheid")
    await ada.move()
    await ada.until(lambda: ada.states)
    async with place.session.get(f"{place.address}/metrics") as answer:
        text = await answer.text()
    values = dict(line.split(" ") for line in text.splitlines() if not line.startswith("#"))
    assert (values["room_people"], values["room_rooms"], values["room_states_total"]) == ("1", "1", "1")
    assert "room_late_seconds_total" in values
    assert "Adelheid" not in text
    assert "meeting" not in text
    async with place.session.get(f"{place.address}/health") as answer:
        assert (answer.status, await answer.text()) == (200, "well\n")


def test_a_relay_gets_credentials_that_end():
    async def run() -> None:
        relays = Relays(stun=("stun:a:1",), turn=("turn:b:2",), secret="north")
        async with open_room(relays=relays) as place:
            stun, turn = (await place.guest()).welcome.ice
            assert stun.urls == ("stun:a:1",)
            until, _, person = turn.username.partition(":")
            assert 11 * 3600 < int(until) - time.time() < 13 * 3600
            assert len(person) == 16

    asyncio.run(run())
    # a second opinion (printf 43200:u | openssl dgst -sha1 -hmac north -binary | base64)
    made = Relays(turn=("turn:b:2",), secret="north").servers("u", now_s=0)[0]
    assert (made.username, made.credential) == ("43200:u", "/OPIxHbL4qrWWh2PvVXUnjR2s88=")


def test_a_bucket_allows_a_rate_and_a_burst():
    bucket = Bucket(2, burst=4)
    assert [bucket.take(now=0) for _ in range(5)] == [True] * 4 + [False]
    assert [bucket.take(now=1) for _ in range(3)] == [True, True, False]
    assert [bucket.take(now=100) for _ in range(5)] == [True] * 4 + [False]


@pytest.mark.parametrize(
    ("takes", "gets"),
    [
        ("gzip, deflate, br, zstd", "br"),
        ("br;q=1.0, gzip;q=0.5", "br"),
        ("gzip, br;q=0", "gzip"),
        ("GZIP ; q=0.2, br;q=0.000", "gzip"),
        ("gzip;q=0", None),
        ("brotli, xgzip", None),
        ("", None),
    ],
)
def test_a_packed_form_goes_to_who_takes_it(tmp_path: Path, takes: str, gets: str | None):
    content, brotli = b"0123456789" * 1000, b"as Brotli made it"
    (tmp_path / f"{hashlib.sha256(content).hexdigest()}.br").write_bytes(brotli)
    request = make_mocked_request("GET", "/", headers={"Accept-Encoding": takes})
    answered = asyncio.run(answer(request, hold(content, ".js", tmp_path)))
    assert answered.headers.get("Content-Encoding") == gets
    assert {"br": bytes, "gzip": gzip.decompress, None: bytes}[gets](answered.body) == (
        brotli if gets == "br" else content
    )
    assert hold(content + b"!", ".js", tmp_path).brotli is None, "of another version"


@meeting
async def test_files_are_served_whole_compressed_and_no_others(place):
    script = place.address + "/static/room.js"
    async with place.session.get(script, headers={"Accept-Encoding": "identity"}) as answer:
        plain = await answer.read()
        assert answer.headers["Content-Type"].startswith("text/javascript")
        tag = answer.headers["ETag"]
    assert plain == (STATIC / "room.js").read_bytes()
    async with place.session.get(script, headers={"Accept-Encoding": "gzip"}) as answer:
        assert int(answer.headers["Content-Length"]) < len(plain) / 3
        assert await answer.read() == plain
    async with place.session.get(script, headers={"If-None-Match": tag}) as answer:
        assert (answer.status, await answer.read()) == (304, b"")
    for path in (
        "../keys.py",
        "..%2fkeys.py",
        "%2e%2e/keys.py",
        "/etc/passwd",
        "nothing.js",
        "avatars",
        ".",
        "",
    ):
        async with place.session.get(URL(f"{place.address}/static/{path}", encoded=True)) as answer:
            assert answer.status == 404, path
    async with place.session.get(place.address + "/avatars.json") as answer:
        assert await answer.json() == sorted(path.stem for path in (STATIC / "avatars").glob("*.glb"))

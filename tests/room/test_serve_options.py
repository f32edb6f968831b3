"""What `room serve` is told reaches the server: rooms, places, relays."""

from typing import Any

import pytest
from typer.testing import CliRunner

import room.server
from room.cli import app
from room.places import read_place
from room.server import Address, Limits, Relays


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What a server is made of; none is started."""
    heard: dict[str, Any] = {}

    class Rooms:
        def __init__(self, keys: object, **options: object) -> None:
            heard.update(options)

    def serve(rooms: Rooms, address: Address, *, started: object) -> None:
        heard["address"] = address

    monkeypatch.setattr(room.server, "Rooms", Rooms)
    monkeypatch.setattr(room.server, "serve", serve)
    return heard


def serve(*words: str) -> None:
    result = CliRunner().invoke(app, ["serve", *words])
    assert result.exit_code == 0, result.output


def test_limits_are_those_that_are_said(told):
    serve("--rooms", "3", "--people", "5", "--port", "0", "--host", "localhost")
    assert told["limits"] == Limits(people=5, rooms=3)
    assert (told["address"].host, told["address"].port) == ("localhost", 0)
    serve()
    assert told["limits"] == Limits()


def test_every_browser_is_told_of_the_stun_servers(told):
    serve("--stun", "stun:one.example:3478", "--stun", "stun:two.example:3478")
    assert told["relays"] == Relays(stun=("stun:one.example:3478", "stun:two.example:3478"))
    (server,) = told["relays"].servers("ada", now_s=0.0)
    assert (server.urls, server.username, server.credential) == (told["relays"].stun, None, None)


def test_rooms_have_the_places_that_are_said(told):
    serve("--place", "meeting", "--place", "lab=operating")
    assert told["places"] == {"": read_place("meeting"), "lab": read_place("operating")}
    serve()
    assert told["places"] == {}


def test_no_room_has_two_places(told):
    for words, whose in (
        (("lab=meeting", "lab=operating"), "room lab"),
        (("meeting", "operating"), "all rooms"),
    ):
        result = CliRunner().invoke(app, ["serve", *(word for place in words for word in ("--place", place))])
        assert f"{whose} would have two places" in str(result.exception)
    assert told == {}

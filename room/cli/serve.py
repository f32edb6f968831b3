"""Defines ``room serve``."""

import itertools
import os
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from facegen.console import say
from room.cli.links import RoomNames, print_links
from room.cli.places import read_places

if TYPE_CHECKING:
    from room.server import Keys
    from room.server.janus import Janus
    from room.server.redis_channels import RedisChannels


def serve(
    names: RoomNames = ("meeting",),
    host: Annotated[str, typer.Option(help="Interface; 0.0.0.0 for all, which needs --cert.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="0 takes any that is free.", min=0, max=65535)] = 8443,
    cert: Annotated[Path | None, typer.Option(help="Certificate (PEM) for https.")] = None,
    key: Annotated[Path | None, typer.Option(help="Its private key (PEM).")] = None,
    keys: Annotated[
        Path | None,
        typer.Option(
            help="File of the secret behind all links, made if it is not there; without, links end with the server."
        ),
    ] = None,
    people: Annotated[int, typer.Option(help="Places of a room.", min=1, max=1000)] = 64,
    rooms: Annotated[int, typer.Option(help="Rooms in use at one time.", min=1)] = 100,
    stun: Annotated[
        list[str] | None, typer.Option(help="stun:HOST:PORT, for voices beyond one network.")
    ] = None,
    turn: Annotated[
        list[str] | None, typer.Option(help="turn:HOST:PORT of a coturn, with --turn-secret.")
    ] = None,
    turn_secret: Annotated[Path | None, typer.Option(help="File of coturn's static-auth-secret.")] = None,
    origin: Annotated[
        list[str] | None,
        typer.Option(help="https://HOST that people type, where it is another name or a proxy's."),
    ] = None,
    redis: Annotated[
        str | None,
        typer.Option(
            help="redis://HOST:PORT/0 of a Redis by which several servers carry one room, all with the same --keys."
        ),
    ] = None,
    janus: Annotated[
        list[str] | None,
        typer.Option(
            help="ws://HOST:8188 of a Janus that passes voices on, for more than six people; several share the rooms."
        ),
    ] = None,
    janus_secret: Annotated[Path | None, typer.Option(help="File of its api_secret.")] = None,
    place: Annotated[
        list[str] | None,
        typer.Option(
            help="Where people meet: meeting, operating or FILE.glb, for all rooms; ROOM=PLACE for one of them."
        ),
    ] = None,
    record: Annotated[
        Path | None,
        typer.Option(
            help="A .jsonl for the states of those who agree: no voice, no pictures. A taken name gets a number."
        ),
    ] = None,
) -> None:
    """Open rooms, print their links, and serve them until Ctrl-C.

    Example: room serve --host 0.0.0.0 --cert cert.pem --key key.pem --keys room.keys
    """
    from facegen.errors import OutputError
    from room.errors import InputError
    from room.recording import Recorder
    from room.server import Address, Limits, Relays, Rooms, keep_keys, new_keys, read_keys
    from room.server import serve as run
    from room.server.headers import parse_origin
    from room.server.live_room import HERTZ

    places = read_places(place or ())
    if bool(turn) != bool(turn_secret):
        raise InputError("a relay needs both --turn and --turn-secret")
    secret = _secret(turn_secret, "coturn's static-auth-secret")
    engines = _engines(janus, janus_secret)
    known = keys is not None and keys.exists()
    held = read_keys(keys) if keys and known else new_keys()
    channels = _channels(redis, held, shared=keys is not None, recorded=record is not None)
    record = record and _free_place(record, names)
    origins = [parse_origin(text) for text in origin or ()]
    relays = Relays(stun=tuple(stun or ()), turn=tuple(turn or ()), secret=secret)
    limits = Limits(people=people, rooms=rooms)
    opened = Rooms(
        held,
        limits=limits,
        relays=relays,
        origins=frozenset(origins),
        places=places,
        channels=channels,
        engines=engines,
    )
    address = Address(host=host, port=port, certificate=cert, private_key=key)

    def started(where: str) -> None:
        if keys and not known:
            keep_keys(held, keys)
        if record:
            try:
                recorder = Recorder(
                    record, room=names[0], hertz=HERTZ, ended=lambda text: say(f"room: {text}")
                )
            except (InputError, OutputError):  # a command that was refused has written nothing
                if keys and not known:
                    keys.unlink()
                raise
            ending.callback(recorder.close)
            opened.record(recorder)
        print_links(held, names, origins[0] if origins else where)
        if not cert and host not in ("127.0.0.1", "::1", "localhost"):
            say(
                "room: browsers give no camera and no microphone to http pages of other machines: --cert and --key"
            )
        say("room: open; Ctrl-C stops it" + ("" if keys else ", and its links end with it (see --keys)"))

    with ExitStack() as ending:
        run(opened, address, started=started)
    say("room: stopped; " + ("its links open again with the same --keys" if keys else "its links have ended"))


def _free_place(record: Path, names: list[str]) -> Path:
    """The file of a recording: with a number where the name is taken, as when a server is started again."""
    from room.errors import InputError

    if record.suffix.lower() != ".jsonl":
        raise InputError(f"--record is {record}; a recording ends with .jsonl: name such a file")
    if len(names) != 1:
        raise InputError(f"--record takes one room, and --room names {len(names)}; start a server for each")
    if not os.path.lexists(record):
        return record
    numbered = (record.with_stem(f"{record.stem}-{number}") for number in itertools.count(2))
    free = next(path for path in numbered if not os.path.lexists(path))
    say(f"room: {record} is there already, and stays as it is; this recording goes to {free}")
    return free


def _channels(url: str | None, keys: "Keys", *, shared: bool, recorded: bool) -> "RedisChannels | None":
    from room.errors import InputError

    if url is None:
        return None
    if not shared:
        raise InputError("--redis needs --keys: all servers of a room have the file of one secret")
    if recorded:
        raise InputError(
            "--redis and --record: a recording asks the people of one server; leave one of them out"
        )
    from room.server.redis_channels import RedisChannels

    return RedisChannels(url, secret=keys.secret, said=lambda text: say(f"room: {text}"))


def _engines(urls: list[str] | None, file: Path | None) -> "list[Janus]":
    from room.errors import InputError
    from room.server.janus import Janus

    if file and not urls:
        raise InputError("--janus-secret needs --janus, the address that it is for")
    secret = _secret(file, "the api_secret of Janus")
    return [Janus(url, secret=secret, said=lambda text: say(f"room: {text}")) for url in urls or ()]


def _secret(file: Path | None, what: str) -> str:
    from facegen.documents import read_text
    from room.errors import InputError

    if file is None:
        return ""
    secret = read_text(file, most_bytes=4096).strip()
    if not secret:
        raise InputError(f"{file}: is empty; it must hold {what}")
    return secret

"""`room serve` and `room token` as people run them: links, certificates, and refusals in one sentence."""

import asyncio
import os
import platform
import re
import shutil
import signal
import socket
import ssl
import stat
import subprocess
import sys
import urllib.request
from pathlib import Path

import aiohttp
import pytest
from typer.testing import CliRunner

from room.cli import app
from room.errors import InputError, OutputError
from tests.room.recordings import recorded

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]


def room(*arguments: object, seconds: float = 300.0) -> subprocess.CompletedProcess[str]:
    command = (sys.executable, "-m", "room", *map(str, arguments))
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=seconds)


def test_token_prints_the_same_links_whenever_it_is_asked(tmp_path):
    keys = tmp_path / "room.keys"
    first = room("token", "--keys", keys, "--room", "lab", "--address", "https://rooms.example/")
    again = room("token", "--keys", keys, "--room", "lab", "--address", "https://rooms.example/")
    assert (first.returncode, first.stdout) == (0, again.stdout)
    guest, moderator = (line.split("\t") for line in first.stdout.splitlines())
    assert guest[:2] == ["lab", "guest"]
    assert re.fullmatch(r"https://rooms\.example/room/lab#[A-Za-z0-9_-]{22}", guest[2])
    assert moderator[2] != guest[2]
    if os.name == "posix":
        assert stat.S_IMODE(keys.stat().st_mode) == 0o600, "whoever reads it can come in everywhere"
    assert not again.stderr
    other = room("token", "--keys", tmp_path / "other.keys", "--room", "lab")
    assert "other.keys was not there and is made" in other.stderr, "as a mistyped name would be"
    assert guest[2].split("#")[1] not in other.stdout


REFUSED = {
    "a name with a space": ("token", "--keys", "{folder}/k", "--room", "my room"),
    "keys that are none": ("token", "--keys", "{folder}/bad"),
    "keys in a folder that is not there": ("token", "--keys", "{folder}/nowhere/k"),
    "half a certificate": ("serve", "--port", "0", "--cert", "{folder}/bad"),
    "no certificate": ("serve", "--port", "0", "--cert", "{folder}/bad", "--key", "{folder}/bad"),
    "a certificate that is not there": (
        "serve",
        "--port",
        "0",
        "--cert",
        "{folder}/c",
        "--key",
        "{folder}/c",
    ),
    "a relay without a secret": ("serve", "--port", "0", "--turn", "turn:a:1"),
    "a secret that is empty": (
        "serve",
        "--port",
        "0",
        "--turn",
        "turn:a:1",
        "--turn-secret",
        "{folder}/empty",
    ),
    "a secret that is no text": (
        "serve",
        "--port",
        "0",
        "--turn",
        "turn:a:1",
        "--turn-secret",
        "{folder}/binary",
    ),
    "a host with an empty part": ("serve", "--port", "0", "--host", "a..b"),
    "a host that is no one": ("serve", "--port", "0", "--host", "256.0.0.1"),
    "a port that is taken": ("serve", "--port", "{taken}"),
    "a name of no room, of new keys": ("token", "--keys", "{folder}/new", "--room", "My Room"),
    "a name of no room, of a server": ("serve", "--keys", "{folder}/new", "--room", "My Room"),
    "a host that is no one, of new keys": ("serve", "--keys", "{folder}/new", "--host", "256.0.0.1"),
    "no place at all": ("serve", "--port", "0", "--people", "0"),
}


@pytest.mark.parametrize("arguments", REFUSED.values(), ids=REFUSED.keys())
def test_what_cannot_be_used_is_refused_in_a_sentence(arguments, tmp_path):
    (tmp_path / "bad").write_text("no such thing")
    (tmp_path / "empty").write_text("\n")
    (tmp_path / "binary").write_bytes(b"\xff\xfe")
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        words = {"folder": tmp_path, "taken": taken.getsockname()[1]}
        done = room(*(argument.format(**words) for argument in arguments))
    assert done.returncode in (2, 74), done.stderr
    assert "Traceback" not in done.stderr
    assert "#" not in done.stdout, "no link of a room that is not open"
    assert not (tmp_path / "new").exists(), "keys of a server that never was"
    if "--people" not in arguments:  # that one is Typer's, with the usage above it
        assert done.stderr.count("\n") == 1, done.stderr


ENGINES = {
    "Redis without keys": ("--redis needs --keys", "--redis", "redis://localhost"),
    "Redis and a recording": (
        "one server",
        *("--redis", "redis://localhost", "--keys", "{folder}/k", "--record", "{folder}/r"),
    ),
    "an address of no Redis": ("no address of a Redis", "--redis", "http://a", "--keys", "{folder}/k"),
    "an address of no Janus": ("no address of a Janus", "--janus", "http://localhost:8188"),
    "Janus without a host": ("no address of a Janus", "--janus", "ws://"),
    "Janus at half an address": ("no address of a Janus", "--janus", "ws://[::1"),
    "Janus at no port": ("no address of a Janus", "--janus", "ws://h:99999"),
    "an origin without a scheme": ("no address of a server", "--origin", "rooms.example"),
    "an origin that is a page": ("no address of a server", "--origin", "https://rooms.example/room"),
    "a secret of no Janus": ("needs --janus", "--janus-secret", "{folder}/secret"),
    "an empty secret": ("is empty", "--janus", "ws://a:8188", "--janus-secret", "{folder}/empty"),
}


@pytest.mark.parametrize("case", ENGINES.values(), ids=ENGINES.keys())
def test_engines_that_cannot_be_used_are_refused_before_anything_is_written(case, tmp_path):
    (tmp_path / "empty").write_text("\n")
    words, *arguments = case
    filled = [argument.format(folder=tmp_path) for argument in arguments]
    empty = str(
        tmp_path / "empty"
    )  # a certificate by which nothing serves for ever that should have been refused
    result = CliRunner().invoke(app, ["serve", "--port", "0", "--cert", empty, "--key", empty, *filled])
    assert isinstance(result.exception, InputError)
    assert words in str(result.exception)
    assert [path.name for path in tmp_path.iterdir()] == ["empty"]


@pytest.mark.parametrize(
    "refused",
    [
        ("--cert", "{folder}/bad", "--key", "{folder}/bad"),
        ("--port", "{taken}"),
        ("--port", "{taken}", "--origin", "rooms.example"),
        ("--port", "{taken}", "--record", "{folder}/bad.jsonl"),
    ],
)
def test_a_server_that_is_refused_leaves_no_recording_and_no_keys(refused, tmp_path):
    """The corrected command would else find a file of the refused one."""
    for name in ("bad", "bad.jsonl"):
        (tmp_path / name).write_text("no such thing")
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        words = {"folder": tmp_path, "taken": taken.getsockname()[1]}
        filled = [option.format(**words) for option in refused]
        new = ("--record", tmp_path / "new.jsonl", "--keys", tmp_path / "new.keys")
        result = CliRunner().invoke(app, ["serve", "--port", "0", *map(str, new), *filled])
    assert isinstance(result.exception, InputError), result.exception
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad", "bad.jsonl"]
    assert (tmp_path / "bad.jsonl").read_text() == "no such thing"


def test_keys_that_cannot_be_kept_leave_no_recording(tmp_path):
    options = ("--record", str(tmp_path / "new.jsonl"), "--keys", str(tmp_path / "none" / "new.keys"))
    result = CliRunner().invoke(app, ["serve", "--port", "0", *options])
    assert isinstance(result.exception, OutputError), result.exception
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a disk that is always full")
def test_a_full_disk_under_the_log_ends_no_server():
    with (
        open("/dev/full", "w") as full,
        subprocess.Popen(
            (sys.executable, "-m", "room", "serve", "--port", "0"),
            stdout=subprocess.PIPE,
            stderr=full,
            text=True,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        ) as run,
    ):
        try:
            link = run.stdout.readline().split("\t")[2]
            with urllib.request.urlopen(link.partition("/room/")[0] + "/health", timeout=120) as answer:
                assert answer.read() == b"well\n"
            assert run.poll() is None
        finally:
            run.terminate()
            run.communicate(timeout=120)


def test_a_recording_that_has_no_folder_leaves_no_keys(tmp_path):
    options = ("--record", str(tmp_path / "none" / "new.jsonl"), "--keys", str(tmp_path / "new.keys"))
    result = CliRunner().invoke(app, ["serve", "--port", "0", *options])
    assert isinstance(result.exception, OutputError), result.exception
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--redis", "redis://127.0.0.1:9/0", "--keys", "{folder}/k"), "redis is away"),
        (("--janus", "ws://127.0.0.1:9"), "is away"),
    ],
)
def test_a_server_opens_though_an_engine_is_away_and_says_so(options, words, tmp_path):
    filled = [option.format(folder=tmp_path) for option in options]
    command = (sys.executable, "-m", "room", "serve", "--port", "0", *filled)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    ) as run:
        try:
            assert "#" in run.stdout.readline()
            assert any(words in line for line in run.stderr)
        finally:
            run.terminate()
            assert run.wait(120) == 0
            run.communicate()


@pytest.mark.parametrize("command", ["serve", "replay"])
def test_what_is_stopped_on_purpose_ends_well(command, tmp_path):
    words = (command, recorded(tmp_path / "meeting.jsonl")) if command == "replay" else (command,)
    with subprocess.Popen(
        (sys.executable, "-m", "room", *words, "--port", "0"),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    ) as run:
        assert "Ctrl-C stops it" in run.stderr.readline()
        run.send_signal(signal.SIGINT)
        _, said = run.communicate(timeout=300)
    assert (run.returncode, said) == (0, "room: stopped; its links have ended\n")


@pytest.mark.parametrize(
    ("options", "start"),
    [
        (("--host", "0.0.0.0"), f"http://{platform.node()}:"),
        (("--host", "0.0.0.0", "--origin", "HTTPS://Rooms.Example/"), "https://rooms.example/room/"),
        (("--host", "127.0.0.1"), "http://127.0.0.1:"),
    ],
)
def test_links_name_what_others_can_open(options, start):
    with subprocess.Popen(
        (sys.executable, "-m", "room", "serve", "--port", "0", *options),
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    ) as run:
        link = run.stdout.readline().split("\t")[2]
        run.terminate()
        run.communicate()
    assert link.startswith(start), link


@pytest.mark.skipif(shutil.which("openssl") is None, reason="makes the certificate")
def test_https_serves_the_page_and_the_room(tmp_path):
    certificate, key = tmp_path / "cert.pem", tmp_path / "key.pem"
    made = (
        *("openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2"),
        "-subj",
        "/CN=localhost",
    )
    subprocess.run(
        [*made, "-addext", "subjectAltName=DNS:localhost", "-out", certificate, "-keyout", key],
        check=True,
        capture_output=True,
    )
    command = (sys.executable, "-m", "room", "serve", "--port", "0", "--cert", certificate, "--key", key)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    ) as run:
        try:
            link = run.stdout.readline().split("\t")[2].strip().replace("127.0.0.1", "localhost")
            assert link.startswith("https://")
            asyncio.run(_visit(link, certificate))
        finally:
            run.terminate()
            assert run.wait(120) == 0
            run.communicate()


async def _visit(link: str, certificate: Path) -> None:
    trusted = ssl.create_default_context(cafile=str(certificate))
    address, key = link.split("#")
    join = {"kind": "join", "key": key, "secret": "s" * 22, "name": "Ada"}
    async with aiohttp.ClientSession() as session:
        async with session.get(address, ssl=trusted) as page:
            assert page.status == 200
            assert "<title>Room</title>" in await page.text()
        async with session.ws_connect(f"{address}/socket", ssl=trusted) as line:
            await line.send_json(join)
            assert (await line.receive_json())["kind"] == "welcome"
    await asyncio.sleep(0.25)  # aiohttp does not wait until transports of TLS have ended

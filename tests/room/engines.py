"""Starts the programs that a room outgrows one process by, from Debian's packages, on free ports of this machine."""

import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
START_S = 120.0

needs_redis = pytest.mark.skipif(
    shutil.which("redis-server") is None, reason="needs redis-server (Debian: redis-server)"
)


def free_port() -> int:
    """A port of this machine that nobody listens at."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextmanager
def started(*command: str, port: int) -> Iterator[subprocess.Popen]:
    """A program that listens at a port, until the context ends."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        end = time.monotonic() + START_S
        while True:
            assert process.poll() is None, f"{command[0]} has ended at once"
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    break
            assert time.monotonic() < end, f"{command[0]} does not listen"
            time.sleep(0.02)
        yield process
    finally:
        process.kill()
        process.wait()


@contextmanager
def redis(port: int) -> Iterator[subprocess.Popen]:
    """A Redis that keeps nothing."""
    command = ("redis-server", "--port", str(port), "--bind", "127.0.0.1", "--save", "", "--appendonly", "no")
    with started(*command, port=port) as process:
        yield process


needs_janus = pytest.mark.skipif(shutil.which("janus") is None, reason="needs Janus (Debian: janus)")

API_SECRET = "north"


@contextmanager
def janus(port: int, folder: Path) -> Iterator[subprocess.Popen]:
    """A Janus with the video room alone, as containers/room has it."""
    settings = folder / f"janus-{port}"
    settings.mkdir(exist_ok=True)
    for file in sorted((ROOT / "containers" / "room" / "janus").glob("*.jcfg")):
        text = file.read_text(encoding="utf-8").replace("8188", str(port))
        (settings / file.name).write_text(text, encoding="utf-8")
    command = ("janus", "--configs-folder", str(settings), "--apisecret", API_SECRET)
    with started(*command, port=port) as process:
        yield process

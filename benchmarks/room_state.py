"""Measures the state plane: bots who move at 30 Hz in one room, served by one process or by several over Redis.

    python benchmarks/room_state.py --people 8,16,32,64,200 --seconds 10
    python benchmarks/room_state.py --people 64,200 --servers 2

Bots speak WebSocket by hand, so that two processes of them can be 200 people: they walk over frames, answer pings, and
but for one in each process look into none. Last result: see docs/measurements/room.md, with machine, versions and date.
"""

import argparse
import asyncio
import base64
import json
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from multiprocessing import Process, Queue
from pathlib import Path

import psutil

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from room.protocol import Message, encode  # noqa: E402
from room.protocol.message import MESSAGE_BYTES  # noqa: E402
from room.protocol.texts import Join  # noqa: E402
from room.protocol.tick import ENTRY_BYTES, HEAD_BYTES  # noqa: E402
from room.server import load_keys  # noqa: E402

HERTZ = 30
BINARY, PING = 2, 9
SETTLE_S = 3.0
"""From the last who came in to the first second that counts."""


@dataclass
class Counts:
    """What one bot saw, from the beginning of what counts."""

    bytes: int = 0
    ticks: int = 0
    latencies_ms: list[int] = field(default_factory=list)
    sequences: dict[bytes, list[int]] = field(default_factory=dict)


class Bot(asyncio.Protocol):
    """One person who moves all the time."""

    def __init__(self, path: str, join: Join, index: int, *, looks: bool) -> None:
        self.counts, self.counting = Counts(), False
        self._path, self._join, self._looks = path, join, looks
        self._buffer, self._open = bytearray(), False
        self._skip = 0
        rest = encode(
            Message(weights=tuple(step / 51 for step in range(52)), floor_m=(index % 20, index // 20))
        )
        self._head, self._tail = _head(BINARY, MESSAGE_BYTES) + rest[:2], rest[8:]
        self._sequence = 0
        self.came = asyncio.get_running_loop().create_future()

    def connection_made(self, transport: asyncio.Transport) -> None:
        self._transport = transport
        key = base64.b64encode(os.urandom(16)).decode()
        transport.write(
            f"GET {self._path} HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n".encode()
        )

    def move(self) -> None:
        """Send a state with the time of all bots' clock."""
        clock = int(time.monotonic() * 1000) % 2**32
        self._sequence = (self._sequence + 1) % 2**16
        self._transport.write(
            self._head + self._sequence.to_bytes(2, "little") + clock.to_bytes(4, "little") + self._tail
        )

    def data_received(self, data: bytes) -> None:
        if self.counting:
            self.counts.bytes += len(data)
        if self._skip >= len(data):
            self._skip -= len(data)
            return
        self._buffer += memoryview(data)[self._skip :]
        self._skip = 0
        if not self._open:
            end = self._buffer.find(b"\r\n\r\n")
            if end < 0:
                return
            assert self._buffer.startswith(b"HTTP/1.1 101"), bytes(self._buffer[:200])
            del self._buffer[: end + 4]
            self._open = True
            content = self._join.model_dump_json().encode()
            self._transport.write(_head(1, len(content)) + content)
        while self._frame():
            pass

    def _frame(self) -> bool:
        """Take one frame off the buffer; says whether there was one."""
        buffer = self._buffer
        if len(buffer) < 2:
            return False
        length, at = buffer[1] & 127, 2
        if length > 125:
            at = 4 if length == 126 else 10
            length = int.from_bytes(buffer[2:at], "big")
        if len(buffer) < at:
            return False
        opcode, looked = buffer[0] & 15, self._looks and self.counting
        if opcode == BINARY and not looked:
            self._skip = max(0, at + length - len(buffer))
            del buffer[: at + length]
            self.counts.ticks += self.counting
            return self._skip == 0
        if len(buffer) < at + length:
            return False
        content = bytes(buffer[at : at + length])
        del buffer[: at + length]
        if opcode == PING:
            self._transport.write(_head(10, length) + content)
        elif opcode == 1 and not self.came.done():
            assert b'"welcome"' in content, content
            self.came.set_result(None)
        elif opcode == BINARY:
            self._look(content)
        return True

    def _look(self, content: bytes) -> None:
        self.counts.ticks += 1
        clock = int(time.monotonic() * 1000) % 2**32
        for place in range(HEAD_BYTES + 2, len(content), ENTRY_BYTES):
            number, state = content[place - 2 : place], content[place : place + 8]
            self.counts.latencies_ms.append(clock - int.from_bytes(state[4:8], "little"))
            self.counts.sequences.setdefault(number, []).append(int.from_bytes(state[2:4], "little"))


def _head(opcode: int, length: int) -> bytes:
    """Of a frame of a client, whose mask of zeros leaves the content as it is."""
    size = bytes((128 | length,)) if length < 126 else bytes((128 | 126,)) + length.to_bytes(2, "big")
    return bytes((128 | opcode,)) + size + bytes(4)


def _bots(queue: Queue, ports: list[int], key: str, indices: range, people: int, seconds: float) -> None:
    async def run() -> list[Counts]:
        loop, bots = asyncio.get_running_loop(), []
        for index in indices:
            join = Join(key=key, secret=f"{index:022d}", name=f"Bot {index}")
            port = ports[index // 2 % len(ports)]  # each process of bots has people at each server

            def make(join: Join = join, index: int = index) -> Bot:
                return Bot("/room/meeting/socket", join, index, looks=index == indices[0])

            _, bot = await loop.create_connection(make, "127.0.0.1", port)
            await bot.came
            bots.append(bot)
        queue.put("in")
        start = time.monotonic() + SETTLE_S
        until, due, next_one = start + seconds, time.monotonic(), 0
        step = 1 / HERTZ / len(bots)
        while (now := time.monotonic()) < until + 0.5:
            counting = start <= now < until
            if counting != bots[0].counting:
                for bot in bots:
                    bot.counting = counting
            while due <= now:
                bots[next_one].move()
                next_one = (next_one + 1) % len(bots)
                due += step
            await asyncio.sleep(max(0.0, min(due - now, 0.002) if step < 0.002 else due - now))
        return [bot.counts for bot in bots]

    queue.put(asyncio.run(run()))


@contextmanager
def _servers(count: int, folder: Path) -> Iterator[tuple[list[subprocess.Popen], list[int]]]:
    """Servers of one room, and, of several, the Redis between them, which is the last of the processes."""
    with ExitStack() as stack:
        options: tuple[str, ...] = ()
        redis = []
        if count > 1:
            port = _free_port()
            command = ("redis-server", "--port", str(port), "--bind", "127.0.0.1", "--save", "")
            redis = [stack.enter_context(_process(*command))]
            options = ("--redis", f"redis://127.0.0.1:{port}/0")
            time.sleep(1.0)
        serve = (sys.executable, "-m", "room", "serve", "--port", "0", "--people", "1000")
        servers = []
        for _ in range(count):
            servers.append(
                stack.enter_context(_process(*serve, "--keys", str(folder / "room.keys"), *options))
            )
            line = servers[-1].stdout.readline()
            servers[-1].port = int(line.split("\t")[2].split("/")[2].split(":")[1])
        yield servers + redis, [server.port for server in servers]


@contextmanager
def _process(*command: str) -> Iterator[subprocess.Popen]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        try:
            yield process
        finally:
            process.kill()


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def _used_s(process: subprocess.Popen) -> float:
    times = psutil.Process(process.pid).cpu_times()
    return times.user + times.system


def measure(people: int, *, seconds: float, processes: int, servers: int) -> dict[str, object]:
    """One room with so many bots."""
    with tempfile.TemporaryDirectory() as folder, _servers(servers, Path(folder)) as (running, ports):
        key = load_keys(Path(folder, "room.keys")).key("meeting", "guest")
        queue: Queue = Queue()
        shares = [range(part, people, processes) for part in range(min(processes, people))]
        workers = [
            Process(target=_bots, args=(queue, ports, key, share, people, seconds)) for share in shares
        ]
        for worker in workers:
            worker.start()
        for _ in workers:
            assert queue.get(timeout=120) == "in"
        time.sleep(SETTLE_S)
        before, at = [_used_s(process) for process in running], time.monotonic()
        own = [psutil.Process(worker.pid).cpu_times() for worker in workers]
        time.sleep(seconds)
        took = time.monotonic() - at
        used = [(_used_s(process) - was) / took for process, was in zip(running, before, strict=True)]
        bots_used = sum(
            sum(psutil.Process(worker.pid).cpu_times()[:2]) - sum(was[:2])
            for worker, was in zip(workers, own, strict=True)
        )
        counts = [bot for _ in workers for bot in queue.get(timeout=120)]
        for worker in workers:
            worker.join()
    latencies = sorted(latency for bot in counts for latency in bot.latencies_ms)
    seen = [sequences for bot in counts for sequences in bot.sequences.values()]
    # every number between the first and the last that came was sent, and a last state may come twice to a newcomer
    missed = sum(sequences[-1] - sequences[0] + 1 - len(set(sequences)) for sequences in seen)
    kbits = statistics.mean(bot.bytes for bot in counts) * 8 / 1000 / seconds
    return {
        "people": people,
        "cpu_percent_each_server": [round(100 * share, 1) for share in used[:servers]],
        "cpu_percent_redis": round(100 * used[servers], 1) if servers > 1 else None,
        "cpu_percent_bots": round(100 * bots_used / took, 1),
        "kbit_s_down": round(kbits),
        "kbit_s_a_person_seen": round(kbits / people, 1),
        "latency_ms_p50": latencies[len(latencies) // 2],
        "latency_ms_p95": latencies[int(len(latencies) * 0.95)],
        "ticks_a_second": round(statistics.mean(bot.ticks for bot in counts) / seconds, 1),
        "lost": missed,
        "of": sum(map(len, seen)) + missed,
        "load": os.getloadavg()[0],
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--people", default="8,16,32,64,200")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--processes", type=int, default=2, help="that the bots share")
    parser.add_argument(
        "--servers", type=int, default=1, help="that carry the room; more than one need redis-server"
    )
    options = parser.parse_args()
    for people in map(int, options.people.split(",")):
        found = measure(people, seconds=options.seconds, processes=options.processes, servers=options.servers)
        print(json.dumps(found), flush=True)


if __name__ == "__main__":
    main()

"""Measures the state plane: bots who move at 30 Hz in one room, served by one process on the same machine.

    python benchmarks/room_state.py --people 8,16,32,64,200 --seconds 10

Last result: see docs/room.md, which has the table, the machine and the versions.
"""

import argparse
import asyncio
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from multiprocessing import Process, Queue
from pathlib import Path

import aiohttp
import psutil

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from room.protocol import Message, encode  # noqa: E402
from room.protocol.message import MESSAGE_BYTES  # noqa: E402
from room.protocol.texts import Join  # noqa: E402
from room.protocol.tick import ENTRY_BYTES, HEAD_BYTES  # noqa: E402
from room.server import load_keys  # noqa: E402

HERTZ = 30
SENT_AT = slice(4, 8)
"""Where a message has its sender's clock; all bots share one here, so a difference is the latency."""


async def _bot(
    session: aiohttp.ClientSession, address: str, key: str, index: int, *, seconds: float, measured: bool
) -> dict:
    """One person who moves all the time; `measured` ones look into what they get, the others only count it."""
    join = Join(key=key, secret=f"{index:022d}", name=f"Bot {index}")
    rest = encode(Message(weights=tuple(step / 51 for step in range(52)), floor_m=(index % 20, index // 20)))
    seen: dict[bytes, list[int]] = {}
    latencies: list[float] = []
    counted = {"ticks": 0, "bytes": 0, "states": 0}
    async with session.ws_connect(f"{address}/socket", max_msg_size=0) as socket:
        await socket.send_str(join.model_dump_json())
        await socket.receive()
        start = time.monotonic() + 2.0  # everybody is in by then
        until = start + seconds

        async def move() -> None:
            due = start - 1.0 + index / 1000
            sequence = 0
            while due < until + 0.5:
                await asyncio.sleep(max(0.0, due - time.monotonic()))
                clock = int(time.monotonic() * 1000) % 2**32
                await socket.send_bytes(
                    rest[:2] + sequence.to_bytes(2, "little") + clock.to_bytes(4, "little") + rest[8:]
                )
                sequence = (sequence + 1) % 2**16
                due += 1 / HERTZ

        moving = asyncio.create_task(move())
        while (now := time.monotonic()) < until:
            try:
                message = await socket.receive(timeout=until - now)
            except asyncio.TimeoutError:
                break
            if message.type is not aiohttp.WSMsgType.BINARY or time.monotonic() < start:
                continue
            content = message.data
            counted["ticks"] += 1
            counted["bytes"] += len(content)
            counted["states"] += (len(content) - HEAD_BYTES) // ENTRY_BYTES
            if measured:
                clock = int(time.monotonic() * 1000) % 2**32
                for place in range(HEAD_BYTES + 2, len(content), ENTRY_BYTES):
                    state = content[place : place + MESSAGE_BYTES]
                    latencies.append(clock - int.from_bytes(state[SENT_AT], "little"))
                    seen.setdefault(content[place - 2 : place], []).append(
                        int.from_bytes(state[2:4], "little")
                    )
        await moving
    # every number between the first and the last that came was sent
    missed = sum(sequences[-1] - sequences[0] + 1 - len(sequences) for sequences in seen.values())
    return counted | {
        "latencies": latencies,
        "missed": missed,
        "expected": sum(map(len, seen.values())) + missed,
    }


def _bots(queue: Queue, address: str, key: str, indices: range, seconds: float) -> None:
    async def run() -> list[dict]:
        connector = aiohttp.TCPConnector(limit=0)
        async with aiohttp.ClientSession(connector=connector) as session:
            bots = (
                _bot(session, address, key, index, seconds=seconds, measured=index == indices[0])
                for index in indices
            )
            return await asyncio.gather(*bots)

    queue.put(asyncio.run(run()))


def measure(people: int, *, seconds: float, processes: int) -> dict[str, float]:
    """One room with so many bots."""
    with tempfile.TemporaryDirectory() as folder:
        keys = Path(folder, "room.keys")
        command = (
            sys.executable,
            "-m",
            "room",
            "serve",
            "--port",
            "0",
            "--keys",
            str(keys),
            "--people",
            "1000",
        )
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as server:
            try:
                address = server.stdout.readline().split("\t")[2].split("#")[0]
                key = load_keys(keys).key("meeting", "guest")
                queue: Queue = Queue()
                shares = [range(part, people, processes) for part in range(min(processes, people))]
                workers = [
                    Process(target=_bots, args=(queue, address, key, share, seconds)) for share in shares
                ]
                for worker in workers:
                    worker.start()
                time.sleep(3.0)
                times = psutil.Process(server.pid).cpu_times()
                before, at = times.user + times.system, time.monotonic()
                time.sleep(max(1.0, seconds - 3.0))
                times = psutil.Process(server.pid).cpu_times()
                used = (times.user + times.system - before) / (time.monotonic() - at)
                bots = [bot for _ in workers for bot in queue.get(timeout=120)]
                for worker in workers:
                    worker.join()
            finally:
                server.kill()
    latencies = sorted(latency for bot in bots for latency in bot["latencies"])
    kbits = statistics.mean(bot["bytes"] for bot in bots) * 8 / 1000 / seconds
    return {
        "people": people,
        "cpu_percent": round(100 * used, 1),
        "kbit_s_down": round(kbits),
        "kbit_s_a_person_seen": round(kbits / people, 1),
        "latency_ms_p50": latencies[len(latencies) // 2],
        "latency_ms_p95": latencies[int(len(latencies) * 0.95)],
        "ticks_a_second": round(statistics.mean(bot["ticks"] for bot in bots) / seconds, 1),
        "lost": sum(bot["missed"] for bot in bots),
        "of": sum(bot["expected"] for bot in bots),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--people", default="8,16,32,64,200")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--processes", type=int, default=2, help="that the bots share")
    options = parser.parse_args()
    for people in map(int, options.people.split(",")):
        print(json.dumps(measure(people, seconds=options.seconds, processes=options.processes)), flush=True)


if __name__ == "__main__":
    main()

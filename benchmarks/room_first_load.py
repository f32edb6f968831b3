"""Asks a real server of a room for what a browser gets on its first visit, and counts what crosses the network.

    python benchmarks/room_first_load.py

Each file is asked for once with ``Accept-Encoding: gzip``, as browsers do, and counted as it came, packed: what the
page's text names and its worklet, the place, each avatar, and the face parts where `make room-face` has put them.

Last result, 2026-11-23, Python 3.11, one avatar and the face parts: meeting 9.52 MB, operating 10.12 MB. The aim of 9
is missed by the place, which came after the aim; without a camera it is 1.92 and 2.52 MB.
"""

import asyncio
import re
import sys
from pathlib import Path

import aiohttp

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from room.places import read_place  # noqa: E402
from room.server.application import STATIC  # noqa: E402
from tests.room.guests import Place, open_room  # noqa: E402

PLACES = ("meeting", "operating")
AIM_MB = 9.0


async def packed(session: aiohttp.ClientSession, address: str) -> tuple[int, bytes]:
    """Bytes of an answer's body as they cross the network, and as they are."""
    async with session.get(address, headers={"Accept-Encoding": "gzip"}) as answer:
        answer.raise_for_status()
        content = await answer.read()
        return int(answer.headers["Content-Length"]), content


async def measured(place_name: str) -> dict[str, int]:
    """Bytes by part, of a first visit to a place."""
    async with open_room(places={"": read_place(place_name)}) as place:
        async with aiohttp.ClientSession(auto_decompress=False) as session:
            return await visited(session, place)


async def visited(session: aiohttp.ClientSession, place: Place) -> dict[str, int]:
    """As `measured`, of a server that runs."""
    room = f"{place.address}/room/meeting"
    html = (STATIC / "room.html").read_text(encoding="utf-8")
    page = [room, f"{room}/about.json", f"{place.address}/avatars.json"]
    page += [place.address + path for path in re.findall(r'(?:src|href)="(/static/[^"]+)"', html)]
    page += [f"{place.address}/static/{name}" for name in ("frames.worklet.js", "fvad.wasm")]
    parts = {"page": page, "place": [f"{room}/place.glb"]}
    for path in sorted(STATIC.glob("avatars/*.glb")):
        parts[f"avatar {path.stem}"] = [f"{place.address}/static/avatars/{path.name}"]
    face = [path for path in sorted((STATIC / "face").rglob("*")) if path.is_file()]
    if face:
        worker = [f"{place.address}/static/face.worker.js"]
        parts["face"] = worker + [
            f"{place.address}/static/{path.relative_to(STATIC).as_posix()}" for path in face
        ]
    return {name: sum([(await packed(session, each))[0] for each in asked]) for name, asked in parts.items()}


def main() -> None:
    """Print a line for each part and place."""
    for name in PLACES:
        parts = asyncio.run(measured(name))
        avatars = [size for part, size in parts.items() if part.startswith("avatar ")]
        total = sum(parts.values()) - sum(avatars) + max(avatars, default=0)
        print(f"{name}: " + ", ".join(f"{part} {size / 1e6:.2f} MB" for part, size in parts.items()))
        without = "" if "face" in parts else " without the face parts (make room-face)"
        print(f"{name}: {total / 1e6:.2f} MB with one avatar{without}; the aim is {AIM_MB:g}")


if __name__ == "__main__":
    main()

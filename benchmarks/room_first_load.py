"""Asks a real server of a room for what a browser gets on its first visit, and counts what crosses the network.

    python benchmarks/room_first_load.py

Each file is asked for once, as a browser that takes Brotli does, and once as one that takes gzip alone; counted is what
came, packed: what the page's text names and its worklet, the place, each avatar, and the face parts. `make room-face`
puts these there, and packs with Brotli. Browsers take it by https, and from their own machine.

Last result, 2026-11-24, Python 3.11, Node 20.20, one avatar and the face parts: meeting 7.96 MB, operating 8.43 MB by
Brotli, 9.53 and 10.12 MB by gzip. Without a camera 6.36 or 7.60 MB less are loaded.
"""

import asyncio
import itertools
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
TAKES = {"Brotli": "gzip, deflate, br, zstd", "gzip": "gzip"}


async def packed(session: aiohttp.ClientSession, address: str) -> tuple[int, bytes]:
    """Bytes of an answer's body as they cross the network, and as they are."""
    async with session.get(address) as answer:
        answer.raise_for_status()
        content = await answer.read()
        return int(answer.headers["Content-Length"]), content


async def measured(place_name: str, takes: str) -> dict[str, int]:
    """Bytes by part, of a first visit to a place with an ``Accept-Encoding``."""
    async with open_room(places={"": read_place(place_name)}) as place:
        headers = {"Accept-Encoding": takes}
        async with aiohttp.ClientSession(auto_decompress=False, headers=headers) as session:
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
    face = [path for path in sorted((STATIC / "face").rglob("*")) if path.is_file() and path.name[0] != "."]
    if face:
        worker = [f"{place.address}/static/face.worker.js"]
        parts["face"] = worker + [
            f"{place.address}/static/{path.relative_to(STATIC).as_posix()}" for path in face
        ]
    return {name: sum([(await packed(session, each))[0] for each in asked]) for name, asked in parts.items()}


def main() -> None:
    """Print a line for each place and packing."""
    for name, (packing, takes) in itertools.product(PLACES, TAKES.items()):
        parts = asyncio.run(measured(name, takes))
        avatars = [size for part, size in parts.items() if part.startswith("avatar ")]
        total = sum(parts.values()) - sum(avatars) + max(avatars, default=0)
        without = "" if "face" in parts else " without the face parts (make room-face)"
        listed = ", ".join(f"{part} {size / 1e6:.2f} MB" for part, size in parts.items())
        print(f"{name}, {packing}: {total / 1e6:.2f} MB with one avatar{without} (aim {AIM_MB:g}): {listed}")


if __name__ == "__main__":
    main()

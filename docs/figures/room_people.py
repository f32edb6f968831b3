"""Makes people for pictures of the room, and lets them bring what they look like, as everybody's page can.

Two people come with the server; a meeting of more needs others. `facegen rig export` makes them once, into the rig's
folder; delete them there when the rig changes.
"""

import subprocess
import sys
from pathlib import Path

from tests.room.guests import Guest, Place

ROOT = Path(__file__).resolve().parents[2]
MADE = ROOT / "blender_assets/build/people"

PEOPLE = {
    "leo": "--sex male --hair short --age 58 --seed 11",
    "mei": "--sex female --hair bun --ancestry asian --age 47 --seed 12",
}
"""Options of `facegen rig export anny --body`."""


def person(name: str) -> bytes:
    """Somebody's avatar, made where it is missing."""
    path = MADE / f"{name}.glb"
    if not path.exists():
        path.parent.mkdir(exist_ok=True)
        export = [sys.executable, "-m", "facegen", "rig", "export", "anny", "--body"]
        subprocess.run([*export, *PEOPLE[name].split(), "--out", path], check=True, cwd=ROOT)
    return path.read_bytes()


async def dressed_guest(place: Place, *, name: str, avatar: str, **change: object) -> Guest:
    """Somebody who comes in, in an avatar of the server's or of `PEOPLE`."""
    if avatar not in PEOPLE:
        return await place.guest(name=name, avatar=avatar, **change)
    guest = await place.guest(name=name, **change)
    bearer = f"Bearer {place.keys.key(place.name, 'guest')}.{guest.secret}"
    address = f"{place.address}/room/{place.name}/avatar"
    async with place.session.post(address, data=person(avatar), headers={"Authorization": bearer}) as answer:
        assert answer.ok, await answer.text()
    return guest

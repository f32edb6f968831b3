"""Makes people for pictures of the room, and lets them bring what they look like, as everybody's page can.

Two people come with the server; a meeting of more needs others. `facegen rig export` makes them once, into the rig's
folder; delete them there when the rig or their options change.
"""

import itertools
import subprocess
import sys
from pathlib import Path

from room.state import identity
from room.state.numbers import COLOURS
from tests.room.guests import Guest, Place

ROOT = Path(__file__).resolve().parents[2]
MADE = ROOT / "blender_assets/build/people"

PEOPLE = {
    "leo": "--sex male --hair short --age 58 --seed 11 --clothes shirt",
    "mei": "--sex female --hair cap --ancestry asian --age 47 --seed 12 --clothes gown",
}
"""Options of `facegen rig export anny --body`. Own avatars are never dyed, so each wears what nobody else does."""

WINE, SAND, PURPLE, BLUE = 1, 3, 4, 9
"""Of the colours of clothes in `web/room/figure/colours.ts`: those that differ from rooms, gown and shirt."""


def person(name: str) -> bytes:
    """Somebody's avatar, made where it is missing."""
    path = MADE / f"{name}.glb"
    if not path.exists():
        path.parent.mkdir(exist_ok=True)
        export = [sys.executable, "-m", "facegen", "rig", "export", "anny", "--body"]
        subprocess.run([*export, *PEOPLE[name].split(), "--out", path], check=True, cwd=ROOT)
    return path.read_bytes()


def secret_of(name: str, clothes: int, hair: int = 0) -> str:
    """A secret whose person the room dyes so: pictures are the same whenever they are drawn.

    Hair is one of six, or of four where the avatar's is dark; twelve is a multiple of both.
    """
    for attempt in itertools.count():
        secret = f"{name}-{attempt}".ljust(22, "-")
        whose = identity(secret)
        if int(whose, 16) % COLOURS == clothes and int(whose[:8], 16) % 12 == hair:
            return secret


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

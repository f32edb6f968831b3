"""Two pages find each other's voices again, where one of them has let go of a connection that the other still keeps."""

import asyncio
from pathlib import Path

import pytest

from tests.browser import Tab, needs_chromium
from tests.room.page import CONNECTED, meet

pytestmark = [needs_chromium, pytest.mark.slow]

PEOPLE = "[...meeting.known.values()].map(({ person }) => person)"
MEET = f"meeting.voice.meet({PEOPLE}, meeting.own.id)"

LET_GO = f"""void (() => {{
  meeting.voice.meet({PEOPLE}.map((person) => ({{ ...person, present: false }})), meeting.own.id);
  {MEET};
}})()"""
"""As a page does with somebody whom the room has missed for a while, and who then comes back."""

COME_BACK = f"""void (() => {{
  [...meeting.voice.lines.peers.values()][0].connection.close();
  meeting.voice.configure([], false);
  {MEET};
}})()"""
"""As a page does whose network was gone for so long that nothing is left of the connection."""

KEEP = "void (globalThis.before = [...meeting.voice.lines.peers.values()][0])"

HEARD_ANEW = (
    f"{CONNECTED} && [...meeting.voice.lines.peers.values()][0] !== before"
    " && [...meeting.voice.sounds.values()].some((sound) => sound.peak() > 0.01)"
)


async def found_again(ada: Tab, ben: Tab, acts: tuple[str, str]) -> None:
    """Let both act, and wait until they hear each other by another connection."""
    for tab in (ada, ben):
        await tab.until(CONNECTED)
        await tab.ask(KEEP)
    for tab, act in zip((ada, ben), acts, strict=True):
        if act:
            await tab.ask(act)
    for tab in (ada, ben):
        await tab.until(HEARD_ANEW)


async def break_all(folder: Path) -> list[str]:
    """Every way of losing one, on either page: one of them is the polite side."""
    async with meet(folder, "Ada", "Ben") as (_, (ada, ben)):
        for acts in [
            (LET_GO, ""),
            ("", LET_GO),
            (COME_BACK, ""),
            ("", COME_BACK),
            (COME_BACK, LET_GO),
            (LET_GO, COME_BACK),
            (COME_BACK, COME_BACK),
        ]:
            await found_again(ada, ben, acts)
        return ada.complaints + ben.complaints


def test_a_connection_that_one_side_alone_still_has_is_made_anew(tmp_path):
    assert asyncio.run(break_all(tmp_path)) == []

"""Brings somebody into a room's page for pictures: without a microphone, and with nothing on it but the room."""

import json
from pathlib import Path

from tests.browser import Tab

BARE = "nav, aside, #mirror, #state { display: none !important }"


async def be(tab: Tab, secret: str) -> None:
    """Load the page again as the person of a secret, so that who looks wears the same colours in every picture."""
    keep = f"sessionStorage.setItem('secret of meeting', {json.dumps(secret)}); globalThis.again = true"
    await tab.call("Page.addScriptToEvaluateOnNewDocument", source=keep)
    await tab.call("Page.reload")
    await tab.until("globalThis.again")


async def come_in(tab: Tab, name: str, avatar: str = "") -> None:
    """Fill in the form and wait for the room's answer."""
    await tab.until("document.querySelector('#join select[name=avatar]')?.value")
    await tab.ask(
        f"(() => {{ const form = document.querySelector('#join'); form.elements.name.value = {json.dumps(name)};"
        f" form.elements.avatar.value = {json.dumps(avatar)} || form.elements.avatar.value;"
        " if (form.elements.voice.checked) form.elements.voice.click(); form.requestSubmit(); })()"
    )
    await tab.until("globalThis.meeting?.own && meeting.presence.placed", 240)


async def dressed(tab: Tab) -> None:
    """Wait until everybody wears what they chose, or brought: a file that was brought is called avatar."""
    worn = "({ person, figure }) => figure.avatar.name === (person.own ? 'avatar' : person.avatar)"
    await tab.until(f"[...meeting.known.values()].every({worn})", 240)


async def stand(tab: Tab, *, x: float, z: float, heading: float, pitch: float = 0.0) -> None:
    """Put whoever looks to a place, in metres and radians, also where the table is."""
    where = json.dumps({"x": x, "z": z, "heading": heading, "pitch": pitch})
    await tab.ask(f"void Object.assign(meeting.presence.walk, {where}, {{ update() {{}} }})")


async def only_the_room(tab: Tab) -> None:
    """Take buttons, lists and the mirror away; a style of its own, as the content policy allows none in the page."""
    await tab.ask(
        f"void document.adoptedStyleSheets.push(Object.assign(new CSSStyleSheet(), {{ }})),"
        f" void document.adoptedStyleSheets[0].replaceSync({json.dumps(BARE)})"
    )
    await tab.ask("void (document.querySelector('#mirror').hidden = true)")


async def draw(tab: Tab, path: Path, *, width: int, height: int) -> None:
    """Let arms and faces go where they go, undrawn, and draw once: software takes seconds for each picture."""
    await tab.ask("void (meeting.stage.drawing = false, globalThis.clock = performance.now())")
    await tab.ask("void (performance.now = () => globalThis.clock)")
    for size, steps in (((160, 100), 20), ((width, height), 3)):
        await tab.look(width=size[0], height=size[1])
        for _ in range(steps):
            await tab.ask("(clock += 100, new Promise((moved) => requestAnimationFrame(() => moved())))")
    await tab.ask("void meeting.stage.view.draw()")
    await tab.picture(path)

"""An avatar that is dropped on one page is worn on the other; a broken one is told to its owner alone."""

import asyncio
import base64
import json
from pathlib import Path

import pytest

from facegen.formats.gltf_container import glb_bytes, parse_glb
from room.server.application import STATIC
from tests.browser import Tab, needs_chromium
from tests.room.avatars import BINARY
from tests.room.page import FACE, meet, other
from tests.track.page.heads import head, vrm1

pytestmark = [needs_chromium, pytest.mark.slow]

DROP = """(() => {
  const bytes = Uint8Array.from(atob(%s), (sign) => sign.charCodeAt(0));
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([bytes], %s));
  dispatchEvent(new DragEvent('drop', { dataTransfer, cancelable: true }));
})()"""
TOLD = "document.querySelector('#told').textContent"


def grown(egg: bytes) -> bytes:
    """A head as large as a body, on a node of its own."""
    document, chunks = parse_glb(egg, "egg")
    document["nodes"].append({"scale": [4, 4, 4], "children": document["scenes"][0]["nodes"]})
    document["scenes"][0]["nodes"] = [len(document["nodes"]) - 1]
    return glb_bytes(document, chunks, Path("egg"))


async def drop(tab: Tab, content: bytes, name: str) -> str:
    """Drop a file on a page; the sentence that it answers."""
    await tab.ask("void (document.querySelector('#told').textContent = '')")
    await tab.ask(DROP % (json.dumps(base64.b64encode(content).decode()), json.dumps(name)))
    await tab.until(TOLD)
    return await tab.ask(TOLD)


def wears(name: str) -> str:
    return f"{other('Ada')}.figure?.avatar.name === {json.dumps(name)}"


async def dressed(folder: Path) -> dict[str, object]:
    async with meet(folder, "Ada", "Ben") as (_, (ada, ben)):
        await ben.until(wears("nora"))
        found: dict[str, object] = {"broken": await drop(ada, BINARY, "broken.glb")}
        found["tiny"] = await drop(ada, head(), "egg.glb")
        assert await ben.ask(wears("nora"))
        found["taken"] = await drop(ada, (STATIC / "avatars" / "omar.glb").read_bytes(), "me.glb")
        await ben.until(wears("avatar"))
        weights = [0.5 + index / 200 for index in range(52)]
        await ada.ask(FACE % json.dumps(weights))
        await ben.until(f"{other('Ada')}.figure.avatar.influences().jawOpen > 0.5")
        await drop(ada, grown(head(vrm=vrm1)), "egg.vrm")
        vrm = f"{other('Ada')}.figure?.avatar.vrm && {other('Ada')}.figure.avatar.influences().jawOpen > 0.5"
        await ben.until(vrm)
        found["complaints"] = list(ben.complaints)
        await ada.ask("document.querySelector('#bring').click()")
        await ben.until(wears("nora"))
        return found


def test_what_one_drops_the_others_see(tmp_path):
    found = asyncio.run(dressed(tmp_path))
    print(found)
    assert "broken.glb is no .glb or .vrm file" in found["broken"]
    assert "m high" in found["tiny"]
    assert "me.glb" in found["taken"]
    assert found["complaints"] == []

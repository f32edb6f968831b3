"""An avatar that is dropped on one page is worn on the other; a broken one harms nobody but its owner."""

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


BREAKS = """void (() => {
  const broken = () => { throw new Error('broken'); };
  const { avatar } = %s.figure;
  %s
})()"""
RENDERER = "meeting.stage.view.renderer"


async def broken(folder: Path) -> dict[str, object]:
    """What is left of a picture after one of two own avatars breaks: as it takes a face, and as it is drawn."""
    async with meet(folder, "Ada", "Cid", "Ben") as (_, (ada, cid, ben)):  # pictures are of who came last
        omar, nora = ((STATIC / "avatars" / f"{name}.glb").read_bytes() for name in ("omar", "nora"))
        found: dict[str, object] = {}
        await drop(cid, omar, "cid.glb")
        ways = ("avatar.update = broken", "avatar.model.traverse((node) => (node.onBeforeShadow = broken))")
        for number, (content, way) in enumerate(zip((omar, nora), ways, strict=True)):
            await drop(ada, content, "ada.glb")
            await ben.until(f"{wears('avatar')} && {other('Cid')}.figure?.avatar.name === 'avatar'")
            await ben.ask(f"void (meeting.stage.drawing = {json.dumps(number == 1)})")
            await ben.ask(BREAKS % (other("Ada"), way))
            await ben.until(wears("nora"))
            await ada.ask("document.querySelector('#bring').click()")
            await ben.until(f"{other('Ada')}.person.own === ''")
        before = await ben.ask(f"{RENDERER}.info.render.frame")
        await ben.until(f"{RENDERER}.info.render.frame > {before}")
        await ben.ask("void (meeting.stage.drawing = false)")
        found["cid"] = await ben.ask(f"{other('Cid')}.figure.avatar.name")
        found["target"] = await ben.ask(f"{RENDERER}.getRenderTarget()")
        found["scissors"] = await ben.ask(f"{RENDERER}.getScissorTest()")
        found["said"] = [line for line in ben.complaints if "broken" in line]
        return found


def test_of_an_avatar_that_cannot_be_drawn_the_rooms_stands_in_and_others_keep_theirs(tmp_path):
    found = asyncio.run(broken(tmp_path))
    assert found["cid"] == "avatar"
    assert (found["target"], found["scissors"]) == (None, False)
    assert len(found["said"]) >= 2

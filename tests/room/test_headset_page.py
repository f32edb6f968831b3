"""A headset that is emulated (npm's iwer) enters by the page's button, and its head moves the body that others see."""

import asyncio
import json
import math
import subprocess
from pathlib import Path

import pytest

from tests.browser import Tab, chromium, needs_chromium
from tests.room.guests import open_room
from tests.room.speech import write_bursts
from tests.room.test_browser_code import ESBUILD, WEB
from tests.room.test_page import AWAKE, come_in

pytestmark = [
    needs_chromium,
    pytest.mark.slow,
    pytest.mark.skipif(not (WEB / "node_modules" / "iwer").exists(), reason="needs `npm ci` in web/"),
]

DEVICE = """import { XRDevice, metaQuest3 } from "iwer";
const device = new XRDevice(metaQuest3, { stereoEnabled: true });
device.installRuntime();
globalThis.device = device;
"""
EMULATED = "--disable-blink-features=WebXR"
"""Chromium's own WebXR would stay in place of the emulated one."""

EAR = "[meeting.voice.context.listener.forwardX.value, meeting.voice.context.listener.forwardZ.value]"


def emulator(folder: Path) -> str:
    """The emulated device as a script; it goes into the test's page alone."""
    source, made = folder / "device.js", folder / "emulator.js"
    source.write_text(DEVICE)
    options = ("--bundle", "--format=iife", "--log-level=warning", f"--outfile={made}")
    subprocess.run([ESBUILD, source, *options], check=True, env={"NODE_PATH": str(WEB / "node_modules")})
    return made.read_text()


async def enter(tab: Tab, address: str, script: str) -> None:
    """Come in with a headset, and put it on."""
    await tab.call("Page.addScriptToEvaluateOnNewDocument", source=script)
    await tab.call("Page.navigate", url=address)
    await tab.look(width=320, height=240)
    await come_in(tab, "Ada")
    await tab.until("!document.querySelector('#headset').hidden")
    await tab.ask("void device.position.set(0, 1.6, 0)")
    await tab.ask("document.querySelector('#headset').click()")
    await tab.until("meeting.presence.headset.worn && meeting.presence.headset.update(0)", 90)


async def worn(folder: Path) -> dict[str, object]:
    write_bursts(folder / "speech.wav")
    async with (
        open_room() as place,
        chromium(*AWAKE, EMULATED, f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}") as browser,
        browser.open("about:blank") as tab,
    ):
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        await enter(tab, link, emulator(folder))
        ben = await place.guest(name="Ben")
        number = await tab.ask("meeting.own.number")

        async def seen():
            """What another gets of Ada, once it has settled."""
            await asyncio.sleep(2.0)
            return ben.states[number]

        await tab.ask("void Object.assign(meeting.presence.walk, { x: 2, z: -2, heading: 0 })")
        found: dict[str, object] = {"stands": (await seen()).floor_m}
        # a step of 30 cm to the own left, which is -x for WebXR and +x for who looks along +z, and a bow of 20 cm
        await tab.ask("void device.position.set(-0.3, 1.4, 0)")
        state = await seen()
        found |= {"stepped": state.floor_m, "bowed": state.head_m[1]}
        half = math.radians(60) / 2
        await tab.ask(f"void device.quaternion.set(0, {math.sin(half)}, 0, {math.cos(half)})")
        await asyncio.sleep(0.5)
        early = ben.states[number]
        state = await seen()
        for name, at in (("early", early), ("late", state)):
            head = 2 * math.atan2(at.rotation[1], at.rotation[3])
            found[name] = (math.degrees(at.heading), math.degrees(at.heading + head))
        found["ears"] = await tab.ask(EAR)
        await tab.ask("void device.controllers.right.updateAxis('thumbstick', 'x-axis', 1)")
        turned = await seen()
        found["snapped"] = math.degrees(turned.heading - state.heading)
        found["moved by a turn"] = math.dist(turned.floor_m, state.floor_m)
        await tab.ask("void device.controllers.right.updateAxis('thumbstick', 'x-axis', 0)")
        await tab.ask("void device.controllers.left.updateAxis('thumbstick', 'y-axis', -1)")
        await asyncio.sleep(1.0)
        await tab.ask("void device.controllers.left.updateAxis('thumbstick', 'y-axis', 0)")
        walked = await seen()
        found["walked"] = [round(b - a, 3) for a, b in zip(turned.floor_m, walked.floor_m, strict=True)]
        found["looks"] = turned.heading + 2 * math.atan2(turned.rotation[1], turned.rotation[3])
        await tab.ask("document.querySelector('#headset').click()")
        await tab.until("!meeting.presence.headset.worn")
        left = await seen()
        found["left behind"] = math.dist(left.floor_m, walked.floor_m)
        # Chromium's own part is switched off, and it wonders about the word for it in our headers
        found["complaints"] = [line for line in tab.complaints if "xr-spatial-tracking" not in line]
        return found


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    found = asyncio.run(asyncio.wait_for(worn(tmp_path_factory.mktemp("headset")), 240))
    print(json.dumps(found))
    return found


def test_a_step_and_a_bow_arrive(found):
    assert found["stands"] == pytest.approx((2, -2), abs=0.011)
    assert found["stepped"] == pytest.approx((1.7 + 0.6, -2), abs=0.011), "to the own left"
    assert found["bowed"] == pytest.approx(-0.2, abs=0.002)


def test_a_head_turns_first_and_the_body_follows(found):
    assert found["early"][1] == pytest.approx(60, abs=1)
    assert found["late"][1] == pytest.approx(60, abs=1)
    assert found["early"][0] < found["late"][0] <= 60.1
    assert found["ears"] == pytest.approx([math.sin(math.radians(60)), math.cos(math.radians(60))], abs=0.02)


def test_a_stick_turns_once_by_thirty_degrees_about_the_head(found):
    assert found["snapped"] == pytest.approx(-30, abs=12), "the body still follows its head a little"
    assert found["moved by a turn"] <= 0.015


def test_a_stick_walks_where_one_looks_and_the_page_goes_on_there(found):
    walked = math.hypot(*found["walked"])
    assert 0.4 < walked < 3
    assert math.atan2(*found["walked"]) == pytest.approx(found["looks"], abs=0.05)
    assert found["left behind"] <= 0.015
    assert found["complaints"] == []

"""A headset that is emulated (npm's iwer) enters by the page's button, and its head moves the body that others see."""

import asyncio
import json
import math
import subprocess
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from room.protocol import Message
from tests.browser import Tab, chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.guests import open_room
from tests.room.page import AWAKE, come_in
from tests.room.speech import write_bursts
from tests.room.test_browser_code import ESBUILD, WEB

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

STEPPED = (-1.7, -2)
MOST_PACE = 1.5
"""Metres a second; people walk at 1.4 here."""

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
    await tab.until("meeting.presence.headset.worn && meeting.presence.headset.update(0)")


def looks_deg(state: Message) -> float:
    """Where the head looks, in the room."""
    return math.degrees(state.heading + 2 * math.atan2(state.rotation[1], state.rotation[3]))


async def worn(folder: Path) -> dict[str, object]:
    write_bursts(folder / "speech.wav")
    async with (
        open_room(places=BARE) as place,
        chromium(*AWAKE, EMULATED, f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}") as browser,
        browser.open("about:blank") as tab,
    ):
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        await enter(tab, link, emulator(folder))
        ben = await place.guest(name="Ben")
        number = await tab.ask("meeting.own.number")

        async def seen(right: Callable[[Message], bool]) -> Message:
            """What another gets of Ada, once it is as it should be; or as it stays."""
            with suppress(TimeoutError):
                await ben.until(lambda: number in ben.states and right(ben.states[number]))
            return ben.states[number]

        async def still() -> Message:
            """The same, once she has stood still for a third of a second."""
            floors: list[tuple[float, float]] = []
            while len(floors) < 10 or len(set(floors[-10:])) > 1:
                before = ben.states[number]
                await ben.until(lambda before=before: ben.states[number] is not before)
                floors.append(ben.states[number].floor_m)
            return ben.states[number]

        await tab.ask("void Object.assign(meeting.presence.walk, { x: -2, z: -2, heading: 0 })")
        found: dict[str, object] = {"stands": (await seen(lambda it: it.floor_m == (-2, -2))).floor_m}
        # a step of 30 cm to the own left, which is -x for WebXR and +x for who looks along +z, and a bow of 20 cm
        await tab.ask("void device.position.set(-0.3, 1.4, 0)")
        state = await seen(lambda it: math.dist(it.floor_m, STEPPED) < 0.011 and it.head_m[1] < -0.198)
        found |= {"stepped": state.floor_m, "bowed": state.head_m[1]}
        half = math.radians(60) / 2
        await tab.ask(f"void device.quaternion.set(0, {math.sin(half)}, 0, {math.cos(half)})")
        early = await seen(lambda it: looks_deg(it) > 59)
        late = await seen(lambda it: math.degrees(it.heading) > 50)
        for name, at in (("early", early), ("late", late)):
            found[name] = (math.degrees(at.heading), looks_deg(at))
        await tab.until(f"Math.abs({EAR}[0] - {math.sin(2 * half)}) < 0.01")
        found["ears"] = await tab.ask(EAR)
        state = ben.states[number]
        await tab.ask("void device.controllers.right.updateAxis('thumbstick', 'x-axis', 1)")
        turned = await seen(lambda it: looks_deg(it) < 31)
        found["snapped"] = looks_deg(turned) - looks_deg(state)
        found["moved by a turn"] = math.dist(turned.floor_m, state.floor_m)
        await tab.ask("void device.controllers.right.updateAxis('thumbstick', 'x-axis', 0)")
        await tab.ask("void device.controllers.left.updateAxis('thumbstick', 'y-axis', -1)")
        await seen(lambda it: math.dist(it.floor_m, turned.floor_m) > 0.5)
        await tab.ask("void device.controllers.left.updateAxis('thumbstick', 'y-axis', 0)")
        walked = await still()
        found["walked"] = [round(b - a, 3) for a, b in zip(turned.floor_m, walked.floor_m, strict=True)]
        found["seconds"] = (walked.time_ms - turned.time_ms) / 1000
        found["looks"] = looks_deg(walked)
        await tab.ask("document.querySelector('#headset').click()")
        await tab.until("!meeting.presence.headset.worn")
        sent = await tab.ask("meeting.line.sequence")
        left = await seen(lambda it: it.sequence > sent)
        found["left behind"] = math.dist(left.floor_m, walked.floor_m)
        found["field"] = await tab.ask("meeting.stage.view.camera.fov")
        await tab.ask("void (meeting.presence.stance.seated = true)")
        await tab.until("document.querySelector('#seat').textContent === 'Stand up'")
        await tab.ask("document.querySelector('#headset').click()")
        await tab.until("meeting.presence.headset.worn")
        await tab.until("document.querySelector('#seat').textContent === 'Sit'")
        await tab.ask("document.querySelector('#seat').click()")
        found["seated"] = await tab.ask("meeting.presence.stance.seated")
        await tab.ask("document.querySelector('#leave').click()")
        await tab.until("!meeting.presence.headset.worn")
        found["offered"] = await tab.ask("document.querySelector('#headset').checkVisibility()")
        # Chromium's own part is switched off, and it wonders about the word for it in our headers
        found["complaints"] = [line for line in tab.complaints if "xr-spatial-tracking" not in line]
        return found


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    found = asyncio.run(asyncio.wait_for(worn(tmp_path_factory.mktemp("headset")), 1200))
    print(json.dumps(found))
    return found


def test_a_step_and_a_bow_arrive(found):
    assert found["stands"] == pytest.approx((-2, -2), abs=0.011)
    assert found["stepped"] == pytest.approx(STEPPED, abs=0.011), "to the own left"
    assert found["bowed"] == pytest.approx(-0.2, abs=0.002)


def test_a_head_turns_first_and_the_body_follows(found):
    assert found["early"][1] == pytest.approx(60, abs=1)
    assert found["late"][1] == pytest.approx(60, abs=1)
    assert found["early"][0] < 50 < found["late"][0] <= 60.1
    assert found["ears"] == pytest.approx([math.sin(math.radians(60)), math.cos(math.radians(60))], abs=0.02)


def test_a_stick_turns_once_by_thirty_degrees_about_the_head(found):
    assert found["snapped"] == pytest.approx(-30, abs=1)
    assert found["moved by a turn"] <= 0.015


def test_a_stick_walks_where_one_looks_and_the_page_goes_on_there(found):
    walked = math.hypot(*found["walked"])
    assert 0.4 < walked < MOST_PACE * found["seconds"]
    assert found["looks"] == pytest.approx(30, abs=1), (
        "the other stick has turned once, however long it was pushed"
    )
    assert math.degrees(math.atan2(*found["walked"])) == pytest.approx(found["looks"], abs=3)
    assert found["left behind"] <= 0.015
    assert found["complaints"] == []


def test_the_pages_view_is_that_of_before_and_who_leaves_the_meeting_leaves_the_headset(found):
    assert found["field"] == 50
    assert not found["offered"]


def test_who_puts_the_headset_on_stands(found):
    assert found["seated"] is False

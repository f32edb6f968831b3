"""A headset's hands move the arms, for its wearer and at another page; an emulated one (iwer) in the room's page."""

import asyncio
import json
import math
import os
from contextlib import AsyncExitStack
from pathlib import Path

import pytest

from tests.browser import Tab, chromium, needs_chromium
from tests.room.guests import open_room
from tests.room.speech import write_bursts
from tests.room.test_browser_code import WEB
from tests.room.test_headset_page import EMULATED, emulator, enter
from tests.room.test_page import AWAKE, come_in, other

pytestmark = [
    needs_chromium,
    pytest.mark.slow,
    pytest.mark.skipif(not (WEB / "node_modules" / "iwer").exists(), reason="needs `npm ci` in web/"),
]

SEEN = """new Promise((done) => {
  const { xr } = meeting.stage.view.renderer;
  xr.getSession().requestAnimationFrame((_, frame) => {
    const found = {};
    for (const { handedness, gripSpace, hand } of xr.getSession().inputSources) {
      const space = xr.getReferenceSpace();
      const pose = hand ? frame.getJointPose(hand.get('wrist'), space) : frame.getPose(gripSpace, space);
      if (!pose) continue;
      const world = meeting.stage.view.rig.matrixWorld.clone().multiply({ elements: pose.transform.matrix });
      found[handedness] = { at: world.elements.slice(12, 15), arm: world.elements.slice(4, 7) };
    }
    done(found);
  });
})"""
"""What the headset itself says, in the room: a controller's grip and its y axis, or a hand's wrist."""

SHOWN = """(() => {
  const { figure } = %s;
  figure.root.updateWorldMatrix(true, true);
  const found = {};
  figure.root.traverse(({ name, matrixWorld }) => {
    const [, bone] = /^mixamorig((?:Left|Right)(?:Arm|ForeArm|Hand|HandMiddle1))$/.exec(name) ?? [];
    if (bone) found[bone] = matrixWorld.elements.slice(12, 15);
  });
  return found;
})()"""
FRAMES = """new Promise((done) => {
  let left = 12;
  const step = () => (left-- ? requestAnimationFrame(step) : done());
  step();
})"""
"""A busy machine draws few pictures, and each moves an arm on."""

BEHIND_GRIP_M = 0.06


def device(side: str, at: tuple[float, float, float], *, pitch_deg: float = 0.0) -> str:
    half = math.radians(pitch_deg) / 2
    parts = [
        f"device.{kind}.{side}.{what}"
        for kind in ("controllers", "hands")
        for what in (f"position.set{at}", f"quaternion.set({math.sin(half)}, 0, 0, {math.cos(half)})")
    ]
    return "void [" + ", ".join(parts) + "]"


async def in_front(tab: Tab) -> None:
    """Let one of the two draw, as a headset's hands are told with its pictures; the other goes on to send."""
    await tab.call("Page.bringToFront")
    await asyncio.sleep(1.5)
    await tab.ask(FRAMES)


async def hands(folder: Path) -> dict[str, dict]:
    write_bursts(folder / "speech.wav")
    async with (
        open_room() as place,
        chromium(*AWAKE, EMULATED, f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}") as browser,
        browser.open("about:blank") as ada,
        AsyncExitStack() as later,
    ):
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        await enter(ada, link, emulator(folder))
        ben = await later.enter_async_context(browser.open(link))
        await ben.look(width=480, height=360)
        await come_in(ben, "Ben")
        for tab in (ada, ben):
            await tab.call("Page.bringToFront")
            await tab.until(f"{other('Ada')}?.figure.avatar.model.getObjectByName('mixamorigLeftHand')", 30)
        await ada.ask("void Object.assign(meeting.presence.walk, { x: 2, z: -2, heading: 0.7 })")

        async def settled() -> dict:
            await in_front(ada)
            seen = {"said": await ada.ask(SEEN), "mirror": await ada.ask(SHOWN % other("Ada"))}
            await in_front(ben)
            flags = await ben.ask(f"{other('Ada')}.newest.flags")
            return seen | {"other": await ben.ask(SHOWN % other("Ada")), "flags": flags}

        found = {}
        await ada.ask(device("left", (-0.22, 1.1, -0.3), pitch_deg=30))
        await ada.ask(device("right", (0.2, 1.35, -0.32), pitch_deg=60))
        found["before the chest"] = await settled()
        await look(ben, folder)
        await ada.ask(device("left", (-0.3, 1.62, -0.1), pitch_deg=90))
        await ada.ask(device("right", (0.05, 1.0, -0.25)))
        found["raised and at the belt"] = await settled()
        await ada.ask(device("right", (2, 1.2, -1)))
        found["out of reach"] = await settled()
        await ada.ask(device("right", (0.2, 1.3, -0.3)))
        await ada.ask("void (device.primaryInputMode = 'hand')")
        found["without controllers"] = await settled()
        await ada.ask("void (device.hands.left.connected = device.hands.right.connected = false)")
        found["lost"] = await settled()
        complaints = [line for line in ada.complaints + ben.complaints if "xr-spatial-tracking" not in line]
        return found | {"complaints": complaints}


async def look(tab: Tab, folder: Path) -> None:
    """A picture of the person before the other, for who asks for one."""
    if not (wanted := os.environ.get("HANDS_PICTURE")):
        return
    x, z = 2 + 1.25 * math.sin(0.7), -2 + 1.25 * math.cos(0.7)
    await tab.ask(
        f"void Object.assign(meeting.presence.walk, {{ x: {x}, z: {z}, heading: {0.7 + math.pi}, pitch: -0.2 }})"
    )
    await tab.ask("void (meeting.stage.drawing = true)")
    await asyncio.sleep(6)
    await tab.picture(Path(wanted))
    await tab.ask("void (meeting.stage.drawing = false)")


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict:
    found = asyncio.run(asyncio.wait_for(hands(tmp_path_factory.mktemp("hands")), 480))
    print(json.dumps(found))
    return found


SIDES = ("Left", "Right")
PAGES = ("mirror", "other")


def wrist(said: dict) -> list[float]:
    """Where the wrist of who holds a controller is."""
    return [at + BEHIND_GRIP_M * arm for at, arm in zip(said["at"], said["arm"], strict=True)]


@pytest.mark.parametrize("page", PAGES)
@pytest.mark.parametrize("pose", ["before the chest", "raised and at the belt"])
def test_a_controller_is_in_the_hand(found, page, pose):
    shown = found[pose][page]
    for side in SIDES:
        said = found[pose]["said"][side.lower()]
        hand, knuckle = shown[f"{side}Hand"], shown[f"{side}HandMiddle1"]
        palm = [(a + b) / 2 for a, b in zip(hand, knuckle, strict=True)]
        assert math.dist(hand, wrist(said)) < 0.02, f"{side} wrist"
        assert math.dist(palm, said["at"]) < 0.02, f"{side} palm"


@pytest.mark.parametrize("page", PAGES)
def test_a_tracked_hand_is_where_its_wrist_is(found, page):
    for side in SIDES:
        said = found["without controllers"]["said"][side.lower()]["at"]
        assert math.dist(found["without controllers"][page][f"{side}Hand"], said) < 0.02, side


@pytest.mark.parametrize("page", PAGES)
def test_an_arm_reaches_as_far_as_it_is_long(found, page):
    shown, wanted = found["out of reach"][page], wrist(found["out of reach"]["said"]["right"])
    shoulder, elbow, hand = (shown[f"Right{part}"] for part in ("Arm", "ForeArm", "Hand"))
    length = math.dist(shoulder, elbow) + math.dist(elbow, hand)
    assert 0.99 * length < math.dist(shoulder, hand) < length
    far = math.dist(shoulder, wanted)
    assert far > 2 * length
    along = [s + (w - s) * math.dist(shoulder, hand) / far for s, w in zip(shoulder, wanted, strict=True)]
    assert math.dist(along, hand) < 0.02, "towards the hand"


@pytest.mark.parametrize("page", PAGES)
def test_arms_hang_again_when_hands_are_lost(found, page):
    assert found["without controllers"]["flags"] & 8
    assert not found["lost"]["flags"] & 8
    for side in SIDES:
        arm, hand = (found["lost"][page][f"{side}{part}"] for part in ("Arm", "Hand"))
        assert arm[1] - hand[1] > 0.35, side
    assert found["complaints"] == []

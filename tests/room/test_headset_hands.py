"""A headset's hands move the arms, for its wearer and at another page; an emulated one (iwer) in the room's page."""

import asyncio
import json
import math
import os
import time
from collections.abc import Callable
from contextlib import AsyncExitStack
from pathlib import Path

import pytest

from tests.browser import PATIENCE_S, Tab, chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.guests import open_room
from tests.room.page import AWAKE, come_in, other
from tests.room.speech import write_bursts
from tests.room.test_browser_code import WEB
from tests.room.test_headset_page import EMULATED, emulator, enter

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
BEHIND_GRIP_M = 0.06


def device(side: str, at: tuple[float, float, float], *, pitch_deg: float = 0.0) -> str:
    half = math.radians(pitch_deg) / 2
    parts = [
        f"device.{kind}.{side}.{what}"
        for kind in ("controllers", "hands")
        for what in (f"position.set{at}", f"quaternion.set({math.sin(half)}, 0, 0, {math.cos(half)})")
    ]
    return "void [" + ", ".join(parts) + "]"


PICTURES = 12
"""A busy machine draws few pictures, and each moves an arm on."""


async def in_front(tab: Tab) -> None:
    """Let one of the two draw, as a headset's hands are told with its pictures; the other goes on to send."""
    await tab.call("Page.bringToFront")
    await tab.drawn(PICTURES)


SIDES = ("Left", "Right")
PAGES = ("mirror", "other")
NEAR_M = 0.02


def wrist(said: dict) -> list[float]:
    """Where the wrist of who holds a controller is."""
    return [at + BEHIND_GRIP_M * arm for at, arm in zip(said["at"], said["arm"], strict=True)]


def held(seen: dict, page: str) -> bool:
    """Whether both controllers are in the hands that a page shows."""

    def in_hand(side: str) -> bool:
        said, hand, knuckle = (
            seen["said"][side.lower()],
            seen[page][f"{side}Hand"],
            seen[page][f"{side}HandMiddle1"],
        )
        palm = [(a + b) / 2 for a, b in zip(hand, knuckle, strict=True)]
        return math.dist(hand, wrist(said)) < NEAR_M and math.dist(palm, said["at"]) < NEAR_M

    return all(map(in_hand, SIDES))


def tracked(seen: dict, page: str) -> bool:
    """Whether both hands that a page shows are where their wrists are."""
    return all(
        math.dist(seen[page][f"{side}Hand"], seen["said"][side.lower()]["at"]) < NEAR_M for side in SIDES
    )


def stretched(seen: dict, page: str) -> bool:
    """Whether the right arm reaches for a controller that is far away, as far as it is long."""
    wanted = wrist(seen["said"]["right"])
    shoulder, elbow, hand = (seen[page][f"Right{part}"] for part in ("Arm", "ForeArm", "Hand"))
    length, reach = math.dist(shoulder, elbow) + math.dist(elbow, hand), math.dist(shoulder, hand)
    far = math.dist(shoulder, wanted)
    along = [s + (w - s) * reach / far for s, w in zip(shoulder, wanted, strict=True)]
    return far > 2 * length and 0.99 * length < reach < length and math.dist(along, hand) < NEAR_M


def hanging(seen: dict, page: str) -> bool:
    """Whether both arms hang, and no hands are said any more."""
    drops_m = [seen[page][f"{side}Arm"][1] - seen[page][f"{side}Hand"][1] for side in SIDES]
    return min(drops_m) > 0.35 and not seen["flags"] & 8


async def hands(folder: Path) -> dict[str, dict]:
    write_bursts(folder / "speech.wav")
    async with (
        open_room(places=BARE) as place,
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
            await tab.until(f"{other('Ada')}?.figure.avatar.model.getObjectByName('mixamorigLeftHand')")
        await ada.ask("void Object.assign(meeting.presence.walk, { x: 2, z: -2, heading: 0.7 })")

        async def settled(right: Callable[[dict, str], bool]) -> dict:
            """What is said and seen, once it is as it should be in both pages; or as it stays."""
            end = time.monotonic() + PATIENCE_S
            while True:
                await in_front(ada)
                seen = {"said": await ada.ask(SEEN), "mirror": await ada.ask(SHOWN % other("Ada"))}
                await in_front(ben)
                seen["flags"] = await ben.ask(f"{other('Ada')}.newest.flags")
                seen["other"] = await ben.ask(SHOWN % other("Ada"))
                if all(right(seen, page) for page in PAGES) or time.monotonic() > end:
                    return seen

        found = {}
        await ada.ask(device("left", (-0.22, 1.1, -0.3), pitch_deg=30))
        await ada.ask(device("right", (0.2, 1.35, -0.32), pitch_deg=60))
        found["before the chest"] = await settled(held)
        await look(ben, folder)
        await ada.ask(device("left", (-0.3, 1.62, -0.1), pitch_deg=90))
        await ada.ask(device("right", (0.05, 1.0, -0.25)))
        found["raised and at the belt"] = await settled(held)
        await ada.ask(device("right", (2, 1.2, -1)))
        found["out of reach"] = await settled(stretched)
        await ada.ask(device("right", (0.2, 1.3, -0.3)))
        await ada.ask("void (device.primaryInputMode = 'hand')")
        found["without controllers"] = await settled(tracked)
        await ada.ask("void (device.hands.left.connected = device.hands.right.connected = false)")
        found["lost"] = await settled(hanging)
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
    await tab.drawn(PICTURES)
    await tab.picture(Path(wanted))
    await tab.ask("void (meeting.stage.drawing = false)")


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict:
    found = asyncio.run(asyncio.wait_for(hands(tmp_path_factory.mktemp("hands")), 1200))
    print(json.dumps(found))
    return found


@pytest.mark.parametrize("page", PAGES)
@pytest.mark.parametrize("pose", ["before the chest", "raised and at the belt"])
def test_a_controller_is_in_the_hand(found, page, pose):
    assert held(found[pose], page), found[pose]


@pytest.mark.parametrize("page", PAGES)
def test_a_tracked_hand_is_where_its_wrist_is(found, page):
    assert tracked(found["without controllers"], page), found["without controllers"]


@pytest.mark.parametrize("page", PAGES)
def test_an_arm_reaches_as_far_as_it_is_long(found, page):
    assert stretched(found["out of reach"], page), found["out of reach"]


@pytest.mark.parametrize("page", PAGES)
def test_arms_hang_again_when_hands_are_lost(found, page):
    assert found["without controllers"]["flags"] & 8
    assert not found["lost"]["flags"] & 8
    assert hanging(found["lost"], page), found["lost"]
    assert found["complaints"] == []

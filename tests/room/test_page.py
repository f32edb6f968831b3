"""Two people meet in the room's page, in two tabs of one real browser with a fake microphone."""

import asyncio
import json
import statistics
import time
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.runtime.sample import Sample
from room.server import new_keys
from tests.browser import Tab, chromium, needs_chromium
from tests.room.guests import Guest, Place, open_room
from tests.room.speech import write_bursts
from track.sinks.targets import open_sink, parse_target

pytestmark = [needs_chromium, pytest.mark.slow]

AWAKE = (
    *("--disable-background-timer-throttling", "--disable-backgrounding-occluded-windows"),
    *("--disable-renderer-backgrounding", "--autoplay-policy=no-user-gesture-required", "--mute-audio"),
    *("--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream"),
)
"""Two pages of one browser: neither is slowed because the other is in front."""


@asynccontextmanager
async def meet(tmp_path: Path, *names: str) -> AsyncIterator[tuple[Place, list[Tab]]]:
    """A server, a browser, and people who have come in by the page."""
    write_bursts(tmp_path / "speech.wav")
    async with open_room() as place:
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        async with chromium(
            *AWAKE, f"--use-file-for-fake-audio-capture={tmp_path / 'speech.wav'}"
        ) as browser:
            opened = [browser.open(link) for _ in names]
            tabs = [await tab.__aenter__() for tab in opened]
            try:
                for tab, name in zip(tabs, names, strict=True):
                    await tab.look(width=480, height=360)
                    await come_in(tab, name)
                for tab in tabs:
                    await tab.until(f"meeting.known.size === {len(names)}")
                yield place, tabs
            finally:
                for tab in opened:
                    await tab.__aexit__(None, None, None)


async def come_in(tab: Tab, name: str) -> None:
    await tab.until("document.querySelector('#join select[name=avatar]')?.value")
    await tab.ask(
        f"(() => {{ const form = document.querySelector('#join'); form.elements.name.value = {json.dumps(name)};"
        " form.requestSubmit(); })()"
    )
    await tab.until("globalThis.meeting?.own", 60)  # with the first shaders, on a busy machine
    await tab.ask(
        "void (meeting.stage.drawing = false)"
    )  # software draws two rooms no faster than it detects voices


def other(name: str) -> str:
    """Somebody as another's page knows them."""
    return f"[...meeting.known.values()].find(({{ person }}) => person.name === {json.dumps(name)})"


FACE = """void (meeting.presence.idle.update = () => ({
  weights: Float32Array.from(%s), gaze: [0.1, 0.05, 0.1, 0.05], head: [0.2, 0.1, 0], head_m: [0, 0, 0], tracked: true,
}))"""
"""Lets a page send a face, as a camera would."""

CONNECTED = "[...meeting.voice.sounds.keys()].some((id) => meeting.voice.state(id) === 'connected')"

EARS = """void (globalThis.listen = async () => {
  const { context, loopback } = meeting.voice;
  const split = new ChannelSplitterNode(context, { numberOfOutputs: 2 });
  context.createMediaStreamSource(loopback.element.srcObject).connect(split);
  const meters = [0, 1].map((ear) => new AnalyserNode(context, { fftSize: 4096 }));
  meters.forEach((meter, ear) => split.connect(meter, ear));
  const sums = [0, 0];
  const samples = new Float32Array(4096);
  for (let i = 0; i < 60; i++) {
    await new Promise((resolve) => setTimeout(resolve, 50));
    meters.forEach((meter, ear) => {
      meter.getFloatTimeDomainData(samples);
      sums[ear] += samples.reduce((sum, sample) => sum + sample * sample, 0);
    });
  }
  return sums;
})"""
"""Energy at the left and the right ear over three seconds, of what the page plays behind its loopback."""

HEARD = """void (() => {
  globalThis.heard = [];
  let loud = false;
  const { microphone } = meeting;
  const hear = microphone.hear;
  microphone.hear = (frame) => {
    hear.call(microphone, frame);
    if ((microphone.level > 0.01) !== loud) heard.push([(loud = !loud), Date.now()]);
  };
})()"""
"""When the sound at a microphone begins and ends."""

SHOWN = """void (() => {
  globalThis.shown = [];
  const { figure } = %s;
  const speak = figure.speak;
  figure.speak = (speaking) => {
    if (speaking !== figure.signShown) shown.push([speaking, Date.now()]);
    speak.call(figure, speaking);
  };
})()"""
"""When somebody's sign comes and goes."""

SAY = """(() => {
  const form = document.querySelector('#chat');
  form.elements.text.value = %s;
  form.requestSubmit();
})()"""


WORN = """[...meeting.known.values()].map(({ person, figure }) => {
  const tops = [];
  figure.avatar.root.traverse(({ material }) => material?.name === 'top' && tops.push(material.color.getHexString()));
  return [person.name, ...tops];
}).sort()"""
"""In what colour a page shows the clothes of each person."""

DRAWN = """new Promise((done) => {
    let left = 30;
    const next = () => (--left ? requestAnimationFrame(next) : done(true));
    next();
})"""
"""A place's first pictures take a software renderer seconds, in which no face moves."""


async def faces(ada: Tab, ben: Tab) -> tuple[int, float]:
    """How many shapes one has on the other's page, and how far they are at most from what was sent."""
    await ben.until(f"{other('Ada')}.figure?.avatar.name === 'nora'")
    await ben.ask(DRAWN)
    errors = []
    for step in (0, 20):
        weights = [((7 * index + step) % 53) / 52 for index in range(52)]
        await ada.ask(FACE % json.dumps(weights))
        await asyncio.sleep(2.0)
        stands = await ben.ask(f"{other('Ada')}.figure.avatar.influences()")
        errors += [abs(stands[name] - weights[BLENDSHAPES.index(name)]) for name in stands]
    return len(errors) // 2, max(errors)


async def sides(ada: Tab, ben: Tab) -> dict[str, float]:
    """Energy at the ear of the other's side over that at the other ear."""
    for tab in (ada, ben):
        await tab.until(CONNECTED, 30)
        await tab.until("meeting.voice.loopback.used", 10)
    await ada.ask("void Object.assign(meeting.presence.walk, { x: 0, z: -2.2, heading: 0 })")
    await ada.ask(EARS)
    found = {}
    for side, x in (("left", 2.0), ("right", -2.0)):
        await ben.ask(f"void Object.assign(meeting.presence.walk, {{ x: {x}, z: -2.2, heading: 0 }})")
        await asyncio.sleep(1.0)
        left, right = await ada.ask("listen()")
        found[side] = left / right if side == "left" else right / left
    return found


async def signs(ada: Tab, ben: Tab) -> dict[str, list[float]]:
    """Milliseconds from a sound's begin, and from its end, to the sign on the other's page."""
    await ada.ask(HEARD)
    await ben.ask(SHOWN % other("Ada"))
    await asyncio.sleep(14.0)
    heard, shown = await ada.ask("heard"), await ben.ask("shown")
    late = {}
    for word, state in (("on", True), ("off", False)):
        begins = [at for loud, at in heard if loud is state][1:-1]
        late[word] = [min(at - begun for on, at in shown if on is state and at >= begun) for begun in begins]
    return late


async def observe(folder: Path) -> dict[str, object]:
    """All that two people notice of each other, measured."""
    async with meet(folder, "Ada", "Ben") as (place, (ada, ben)):
        shapes, error = await faces(ada, ben)
        found = {"shapes": shapes, "weights": error, **await sides(ada, ben), **await signs(ada, ben)}
        for tab in (ada, ben):
            await tab.until(
                "[...meeting.known.values()].every(({ figure }) => figure?.avatar.name === 'nora')"
            )
        found["worn"] = [await tab.ask(WORN) for tab in (ada, ben)]
        found["dots"] = await ben.ask(
            "[...document.querySelectorAll('#people .dot')].map((dot) => dot.style.background)"
        )
        await ada.ask(SAY % json.dumps("<img src=x onerror=alert(1)> **hello**"))
        await ben.until("document.querySelector('#lines li')")
        found["line"] = await ben.ask("document.querySelector('#lines li').textContent")
        found["images"] = await ben.ask("document.querySelectorAll('#lines img').length")
        await ada.ask("document.querySelector('#leave').click()")
        await ben.until("meeting.known.size === 1")
        found["complaints"] = ada.complaints + ben.complaints
        found["asked"] = {
            address.split("/")[2] for tab in (ada, ben) for address in tab.asked if "://" in address
        }
        found["own"] = place.address.split("/")[2]
        print({key: value for key, value in found.items() if key not in ("asked", "own")})
        return found


async def restarted(folder: Path) -> dict[str, object]:
    """A server that goes away under two people who are talking, for so long that pages try less often."""
    write_bursts(folder / "speech.wav")
    keys = new_keys()
    camera = f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}"
    async with chromium(*AWAKE, camera) as browser, AsyncExitStack() as stack:
        tabs = []
        async with open_room(keys=keys) as place:
            port = int(place.address.rsplit(":", 1)[1])
            for name in ("Ada", "Ben"):
                link = f"{place.address}/room/meeting#{keys.key('meeting', 'guest')}"
                tabs.append(await stack.enter_async_context(browser.open(link)))
                await come_in(tabs[-1], name)
            ada, ben = tabs
            await ada.ask("void Object.assign(meeting.presence.walk, { x: 2.5, z: -1.5, heading: 1 })")
            for tab in tabs:
                await tab.until(CONNECTED, 30)
                await tab.ask(
                    "void (globalThis.before = [meeting.own, ...meeting.voice.lines.peers.values()])"
                )
            await ben.until(f"{other('Ada')}.newest?.floor_m[0] === 2.5")
        for tab in tabs:
            await tab.until("document.querySelector('#state').textContent.includes('broke')")
        await asyncio.sleep(4.8)
        async with open_room(keys=keys, port=port):
            start = time.monotonic()
            for tab in tabs:
                await tab.until("meeting.own !== before[0] && meeting.known.size === 2")
            await ben.until(f"{other('Ada')}.newest?.floor_m[1] === -1.5")
            return {
                "seconds": time.monotonic() - start,
                "place": await ben.ask(f"{other('Ada')}.newest.floor_m"),
                "same voices": [
                    await tab.ask("before[1] === [...meeting.voice.lines.peers.values()][0]") for tab in tabs
                ],
                "connected": [await tab.ask(CONNECTED) for tab in tabs],
            }


def test_a_server_that_starts_again_has_its_people_back_and_voices_never_stop(tmp_path):
    found = asyncio.run(restarted(tmp_path))
    print(found)
    assert found["seconds"] < 3
    assert found["place"] == [2.5, -1.5]
    assert found["same voices"] == [True, True]
    assert found["connected"] == [True, True]


async def pauses(guest: Guest, seconds: float) -> list[float]:
    """Seconds between the ticks that somebody is sent meanwhile."""
    came_s, ticks, end = [time.monotonic()], guest.ticks, time.monotonic() + seconds
    while time.monotonic() < end:
        await asyncio.sleep(0.005)
        if guest.ticks > ticks:
            came_s.append(time.monotonic())
            ticks = guest.ticks
    return list(np.diff([*came_s, end]))


async def killed() -> dict[str, object]:
    """What is noticed of a browser that is killed: by another page, and by somebody who counts ticks."""
    async with open_room() as place, chromium(*AWAKE) as hers, chromium(*AWAKE) as his:
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        async with his.open(link) as ben, AsyncExitStack() as stack:
            ada = await stack.enter_async_context(hers.open(link))
            await come_in(ada, "Ada")
            await come_in(ben, "Ben")
            await ben.until(f"{other('Ada')}?.person.present && {other('Ada')}.newest")
            await ben.ask("void (globalThis.before = meeting.own)")
            cem = await place.guest(name="Cem")
            counting = asyncio.create_task(pauses(cem, 5.0))
            await asyncio.sleep(1.0)
            hers.kill()
            start = time.monotonic()
            await ben.until(f"!{other('Ada')}?.person.present")
            return {
                "away": time.monotonic() - start,
                "pauses": await counting,
                "same": await ben.ask("before === meeting.own && meeting.known.size === 3"),
                "complaints": ben.complaints,
            }


def test_of_a_killed_browser_the_others_see_that_its_person_is_away():
    found = asyncio.run(killed())
    print(f"away after {found['away']:.2f} s, longest pause {max(found['pauses']):.2f} s")
    assert found["away"] < 3
    assert len(found["pauses"]) > 60, "ticks of Ben's page come on"
    assert max(found["pauses"]) < 1
    assert found["same"]
    assert found["complaints"] == []


async def moved_by_track(folder: Path) -> tuple[dict[str, float], np.ndarray, list[str]]:
    """What a page's own picture stands at while `track` moves its person's face, the weights, and complaints."""
    weights = np.array([((7 * index) % 53) / 52 for index in range(52)])
    sample = Sample(time_s=1.0, weights=weights, gaze=np.zeros(4), head=np.array([0, 0, 0.5, 0.1, 0.0, 0.0]))
    async with meet(folder, "Ada") as (place, (ada,)):
        await ada.until(f"{other('Ada')}.figure?.avatar.name === 'nora'")
        await ada.ask(DRAWN)
        secret = await ada.ask("sessionStorage.getItem('secret of meeting')")
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}.{secret}"
        told: list[str] = []
        sink = await asyncio.to_thread(open_sink, parse_target(f"room:{link}"), told.append)
        end = time.monotonic() + 3
        while time.monotonic() < end:
            sink.send(replace(sample, time_s=time.monotonic()))
            await asyncio.sleep(1 / 30)
        stands = await ada.ask(f"{other('Ada')}.figure.avatar.influences()")
        assert "face by a program" in await ada.ask("document.querySelector('#people').textContent")
        await asyncio.to_thread(sink.close)
        await ada.until("!document.querySelector('#people').textContent.includes('program')")
        return stands, weights, told + ada.complaints


def test_track_moves_the_face_of_a_page(tmp_path):
    stands, weights, complaints = asyncio.run(moved_by_track(tmp_path))
    assert len(stands) >= 51
    assert max(abs(stands[name] - weights[BLENDSHAPES.index(name)]) for name in stands) <= 0.02
    assert complaints == []


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    return asyncio.run(observe(tmp_path_factory.mktemp("meeting")))


def test_weights_arrive(found):
    assert found["shapes"] >= 51
    assert found["weights"] <= 0.02


def test_two_in_one_avatar_are_told_apart_and_all_see_them_alike(found):
    assert found["worn"][0] == found["worn"][1]
    (ada, hers), (ben, his) = found["worn"][0]
    assert (ada, ben) == ("Ada", "Ben")
    assert hers != his
    assert len(set(found["dots"])) == 2, "beside the names as well"


def test_a_voice_comes_from_its_side(found):
    assert found["left"] > 1.5, "energy at the left ear over that at the right one"
    assert found["right"] > 1.5


def test_the_speaking_sign_comes_and_goes_in_time(found):
    assert len(found["on"]) >= 2
    assert statistics.median(found["on"]) <= 200, found["on"]
    assert statistics.median(found["off"]) <= 700, found["off"]


def test_chat_is_text(found):
    assert found["line"] == "Ada <img src=x onerror=alert(1)> **hello**"
    assert found["images"] == 0


def test_pages_ask_nobody_else_and_complain_of_nothing(found):
    assert found["asked"] == {found["own"]}
    assert found["complaints"] == []

"""The page in a real browser: what is published arrives on the avatar, what is clicked arrives at the session."""

import asyncio
import json
import time
from collections.abc import Iterator
from contextlib import asynccontextmanager
from functools import partial
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.runtime.features.reference_shape import load_reference_shape
from regress.runtime.sample import Sample
from tests.browser import Browser, Tab, chromium, needs_chromium
from tests.track.page.heads import HALVED, head, vrm0, vrm1
from track.messages import Command, Moment, Step
from track.page import Page

ROOT = Path(__file__).resolve().parents[3]
AXE = ROOT / "web/node_modules/axe-core/axe.min.js"
CORPUS = sorted((ROOT / "tests/hostile/corpus").glob("avatar-*/*"))
STEPS = ("neutral", "jaw_open", "smile")

pytestmark = [needs_chromium, pytest.mark.slow]


class Stand:
    """A page's server and what it was asked for, a tab that looks at it, and words for both."""

    def __init__(self, page: Page, asked: list[Command], tab: Tab) -> None:
        self.page, self.asked, self.tab = page, asked, tab
        self._read = 0

    async def show(self, weights: np.ndarray, **changes: object) -> dict[str, float]:
        """Publish until the avatar stands at these weights, and give what it stands at."""
        moment = moment_of(weights, **changes)
        end = time.monotonic() + 10
        while True:
            self.page.publish(moment)
            await asyncio.sleep(0.05)
            stands = await self.tab.ask("track.stage.avatar?.influences()") or {}
            if stands and max(abs(stands[name] - told(weights, name)) for name in stands) <= 0.001:
                return stands
            assert time.monotonic() < end, (stands, self.tab.complaints)

    async def publish_until(self, script: str, **changes: object) -> None:
        """Publish a face at rest until an expression in the page is true."""
        end = time.monotonic() + 10
        while not await self.tab.ask(f"Boolean({script})"):
            self.page.publish(moment_of(np.zeros(52), **changes))
            await asyncio.sleep(0.05)
            assert time.monotonic() < end, f"{script} stays false; complaints: {self.tab.complaints}"

    async def drop(self, path: Path) -> None:
        """Drop a file onto the avatar, as a hand does."""
        data = {"items": [], "files": [str(path)], "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            await self.tab.call("Input.dispatchDragEvent", type=kind, x=200, y=200, data=data)

    async def asks(self, count: int) -> list[Command]:
        """The next so many commands to the session, once they are there."""
        end = time.monotonic() + 5
        while len(self.asked) < self._read + count:
            await asyncio.sleep(0.01)
            assert time.monotonic() < end, self.asked[self._read :]
        self._read += count
        return self.asked[self._read - count : self._read]


def told(weights: np.ndarray, name: str) -> float:
    """A weight as an avatar applies it: 0 where nothing is known."""
    return float(np.nan_to_num(weights[BLENDSHAPES.index(name)]))


def moment_of(weights: np.ndarray, *, pictures: bool = True, **changes: object) -> Moment:
    shape = load_reference_shape().points[:, :2] * [1, -1]
    points = (shape - shape.mean(0)) / np.ptp(shape[:, 0]) * 60 + [80, 60]
    sample = {"time_s": 0.0, "weights": weights}
    sample |= {key: changes.pop(key) for key in ("gaze", "head") if key in changes}
    shown = {"camera": np.full((120, 160, 3), 128, np.uint8)} if pictures else {}
    return Moment(sample=Sample(**sample), pictures=shown, points={"camera": points}, **changes)


@pytest.fixture(scope="module")
def loop() -> Iterator[asyncio.AbstractEventLoop]:
    loop = asyncio.new_event_loop()
    yield loop
    loop.close()


@pytest.fixture(scope="module")
def browser(loop) -> Iterator[Browser]:
    context = chromium()
    yield loop.run_until_complete(context.__aenter__())
    loop.run_until_complete(context.__aexit__(None, None, None))


@pytest.fixture(scope="module")
def egg(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("avatars") / "egg.glb"
    path.write_bytes(head())
    return path


@asynccontextmanager
async def standing(browser: Browser, avatar: Path, *, quiet: bool = True):
    """A page with an avatar on its stage, which speaks to nobody else; with `quiet` also without a complaint."""
    asked: list[Command] = []
    with Page(asked.append, steps=STEPS, avatar=avatar) as page:
        async with browser.open(page.url) as tab:
            await tab.look(width=400, height=300)  # drawn in software, sixty times a second
            await tab.until("globalThis.track?.stage.avatar && document.querySelector('#step').length")
            yield Stand(page, asked, tab)
            assert {urlsplit(address).hostname for address in tab.asked if ":" in address} <= {
                "127.0.0.1",
                None,
            }
            if quiet:
                assert tab.complaints == []


@pytest.fixture
def stand(loop, browser, egg) -> Iterator[Stand]:
    context = standing(browser, egg)
    yield loop.run_until_complete(context.__aenter__())
    loop.run_until_complete(context.__aexit__(None, None, None))


def test_what_is_published_arrives_on_avatar_and_bars(loop, stand):
    async def look():
        rng = np.random.default_rng(29)
        for _ in range(5):
            weights = rng.uniform(0, 1, 52)
            weights[BLENDSHAPES.index("tongueOut")] = np.nan
            stands = await stand.show(weights, fps=29.6, latency_ms={"p50": 21.4, "p95": 34.6})
            assert set(stands) == set(BLENDSHAPES)
            bars = await stand.tab.ask(
                "Object.fromEntries([...document.querySelectorAll('.bar')].map((bar) => "
                "[bar.dataset.shape, bar.querySelector('.fill').getBoundingClientRect().width / "
                "bar.querySelector('.meter').getBoundingClientRect().width]))"
            )
            assert set(bars) == set(BLENDSHAPES)
            assert max(abs(bars[name] - told(weights, name)) for name in BLENDSHAPES) < 0.01
        await stand.publish_until(
            "fps.textContent == '30' && delay.textContent == '21 ms' && slowest.textContent == '35 ms'",
            fps=29.6,
            latency_ms={"p50": 21.4, "p95": 34.6},
        )
        assert await stand.tab.ask("connection.textContent") == "Live"

    loop.run_until_complete(look())


TURNS = """(() => {
    const of = (name) => {
        const bone = track.stage.avatar.model.getObjectByName(name);
        bone.updateWorldMatrix(true, false);
        const [a, b, c, , d, e, f, , g, h, i] = bone.matrixWorld.elements;
        return [[a, d, g], [b, e, h], [c, f, i]];
    };
    return { head: of("head"), left: of("leftEye"), right: of("rightEye") };
})()"""
"""Rotations of bones in the world."""


async def turns(stand: Stand, **pose: np.ndarray) -> dict[str, np.ndarray]:
    """By what bones turn, in the world, from rest to a pose."""
    await stand.show(np.full(52, 0.2), gaze=np.zeros(4))
    rest = await stand.tab.ask(TURNS)
    await stand.show(np.full(52, 0.3), **pose)
    turned = await stand.tab.ask(TURNS)
    return {name: np.array(turned[name]) @ np.array(rest[name]).T for name in rest}


def turn(yaw: float, pitch: float, roll: float = 0.0) -> np.ndarray:
    """To the subject's left, upwards, towards the left shoulder: ``Ry(yaw) Rx(-pitch) Rz(-roll)``."""
    (cy, cx, cz), (sy, sx, sz) = ((f(yaw), f(-pitch), f(-roll)) for f in (np.cos, np.sin))
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    return about_y @ about_x @ np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])


GAZE, POSE = np.array([0.2, 0.1, 0.15, 0.05]), np.array([0, 0, 0.6, 0.3, 0.2, 0.2])
perfect_sync = partial(head, spell=lambda name: name[0].upper() + name[1:])
AVATARS = {
    "spelled.glb": partial(head, spell=lambda name: name.replace("Left", "_L").replace("Right", "_R")),
    "leaning.glb": partial(head, leaning=True),
    "perfect-sync.vrm": partial(perfect_sync, vrm=vrm1),
    "zero.vrm": partial(perfect_sync, vrm=vrm0),
}


@pytest.mark.parametrize("name", AVATARS)
def test_a_dropped_avatar_takes_the_place_of_the_last_and_follows(loop, stand, tmp_path, name):
    path = tmp_path / name
    path.write_bytes(AVATARS[name]())
    weights = np.random.default_rng(4).uniform(0, 1, 52)

    async def look():
        await stand.drop(path)
        await stand.tab.until(f"track.stage.avatar.name === {json.dumps(name)}")
        turned = await turns(stand, gaze=GAZE, head=POSE)
        assert set(await stand.show(weights)) == set(BLENDSHAPES)
        # what the graphics card is told, not what an expression believes
        morphs = await stand.tab.ask(
            f"{json.dumps(BLENDSHAPES)}.map((_, shape) => track.stage.avatar.morphs.influence(shape))"
        )
        faces = await stand.tab.ask("track.stage.avatar.model.rotation.y")
        assert await stand.tab.ask("document.getElementById('said').hidden")
        await stand.tab.ask("ours.click()")
        await stand.tab.until("track.stage.avatar.name !== " + json.dumps(name))
        return turned, morphs, faces

    turned, morphs, faces = loop.run_until_complete(look())
    if name.endswith(".vrm"):
        weights[BLENDSHAPES.index(HALVED[0].lower() + HALVED[1:])] /= 2
    np.testing.assert_allclose(morphs, weights, atol=0.001)
    held = turn(*POSE[3:])
    np.testing.assert_allclose(turned["head"], held, atol=1e-4)
    # eyes of a VRM go as far as it says, a ninth here, and together
    eyes = [GAZE.reshape(2, 2).mean(0) / 9] * 2 if name.endswith(".vrm") else GAZE.reshape(2, 2)
    for side, angles in zip(("left", "right"), eyes, strict=True):
        np.testing.assert_allclose(turned[side], held @ turn(*angles), atol=1e-3)
    assert faces == pytest.approx(np.pi if name == "zero.vrm" else 0)  # VRM 0.x faces away


def test_left_is_the_subjects_left_and_up_is_up(loop, stand):
    turned = loop.run_until_complete(turns(stand, gaze=np.zeros(4), head=POSE))
    nose, crown = turned["head"][:, 2], turned["head"][:, 1]
    assert nose[0] > 0.2  # +x is the subject's left
    assert nose[1] > 0.1
    assert crown[0] > 0.1  # to the left shoulder


def test_a_vrm_of_presets_alone_follows_roughly_and_says_so(loop, stand, tmp_path):
    path = tmp_path / "plain.vrm"
    names = {"jawOpen": "Fcl_A", "mouthPucker": "Fcl_U", "eyeBlinkLeft": "Fcl_L", "eyeBlinkRight": "Fcl_R"}

    def presets(nodes, shapes):
        return vrm1(nodes, list(names), custom=False)

    path.write_bytes(head(shapes=list(names), spell=names.get, vrm=presets))
    weights = np.zeros(52)
    weights[BLENDSHAPES.index("jawOpen")] = 0.7

    async def look():
        await stand.drop(path)
        await stand.tab.until("track.stage.avatar.name === 'plain.vrm'")
        sentence = await stand.tab.ask("said.textContent")
        moved = """[...track.stage.avatar.model.getObjectByName('mesh').children,
            track.stage.avatar.model.getObjectByName('mesh')].find((each) => each.morphTargetInfluences)
            .morphTargetInfluences"""
        end = time.monotonic() + 10
        while not (influences := await stand.tab.ask(moved))[0] and time.monotonic() < end:
            stand.page.publish(moment_of(weights))
            await asyncio.sleep(0.03)
        return sentence, influences

    sentence, influences = loop.run_until_complete(look())
    assert sentence == "plain.vrm has no ARKit shapes, so its 4 expressions follow roughly."
    np.testing.assert_allclose(influences, [0.7, 0, 0, 0], atol=1e-6)


def broken(whole: bytes) -> dict[str, bytes]:
    plain = head()
    return {
        "empty.vrm": b"",
        "text.glb": b"This is no avatar, but a letter to my aunt.",
        "cut.vrm": whole[: len(whole) // 2],
        "rest-lost.glb": plain[:200],
        "no-vrm.vrm": plain,
        "json.glb": plain[:20] + b"{" * 50 + plain[70:],
        "packed.glb": plain.replace(
            b'"asset"', b'"extensionsRequired":["KHR_draco_mesh_compression"],"asset"'
        ),
        "old.glb": plain[:4] + b"\x01" + plain[5:],
        "<img src=x onerror=alert(1)>.glb": b"",
    }


def test_a_broken_avatar_is_one_sentence_and_the_last_one_stays(loop, browser, egg, tmp_path):
    cases = broken(head(vrm=vrm1))

    async def look():
        sentences = {}
        async with standing(browser, egg, quiet=False) as stand:
            for name, content in cases.items():
                (tmp_path / name).write_bytes(content)
                await stand.tab.ask("said.textContent = ''")
                await stand.drop(tmp_path / name)
                await stand.tab.until("said.textContent")
                sentences[name] = await stand.tab.ask("said.textContent")
                assert await stand.tab.ask("track.stage.avatar.name") == "The avatar of track"
            assert await stand.tab.ask("document.querySelectorAll('#said *').length") == 0
            await stand.show(np.linspace(0, 1, 52))
            return sentences, stand.tab.complaints

    sentences, complaints = loop.run_until_complete(look())
    for name, sentence in sentences.items():
        assert sentence.startswith(name)
        assert sentence.count("\n") == 0
        assert sentence.endswith(".")
        assert len(sentence) < 300
    assert [each for each in complaints if "Uncaught" in each] == []


def test_damaged_avatars_of_the_corpus_never_end_the_page(loop, browser, egg, tmp_path):
    assert CORPUS

    async def look():
        async with standing(browser, egg, quiet=False) as stand:
            for number, damaged in enumerate(CORPUS):
                path = tmp_path / f"{number}.glb"
                path.write_bytes(damaged.read_bytes() if damaged.is_file() else b"")
                before = await stand.tab.ask("track.stage.avatar.name")
                await stand.tab.ask("said.textContent = ''")
                await stand.drop(path)
                await stand.tab.until(f"said.textContent || track.stage.avatar.name !== {json.dumps(before)}")
            return stand.tab.complaints

    assert [each for each in loop.run_until_complete(look()) if "Uncaught" in each] == []


def test_what_is_clicked_is_asked_for_and_what_holds_is_shown(loop, stand):
    async def click():
        assert (await stand.asks(1))[0] == Command(verb="picture", value=True)
        await stand.publish_until("document.querySelector('#cameras canvas')")
        drawn = """(() => {
            const canvas = document.querySelector('#cameras canvas'), { width, height } = canvas;
            const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, 0, 0);
            const image = copy.getImageData(0, 0, width, height);
            return [width, height, image.data.filter((value, at) => at % 4 === 1 && value > 168).length];
        })()"""  # green of the points, on grey
        width, height, green = await stand.tab.ask(drawn)
        assert (width, height) == (160, 120)
        assert green > 60
        await stand.tab.ask("points.click()")
        await stand.publish_until(f"{drawn}[2] === 0")
        await stand.tab.ask(
            "step.value = 'jaw_open', document.querySelector('#calibrate button').click(), mirror.click(),"
            "recentre.click(), picture.click(), gains.click(), 0"
        )
        await stand.tab.ask(
            "(() => { const slider = document.querySelector('[data-shape=jawOpen] input');"
            "slider.value = 1.5; slider.dispatchEvent(new Event('input')); })()"
        )
        expected = [
            Command(verb="calibrate", value="jaw_open"),
            Command(verb="mirror", value=True),
            Command(verb="recentre"),
            Command(verb="picture", value=False),
            Command(verb="gain", shape="jawOpen", value=1.5),
        ]
        assert await stand.asks(5) == expected
        assert not await stand.tab.ask("document.querySelector('#cameras canvas')")
        await stand.tab.ask("document.getElementById('gains-reset').click()")
        assert await stand.asks(1) == [Command(verb="gain", shape="jawOpen", value=1)]
        # another tab changes things: this one follows
        await stand.publish_until(
            "mirror.ariaPressed === 'false' && document.querySelector('[data-shape=tongueOut] input').value === '2'"
            "&& document.querySelector('[data-shape=tongueOut] .factor').textContent === '×2'",
            settings={"mirror": False, "gains": {"tongueOut": 2.0}},
        )
        await stand.publish_until(
            "person.textContent === 'not calibrated yet'", settings={"calibrated": False}
        )
        known = {"calibrated": True, "profile": "<i>Ada</i>"}
        await stand.publish_until("person.textContent === 'as <i>Ada</i>'", settings=known)
        await stand.tab.ask("record.click()")
        assert await stand.asks(1) == [Command(verb="record", value=True)]

    loop.run_until_complete(click())


def test_calibration_says_what_to_do_and_can_be_cancelled(loop, stand):
    step = Step(name="jaw_open", state="recording", seconds_left=1.4, text="Open <b>wide</b>")

    async def look():
        asking = "document.getElementById('asking')"
        await stand.publish_until(f"!{asking}.hidden", step=step)
        assert await stand.tab.ask(f"{asking}.innerText.split('\\n').filter(Boolean)") == [
            "2",
            "Jaw open · Hold it",
            "Open <b>wide</b>",
            "Cancel",
        ]
        await stand.tab.ask("document.getElementById('asking-cancel').click()")
        assert await stand.asks(2) == [Command(verb="picture", value=True), Command(verb="cancel")]
        await stand.publish_until(f"{asking}.hidden")

    loop.run_until_complete(look())


def test_faults_are_named_while_they_last(loop, stand):
    fault = "The camera <script>alert(1)</script> shows nobody."

    async def look():
        await stand.publish_until("faults.textContent", faults=(fault,))
        assert await stand.tab.ask("[...faults.children].map((each) => each.textContent)") == [fault]
        await stand.publish_until("faults.textContent === ''")

    loop.run_until_complete(look())


def test_a_take_is_played_back_while_live_goes_on(loop, stand):
    async def look():
        await stand.tab.ask("record.click()")
        spoken = np.zeros(52)
        spoken[BLENDSHAPES.index("jawOpen")] = 0.8
        await stand.show(spoken)
        await stand.tab.ask("record.click()")
        await stand.show(np.zeros(52))
        await stand.tab.ask("play.click()")
        await stand.publish_until("Math.abs(track.stage.avatar.influences().jawOpen - 0.8) < 0.001")
        await stand.tab.ask("play.click()")
        await stand.publish_until("track.stage.avatar.influences().jawOpen < 0.001")

    loop.run_until_complete(look())


def test_the_page_comes_back_by_itself(loop, browser, egg):
    async def look():
        async with standing(browser, egg, quiet=False) as stand:
            await stand.publish_until("connection.dataset.state === 'live'")
            await asyncio.to_thread(stand.page.close)
            await stand.tab.until("connection.dataset.state === 'lost'")
            assert (await stand.tab.ask("connection.textContent")).startswith("track has ended")
            asked = []
            with Page(asked.append, port=stand.page.port, steps=STEPS, avatar=egg) as again:
                stand.page = again
                await stand.publish_until("connection.dataset.state === 'live'")
                await stand.show(np.full(52, 0.5))
                await stand.tab.until("connection.textContent === 'Nothing comes from the camera'")

    loop.run_until_complete(look())


@pytest.mark.parametrize(("width", "dark"), [(320, True), (400, False), (1600, True)])
def test_nothing_is_cut_off_and_all_can_be_used_by_everyone(loop, stand, tmp_path, width, dark):
    async def look():
        await stand.tab.look(width=width, height=900, dark=dark, telephone=width < 600)
        await stand.show(np.linspace(0, 1, 52), faults=("The picture is dark: light from the front helps.",))
        await stand.tab.ask("gains.click()")
        assert await stand.tab.ask("document.documentElement.scrollWidth") <= width
        await stand.tab.picture(tmp_path / "page.png", whole=True)
        if AXE.exists():
            await stand.tab.ask(AXE.read_text() + ";0")
            return await stand.tab.ask(
                "axe.run().then(({ violations }) => violations.map((each) => each.id + ' ' + each.nodes[0].html))"
            )

    assert not loop.run_until_complete(look())
    assert (tmp_path / "page.png").stat().st_size > 20_000


def test_the_keyboard_reaches_everything_and_shows_where_it_is(loop, stand):
    async def walk():
        reached, bare = set(), []
        for _ in range(40):
            for kind in ("rawKeyDown", "keyUp"):
                await stand.tab.call(
                    "Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9
                )
            name, outlined = await stand.tab.ask(
                "(() => { const at = document.activeElement; const shown = at.id === 'file' "
                "? document.querySelector('label[for=file]') : at;"
                "return [at.id || at.className || at.tagName, getComputedStyle(shown).outlineStyle !== 'none']; })()"
            )
            reached.add(name)
            bare += [] if outlined or name in ("BODY", "controls") else [name]
        return reached, bare

    reached, bare = loop.run_until_complete(walk())
    wanted = {"step", "first", "mirror", "recentre", "picture", "points", "record", "file", "gains", "skip"}
    assert wanted <= reached
    assert bare == []

"""The avatar on the page in a real browser: it stands as was published, ours or anyone's, and broken ones stay away."""

import asyncio
import json
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from tests.browser import needs_chromium
from tests.track.page.heads import HALVED, head, vrm0, vrm1
from tests.track.page.stand import SOON_S, Stand, moment_of, standing, told

CORPUS = sorted((Path(__file__).resolve().parents[2] / "hostile/corpus").glob("avatar-*/*"))

pytestmark = [needs_chromium, pytest.mark.slow]


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

    path.write_bytes(head(shapes=list(names), spell=names.get, vrm=presets, body=True))
    weights = np.zeros(52)
    weights[BLENDSHAPES.index("jawOpen")] = 0.7

    async def look():
        await stand.drop(path)
        await stand.tab.until("track.stage.avatar.name === 'plain.vrm'")
        sentence = await stand.tab.ask("said.textContent")
        moved = """[...track.stage.avatar.model.getObjectByName('mesh').children,
            track.stage.avatar.model.getObjectByName('mesh')].find((each) => each.morphTargetInfluences)
            .morphTargetInfluences"""
        end = time.monotonic() + SOON_S
        while not (influences := await stand.tab.ask(moved))[0] and time.monotonic() < end:
            stand.page.publish(moment_of(weights))
            await asyncio.sleep(0.03)
        frame = await stand.tab.ask(
            "(({ frame: { centre, height } }) => [centre.y, height])(track.stage.portrait)"
        )
        return sentence, influences, frame

    sentence, influences, (middle, height) = loop.run_until_complete(look())
    # the head is an egg of .24 m about a height of 1.59, and its body is as wide as high
    assert height < 0.4
    assert middle - height / 2 < 1.47
    assert middle + height / 2 > 1.71
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


def test_a_folder_and_what_no_browser_reads_are_one_sentence(loop, stand, tmp_path):
    (tmp_path / "folder.glb").mkdir()
    with (tmp_path / "large.glb").open("wb") as file:
        file.truncate(2**32)  # of a file that takes no room

    async def look(name: str) -> str:
        await stand.tab.ask("said.textContent = ''")
        await stand.drop(tmp_path / name)
        await stand.tab.until("said.textContent")
        return await stand.tab.ask("said.textContent")

    assert loop.run_until_complete(look("folder.glb")).startswith(
        "folder.glb cannot be read, as it is a folder"
    )
    assert loop.run_until_complete(look("large.glb")).startswith("large.glb is larger than 512 MiB")


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

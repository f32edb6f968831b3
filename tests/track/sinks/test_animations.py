"""Recorded animations: a moving avatar and a VRM animation, played by three.js and three-vrm, validated by Khronos."""

import re
import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from facegen.errors import FormatError, OutputError
from facegen.formats import gltf_additions
from facegen.formats.gltf_container import glb_bytes, open_glb
from facegen.formats.vrm_animation import EXTENSION
from facegen.geometry import rotation_from_angles
from regress.runtime.sample import Sample
from tests.facegen.formats.test_gltf_animation import avatar
from tests.facegen.formats.test_gltf_expressions import vrm
from tests.facegen.formats.test_gltf_eyes import compressed
from tests.node_modules import answer_of
from tests.track.sinks.receivers import acted, lost
from tests.track.sinks.test_axes import matrix
from track.sinks import animations
from track.sinks.targets import open_sink, parse_target

FPS = 25


def take(count: int = 6) -> list[Sample]:
    """Faces, of which the third is lost and the fourth comes out of order."""
    samples = [acted(number, time_s=100 + number / FPS) for number in range(count)]
    samples[2] = lost(time_s=100 + 2 / FPS)
    samples[3] = replace(samples[3], time_s=100 + 0.5 / FPS)
    return samples


KEPT = [0, 1, 4, 5]


def recorded(target: str, samples: list[Sample]) -> list[str]:
    """What was told."""
    told: list[str] = []
    sink = open_sink(parse_target(target), told.append)
    for sample in samples:
        sink.send(sample)
    sink.close()
    return told


def test_an_avatar_whose_eyes_are_compressed_is_told(tmp_path: Path):
    worn = compressed(tmp_path / "worn.glb")
    told = recorded(f"gltf:{tmp_path / 'b.glb'},avatar={worn}", take())
    assert any(f"{worn} is compressed, which hides" in sentence for sentence in told)


def headed(path: Path) -> Path:
    """An avatar of two meshes, with a bone called Head."""
    document, chunks = open_glb(avatar(path))
    document["nodes"].append({"name": "Head"})
    document["scenes"][0]["nodes"].append(len(document["nodes"]) - 1)
    path.write_bytes(glb_bytes(document, chunks[:1], path))
    return path


PLAYED = """
import { readFileSync } from "node:fs";
globalThis.self = globalThis;
const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");
const { AnimationMixer } = await import("three");
const content = readFileSync(process.argv[1]);
const times = JSON.parse(process.argv[2]);
const buffer = content.buffer.slice(content.byteOffset, content.byteOffset + content.length);
const gltf = await new GLTFLoader().parseAsync(buffer, "");
const mixer = new AnimationMixer(gltf.scene);
mixer.clipAction(gltf.animations.at(-1)).play();
const nodes = [];
gltf.scene.traverse((node) => nodes.push(node));
console.log(JSON.stringify(times.map((time) => {
  mixer.setTime(time);
  return Object.fromEntries(nodes.map((node) => [
    node.name,
    {
      weights: [...(node.morphTargetInfluences ?? [])],
      turn: node.quaternion.toArray(),
      place: node.position.toArray(),
    },
  ]));
})));
"""


def test_three_plays_the_avatar_as_it_was_recorded(tmp_path: Path):
    samples = take()
    told = recorded(f"gltf:{tmp_path / 'b.glb'},avatar={headed(tmp_path / 'a.glb')}", samples)
    assert len(told) == 1
    assert "no morph target for" in told[0]
    times = [samples[row].time_s - 100 + 1e-9 for row in KEPT]
    frames = answer_of(PLAYED, tmp_path / "b.glb", times, packages=("three",))
    jaw = [frame["n1"]["weights"][0] for frame in frames]
    np.testing.assert_allclose(
        jaw, [samples[row].weights[BLENDSHAPES.index("jawOpen")] for row in KEPT], atol=1e-6
    )
    for frame, row in zip(frames, KEPT, strict=True):
        turned = rotation_from_angles(*samples[row].head[3:])
        np.testing.assert_allclose(matrix(frame["Head"]["turn"]), turned, atol=1e-5)


def test_a_vrm_moves_by_its_expressions(tmp_path: Path):
    target = f"gltf:{tmp_path / 'b.glb'},avatar={vrm(tmp_path / 'a.vrm', 'VRM 1.0')},names=vrm1"
    samples = take()
    recorded(target, samples)
    frames = answer_of(PLAYED, tmp_path / "b.glb", [1e-9], packages=("three",))
    jaw = samples[0].weights[BLENDSHAPES.index("jawOpen")]
    assert frames[0]["n0"]["weights"][0] == pytest.approx(0.75 * jaw, abs=1e-6)


def test_three_plays_expressions_head_and_gaze_of_a_vrm_animation(tmp_path: Path):
    samples = take()
    assert recorded(f"vrma:{tmp_path / 'b.vrma'}", samples) == []
    times = [samples[row].time_s - 100 + 1e-9 for row in KEPT]
    frames = answer_of(PLAYED, tmp_path / "b.vrma", times, packages=("three",))
    for frame, row in zip(frames, KEPT, strict=True):
        weights = dict(zip(BLENDSHAPES, samples[row].weights, strict=True))
        for name, shape in (("aa", "jawOpen"), ("blinkLeft", "eyeBlinkLeft"), ("MouthFunnel", "mouthFunnel")):
            np.testing.assert_allclose(frame[name]["place"], [weights[shape], 0, 0], atol=1e-6)
        turned = rotation_from_angles(*samples[row].head[3:])
        np.testing.assert_allclose(matrix(frame["head"]["turn"]), turned, atol=1e-5)
        yaw, pitch = samples[row].gaze.reshape(2, 2).mean(axis=0)
        np.testing.assert_allclose(
            matrix(frame["lookAt"]["turn"]), rotation_from_angles(yaw, pitch, 0), atol=1e-5
        )
    for name, side in (("left", 1), ("right", -1)):  # VRM faces +z, its left is +x
        places = [frame["place"][0] for bone, frame in frames[-1].items() if bone.startswith(name)]
        assert max(side * place for place in places) > 0.1
        assert min(side * place for place in places) >= 0
    look = open_glb(tmp_path / "b.vrma")[0]["extensions"][EXTENSION]["lookAt"]
    assert set(look) == {"node", "offsetFromHeadBone"}


THREE_VRM_ANIMATION = """
import { readFileSync } from "node:fs";
globalThis.self = globalThis;
console.warn = (text) => { throw new Error(text); };
const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");
const { VRMAnimationLoaderPlugin } = await import("@pixiv/three-vrm-animation");
const content = readFileSync(process.argv[1]);
const buffer = content.buffer.slice(content.byteOffset, content.byteOffset + content.length);
const loader = new GLTFLoader();
loader.register((parser) => new VRMAnimationLoaderPlugin(parser));
const [made] = (await loader.parseAsync(buffer, "")).userData.vrmAnimations;
const values = (tracks) => Object.fromEntries([...tracks].map(([name, track]) => [name, [...track.values]]));
console.log(JSON.stringify({
  duration: made.duration,
  preset: values(made.expressionTracks.preset),
  custom: values(made.expressionTracks.custom),
  bones: values(made.humanoidTracks.rotation),
  moved: [...made.humanoidTracks.translation.keys()],
  look: [...made.lookAtTrack.values],
}));
"""


def test_three_vrm_reads_the_animation(tmp_path: Path):
    samples = take()
    recorded(f"vrma:{tmp_path / 'b.vrma'}", samples)
    made = answer_of(
        THREE_VRM_ANIMATION, tmp_path / "b.vrma", packages=("three", "@pixiv/three-vrm-animation")
    )
    assert made["duration"] == pytest.approx(5 / FPS, abs=1e-6)
    assert len(made["custom"]) == 52
    assert len(made["preset"]) == 14  # without the four of looking, which the gaze has
    assert (list(made["bones"]), made["moved"]) == (["head"], [])
    weights = np.array([samples[row].weights for row in KEPT])
    np.testing.assert_allclose(
        made["custom"]["TongueOut"], weights[:, BLENDSHAPES.index("tongueOut")], atol=1e-6
    )
    np.testing.assert_allclose(made["preset"]["oh"], weights[:, BLENDSHAPES.index("mouthFunnel")], atol=1e-6)
    for turn, row in zip(np.reshape(made["bones"]["head"], (-1, 4)), KEPT, strict=True):
        np.testing.assert_allclose(matrix(turn), rotation_from_angles(*samples[row].head[3:]), atol=1e-5)
    assert len(made["look"]) == 4 * len(KEPT)


VALIDATED = """
import { readFileSync } from "node:fs";
import validator from "gltf-validator";
const report = await validator.validateBytes(new Uint8Array(readFileSync(process.argv[1])));
console.log(JSON.stringify(report.issues.messages));
"""


@pytest.mark.parametrize("name", ["gltf:b.glb", "vrma:b.vrma"])
def test_khronos_validator_complains_of_nothing(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    assert recorded(name, take()) == []  # our own avatar has every shape and a head
    issues = answer_of(VALIDATED, tmp_path / name.split(":")[1], packages=("gltf-validator",))
    # it does not know VRM's extension, and so not what nodes without meshes are for
    known = {"UNSUPPORTED_EXTENSION", "NODE_EMPTY"} if name.startswith("vrma") else set()
    assert [issue for issue in issues if issue["code"] not in known] == []


@pytest.mark.parametrize(
    ("names", "presets", "customs"), [("both", 14, 52), ("vrm1", 14, 0), ("perfect-sync", 0, 52)]
)
def test_expressions_by_name(names: str, presets: int, customs: int, tmp_path: Path):
    recorded(f"vrma:{tmp_path / 'b.vrma'},names={names}", take())
    document, _ = open_glb(tmp_path / "b.vrma")
    found = document["extensions"][EXTENSION]["expressions"]
    assert (len(found.get("preset", {})), len(found.get("custom", {}))) == (presets, customs)


@pytest.mark.parametrize("ending", ["glb", "vrma"])
def test_a_head_and_a_gaze_that_come_and_go(ending: str, tmp_path: Path):
    samples = [replace(sample, head=None, gaze=None) for sample in take()[:2]] + take()[4:]
    name = {"glb": "gltf", "vrma": "vrma"}[ending]
    assert recorded(f"{name}:{tmp_path / f'b.{ending}'}", samples) == []
    assert recorded(f"{name}:{tmp_path / f'c.{ending}'}", samples[:2]) == []
    document, _ = open_glb(tmp_path / "c.vrma" if ending == "vrma" else tmp_path / "c.glb")
    assert "lookAt" not in document.get("extensions", {}).get(EXTENSION, {})


@pytest.mark.parametrize("name", ["gltf:b.glb", "vrma:b.vrma"])
def test_it_appears_whole_or_not_at_all(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    told = recorded(name, [lost()])
    assert told == [f"{parse_target(name).title}: no face was recorded, so there is no file"]
    assert list(tmp_path.iterdir()) == []
    sink = open_sink(parse_target(name), pytest.fail)
    sink.send(acted())
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == []
    sink.close()
    assert [path.name for path in tmp_path.iterdir()] == [name.split(":")[1]]
    with pytest.raises(OutputError, match="there is no folder none; make it"):
        open_sink(parse_target(name.replace(":", ":none/")), pytest.fail)


@pytest.mark.parametrize(("given", "said"), [("none.glb", "does not exist"), ("other.glb", "a retargeting")])
def test_an_avatar_that_cannot_be_moved_is_said_before_anything_is_recorded(given, said, tmp_path: Path):
    avatar(tmp_path / "other.glb", names=(["x"],))
    with pytest.raises(FormatError, match=said):
        open_sink(parse_target(f"gltf:{tmp_path / 'b.glb'},avatar={tmp_path / given}"), pytest.fail)
    assert [path.name for path in tmp_path.iterdir()] == ["other.glb"]


def test_a_take_outlives_its_avatar(tmp_path: Path):
    """It was there at the beginning, and may be exported anew in the meantime."""
    worn = avatar(tmp_path / "me.glb")
    sink = open_sink(parse_target(f"gltf:{tmp_path / 'b.glb'},avatar={worn}"), lambda said: None)
    for sample in take():
        sink.send(sample)
    worn.write_bytes(worn.read_bytes()[:100])
    with pytest.raises(FormatError, match=r"the recorded weights are in .*b-weights\.csv"):
        sink.close()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["b-weights.csv", "me.glb"]
    table = np.genfromtxt(tmp_path / "b-weights.csv", delimiter=",", names=True)
    sent = np.array([sample.weights for sample in take()])[
        [0, 1, 4, 5]
    ]  # with a face, and at times that rise
    np.testing.assert_allclose([table[name] for name in BLENDSHAPES], sent.T, atol=1e-5)

    heads = np.degrees([sample.head[3] for sample in take()])[[0, 1, 4, 5]]
    np.testing.assert_allclose(table["head_yaw_deg"], heads, atol=1e-5)
    gazes = np.degrees([sample.gaze[1] for sample in take()])[[0, 1, 4, 5]]
    np.testing.assert_allclose(table["left_eye_pitch_deg"], gazes, atol=1e-5)


@pytest.mark.parametrize("stops", [1, 2])
def test_ctrl_c_while_an_animation_is_made_loses_no_take(
    stops: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """The first one in the middle of it, the second while the take is rescued."""

    def stopped(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    told: list[str] = []
    sink = open_sink(parse_target(f"vrma:{tmp_path / 'b.vrma'}"), told.append)
    samples = [acted(number, time_s=number / FPS) for number in range(1200)]
    for sample in samples:
        sink.send(sample)
    monkeypatch.setattr(animations, "vrm_animation", stopped)
    if stops == 2:
        monkeypatch.setattr(animations, "write_whole", stopped)
    with pytest.raises(KeyboardInterrupt):
        sink.close()
    (left,) = tmp_path.iterdir()
    assert told == [
        f"writing vrma to {tmp_path / 'b.vrma'}",
        f"vrma to {tmp_path / 'b.vrma'} is not made; the recorded weights are in {left}",
    ]
    assert left.name == {1: "b-weights.csv", 2: "b-weights.f64"}[stops]
    if stops == 1:
        assert len(left.read_text().splitlines()) == 1201
        return
    numbers = np.fromfile(left, "<f8").reshape(-1, 63)
    np.testing.assert_array_equal(numbers[:, 1:53], [sample.weights for sample in samples])
    np.testing.assert_array_equal(numbers[:, 57:], [sample.head for sample in samples])


@pytest.mark.parametrize("target", ["gltf:b.glb", "vrma:b.vrma", "vrma:b.vrma,names=vrm1"])
def test_a_take_ends_where_its_file_would_get_too_large(
    target: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    most = 400_000 + (animations.OUR_AVATAR.stat().st_size if "gltf" in target else 0)
    monkeypatch.setattr(animations, "MOST_BYTES", most)
    monkeypatch.setattr(gltf_additions, "MOST_BYTES", most)
    told = recorded(target, [acted(time_s=number / FPS) for number in range(1800)])
    assert re.fullmatch(r".* to b\.\w+: [\d,]+ frames are recorded, and no more; the rest goes on", told[0])
    assert most * 0.7 < (tmp_path / target.split(":")[1].split(",")[0]).stat().st_size <= most


def test_a_long_recording_takes_no_more_memory_and_has_an_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(animations, "MOST_FRAMES", 500)
    told: list[str] = []
    sink = open_sink(parse_target(f"vrma:{tmp_path / 'b.vrma'}"), told.append)
    samples = [acted(time_s=number / FPS) for number in range(600)]
    for sample in samples[:50]:
        sink.send(sample)
    tracemalloc.start()
    for sample in samples[50:]:
        sink.send(sample)
    grown, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    sink.close()
    assert grown < 20_000  # 450 frames have 226,800 bytes
    assert len(told) == 1
    assert "500 frames are recorded, and no more" in told[0]
    document, _ = open_glb(tmp_path / "b.vrma")
    assert document["accessors"][0]["count"] == 500

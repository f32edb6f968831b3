"""Expressions of VRM avatars: which morph targets they bind, and that an animation moves these by their weights."""

import contextlib
import copy
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pygltflib import GLTF2

from facegen.conventions import BLENDSHAPES
from facegen.errors import FormatError, InputError
from facegen.formats.gltf_animation import animate_avatar
from facegen.formats.gltf_container import glb_bytes, open_glb
from facegen.formats.gltf_expressions import Bind, Expression, read_expressions
from tests.facegen.formats.test_gltf import VALUES, changed, places_of
from tests.facegen.formats.test_gltf_animation import avatar
from tests.node_modules import answer_of

VRM_1 = {
    "specVersion": "1.0",
    "meta": {
        "name": "test",
        "authors": ["nobody"],
        "licenseUrl": "https://vrm.dev/licenses/1.0/",
    },
    "humanoid": {"humanBones": {}},
    "expressions": {
        "preset": {
            "happy": {
                "morphTargetBinds": [
                    {"node": 0, "index": 4, "weight": 0.5},
                    {"node": 1, "index": 0, "weight": 0.25},
                ]
            },
            "blinkLeft": {"isBinary": True, "morphTargetBinds": [{"node": 0, "index": 1, "weight": 1.0}]},
            "aa": {
                "morphTargetBinds": [
                    {"node": 0, "index": 0, "weight": 0.75},
                    {"node": 1, "index": 0, "weight": 0.5},
                ]
            },
            "surprised": {"morphTargetBinds": []},
        },
        "custom": {
            "BrowDownLeft": {"morphTargetBinds": [{"node": 0, "index": 4, "weight": 1.0}]},
            "wrong": {"morphTargetBinds": [{"node": 0, "index": 99, "weight": 1.0}, {"node": "0"}, 7]},
        },
    },
}
VRM_0 = {
    "blendShapeMaster": {
        "blendShapeGroups": [
            {
                "name": "Joy",
                "presetName": "joy",
                "binds": [{"mesh": 0, "index": 4, "weight": 50}, {"mesh": 1, "index": 0, "weight": 25}],
            },
            {
                "name": "Blink_L",
                "presetName": "blink_l",
                "isBinary": True,
                "binds": [{"mesh": 0, "index": 1, "weight": 100}],
            },
            {
                "name": "A",
                "presetName": "a",
                "binds": [{"mesh": 0, "index": 0, "weight": 75}, {"mesh": 1, "index": 0, "weight": 50}],
            },
            {"name": "Surprised", "presetName": "unknown", "binds": []},
            {
                "name": "BrowDownLeft",
                "presetName": "unknown",
                "binds": [{"mesh": 0, "index": 4, "weight": 100}],
            },
            {"name": "wrong", "presetName": "unknown", "binds": [{"mesh": 9, "index": 0, "weight": 1}, None]},
        ]
    }
}
EXTENSIONS = {"VRM 1.0": {"VRMC_vrm": VRM_1}, "VRM 0.x": {"VRM": VRM_0}}
NAMES = {
    "VRM 1.0": ("happy", "blinkLeft", "aa", "surprised"),
    "VRM 0.x": ("joy", "blink_l", "a", "surprised"),
}


def vrm(path: Path, kind: str) -> Path:
    """An avatar of two meshes with five and one morph targets, and expressions that bind some of them."""
    document, chunks = open_glb(avatar(path))
    document["extensions"] = EXTENSIONS[kind]
    document["extensionsUsed"] = [*document["extensionsUsed"], *EXTENSIONS[kind]]
    path.write_bytes(glb_bytes(document, chunks[:1], path))
    return path


def _values(content: bytes, path: Path) -> dict[int, np.ndarray]:
    """Weights of the last animation by node, a row a keyframe."""
    path.write_bytes(content)
    gltf = GLTF2().load(str(path))
    animation, found = gltf.animations[-1], {}
    for channel in animation.channels:
        accessor = gltf.accessors[animation.samplers[channel.sampler].output]
        view = gltf.bufferViews[accessor.bufferView]
        numbers = np.frombuffer(gltf.binary_blob(), "<f4", accessor.count, view.byteOffset)
        found[channel.target.node] = numbers.reshape(len(WEIGHTS), -1)
    return found


WEIGHTS = np.array([[0.0, 0.0, 0.0, 0.0], [1.0, 0.4, 0.5, 1.0], [0.5, 0.6, 1.0, 0.0]])
TIMES = np.arange(3) / 30


@pytest.mark.parametrize("kind", EXTENSIONS)
def test_what_expressions_bind_is_moved_by_their_weights(kind: str, tmp_path: Path):
    made = animate_avatar(vrm(tmp_path / "a.vrm", kind), NAMES[kind], WEIGHTS, TIMES, title="take")
    values = _values(made.content, tmp_path / "b.glb")
    happy, blink, aa, _ = WEIGHTS.T
    expected = np.zeros((3, 5))
    expected[:, 0], expected[:, 1], expected[:, 4] = 0.75 * aa, blink > 0.5, 0.5 * happy
    np.testing.assert_allclose(values[0], expected, atol=1e-7)
    np.testing.assert_allclose(values[1][:, 0], 0.25 * happy + 0.5 * aa, atol=1e-7)
    assert set(values) == {0, 1}
    assert made.missing == ("surprised",)


@pytest.mark.parametrize("kind", EXTENSIONS)
def test_an_expression_goes_before_a_morph_target_of_its_name(kind: str, tmp_path: Path):
    weights = np.tile(np.linspace(0, 1, 3)[:, None], (1, 52))
    made = animate_avatar(vrm(tmp_path / "a.vrm", kind), BLENDSHAPES, weights, TIMES, title="take")
    values = _values(made.content, tmp_path / "b.glb")
    # jawOpen, eyeBlink_L and eyeblinkright by their names; browDownLeft by its expression, which binds myFang
    np.testing.assert_allclose(values[0][:, [0, 1, 2, 4]], weights[:, :4], atol=1e-7)
    np.testing.assert_array_equal(values[0][:, 3], 0)
    assert "browDownLeft" not in made.missing


def test_what_is_read_of_each_vrm():
    documents = {
        kind: {"extensions": extensions, "nodes": [{"mesh": 0}, {"mesh": 1}]}
        for kind, extensions in EXTENSIONS.items()
    }
    read = {kind: read_expressions(document) for kind, document in documents.items()}
    assert [expression.name for expression in read["VRM 1.0"]] == [
        "happy",
        "blinkLeft",
        "aa",
        "BrowDownLeft",
        "wrong",
    ]
    assert [expression.name for expression in read["VRM 0.x"]] == ["joy", "blink_l", "a", "BrowDownLeft"]
    assert read["VRM 0.x"][1] == Expression(
        name="blink_l", binds=(Bind(node=0, target=1, weight=1.0),), binary=True
    )
    assert [one.binds for one in read["VRM 0.x"]] == [one.binds for one in read["VRM 1.0"]][:4]
    assert read_expressions({"nodes": []}) == []


def test_one_mesh_of_two_nodes_is_moved_in_both():
    document = {"extensions": {"VRM": VRM_0}, "nodes": [{"mesh": 0}, {}, {"mesh": 0}]}
    assert [bind.node for bind in read_expressions(document)[1].binds] == [0, 2]


def test_an_avatar_of_other_expressions_is_refused(tmp_path: Path):
    with pytest.raises(FormatError, match="a retargeting to its own names may help"):
        animate_avatar(vrm(tmp_path / "a.vrm", "VRM 1.0"), ("joy", "a"), WEIGHTS[:, :2], TIMES, title="take")


@given(data=st.data())
@pytest.mark.parametrize("kind", EXTENSIONS)
def test_no_value_of_any_record_is_a_traceback(
    kind: str, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
):
    document = {"extensions": copy.deepcopy(EXTENSIONS[kind]), "nodes": [{"mesh": 0}, {"mesh": 1}]}
    places = [place for place in places_of(document) if place.startswith("extensions")]
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.sampled_from(places))
        with contextlib.suppress(LookupError, TypeError):  # an earlier change took it away
            document = changed(document, place, data.draw(st.sampled_from(VALUES)))
    for expression in read_expressions(document):
        assert all(0 <= bind.weight <= 1 for bind in expression.binds)
    path = tmp_path_factory.mktemp("avatar") / "a.vrm"
    whole, chunks = open_glb(vrm(path, kind))
    whole["extensions"] = document["extensions"]
    with contextlib.suppress(InputError):
        path.write_bytes(glb_bytes(whole, chunks, path))
        assert animate_avatar(path, NAMES[kind], WEIGHTS, TIMES, title="take").content


THREE_VRM = """
import { readFileSync } from "node:fs";
globalThis.self = globalThis;
const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");
const { VRMExpressionLoaderPlugin } = await import("@pixiv/three-vrm");
const { AnimationMixer } = await import("three");
const loader = new GLTFLoader();
loader.register((parser) => new VRMExpressionLoaderPlugin(parser));
const content = readFileSync(process.argv[1]);
const gltf = await loader.parseAsync(content.buffer.slice(content.byteOffset, content.byteOffset + content.length), "");
const meshes = [];
gltf.scene.traverse((node) => node.isMesh && node.morphTargetInfluences && meshes.push(node));
const shown = () => meshes.map((mesh) => [...mesh.morphTargetInfluences]);
const manager = gltf.userData.vrmExpressionManager;
const [names, frames, times] = process.argv.slice(2).map((text) => JSON.parse(text));
const expressed = frames.map((frame) => {
  frame.forEach((weight, index) => manager.setValue(names[index], weight));
  manager.update();
  return shown();
});
manager.expressions.forEach((expression) => manager.setValue(expression.expressionName, 0));
manager.update();
const mixer = new AnimationMixer(gltf.scene);
mixer.clipAction(gltf.animations.at(-1)).play();
const played = times.map((time) => { mixer.setTime(time); return shown(); });
console.log(JSON.stringify({ expressed, played }));
"""


@pytest.mark.parametrize("kind", EXTENSIONS)
def test_three_vrm_shows_the_same_faces_by_expressions_and_by_the_animation(kind: str, tmp_path: Path):
    path = vrm(tmp_path / "a.vrm", kind)
    document, chunks = open_glb(path)
    if kind == "VRM 0.x":
        del document["extensions"]["VRM"]["blendShapeMaster"]["blendShapeGroups"][-1]  # no damage here
    path.write_bytes(glb_bytes(document, chunks, path))
    made = animate_avatar(path, NAMES[kind], WEIGHTS, TIMES, title="take")
    (tmp_path / "b.glb").write_bytes(made.content)
    # three-vrm gives the presets of 0.x the names of 1.0
    names = ["happy", "blinkLeft", "aa", "Surprised"] if kind == "VRM 0.x" else NAMES[kind]
    given = (tmp_path / "b.glb", list(names), WEIGHTS.tolist(), (TIMES + 1e-9).tolist())
    answer = answer_of(THREE_VRM, *given, packages=("three", "@pixiv/three-vrm"))
    for expressed, played in zip(answer["expressed"], answer["played"], strict=True):
        for one, other in zip(expressed, played, strict=True):
            np.testing.assert_allclose(one, other, atol=1e-6)
    assert np.ptp([frame[0] for frame in answer["played"]]) > 0.4

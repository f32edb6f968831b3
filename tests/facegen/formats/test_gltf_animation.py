"""Animations added to an avatar, read again by pygltflib and by Blender."""

import base64
import contextlib
import json
import re
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pygltflib import GLTF2

from facegen.conventions import BLENDSHAPES
from facegen.errors import FormatError, InputError
from facegen.formats.gltf_animation import animate_avatar
from tests.facegen.formats.test_gltf import VALUES, changed, places_of

HEAD = ["jawOpen", "EyeBlink_L", "eyeblinkright", "Brow_Down_Left", "myFang"]
TEETH = ["JAWOPEN"]


def avatar(
    path: Path, *, names: tuple[list[str], ...] = (HEAD, TEETH, ["Ear_Up"]), binary: bool = True
) -> Path:
    """A triangle a mesh with its morph targets, a mesh without any, an animation, extensions, and an odd chunk.

    Without ``binary`` its data are in a URI.
    """
    triangle = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4")
    data = triangle.tobytes() * 2 + np.array([0.0, 1.0], "<f4").tobytes() + np.zeros((2, 3), "<f4").tobytes()
    views = [(0, 36), (36, 36), (72, 8), (80, 24)]
    mesh = {"primitives": [{"attributes": {"POSITION": 0}}]}
    meshes = [
        {"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}] * len(each)}]}
        | {"extras": {"targetNames": each}}
        for each in names
    ]
    meshes[0]["weights"] = [0.0] * (len(names[0]) - 1) + [0.7]
    document = {
        "asset": {"version": "2.0", "generator": ""},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(names) + 1))}],
        "nodes": [{"mesh": index, "name": f"n{index}"} for index in range(len(names) + 1)],
        "meshes": [*meshes, mesh],
        "extensionsUsed": ["KHR_materials_unlit"],
        "materials": [{"name": "ö", "extensions": {"KHR_materials_unlit": {}}, "unknownKey": 3}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 3,
                "type": "VEC3",
                "min": [0, 0, 0],
                "max": [1, 1, 0],
            },
            {
                "bufferView": 1,
                "componentType": 5126,
                "count": 3,
                "type": "VEC3",
                "min": [0, 0, 0],
                "max": [1, 1, 0],
            },
            {
                "bufferView": 2,
                "componentType": 5126,
                "count": 2,
                "type": "SCALAR",
                "min": [0.0],
                "max": [1.0],
            },
            {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"},
        ],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": length} for at, length in views],
        "buffers": [{"byteLength": len(data)}],
        "animations": [
            {
                "name": "walk",
                "samplers": [{"input": 2, "output": 3}],
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
            }
        ],
    }
    if not binary:
        document["buffers"][0]["uri"] = (
            "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        )
    text = json.dumps(document).encode()
    chunks = [(b"JSON", text + b" " * (-len(text) % 4))]
    if binary:
        chunks += [(b"BIN\0", data), (b"ODD\0", b"kept")]
    body = b"".join(struct.pack("<I4s", len(content), kind) + content for kind, content in chunks)
    path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body)
    return path


def _document(content: bytes) -> dict:
    return json.loads(content[20 : 20 + struct.unpack_from("<I", content, 12)[0]])


def _scalars(gltf: GLTF2, index: int) -> np.ndarray:
    accessor = gltf.accessors[index]
    view = gltf.bufferViews[accessor.bufferView]
    data = gltf.get_data_from_buffer_uri(gltf.buffers[view.buffer].uri)
    return np.frombuffer(data, "<f4", accessor.count, view.byteOffset)


@pytest.fixture
def weights() -> np.ndarray:
    drawn = np.random.default_rng(0).uniform(size=(6, 52))
    drawn[2] = np.nan
    return drawn


TIMES = np.array([0.0, 0.04, 0.08, 0.12, 0.5, 1.0])


@pytest.mark.filterwarnings("ignore:Ignoring chunk 2")
@pytest.mark.parametrize("binary", [True, False])
def test_a_library_reads_times_and_weights_back(tmp_path: Path, weights: np.ndarray, binary: bool):
    made = animate_avatar(
        avatar(tmp_path / "a.glb", binary=binary), BLENDSHAPES, weights, TIMES, title="take"
    )
    (tmp_path / "b.glb").write_bytes(made.content)
    gltf = GLTF2().load(str(tmp_path / "b.glb"))
    animation = gltf.animations[-1]
    assert animation.name == "take"
    assert [(c.target.node, c.target.path) for c in animation.channels] == [(0, "weights"), (1, "weights")]
    kept = np.isfinite(weights).all(axis=1)
    columns = [BLENDSHAPES.index(n) for n in ("jawOpen", "eyeBlinkLeft", "eyeBlinkRight", "browDownLeft")]
    expected = {
        0: np.column_stack([weights[kept][:, columns], np.full(5, 0.7)]),
        1: weights[kept][:, columns[:1]],
    }
    for channel in animation.channels:
        sampler = animation.samplers[channel.sampler]
        assert sampler.interpolation == "LINEAR"
        np.testing.assert_array_equal(_scalars(gltf, sampler.input), TIMES[kept].astype("<f4"))
        values = _scalars(gltf, sampler.output).reshape(5, -1)
        np.testing.assert_allclose(values, expected[channel.target.node], atol=1e-7)
    assert "tongueOut" in made.missing
    assert len(made.missing) == 48


def test_all_else_stays_as_it_was(tmp_path: Path, weights: np.ndarray):
    before = avatar(tmp_path / "a.glb").read_bytes()
    after = animate_avatar(tmp_path / "a.glb", BLENDSHAPES, weights, TIMES, title="take").content
    old, new = _document(before), _document(after)
    for key in ("animations", "accessors", "bufferViews"):
        assert new[key][: len(old[key])] == old[key]
        new[key] = old[key]
    assert new["buffers"][0]["byteLength"] > old["buffers"][0]["byteLength"]
    new["buffers"] = old["buffers"]
    assert new == old
    assert after.endswith(struct.pack("<I4s", 4, b"ODD\0") + b"kept")
    assert struct.unpack_from("<I", after, 8)[0] == len(after)
    start = 20 + struct.unpack_from("<I", after, 12)[0] + 8
    assert after[start : start + 104] == before[-116:-12]


def test_what_cannot_be_animated_is_refused(tmp_path: Path, weights: np.ndarray):
    good = avatar(tmp_path / "a.glb")
    cases = {
        "does not exist": (tmp_path / "none.glb", weights, TIMES),
        "is not a binary glTF": (Path(__file__), weights, TIMES),
        "has no morph target called eyeBlinkLeft": (
            avatar(tmp_path / "b.glb", names=(["x"],)),
            weights,
            TIMES,
        ),
        "need times": (good, weights, TIMES[::-1]),
        "rows with weights": (good, np.full((6, 52), np.nan), TIMES),
    }
    (tmp_path / "cut.glb").write_bytes(good.read_bytes()[:-60])
    cases["is cut off"] = (tmp_path / "cut.glb", weights, TIMES)
    for said, (path, values, times) in cases.items():
        with pytest.raises(FormatError, match=said):
            animate_avatar(path, BLENDSHAPES, values, times, title="take")


@pytest.mark.parametrize(
    ("count", "said"), [(1, "called A, and"), (2, "called A, B, and"), (3, "of the 3 shapes, and")]
)
def test_however_many_shapes_are_looked_for_the_sentence_is_whole(tmp_path: Path, count: int, said: str):
    path = avatar(tmp_path / "a.glb", names=(["x"],))
    with pytest.raises(FormatError, match=said):
        animate_avatar(path, ("A", "B", "C")[:count], np.zeros((6, count)), TIMES, title="take")


def _rewritten(path: Path, document: dict) -> Path:
    """The avatar with another document and its binary chunk."""
    content = path.read_bytes()
    rest = content[20 + struct.unpack_from("<I", content, 12)[0] :]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + rest
    path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body)
    return path


MISFITS = {
    "a mesh that is not there": ("nodes.0.mesh", 99, "node 0 has mesh 99, and there are 4"),
    "a mesh from the end": ("nodes.0.mesh", -1, "node 0 has mesh -1"),
    "a mesh by name": ("nodes.0.mesh", "face", "node 0 has mesh face"),
    "too few weights": ("meshes.0.weights", [0.5], "no 5 numbers for their weights"),
    "weights of words": ("nodes.0.weights", ["a"] * 5, "no 5 numbers for their weights"),
    "weights without bound": ("nodes.0.weights", [10**400] * 5, "no 5 numbers for their weights"),
    "weights that are none": ("nodes.0.weights", [float("nan")] * 5, "no 5 numbers for their weights"),
    "nodes that are none": ("nodes", [1], "nodes are no list of records"),
    "meshes that are none": ("meshes", 5, "meshes are no list of records"),
    "views that are none": ("bufferViews", {}, None),
    "accessors that are none": ("accessors", [[]], "accessors are no list of records"),
    "animations that are none": ("animations", "walk", "animations are no list of records"),
    "a buffer beyond its chunk": ("buffers.0.byteLength", 10**9, "its buffer claims 1000000000"),
    "a buffer of less than nothing": ("buffers.0.byteLength", -4, "its buffer claims -4"),
    "NaN elsewhere": ("materials.0.unknownKey", float("nan"), "infinite or NaN"),
    "half a character": ("materials.0.name", "\ud800", None),
    "names of numbers": ("meshes.0.extras.targetNames", [1, 2, 3, 4, 5], None),
    "no names": ("meshes.0.extras", [], None),
}


@pytest.mark.parametrize("name", MISFITS)
def test_records_that_do_not_fit_are_named(name: str, tmp_path: Path, weights: np.ndarray):
    place, value, said = MISFITS[name]
    path = avatar(tmp_path / "a.glb")
    _rewritten(path, changed(_document(path.read_bytes()), place, value))
    if said is None:
        assert _document(animate_avatar(path, BLENDSHAPES, weights, TIMES, title="take").content)
        return
    with pytest.raises(FormatError, match=re.escape(said)) as caught:
        animate_avatar(path, BLENDSHAPES, weights, TIMES, title="take")
    assert "a.glb" in str(caught.value)


@given(data=st.data())
def test_no_value_of_any_record_is_a_traceback(data: st.DataObject, tmp_path_factory: pytest.TempPathFactory):
    path = avatar(tmp_path_factory.mktemp("avatar") / "a.glb")
    document = _document(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 2))):
        document = changed(
            document, data.draw(st.sampled_from(places_of(document))), data.draw(st.sampled_from(VALUES))
        )
    _rewritten(path, document)
    still = np.zeros((len(TIMES), len(BLENDSHAPES)))
    with contextlib.suppress(InputError):
        assert _document(animate_avatar(path, BLENDSHAPES, still, TIMES, title="\udcff").content)


def test_many_nodes_of_one_mesh_do_not_make_gigabytes(
    tmp_path: Path, weights: np.ndarray, monkeypatch: pytest.MonkeyPatch
):
    path = avatar(tmp_path / "a.glb")
    document = _document(path.read_bytes())
    _rewritten(path, changed(document, "nodes", [{"mesh": 0}] * 1000))
    monkeypatch.setattr("facegen.formats.gltf_additions.MOST_BYTES", 50_000)
    with pytest.raises(FormatError, match="more than 50,000 bytes; give the take in parts"):
        animate_avatar(path, BLENDSHAPES, weights, TIMES, title="take")


@pytest.mark.blender
def test_blender_plays_it(tmp_path: Path, weights: np.ndarray):
    import bpy

    made = animate_avatar(avatar(tmp_path / "a.glb"), BLENDSHAPES, weights, TIMES, title="take")
    (tmp_path / "b.glb").write_bytes(made.content)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 100  # every keyframe then lies on a whole frame
    bpy.ops.import_scene.gltf(filepath=str(tmp_path / "b.glb"))
    keys = next(data for data in bpy.data.shape_keys if "jawOpen" in data.key_blocks)
    (curve,) = [
        curve
        for action in bpy.data.actions
        if action.name.startswith("take")
        for curve in action.fcurves
        if curve.data_path == 'key_blocks["jawOpen"].value'
    ]
    jaw = weights[:, BLENDSHAPES.index("jawOpen")]
    frames = {round(point.co[0]): point.co[1] for point in curve.keyframe_points}
    assert keys.key_blocks["EyeBlink_L"] is not None
    np.testing.assert_allclose(
        [frames[round(100 * time)] for time in TIMES[[0, 1, 3, 4, 5]]], jaw[[0, 1, 3, 4, 5]], atol=1e-6
    )

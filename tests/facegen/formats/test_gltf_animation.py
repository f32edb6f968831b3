"""Animations added to an avatar, read again by pygltflib and by Blender."""

import base64
import json
import struct
from pathlib import Path

import numpy as np
import pytest
from pygltflib import GLTF2

from facegen.conventions import BLENDSHAPES
from facegen.errors import FormatError
from facegen.formats.gltf_animation import animate_avatar

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

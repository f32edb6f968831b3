"""Heads of avatars: which bone is found, and that it turns in the model as the head did."""

import copy
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pygltflib import GLTF2
from scipy.spatial.transform import Rotation

from facegen.conventions import BLENDSHAPES
from facegen.formats.gltf_animation import animate_avatar
from facegen.formats.gltf_container import glb_bytes, open_glb
from facegen.formats.gltf_head import head_bone
from facegen.geometry import rotation_from_angles
from tests.facegen.formats.test_gltf_animation import avatar

QUARTER = [0.0, 0.0, 0.5**0.5, 0.5**0.5]
NODES = [
    {"name": "Armature", "children": [1]},
    {"name": "mixamorig:Neck", "children": [2], "rotation": QUARTER},
    {"name": "mixamorig:Head", "rotation": [0.5, 0.5, 0.5, 0.5]},
    {"name": "Eye"},
]
DOCUMENTS = {
    "by its name": {"nodes": NODES},
    "VRM 1.0": {
        "nodes": NODES,
        "extensions": {"VRMC_vrm": {"humanoid": {"humanBones": {"head": {"node": 2}}}}},
    },
    "VRM 0.x": {
        "nodes": NODES,
        "extensions": {
            "VRM": {"humanoid": {"humanBones": [{"bone": "neck", "node": 1}, {"bone": "head", "node": 2}]}}
        },
    },
}


def matrix(quaternion: np.ndarray) -> np.ndarray:
    x, y, z, w = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


@pytest.mark.parametrize("kind", DOCUMENTS)
@given(angles=st.lists(st.floats(-1.5, 1.5), min_size=3, max_size=3))
def test_the_model_s_head_turns_as_the_head_does(kind: str, angles: list[float]):
    bone = head_bone(DOCUMENTS[kind])
    assert bone.node == 2
    local = bone.turned(np.array([angles]))[0]
    assert np.linalg.norm(local) == pytest.approx(1)
    model_from_head = np.diag([-1.0, 1.0, -1.0]) if kind == "VRM 0.x" else np.eye(3)
    turn = model_from_head @ rotation_from_angles(*angles) @ model_from_head
    at_rest = matrix(QUARTER) @ matrix([0.5, 0.5, 0.5, 0.5])
    np.testing.assert_allclose(matrix(QUARTER) @ matrix(local), turn @ at_rest, atol=1e-9)


TURNS = st.lists(st.floats(-3, 3), min_size=3, max_size=3).map(lambda angles: rotation_from_angles(*angles))
SIZES = st.sampled_from([0.01, 1.0, 3.0])
SIGNS = st.lists(st.sampled_from([-1.0, 1.0]), min_size=3, max_size=3)


@given(
    turns=st.lists(TURNS, min_size=2, max_size=2),
    size=SIZES,
    signs=SIGNS,
    kind=st.sampled_from(["matrix", "scale"]),
)
def test_nodes_above_may_have_a_matrix_or_mirror(
    turns: list[np.ndarray], size: float, signs: list[float], kind: str
):
    """As where z is up: a head that turns about the model's y, turns about it."""
    whole = np.eye(4)
    whole[:3, :3] = turns[0] @ np.diag(signs) * size
    whole[:3, 3] = 7.0
    above = {"matrix": whole.T.ravel().tolist()}
    if kind == "scale":
        above = {"rotation": quaternion(turns[0]), "scale": [size * sign for sign in signs]}
    nodes = [{"children": [1]} | above, {"children": [2], "rotation": QUARTER}, {"name": "head"}]
    bone = head_bone({"nodes": nodes})
    turned = matrix(bone.turned(np.array([[0.3, 0.2, 0.1]]))[0])
    down = whole[:3, :3] @ matrix(QUARTER)
    np.testing.assert_allclose(down @ turned, rotation_from_angles(0.3, 0.2, 0.1) @ down, atol=1e-9 * size)


def quaternion(rotation: np.ndarray) -> list[float]:
    return Rotation.from_matrix(rotation).as_quat().tolist()


@pytest.mark.parametrize(
    "above",
    [
        {"matrix": [0] * 16},
        {"matrix": [1] * 16},
        {"matrix": [10**400] * 16},
        {"matrix": [float("nan")] * 16},
        {"matrix": "x" * 16},
        {"matrix": [1e-90] * 16},
        {"scale": [0, -1, 1]},
        {"scale": [True] * 3},
        {"rotation": [10**400] * 4},
    ],
)
def test_damage_above_a_head_turns_nothing(above: dict):
    bone = head_bone({"nodes": [{"children": [1]} | above, {"name": "head"}]})
    np.testing.assert_allclose(matrix(bone.turned(np.zeros((1, 3)))[0]), np.eye(3), atol=1e-9)


@pytest.mark.parametrize(
    "nodes",
    [
        [],
        [{"name": "Body"}],
        [{"name": "Head", "matrix": np.eye(4).ravel().tolist()}],
    ],
)
def test_nodes_without_a_head_have_no_head_bone(nodes: list[dict]):
    assert head_bone({"nodes": nodes}) is None


@pytest.mark.parametrize(
    "change",
    [
        {"extensions": {"VRMC_vrm": {"humanoid": {"humanBones": {"head": {"node": 99}}}}}},
        {"extensions": {"VRMC_vrm": {"humanoid": {"humanBones": {"head": {"node": "2"}}}}}},
        {"extensions": {"VRM": {"humanoid": {"humanBones": [3, {"bone": "head"}]}}}},
        {"extensions": []},
        {"nodes": [{"children": [1]}, {"name": "head", "children": [0, "x"], "rotation": [0, 0]}]},
        {"nodes": [{"children": 7}, {"name": 3}, {"name": "head", "rotation": [1e300] * 4}]},
    ],
)
def test_damage_is_no_head_or_one_at_rest(change: dict):
    bone = head_bone(copy.deepcopy(DOCUMENTS["by its name"]) | change)
    assert bone is None or np.isfinite(bone.turned(np.zeros((1, 3)))).all()


def test_an_animation_of_the_head(tmp_path: Path):
    document, chunks = open_glb(avatar(tmp_path / "a.glb"))
    document["nodes"].append({"name": "Head", "rotation": QUARTER})
    path = tmp_path / "head.glb"
    path.write_bytes(glb_bytes(document, chunks, path))
    angles = np.array([[0.0, 0, 0], [0.3, 0.1, -0.2], [np.nan] * 3, [0.5, 0, 0]])
    weights = np.zeros((4, 52))
    weights[3] = np.nan
    times = np.arange(4) / 30
    animated = animate_avatar(path, BLENDSHAPES, weights, times, title="take", head_rad=angles)
    assert not animated.headless
    (tmp_path / "b.glb").write_bytes(animated.content)
    with pytest.warns(UserWarning, match="Ignoring chunk 2"):
        gltf = GLTF2().load(str(tmp_path / "b.glb"))
    channel = gltf.animations[-1].channels[-1]
    assert (channel.target.node, channel.target.path) == (len(document["nodes"]) - 1, "rotation")
    accessor = gltf.accessors[gltf.animations[-1].samplers[channel.sampler].output]
    assert (accessor.type, accessor.count) == ("VEC4", 3)
    view = gltf.bufferViews[accessor.bufferView]
    turns = np.frombuffer(gltf.binary_blob(), "<f4", 12, view.byteOffset).reshape(3, 4)
    np.testing.assert_allclose(turns[[0, 2]], [QUARTER, QUARTER], atol=1e-7)
    np.testing.assert_allclose(
        matrix(turns[1]), rotation_from_angles(0.3, 0.1, -0.2) @ matrix(QUARTER), atol=1e-6
    )


def test_an_avatar_without_a_head_says_so(tmp_path: Path):
    path, still = avatar(tmp_path / "a.glb"), np.zeros((2, 52))
    animated = animate_avatar(path, BLENDSHAPES, still, np.arange(2.0), title="t", head_rad=np.zeros((2, 3)))
    assert animated.headless
    plain = animate_avatar(path, BLENDSHAPES, still, np.arange(2.0), title="t")
    assert (plain.content, plain.headless) == (animated.content, False)

"""Eyes of avatars: their bones turn as the gaze does, unless morph targets turn the same eyeballs."""

from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from facegen.errors import FormatError
from facegen.formats.gltf import COMPRESSIONS, read_gltf
from facegen.formats.gltf_animation import animate_avatar
from facegen.formats.gltf_container import glb_bytes, open_glb
from facegen.formats.gltf_eyes import eye_bones
from facegen.formats.gltf_writer import GltfWriter
from facegen.geometry import rotation_from_angles
from tests.facegen.formats.test_gltf_head import matrix

OURS = Path(__file__).resolve().parents[3] / "track" / "page" / "static" / "head.glb"
NAMES = ("eyeLookOutLeft", "eyeLookOutRight")
LEFT, RIGHT, REST = 0, 1, 2
"""What each of three vertices hangs on: the left eye's bone, the right one's, the head's."""


def avatar(
    path: Path,
    *,
    moved: tuple[int, int] = (REST, REST),
    names: tuple[str, str] = NAMES,
    skinned: bool = True,
    bones: tuple[str, str] = ("LeftEye", "mixamorig:RightEye"),
) -> Path:
    """A triangle on a head and two eyes, and two targets that each move one of its vertices.

    Without ``skinned`` the triangle hangs on the left eye as a whole.
    """
    writer = GltfWriter(copyright="", extras={})
    place = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    attributes = {"POSITION": writer.numbers(place, bounds=True)}
    if skinned:
        joints = np.zeros((3, 4), np.uint8)
        joints[:, 0] = [LEFT, RIGHT, REST]
        shares = np.zeros((3, 4), np.float32)
        shares[:, 0] = 1
        attributes |= {"JOINTS_0": writer.numbers(joints), "WEIGHTS_0": writer.numbers(shares)}
        identity = np.tile(np.eye(4, dtype=np.float32).ravel(), (3, 1))
        writer.add("skins", {"joints": [1, 2, 0], "inverseBindMatrices": writer.numbers(identity)})
    targets = [{"POSITION": writer.sparse(np.array([row]), np.array([[0, 0, 0.1]]), 3)} for row in moved]
    mesh = {
        "primitives": [{"attributes": attributes, "targets": targets}],
        "extras": {"targetNames": list(names)},
    }
    writer.add("meshes", mesh)
    nodes = [
        {"name": "Head", "children": [1, 2]},
        {"name": bones[0]},
        {"name": bones[1]},
        {"name": "Face", "mesh": 0},
    ]
    if skinned:
        nodes[3]["skin"] = 0
    else:
        nodes[1]["children"] = [3]
    for node in nodes:
        writer.add("nodes", node)
    writer.scene([0, 3] if skinned else [0])
    path.write_bytes(writer.content())
    return path


def compressed(path: Path, name: str = COMPRESSIONS[0], key: str = "extensionsUsed") -> Path:
    """An avatar whose targets turn its eyes, as Draco leaves it: joints and weights have no bytes, and read 0."""
    document, chunks = open_glb(avatar(path, moved=(LEFT, RIGHT)))
    document[key] = [name]
    attributes = document["meshes"][0]["primitives"][0]["attributes"]
    for attribute in ("JOINTS_0", "WEIGHTS_0"):
        del document["accessors"][attributes[attribute]]["bufferView"]
    path.write_bytes(glb_bytes(document, chunks, path))
    return path


def _found(path: Path) -> list[int]:
    return [bone.node for bone in eye_bones(open_glb(path)[0], path)]


@pytest.mark.parametrize(
    ("changes", "bones"),
    [
        ({}, [1, 2]),  # targets move what hangs on the head: lids
        ({"moved": (LEFT, REST)}, []),
        ({"moved": (REST, RIGHT)}, []),
        ({"moved": (RIGHT, LEFT)}, [1, 2]),  # neither moves its own eye
        ({"moved": (LEFT, RIGHT), "names": ("jawOpen", "jawLeft")}, [1, 2]),
        ({"moved": (LEFT, REST), "names": ("eyeLookOut_L", "eyeLookOut_R")}, []),
        ({"moved": (LEFT, REST), "names": ("Eye_Look_Out_Left", "x")}, []),
        ({"skinned": False}, []),
        ({"bones": ("eye.L", "Eye_R")}, [1, 2]),
        ({"bones": ("LeftEye", "Ear")}, []),
    ],
)
def test_bones_that_turn(changes: dict, bones: list[int], tmp_path: Path):
    assert _found(avatar(tmp_path / "a.glb", **changes)) == bones


def test_names_may_stand_with_the_first_primitive(tmp_path: Path):
    path = avatar(tmp_path / "a.glb", moved=(LEFT, REST))
    document, chunks = open_glb(path)
    mesh = document["meshes"][0]
    mesh["primitives"][0]["extras"] = mesh.pop("extras")
    path.write_bytes(glb_bytes(document, chunks, path))
    assert _found(path) == []
    assert [list(part.morphs) for part in read_gltf(path)] == [list(NAMES)]


def test_a_vrm_is_read_as_the_binary_file_that_it_is(tmp_path: Path):
    plain = read_gltf(avatar(tmp_path / "a.glb"))
    worn = read_gltf(avatar(tmp_path / "a.vrm"))
    assert [part.positions.tolist() for part in worn] == [part.positions.tolist() for part in plain]


def test_bones_that_vrm_names(tmp_path: Path):
    path = avatar(tmp_path / "a.vrm", bones=("J_Adj_L_FaceEye", "J_Adj_R_FaceEye"))
    assert _found(path) == []
    document, chunks = open_glb(path)
    document["extensions"] = {
        "VRMC_vrm": {"humanoid": {"humanBones": {"leftEye": {"node": 1}, "rightEye": {"node": 2}}}}
    }
    path.write_bytes(glb_bytes(document, chunks, path))
    assert _found(path) == [1, 2]


@pytest.mark.parametrize(
    "damage", [{"joints": [1]}, {"joints": "x"}, {"joints": [0] * 3, "inverseBindMatrices": 99}]
)
def test_what_cannot_be_read_is_left_to_the_targets(damage: dict, tmp_path: Path):
    path = avatar(tmp_path / "a.glb")
    document, chunks = open_glb(path)
    document["skins"] = [damage] if "inverseBindMatrices" not in damage else []
    path.write_bytes(glb_bytes(document, chunks, path))
    assert _found(path) == []


@pytest.mark.parametrize("key", ["extensionsUsed", "extensionsRequired"])
@pytest.mark.parametrize("name", COMPRESSIONS)
def test_eyes_of_compressed_meshes_are_left_to_the_targets(name: str, key: str, tmp_path: Path):
    path = compressed(tmp_path / "a.glb", name, key)
    document, chunks = open_glb(path)
    assert _found(path) == []
    still = {"weights": np.zeros((1, 52)), "time_s": np.zeros(1), "title": "take"}
    assert animate_avatar(path, BLENDSHAPES, **still, gaze_rad=np.zeros((1, 4))).compressed
    assert not animate_avatar(path, BLENDSHAPES, **still).compressed
    names = document["meshes"][0]["extras"]["targetNames"]
    document["meshes"][0]["extras"]["targetNames"] = ["jawOpen", names[1].replace("LookOut", "Squint")]
    path.write_bytes(glb_bytes(document, chunks, path))
    assert _found(path) == [1, 2]  # no target looks anywhere
    assert not animate_avatar(path, BLENDSHAPES, **still, gaze_rad=np.zeros((1, 4))).compressed


def test_a_second_buffer_has_no_part_of_the_binary_chunk(tmp_path: Path):
    """Meshopt's buffers to unpack into have no uri either."""
    path = avatar(tmp_path / "a.glb")
    document, chunks = open_glb(path)
    document["buffers"].append({"byteLength": 9})
    path.write_bytes(glb_bytes(document, chunks, path))
    with pytest.raises(FormatError, match="buffer 1 has no uri, and the binary chunk is buffer 0's"):
        read_gltf(path)


LOOK_BINDS = {
    "VRMC_vrm": lambda name, binds: {
        "expressions": {
            "preset": {name: {"morphTargetBinds": [{"node": 3, "index": 0, "weight": 1}] * binds}}
        }
    },
    "VRM": lambda name, binds: {
        "blendShapeMaster": {
            "blendShapeGroups": [
                {"presetName": name.lower(), "binds": [{"mesh": 0, "index": 0, "weight": 100}] * binds}
            ]
        }
    },
}


@pytest.mark.parametrize(
    ("extension", "looks_by", "bones"),
    [
        ("VRMC_vrm", {"lookAt": {"type": "expression"}}, 0),
        ("VRMC_vrm", {"lookAt": {"type": "bone"}}, 2),
        ("VRMC_vrm", {}, 2),
        ("VRM", {"firstPerson": {"lookAtTypeName": "BlendShape"}}, 0),
        ("VRM", {"firstPerson": {"lookAtTypeName": "Bone"}}, 2),
        ("VRM", {"firstPerson": 3}, 2),
    ],
)
@pytest.mark.parametrize("name", ["lookLeft", "eyeLookOutLeft"])
def test_eyes_that_a_vrm_turns_by_expressions_are_turned_by_them_alone(
    extension: str, looks_by: dict, bones: int, name: str, tmp_path: Path
):
    """As far as they are driven, and move something."""

    def turned(columns: tuple[str, ...], binds: int) -> int:
        path = avatar(tmp_path / "a.vrm", names=("Fcl_EYE_L", "jawOpen"))
        document, chunks = open_glb(path)
        document["extensions"] = {extension: looks_by | LOOK_BINDS[extension](name, binds)}
        path.write_bytes(glb_bytes(document, chunks, path))
        weights, gaze = np.zeros((1, len(columns))), np.zeros((1, 4))
        made = animate_avatar(path, columns, weights, np.zeros(1), title="take", gaze_rad=gaze)
        path.write_bytes(made.content)
        channels = open_glb(path)[0]["animations"][-1]["channels"]
        return sum(channel["target"]["path"] == "rotation" for channel in channels)

    assert turned((name, "jawOpen"), 1) == bones
    assert turned(("jawOpen",), 1) == 2  # nothing drives the expression
    assert turned((name, "jawOpen"), 0) == 2  # it moves nothing


def test_an_animation_turns_head_and_eyes(tmp_path: Path):
    gaze = np.array([[0.0, 0, 0, 0], [0.2, 0.1, 0.3, -0.1], [np.nan] * 4])
    made = animate_avatar(
        OURS,
        BLENDSHAPES,
        np.zeros((3, 52)),
        np.arange(3) / 30,
        title="take",
        head_rad=gaze[:, :3],
        gaze_rad=gaze,
    )
    path = tmp_path / "b.glb"
    path.write_bytes(made.content)
    document, chunks = open_glb(path)
    names, turns = [], []
    for channel in document["animations"][-1]["channels"]:
        if channel["target"]["path"] == "rotation":
            names.append(document["nodes"][channel["target"]["node"]]["name"])
            output = document["animations"][-1]["samplers"][channel["sampler"]]["output"]
            view = document["bufferViews"][document["accessors"][output]["bufferView"]]
            turns.append(np.frombuffer(chunks[0][1], "<f4", 12, view["byteOffset"]).reshape(3, 4))
    assert names == ["Head", "LeftEye", "RightEye"]
    np.testing.assert_allclose(matrix(turns[1][1]), rotation_from_angles(0.2, 0.1, 0), atol=1e-6)
    np.testing.assert_allclose(matrix(turns[2][1]), rotation_from_angles(0.3, -0.1, 0), atol=1e-6)
    np.testing.assert_allclose(turns[2][2], [0, 0, 0, 1])

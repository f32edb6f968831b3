"""A whole person: skeleton, clothes and the same face; what other programs make of it."""

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from facegen.avatars import export_avatar
from facegen.conventions import BLENDSHAPES
from facegen.errors import InputError
from facegen.formats.gltf import GltfPart, read_gltf
from facegen.rigs import Rig
from tests.facegen.avatars.validator import complaints

PERSON = {"sex": "female", "age_years": 40.0, "build": "average", "ancestry": "asian", "clothes": "scrubs"}
MOST_BYTES = 2_000_000
"""Of a person in the room."""

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def body(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("avatar") / "body.glb"
    path.write_bytes(export_avatar("anny", hair="cap", seed=3, person=PERSON))
    return path


def _document(path: Path) -> dict:
    content = path.read_bytes()
    return json.loads(content[20 : 20 + struct.unpack_from("<I", content, 12)[0]])


def _parts(path: Path) -> dict[str, GltfPart]:
    return {part.material: part for part in read_gltf(path)}


def test_stands_on_the_origin(body: Path) -> None:
    everything = np.concatenate([part.positions for part in read_gltf(body)])
    assert abs(everything[:, 1].min()) < 1e-6
    assert 1.4 < everything[:, 1].max() < 2.1
    assert np.abs(everything[:, 0]).max() < 0.9
    assert np.abs(everything[:, 2]).max() < 0.5
    assert body.stat().st_size <= MOST_BYTES


def test_bones_leave_the_rest_as_it_is(body: Path) -> None:
    document = _document(body)
    accessors = [
        document["accessors"][primitive["attributes"]["POSITION"]]
        for mesh in document["meshes"]
        for primitive in mesh["primitives"]
    ]
    for part, accessor in zip(read_gltf(body), accessors, strict=True):
        np.testing.assert_allclose(part.positions.min(axis=0), accessor["min"], atol=2e-6)
        np.testing.assert_allclose(part.positions.max(axis=0), accessor["max"], atol=2e-6)


def test_skeleton_is_mixamos(body: Path) -> None:
    """The bones' names, and their axes: y runs along limbs, and legs bend about x."""
    nodes = _document(body)["nodes"]
    number = {node["name"]: index for index, node in enumerate(nodes)}
    assert sum(name.startswith("mixamorig:") for name in number) == 52
    assert {"LeftEye", "RightEye"} <= set(number)
    # a child lies along its parent's y
    for parent, child in (
        ("LeftArm", "LeftForeArm"),
        ("LeftForeArm", "LeftHand"),
        ("RightUpLeg", "RightLeg"),
    ):
        assert number[f"mixamorig:{child}"] in nodes[number[f"mixamorig:{parent}"]]["children"]
        away = np.array(nodes[number[f"mixamorig:{child}"]]["translation"])
        assert away[1] > 0.97 * np.linalg.norm(away), child


def test_face_is_carried_whole(body: Path) -> None:
    parts = _parts(body)
    for name in ("skin", "mouth", "brows", "lashes"):
        assert list(parts[name].morphs) == list(BLENDSHAPES)
    opened = parts["skin"].morphs["jawOpen"]
    assert 0.02 < np.linalg.norm(opened, axis=1).max() < 0.06


def test_no_skin_comes_through_clothes(body: Path) -> None:
    """Skin of the trunk that would lie under the top is not in the file."""
    parts = _parts(body)
    top = parts["top"].positions
    # from the hips to below the neckline, 23 cm deep on this person
    low, high = np.quantile(top[:, 1], 0.15), top[:, 1].max() - 0.26
    assert high - low > 0.15
    skin = np.concatenate([parts["skin"].positions, parts["body"].positions])
    trunk = skin[(skin[:, 1] > low) & (skin[:, 1] < high) & (np.abs(skin[:, 0]) < 0.12)]
    assert len(trunk) == 0


def test_validator_has_no_complaint(body: Path) -> None:
    assert complaints(body) == []


def test_other_rigs_have_no_body(anny: Rig, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("facegen.avatars.export.load_rig", lambda name: anny)
    with pytest.raises(InputError, match="only anny has bodies"):
        export_avatar("other", hair="short", seed=1, person=PERSON)

"""glTF files: skins, placed nodes, interleaved and quantised accessors, text files with their data inside."""

import base64
import json
from pathlib import Path

import numpy as np
import pytest

from facegen.errors import FormatError
from facegen.formats.gltf import read_gltf

TRIANGLE = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "<f4")
MOVED = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, 0.0]], "<f4")
QUARTER_ABOUT_Z = [0.0, 0.0, 0.5**0.5, 0.5**0.5]


def write(path: Path, chunks: list[bytes], views: list[dict], accessors: list[dict], **rest) -> Path:
    """A .gltf with its buffer as a data URI; ``views`` say how each chunk is laid out beyond its bounds."""
    offsets = np.cumsum([0] + [len(chunk) for chunk in chunks])
    table = {
        "asset": {"version": "2.0"},
        "buffers": [
            {
                "byteLength": int(offsets[-1]),
                "uri": "data:application/octet-stream;base64," + base64.b64encode(b"".join(chunks)).decode(),
            }
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": int(start), "byteLength": len(chunk)} | view
            for start, chunk, view in zip(offsets, chunks, views, strict=False)
        ],
        "accessors": accessors,
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }
    path.write_text(json.dumps(table | rest))
    return path


def accessor(view: int, kind: str, **rest) -> dict:
    return {"bufferView": view, "componentType": 5126, "count": 3, "type": kind} | rest


def mesh(**attributes: int) -> dict:
    primitive = {"attributes": {"POSITION": 0} | attributes, "targets": [{"POSITION": 1}]}
    return {"name": "face", "primitives": [primitive], "extras": {"targetNames": ["jawOpen"]}}


def test_a_skinned_mesh_stands_where_its_joints_put_it(tmp_path: Path) -> None:
    """The joints turn by a quarter about z and lift by 2; the mesh's own node does not count."""
    bind = np.eye(4, dtype="<f4")
    bind[0, 3] = -1.0
    joints, weights = np.zeros((3, 4), "u1"), np.tile(np.array([1, 0, 0, 0], "<f4"), (3, 1))
    path = write(
        tmp_path / "skinned.gltf",
        [a.tobytes() for a in (TRIANGLE, MOVED, joints, weights, bind.T)],
        [{}] * 5,
        [
            *(accessor(0, "VEC3"), accessor(1, "VEC3"), accessor(2, "VEC4", componentType=5121)),
            *(accessor(3, "VEC4"), accessor(4, "MAT4", count=1)),
        ],
        meshes=[mesh(JOINTS_0=2, WEIGHTS_0=3)],
        skins=[{"joints": [1], "inverseBindMatrices": 4}],
        nodes=[
            {"mesh": 0, "skin": 0, "translation": [9.0, 9.0, 9.0], "children": [1]},
            {"rotation": QUARTER_ABOUT_Z, "translation": [-9.0, -7.0, -9.0]},
        ],
    )
    (part,) = read_gltf(path)
    np.testing.assert_allclose(
        part.positions, [[0.0, 1.0, 0.0], [0.0, 2.0, 0.0], [-1.0, 1.0, 0.0]], atol=1e-6
    )
    np.testing.assert_allclose(part.morphs["jawOpen"], MOVED)
    np.testing.assert_array_equal(part.triangles, [[0, 1, 2]])


def test_interleaved_quantised_and_sparse_values_under_a_matrix(tmp_path: Path) -> None:
    both = np.concatenate([TRIANGLE, MOVED], axis=1)
    quantised = np.array([[0, 0], [65535, 0], [0, 65535]], "<u2")
    matrix = np.diag([2.0, 2.0, 2.0, 1.0])
    matrix[3, :3] = (0.0, 0.0, 3.0)  # glTF writes matrices by columns
    sparse = {
        "count": 1,
        "indices": {"bufferView": 2, "componentType": 5121},
        "values": {"bufferView": 3},
    }
    path = write(
        tmp_path / "packed.gltf",
        [both.tobytes(), quantised.tobytes(), np.array([2], "u1").tobytes(), MOVED[1].tobytes()],
        [{"byteStride": 24}, {}, {}, {}],
        [
            accessor(0, "VEC3"),
            accessor(0, "VEC3", byteOffset=12, sparse=sparse),
            accessor(1, "VEC2", componentType=5123, normalized=True),
        ],
        meshes=[mesh(TEXCOORD_0=2)],
        nodes=[{"mesh": 0, "name": "node", "matrix": matrix.ravel().tolist()}],
    )
    (part,) = read_gltf(path)
    np.testing.assert_allclose(part.positions, 2.0 * TRIANGLE + (0.0, 0.0, 3.0))
    np.testing.assert_allclose(part.morphs["jawOpen"], 2.0 * np.array([MOVED[0], MOVED[1], MOVED[1]]))
    np.testing.assert_allclose(part.uv, [[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]])
    assert (part.mesh, part.node, part.material) == ("face", "node", "")


def test_damage_is_refused_in_one_sentence(tmp_path: Path) -> None:
    views, nodes = [{}, {}], [{"mesh": 0}]
    chunks = [TRIANGLE.tobytes(), MOVED.tobytes()]
    short = write(
        tmp_path / "short.gltf",
        chunks,
        views,
        [accessor(0, "VEC3", count=300), accessor(1, "VEC3")],
        meshes=[mesh()],
        nodes=nodes,
    )
    with pytest.raises(FormatError, match=r"short\.gltf cannot be read as a glTF 2\.0 file"):
        read_gltf(short)
    short.write_text(short.read_text()[:200])
    with pytest.raises(FormatError, match="cannot be read"):
        read_gltf(short)
    with pytest.raises(FormatError, match="does not exist"):
        read_gltf(tmp_path / "none.glb")

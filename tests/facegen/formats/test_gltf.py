"""glTF files: skins, placed nodes, interleaved and quantised accessors, text files with their data inside."""

import base64
import copy
import json
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.errors import FormatError, InputError
from facegen.formats import gltf_container
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


@pytest.mark.parametrize(
    ("scale", "order"), [([1, 1, 1], [0, 1, 2]), ([-1, 1, 1], [2, 1, 0]), ([-1, -1, 1], [0, 1, 2])]
)
def test_a_mirrored_node_still_shows_its_outside(
    tmp_path: Path, scale: list[float], order: list[int]
) -> None:
    """glTF 2.0, 3.7.4: a negative determinant turns the winding round."""
    path = write(
        tmp_path / "mirrored.gltf",
        [TRIANGLE.tobytes(), MOVED.tobytes()],
        [{}] * 2,
        [accessor(0, "VEC3"), accessor(1, "VEC3")],
        meshes=[mesh()],
        nodes=[{"mesh": 0, "scale": scale}],
    )
    (part,) = read_gltf(path)
    np.testing.assert_allclose(part.positions, TRIANGLE * scale)
    np.testing.assert_array_equal(part.triangles, [order])


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
    with pytest.raises(FormatError, match="it is neither GLB nor JSON"):
        read_gltf(short)
    with pytest.raises(FormatError, match="does not exist"):
        read_gltf(tmp_path / "none.glb")


HUGE = 10**400
VALUES = (
    None,
    -1,
    0,
    99,
    10**8,
    10**20,
    HUGE,
    1e308,
    float("nan"),
    float("inf"),
    "",
    "x",
    [],
    [[]],
    {},
    True,
    0.5,
)


def head(path: Path) -> Path:
    """Two nodes with one mesh, skinned and placed by a matrix; the third place has the indices."""
    joints, weights = np.zeros((3, 4), "u1"), np.tile(np.array([1, 0, 0, 0], "<f4"), (3, 1))
    index, bind = np.array([0, 1, 2], "<u2"), np.eye(4, dtype="<f4")
    sparse = {"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 1}}
    primitive = {"attributes": {"POSITION": 0, "JOINTS_0": 3, "WEIGHTS_0": 4}, "indices": 2, "material": 0}
    return write(
        path,
        [array.tobytes() for array in (TRIANGLE, MOVED, index, joints, weights, bind)],
        [{}] * 6,
        [
            *(
                accessor(0, "VEC3"),
                accessor(1, "VEC3", sparse=sparse),
                accessor(2, "SCALAR", componentType=5123),
            ),
            *(accessor(3, "VEC4", componentType=5121), accessor(4, "VEC4"), accessor(5, "MAT4", count=1)),
        ],
        meshes=[mesh() | {"primitives": [mesh()["primitives"][0] | primitive]}],
        materials=[{"name": "skin"}],
        skins=[{"joints": [1], "inverseBindMatrices": 5}],
        scenes=[{"nodes": [0, 2]}],
        nodes=[
            {"mesh": 0, "skin": 0, "children": [1]},
            {"rotation": QUARTER_ABOUT_Z, "translation": [0.0, 1.0, 0.0]},
            {"mesh": 0, "matrix": np.eye(4).ravel().tolist()},
        ],
    )


def changed(document: dict, place: str, value: Any) -> dict:
    """The document with another value at ``nodes.0.mesh``; a copy of it, which a second change may be in."""
    record, keys = document, [int(key) if key.isdigit() else key for key in place.split(".")]
    for key in keys[:-1]:
        record = record[key]
    record[keys[-1]] = copy.deepcopy(value)
    return document


DAMAGE: dict[str, tuple[str, Any, str]] = {
    "a mesh that is not there": ("nodes.0.mesh", 99, "number 99 of its meshes"),
    "a mesh counted from the end": ("nodes.0.mesh", -1, "number -1 of its meshes"),
    "a skin that is not there": ("nodes.0.skin", 7, "number 7 of its skins"),
    "a child that is not there": ("nodes.0.children", [1, 50], "number 50 of its nodes"),
    "a cycle": ("nodes.1.children", [0], "stands in the scene twice"),
    "no scene": ("scene", -1, "number -1 of its scenes"),
    "an accessor from the end": (
        "meshes.0.primitives.0.attributes.POSITION",
        -1,
        "number -1 of its accessors",
    ),
    "a material that is not there": ("meshes.0.primitives.0.material", 3, "number 3 of its materials"),
    "positions of two numbers": ("accessors.0.type", "VEC2", "where VEC3 are needed"),
    "a shape of fewer vertices": ("accessors.1.count", 2, "where 3 VEC3 are needed"),
    "a buffer that is not there": ("bufferViews.0.buffer", -1, "number -1 of its buffers"),
    "a row that is not there": ("accessors.1.count", 1, "where 3 VEC3 are needed"),
    "positions without end": ("accessors.0", accessor(0, "VEC3", count=10**8, bufferView=None), "vertices"),
    "indices without end": (
        "accessors.2",
        accessor(0, "SCALAR", count=10**8 + 1, bufferView=None),
        "numbers",
    ),
    "fewer than none": ("accessors.0", accessor(0, "VEC3", count=-1, bufferView=None), "-1 vertices"),
    "a file beside others": ("buffers.0.uri", "/etc/hostname", "no file below"),
    "a file above": ("buffers.0.uri", "../head.bin", "no file below"),
    "a file above, encoded": ("buffers.0.uri", "%2e%2e/head.bin", "no file below"),
    "a device": ("buffers.0.uri", "/dev/zero", "no file below"),
    "another machine's": ("buffers.0.uri", "https://example.org/a.bin", "no file below"),
    "no base64": ("buffers.0.uri", "data:;base64,A", "no base64"),
    "a matrix too large": ("nodes.2.matrix", [1e308] * 16, "not finite"),
    "a place that is none": ("nodes.1.translation", [float("nan")] * 3, "not finite"),
    "joints for a nation": ("skins.0.joints", [1] * 70_000, "70000 joints"),
    "a huge number": ("nodes.1.translation", [HUGE] * 3, "cannot be read"),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_what_does_not_fit_is_named(name: str, tmp_path: Path):
    place, value, said = DAMAGE[name]
    (tmp_path / "head.bin").write_bytes(bytes(1000))
    (tmp_path / "in").mkdir()
    path = head(tmp_path / "in" / "head.gltf")
    path.write_text(json.dumps(changed(json.loads(path.read_text()), place, value)))
    tracemalloc.start()
    with pytest.raises(FormatError) as caught:
        read_gltf(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert said in str(caught.value)
    assert "head.gltf" in str(caught.value)
    assert peak < 20e6


def test_a_triangle_of_other_vertices_is_refused(tmp_path: Path):
    path = head(tmp_path / "head.gltf")
    document = json.loads(path.read_text())
    path.write_text(json.dumps(changed(document, "accessors.2", accessor(3, "SCALAR", componentType=5120))))
    assert len(read_gltf(path)) == 2  # joints are zeros
    path.write_text(
        json.dumps(changed(document, "accessors.2", accessor(4, "SCALAR", componentType=5120, byteOffset=3)))
    )
    with pytest.raises(FormatError, match="names vertex 63"):  # of the 1 among the weights
        read_gltf(path)


def places_of(document: Any, place: str = "") -> list[str]:
    records = (
        document.items()
        if isinstance(document, dict)
        else enumerate(document)
        if isinstance(document, list)
        else ()
    )
    found = [] if not place or "uri" in place else [place]
    return found + [one for key, value in records for one in places_of(value, f"{place}.{key}".lstrip("."))]


@given(data=st.data())
def test_no_value_of_any_record_is_a_traceback(data: st.DataObject, tmp_path_factory: pytest.TempPathFactory):
    path = head(tmp_path_factory.mktemp("gltf") / "head.gltf")
    document = json.loads(path.read_text())
    for _ in range(data.draw(st.integers(1, 2))):
        place, value = data.draw(st.sampled_from(places_of(document))), data.draw(st.sampled_from(VALUES))
        document = changed(document, place, value)
    path.write_text(json.dumps(document))
    try:
        parts = read_gltf(path)
    except InputError:
        return
    for part in parts:
        assert np.isfinite(part.positions).all()
        assert part.triangles.min(initial=0) >= 0
        assert part.triangles.max(initial=0) < len(part.positions) or not len(part.positions)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"[" * 100_000, "cannot be read"),
        (b'{"asset": {"version": "2.0"}, "nodes": [' + b"{}," * 300_000 + b"{}]}", r"300,00\d records"),
        (b'{"nodes": [' + b"0," * 6_000_000 + b"0]}", "6,000,000 values"),
        (b'{"nodes": [' + b"1" * 5000 + b"]}", "cannot be read"),
        (b"glTF\2\0\0\0", "cannot be read"),
        (b"", "cannot be read"),
    ],
    ids=["deep", "records", "values", "digits", "head", "nothing"],
)
@pytest.mark.parametrize("suffix", [".gltf", ".glb"])
def test_json_is_taken_in_within_bounds(content: bytes, said: str, suffix: str, tmp_path: Path):
    path = tmp_path / f"head{suffix}"
    if suffix == ".glb" and not content.startswith(b"glTF"):
        size = len(content).to_bytes(4, "little")
        content = b"glTF\2\0\0\0" + (len(content) + 20).to_bytes(4, "little") + size + b"JSON" + content
    path.write_bytes(content)
    with pytest.raises(FormatError, match=said):
        read_gltf(path)


def test_files_have_a_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    path = head(tmp_path / "head.gltf")
    monkeypatch.setattr(gltf_container, "MOST_BYTES", 100)
    with pytest.raises(FormatError, match="at most 100"):
        read_gltf(path)


def test_a_picture_is_no_gltf(tmp_path: Path) -> None:
    path = tmp_path / "face.webp"
    path.write_bytes(b"RIFF\xf4\x00\x00\x00WEBPVP8 ")
    with pytest.raises(FormatError, match=r"face\.webp cannot be read .* \(it is neither GLB nor JSON\)"):
        read_gltf(path)

"""A user's glTF head becomes a rig, and what is wrong with its files is said in one sentence."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pygltflib
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.errors import InputError
from facegen.formats.gltf import read_gltf
from facegen.labels import label_keypoints
from facegen.labels.contour import paths_of
from facegen.randomness import stream
from facegen.rigs import Rig, evaluate, load_rig
from facegen.rigs.building import RIGS, add_rig
from facegen.rigs.callipers import MEASURES, measures_mm
from facegen.rigs.gltf_mesh import blendshape_sources
from facegen.rigs.human_eyes import EYE_RADIUS_M
from facegen.rigs.lash_strips import lash_strips
from facegen.rigs.lid_margins import lid_margins
from facegen.sampling import draw_samples
from facegen.sampling.plan import plan_dataset
from facegen.scene.brows import draw_brows
from facegen.scene.lids import crease_fields
from facegen.spec import parse_spec
from facegen.store import column_array, keypoint_schema, keypoint_table, write_shard
from tests.facegen.rigs.glb_head import write_head
from tests.facegen.rigs.people import straight, weights

pytestmark = pytest.mark.slow

EVERY_SHAPE = 0.8 * np.concatenate([np.zeros((1, len(BLENDSHAPES))), np.eye(len(BLENDSHAPES))])


def landmarks(rig: Rig) -> np.ndarray:
    """Of the mean face in rest and in each shape, (53, 68, 3)."""
    identity = np.zeros((len(EVERY_SHAPE), rig.components))
    return evaluate(rig, identity, EVERY_SHAPE, straight(len(EVERY_SHAPE)), cage_only=True).landmarks


@pytest.fixture(scope="module")
def files(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    return write_head(anny, tmp_path_factory.mktemp("marked"), lids=True)


def changed(files: tuple[Path, Path], folder: Path, **values) -> tuple[Path, Path]:
    """The head with another markup: keys set to ``values``, those that are None removed."""
    markup = json.loads(files[1].read_text()) | values
    path = folder / "marks.json"
    path.write_text(json.dumps({key: value for key, value in markup.items() if value is not None}))
    return files[0], path


def test_landmarks_are_those_of_the_head_that_was_written(anny: Rig, glb: Rig, files, tmp_path: Path) -> None:
    add_rig(*files, folder=tmp_path)
    there = landmarks(anny)
    assert np.linalg.norm(landmarks(load_rig("head", tmp_path)) - there, axis=-1).max() < 1e-5
    offset = np.linalg.norm(landmarks(glb) - there, axis=-1)
    lids = np.isin(np.arange(68), np.arange(36, 48))
    assert offset[:, ~lids].max() < 1e-5
    # margins found on the finer mesh place the eye a little elsewhere, and steer the lids at other columns
    assert offset[:, lids].max() < 2.5e-4
    assert glb.components == 0
    assert glb.licence == "CC0-1.0"


@pytest.mark.parametrize("people", [0, 3])
def test_a_head_without_identities_is_measured_for_the_page_of_statistics(glb: Rig, people: int):
    sizes = measures_mm(glb, np.zeros((people, 0)))
    assert sizes.keys() == set(MEASURES) if people else sizes.keys() < set(MEASURES)
    assert all(size.shape == (people,) for size in sizes.values())
    assert all(np.isfinite(size).all() for size in sizes.values())


def test_a_head_whose_faces_go_round_the_other_way_is_turned_outside(anny: Rig, tmp_path: Path):
    """Its keypoints were right, and every picture of it failed at the brows."""
    heads = []
    for name, inside_out in (("right", False), ("wrong", True)):
        (tmp_path / name).mkdir()
        _, added = add_rig(
            *write_head(anny, tmp_path / name, inside_out=inside_out), name=name, folder=tmp_path
        )
        heads.append(added.rig)
    right, wrong = heads

    def corners(rig: Rig) -> set:
        """Each face from its first vertex on, with its texture."""
        turned = [np.roll(np.arange(3), -first) for first in rig.faces[:, :3].argmin(axis=1)]
        rows = np.arange(len(turned))[:, None]
        return {
            (*face.tolist(), *uv.ravel().tolist())
            for face, uv in zip(rig.faces[rows, turned], rig.uv[rows, turned], strict=True)
        }

    assert corners(right) == corners(wrong)
    brows = draw_brows(stream(1, "look", 0), wrong)
    assert len(brows.triangle) > 300
    backwards = replace(wrong, faces=wrong.faces[:, [0, 2, 1, 3]])
    with pytest.raises(
        InputError, match=r"rig 'wrong' has no skin that looks ahead within 12 mm of a brow's"
    ):
        draw_brows(stream(1, "look", 0), backwards)


@pytest.mark.parametrize("turns", [0, 1, 2])
def test_margins_are_those_that_were_marked_whichever_corner_a_triangle_begins_with(glb: Rig, turns: int):
    """And a margin that is shorter than its other side's, which ends with its last vertex twice."""
    faces = np.concatenate([np.roll(glb.faces[:, :3], turns, axis=1), glb.faces[:, 3:]], axis=1)
    assert (faces[:, 3] < 0).all()
    padded = [np.concatenate([lids, lids[:, -1:]], axis=1) for lids in (glb.upper_lid, glb.lower_lid)]
    rig = replace(glb, faces=faces, upper_lid=padded[0], lower_lid=padded[1])
    for eye in range(2):
        for found, marked in zip(
            lid_margins(rig, eye), (glb.upper_lid[eye], glb.lower_lid[eye]), strict=True
        ):
            assert found.tolist() == list(dict.fromkeys(marked.tolist()))
    for name, field in crease_fields(rig).items():
        np.testing.assert_array_equal(field, crease_fields(glb)[name])
        assert np.isfinite(field).all()


def test_a_landmark_of_five_vertices_slides(glb: Rig):
    """The paths of `sliding_contour` go over triangles, of three."""
    more = np.zeros((68, 5 - glb.landmark_vertices.shape[1]))
    rig = replace(
        glb,
        landmark_vertices=np.concatenate([glb.landmark_vertices, more.astype(np.int64)], axis=1),
        landmark_weights=np.concatenate([glb.landmark_weights, more], axis=1),
    )
    there = paths_of(glb)
    paths = paths_of(rig)
    assert paths.vertices.shape[2] == 5
    points = [(p.weights[..., None] * glb.vertices[p.vertices]).sum(axis=2) for p in (paths, there)]
    np.testing.assert_allclose(*points, atol=1e-12)


def test_the_list_of_rigs_says_what_is_built_and_what_was_added(files, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setenv("FACEGEN_RIGS", str(tmp_path))
    add_rig(*files, name="mine")
    lines = [line.split() for line in CliRunner().invoke(app, ["rig", "list"]).output.splitlines()]
    assert [line[0] for line in lines] == [*RIGS, "mine"]
    assert all(line[1:3] == ["not", "built"] for line in lines[:-1])
    assert lines[-1][1:3] == ["added", load_rig("mine").licence]


def test_missing_shapes_are_named_and_zero_and_spelling_does_not_matter(anny: Rig, tmp_path: Path) -> None:
    absent = ("tongueOut", "eyeBlinkLeft", "eyeBlinkRight", "cheekPuff")

    def in_maya(name: str) -> str:
        return "blendShape1." + name.replace("Left", "_L").replace("Right", "_R").upper()

    path, added = add_rig(
        *write_head(anny, tmp_path, rename=in_maya, left_out=absent), folder=tmp_path / "rigs"
    )
    rig = load_rig(path.stem, path.parent)
    assert rig.missing == added.rig.missing == tuple(name for name in BLENDSHAPES if name in absent)
    assert added.left_out == ("Hat",)
    shapes = [0, *(1 + i for name, i in BLENDSHAPE_INDEX.items() if name not in absent)]
    points = [i for i in range(68) if i not in range(36, 48)]  # lids rest on the eye by other columns
    offset = np.linalg.norm(landmarks(rig) - landmarks(anny), axis=-1)
    assert offset[np.ix_(shapes, points)].max() < 1e-5
    blinking = evaluate(rig, np.zeros((1, 0)), weights(1, eyeBlink=1.0), straight(1))
    np.testing.assert_array_equal(
        blinking.landmarks, evaluate(rig, np.zeros((1, 0)), weights(1), straight(1)).landmarks
    )


def test_keypoints_of_a_head_without_identities_are_written_and_read(glb: Rig, tmp_path: Path) -> None:
    """Arrow dies of lists of a fixed size of 0."""
    table = {"version": 1, "kind": "still", "seed": 2, "people": 500, "rig": "glb"}
    spec = parse_spec(table | {"still": {"neutral": 1, "faces": 1}}, where="here")
    samples = draw_samples(plan_dataset(spec), glb, 0).rows(slice(0, 40))
    made = keypoint_table(spec, samples, label_keypoints(spec, glb, samples))
    write_shard(made, tmp_path / "shard.parquet")
    read = pq.read_table(tmp_path / "shard.parquet")
    assert column_array(read, "identity").shape == (40, 0)
    assert column_array(read, "points_3d").shape == (40, 68, 3)
    assert read.schema.equals(keypoint_schema(spec, 0))


@pytest.mark.parametrize(
    ("names", "shape", "sources"),
    [
        (["EyeBlink_L"], "eyeBlinkLeft", ("EyeBlink_L",)),
        (["head.mouth_smile_right"], "mouthSmileRight", ("head.mouth_smile_right",)),
        (["browInnerUp_L", "browInnerUp_R"], "browInnerUp", ("browInnerUp_L", "browInnerUp_R")),
        (["jawLeft", "mouthL"], "jawLeft", ("jawLeft",)),
        (["browInnerUp_L"], "browInnerUp", None),
    ],
)
def test_spellings_of_blendshapes(names: list[str], shape: str, sources: tuple[str, ...] | None) -> None:
    assert blendshape_sources(names).get(shape) == sources


def test_points_may_be_positions(anny: Rig, files, tmp_path: Path) -> None:
    """Positions in the file's frame, as a user picks them in Blender, find the vertices there."""
    part = max(read_gltf(files[0]), key=lambda part: len(part.positions))
    points = [int(point[0][0]) for point in json.loads(files[1].read_text())["landmarks"]]
    _, by_vertex = add_rig(*changed(files, tmp_path, landmarks=points), name="a", folder=tmp_path)
    positions = (part.positions[points] + 1e-6).tolist()
    _, by_position = add_rig(*changed(files, tmp_path, landmarks=positions), name="b", folder=tmp_path)
    np.testing.assert_allclose(landmarks(by_position.rig), landmarks(by_vertex.rig))


def test_eyes_may_be_given_as_balls(anny: Rig, files, tmp_path: Path) -> None:
    eyes = {
        side: {"center": part.positions.mean(axis=0).tolist(), "radius": 0.0165}
        for side, part in zip(
            ("left", "right"), [p for p in read_gltf(files[0]) if p.node.startswith("Eye")], strict=True
        )
    }
    _, added = add_rig(*changed(files, tmp_path, eyes=eyes, head="face"), folder=tmp_path)
    np.testing.assert_allclose(added.rig.eye_radius, EYE_RADIUS_M)
    # the frame's origin is where the file's balls are; human eyes are where the lids are
    before = [rig.eye_center - landmarks(rig)[0, 27] for rig in (added.rig, anny)]
    np.testing.assert_allclose(*before, atol=3e-4)


def test_what_a_head_loses_is_said(anny: Rig, files, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setenv("FACEGEN_RIGS", str(tmp_path))
    parts = json.loads(files[1].read_text())["parts"]
    without = {kind: names for kind, names in parts.items() if kind != "lashes"}
    for name, given in (("all", parts), ("bare", without)):
        marked = changed(files, tmp_path, parts=given)
        result = CliRunner().invoke(
            app, ["rig", "add", str(marked[0]), "--landmarks", str(marked[1]), "--name", name]
        )
        assert result.exit_code == 0, result.exception
        assert "Left out of the head: Hat." in result.stderr
        assert ("lashes are not rendered" in result.stderr) == (name == "all")
        assert not lash_strips(load_rig(name)), "what is said is true"


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"landmarks": [0] * 67}, r"landmarks: must have at least 68 items, not 67 \("),
        ({"landmarks": None}, "key 'landmarks' is missing"),
        ({"landmark": 1}, "unknown key 'landmark'; did you mean 'landmarks'"),
        ({"landmarks": [10**6] * 68}, "landmarks.0 names vertex 1000000; the face's mesh has"),
        ({"landmarks": [0] * 68}, "landmarks.0 and landmarks.1 are the same"),
        ({"landmarks": [[0.0, 0.0, 0.0]] * 68}, "landmarks.0 lies .* mm from the face"),
        ({"eyes": {"left": "EyeRight", "right": "EyeLeft"}}, "left is the subject's"),
        (
            {"eyes": {"left": "Eye", "right": "EyeRight"}},
            "nothing is called 'Eye'; the file holds mesh 'Face'",
        ),
        ({"eyes": {"left": "Skin", "right": "EyeRight"}}, "is no ball"),
        ({"metres_per_unit": 0.01}, "eyes are 0.6.* mm apart.*metres_per_unit"),
        ({"head": "EyeLeft"}, "landmarks.0 names a vertex that is not on the skin"),
        ({"parts": {"hair": ["Hat"]}}, "parts.hair"),
    ],
)
def test_wrong_marks_are_refused(files, tmp_path: Path, values: dict, said: str) -> None:
    with pytest.raises(InputError, match=said):
        add_rig(*changed(files, tmp_path, **values), folder=tmp_path)
    assert not list(tmp_path.glob("*.npz"))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            lambda lids: lids["left"]["upper"].reverse(),
            r"upper lid margin of the left eye goes from 44\.9 to 18\.2 mm .*turn lids\.left\.upper round",
        ),
        (lambda lids: lids["right"]["lower"].reverse(), r"turn lids\.right\.lower round"),
        (lambda lids: lids.update(left=lids["right"], right=lids["left"]), "left .* and right are swapped"),
        (
            lambda lids: lids["left"].update(upper=[lids["left"]["upper"][i] for i in (0, 0, 7, -1)]),
            "upper lid margin of the left eye has only 1 vert.* at least 2",
        ),
    ],
    ids=["upper", "lower", "sides", "columns"],
)
def test_lid_margins_that_cannot_close_are_refused(files, tmp_path: Path, change, said: str) -> None:
    lids = json.loads(files[1].read_text())["lids"]
    change(lids)
    with pytest.raises(InputError, match=said):
        add_rig(*changed(files, tmp_path, lids=lids), folder=tmp_path)
    assert not list(tmp_path.glob("*.npz"))


def test_wrong_files_and_names_are_refused(anny: Rig, files, tmp_path: Path) -> None:
    other = tmp_path / "other.glb"
    with pytest.raises(InputError, match=r"material 'Skin' with 52 ARKit shapes; .*--landmarks"):
        add_rig(files[0], None, folder=tmp_path)
    with pytest.raises(InputError, match="does not exist"):
        add_rig(other, files[1], folder=tmp_path)
    for content in (b"", b"solid", files[0].read_bytes()[:5000], b"glTF" + bytes(40)):
        other.write_bytes(content)
        with pytest.raises(InputError, match="cannot be read as a glTF"):
            add_rig(other, files[1], folder=tmp_path)
    gltf = pygltflib.GLTF2().load(str(files[0]))
    gltf.extensionsRequired = ["KHR_draco_mesh_compression"]
    gltf.save(str(other))
    with pytest.raises(InputError, match="compressed with KHR_draco_mesh_compression"):
        add_rig(other, files[1], folder=tmp_path)
    for name in ("anny", "A Head", "../head"):
        with pytest.raises(InputError, match="--name"):
            add_rig(*files, name=name, folder=tmp_path)
    (tmp_path / "head.npz").touch()
    with pytest.raises(InputError, match="--force"):
        add_rig(*files, folder=tmp_path)
    marks = tmp_path / "marks.json"
    for content in (b"{", b"\xff\xfe"):
        marks.write_bytes(content)
        with pytest.raises(InputError, match="JSON"):
            add_rig(files[0], marks, name="other", folder=tmp_path)

"""Packs: every format repeats byte for byte, goes on after a kill, and opens in its users' tools."""

import contextlib
import gc
import io
import json
import shutil
import tarfile
import tracemalloc
from pathlib import Path

import cv2
import numpy as np
import pyarrow.compute as pc
import pyarrow.parquet as pq
import pytest

from facegen.conventions import BLENDSHAPES, SPLITS
from facegen.errors import InputError, InvalidData
from facegen.geometry import direction_from_angles
from facegen.headsets.headset import TAKEN
from facegen.packing import PACK_FORMATS, Options, PackFile, plan_pack, write_pack
from facegen.packing.arrays import array_schema, face_basis, write_part
from facegen.packing.parquet import row_schema
from facegen.packing.view_points import view_points
from facegen.packing.webdataset import write_tar
from facegen.store import open_dataset, read_png

pytestmark = [pytest.mark.blender, pytest.mark.slow]

ROOT = Path(__file__).resolve().parents[3]
VIEWS = ("left_eye", "mouth", "right_eye")


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def make(rendered, out: Path, name: str, **options) -> Path:
    write_pack(plan_pack(rendered, name, Options(**options)), out)
    return out


@pytest.mark.parametrize("name", PACK_FORMATS)
def test_equal_input_gives_equal_bytes_and_the_licence_goes_along(request, tmp_path, name):
    rendered = request.getfixturevalue("recorded" if name in ("livelink", "openface") else "rendered")
    one, two = (make(rendered, tmp_path / part, name) for part in "ab")
    assert files(one) == files(two)
    about = json.loads((one / "pack.json").read_text())
    assert "CC0" in about["licence"]
    assert about["dataset"]["spec_hash"] == rendered.hash
    index = json.loads((one / "index.json").read_text())
    assert sorted(entry["name"] for entry in index) == sorted(
        files(one).keys() - {"pack.json", "index.json", "README.md", "croissant.json", "LICENSE.txt"}
    )
    assert all((one / entry["name"]).stat().st_size == entry["bytes"] for entry in index)
    again = write_pack(plan_pack(rendered, name), one)
    assert (again.written, again.found) == (0, len(index))


def test_a_copied_dataset_packs_to_the_same_bytes(rendered, tmp_path):
    copy = shutil.copytree(rendered.folder.path, tmp_path / "copy", copy_function=shutil.copy)  # new times
    one, two = (
        make(d, tmp_path / str(i), "webdataset") for i, d in enumerate((rendered, open_dataset(copy)))
    )
    assert files(one) == files(two)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # it leaves shards open
def test_webdataset_opens_in_its_library(rendered, tmp_path):
    webdataset = pytest.importorskip("webdataset")
    out = make(rendered, tmp_path / "pack", "webdataset", shard_size=1)
    shards = sorted(str(path) for path in out.glob("*.tar"))
    assert [Path(shard).name for shard in shards] == ["shard-000000.tar", "shard-000001.tar"]
    samples = list(webdataset.WebDataset(shards, shardshuffle=False))
    assert [sample["__key__"] for sample in samples] == ["000000", "000001"]
    for number, sample in enumerate(samples):
        assert json.loads(sample["json"]) == rendered.sample(number)
        for view in VIEWS:
            folder = rendered.folder.render(number)
            assert sample[f"{view}.png"] == (folder / f"{view}.png").read_bytes()
            assert sample[f"{view}.exr"] == (folder / f"{view}.exr").read_bytes()
    gc.collect()  # so that the open shards are this test's, and no later one's


def test_webdataset_entries_are_sorted_and_tell_no_time_and_no_owner(rendered, tmp_path):
    out = make(rendered, tmp_path / "pack", "webdataset", exr=False, views=("mouth", "left_eye"))
    with tarfile.open(out / "shard-000000.tar") as archive:
        members = archive.getmembers()
    fields = ("json", "left_eye.png", "mouth.png")
    assert [m.name for m in members] == [f"{n:06d}.{field}" for n in (0, 1) for field in fields]
    assert {(m.mtime, m.uid, m.gid, m.uname, m.gname, m.mode) for m in members} == {(0, 0, 0, "", "", 0o644)}


def test_parquet_opens_in_pandas(rendered, tmp_path):
    pandas = pytest.importorskip("pandas")
    out = make(rendered, tmp_path / "pack", "parquet")
    frame = pandas.concat([pandas.read_parquet(path) for path in sorted(out.glob("*.parquet"))])
    frame = frame.sort_values("sample", ignore_index=True)
    assert frame["sample"].tolist() == [0, 1]
    record = rendered.sample(1)
    assert json.loads(frame["record"][1]) == record
    for view in VIEWS:
        picture = cv2.imdecode(np.frombuffer(frame[view][1]["bytes"], np.uint8), cv2.IMREAD_UNCHANGED)
        np.testing.assert_array_equal(picture, read_png(rendered.folder.render(1) / f"{view}.png"))
        points = np.array(frame[f"{view}_points_2d"][1]).reshape(68, 2)
        np.testing.assert_array_equal(points, np.array(record["views"][view]["points_2d"], np.float32))
    weights = dict(zip(BLENDSHAPES, frame["weights"][1], strict=True))
    assert weights["jawOpen"] == np.float32(record["weights"]["jawOpen"])
    assert frame["component"][1] == record["component"]
    assert "CC0" in pq.read_schema(next(out.glob("*.parquet"))).metadata[b"licence"].decode()


def test_keypoints_with_chosen_columns_in_files_of_a_chosen_size(rendered, tmp_path):
    out = make(rendered, tmp_path / "pack", "keypoints", columns=("detected_2d", "split"), shard_size=12)
    whole = rendered.keypoints()
    for split in SPLITS:
        tables = [pq.read_table(path) for path in sorted(out.glob(f"{split}-*.parquet"))]
        rows = whole.filter(pc.equal(whole["split"], split))
        assert [len(table) for table in tables] == [
            min(12, len(rows) - start) for start in range(0, len(rows), 12)
        ]
        for name in ("sample", "split", "detected_2d"):
            assert [v for table in tables for v in table[name].to_pylist()] == rows[name].to_pylist()
            assert all(table.column_names == ["sample", "split", "detected_2d"] for table in tables)


def test_a_split_is_packed_alone(rendered, tmp_path):
    split = rendered.keypoints()["split"].to_pylist()
    for name in sorted(set(split)):
        out = make(rendered, tmp_path / name, "keypoints", split=name, columns=("split",))
        assert {path.name for path in out.glob("*.parquet")} == {f"{name}-000000.parquet"}
        table = pq.read_table(out / f"{name}-000000.parquet")
        assert table["sample"].to_pylist() == [n for n, s in enumerate(split) if s == name]
    with pytest.raises(InputError, match="none of train, validation, test"):
        plan_pack(rendered, "keypoints", Options(split="dev"))


def test_coco_opens_in_pycocotools(rendered, tmp_path):
    coco = pytest.importorskip("pycocotools.coco")
    out = make(rendered, tmp_path / "pack", "coco")
    with contextlib.redirect_stdout(io.StringIO()):
        opened = coco.COCO(str(out / "keypoints-mouth.json"))
    assert sorted(opened.getImgIds()) == [0, 1]
    (category,) = opened.loadCats(opened.getCatIds())
    assert len(category["keypoints"]) == 68
    assert len(set(category["keypoints"])) == 68
    assert {index for pair in category["skeleton"] for index in pair} == set(range(1, 69))
    for image in opened.loadImgs([0, 1]):
        assert (rendered.folder.path / image["file_name"]).is_file()
        view = rendered.sample(image["id"])["views"]["mouth"]
        (annotation,) = opened.loadAnns(opened.getAnnIds(imgIds=[image["id"]]))
        found = np.array(annotation["keypoints"], float).reshape(68, 3)
        visibility = np.array(view["visibility"])
        np.testing.assert_array_equal(found[:, 2], visibility)
        labelled = visibility > 0
        np.testing.assert_array_equal(found[labelled, :2], np.array(view["points_2d"], float)[labelled])
        assert not found[~labelled].any()
        assert annotation["num_keypoints"] == labelled.sum() > 0
        x, y, width, height = annotation["bbox"]
        # boxes count from the picture's corner, points from the middle of its first pixel
        low, high = found[labelled, :2].min(axis=0) + 0.5, found[labelled, :2].max(axis=0) + 0.5
        np.testing.assert_allclose([x, y, x + width, y + height], [*low, *high])
        assert (low >= 0).all()
        assert (high <= [image["width"], image["height"]]).all()


def test_no_camera_may_be_called_as_a_column_is(rendered):
    views = rendered.headset.camera_names
    for schema in (row_schema(rendered, views), array_schema(rendered, views)):
        own = {name for name in schema.names if not any(view in name for view in views)}
        assert own <= TAKEN


def test_arrays_hold_the_datasets_pictures_and_labels(rendered, tmp_path):
    out = make(rendered, tmp_path / "pack", "arrays")
    about = json.loads((out / "arrays.json").read_text())
    assert [camera["name"] for camera in about["cameras"]] == list(rendered.headset.camera_names)
    assert (about["rows"], about["rig"], about["dataset_hash"]) == (2, "anny", rendered.hash)
    table = pq.read_table(out / "labels.parquet")
    assert all(b"description" in field.metadata for field in table.schema)
    for row in (0, 1):
        record = rendered.sample(row)
        for camera in about["cameras"]:
            picture = np.load(out / f"{camera['name']}.npy", mmap_mode="r")[row]
            assert picture.shape == (camera["height"], camera["width"])
            np.testing.assert_array_equal(
                picture, read_png(rendered.folder.render(row) / f"{camera['name']}.png")
            )
        labels = {name: table[name][row].as_py() for name in table.column_names}
        assert {name: labels[name] for name in ("sample", "split", "component", "neutral")} == {
            name: record[name] for name in ("sample", "split", "component", "neutral")
        }
        weights = [record["weights"][name] for name in BLENDSHAPES]
        np.testing.assert_allclose(labels["weights"], weights, atol=1e-7)
        yaw, pitch = np.reshape(labels["gaze"], (2, 2)).T
        axes = [record["eyes"][side]["optical_axis"] for side in ("left", "right")]
        np.testing.assert_allclose(direction_from_angles(yaw, pitch), axes, atol=1e-6)
        pose = np.reshape(labels["head_from_headset"], (4, 4))
        np.testing.assert_allclose(pose, record["headset"]["head_from_headset"], atol=1e-7)
        np.testing.assert_allclose(labels["slip"], record["headset"]["slip"], atol=1e-7)
        for name, view in record["views"].items():
            np.testing.assert_array_equal(np.reshape(labels[f"points_{name}"], (-1, 2)), view_points(view))
    face = np.load(out / "face.npz")
    assert face["displacement"].shape == (52, *face["rest"].shape)


def test_the_faces_basis_turns_weights_into_the_rigs_shape(anny):
    displacement, rest = face_basis(anny)
    opened = BLENDSHAPES.index("jawOpen")
    moved = np.linalg.norm(displacement, axis=-1)
    assert 0.02 < moved[opened].max() < 0.06  # a chin falls by centimetres
    assert (moved[BLENDSHAPES.index("browInnerUp")] > 1e-3).any()
    assert not moved[BLENDSHAPES.index("tongueOut")].any()
    # eyeballs are no skin: nothing lies within them
    assert (
        np.linalg.norm(rest[:, None] - anny.eye_center, axis=-1).min(axis=0) > 0.9 * anny.eye_radius
    ).all()
    brows, chin = rest[:, 1].max(), rest[:, 1].min()
    assert 0.18 < brows - chin < 0.25
    assert 5_000 < len(rest) < 0.6 * len(anny.vertices)


@pytest.mark.parametrize(
    ("write", "part"), [(write_tar, {"name": "a"}), (write_part, {"name": "a", "view": "mouth"})]
)
def test_memory_does_not_grow_with_the_number_of_samples(rendered, tmp_path, write, part):
    def peak(samples: list[int]) -> int:
        tracemalloc.start()
        write(rendered, PackFile(samples=samples, **part), Options(), tmp_path / "a.tar")
        size = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return size

    peak([0])  # imports
    # a sample is 500 kB; all 50 more of them may leave a fifth of one behind
    assert peak([0] * 60) - peak([0] * 10) < 100_000


def test_what_cannot_be_packed_is_refused(rendered, tmp_path):
    with pytest.raises(InputError, match="takes --samples, --split, --views"):
        plan_pack(rendered, "coco", Options(shard_size=3))
    with pytest.raises(InputError, match="none of webdataset, parquet, keypoints, coco"):
        plan_pack(rendered, "zip")
    with pytest.raises(
        InputError, match="1 of the rendered samples to pack are missing, the first is sample 2"
    ):
        plan_pack(rendered, "webdataset", Options(samples="0-2"))
    with pytest.raises(InputError, match="'chin' is none of this dataset's cameras"):
        make(rendered, tmp_path / "views", "coco", views=("chin",))
    with pytest.raises(InputError, match="'x' is none of sample, person"):
        make(rendered, tmp_path / "columns", "keypoints", columns=("x",))
    with pytest.raises(
        InputError, match="--views names no camera; this dataset's are left_eye, right_eye, mouth"
    ):
        make(rendered, tmp_path / "views", "coco", views=())
    other = next(split for split in SPLITS if split != rendered.array("split")[0])
    with pytest.raises(InputError, match="nothing to pack; no sample is that of --samples and --split"):
        plan_pack(rendered, "keypoints", Options(samples="0", split=other))
    make(rendered, tmp_path / "a", "keypoints")
    with pytest.raises(InputError, match="holds another pack"):
        make(rendered, tmp_path / "a", "webdataset")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.doc").write_text("mine")
    with pytest.raises(InputError, match="holds no pack"):
        make(rendered, tmp_path / "mine", "webdataset")


def test_damage_is_not_packed_and_no_half_file_appears(rendered, tmp_path):
    copy = shutil.copytree(rendered.folder.path, tmp_path / "copy")
    path = copy / "renders" / "000" / "000001" / "mouth.png"
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(InvalidData, match=r"mouth\.png: is not what was written"):
        make(open_dataset(copy), tmp_path / "pack", "webdataset")
    assert sorted(p.name for p in (tmp_path / "pack").rglob("*")) == ["pack.json"]


def test_files_of_a_run_that_was_killed_are_not_written_again(rendered, tmp_path):
    """What such a run leaves is in tests/facegen/packing/test_kills.py: no index, and whole files."""
    plan = plan_pack(rendered, "keypoints", Options(shard_size=1))
    write_pack(plan, tmp_path / "whole")
    out = shutil.copytree(tmp_path / "whole", tmp_path / "killed")
    (out / "index.json").unlink()
    for path in sorted(out.glob("*.parquet"))[3:]:
        path.unlink()
    before = {path: path.stat().st_mtime_ns for path in out.glob("*.parquet")}
    packed = write_pack(plan, out)
    assert (packed.found, packed.written) == (3, len(plan.parts) - 3)
    assert {path: path.stat().st_mtime_ns for path in before} == before
    assert files(out) == files(tmp_path / "whole")


@pytest.mark.parametrize("damage", ["half a file", "no file", "half an index"])
def test_a_damaged_pack_is_mended_by_its_next_run(recorded, tmp_path, damage):
    out = make(recorded, tmp_path / "a", "keypoints", shard_size=100)
    whole = files(out)
    path = out / ("index.json" if damage == "half an index" else "validation-000001.parquet")
    if damage == "no file":
        path.unlink()
    else:
        path.write_bytes(whole[path.name][: len(whole[path.name]) // 2])
    again = write_pack(plan_pack(recorded, "keypoints", Options(shard_size=100)), out)
    parts = sum(name.endswith(".parquet") for name in whole)
    assert again.written == (parts if damage == "half an index" else 1)
    assert files(out) == whole

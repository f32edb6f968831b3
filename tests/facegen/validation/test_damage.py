"""Every kind of damage is found and named, and nothing is said of a dataset without any."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InvalidData
from facegen.spec import load_spec
from facegen.store import column_array, open_dataset, resolve, write_shard
from facegen.validation import Finding, Verdict, repair, validate
from facegen.work import generate

pytestmark = [pytest.mark.blender, pytest.mark.slow]

SAMPLE = "renders/000/000001"
SHARD = "keypoints/shard-00000.parquet"


@pytest.fixture(scope="session")
def clean(rendered) -> Verdict:
    return validate(rendered)


@pytest.fixture
def copy(rendered, clean, tmp_path) -> Path:
    assert (clean.findings, clean.missing, clean.invalid) == ((), 0, ()), (
        "the untouched dataset must be clean"
    )
    assert (clean.shards, clean.renders) == (1, 2)
    return Path(shutil.copytree(rendered.folder.path, tmp_path / "copy"))


def found(folder: Path) -> tuple[Finding, ...]:
    return validate(open_dataset(folder)).findings


def flip(path: Path, *, at: float) -> None:
    content = bytearray(path.read_bytes())
    content[int(len(content) * at)] ^= 0x10
    path.write_bytes(content)


def edit(folder: Path, change: Callable[[dict], None]) -> None:
    path = folder / SAMPLE / "sample.json"
    record = json.loads(path.read_text())
    change(record)
    path.write_text(json.dumps(record))


def only(findings: tuple[Finding, ...], place: str) -> set[str]:
    """Kinds of findings, which must all be about one place."""
    assert {finding.remove for finding in findings} == {place}, findings
    return {finding.kind for finding in findings}


def test_a_truncated_png(copy):
    path = copy / SAMPLE / "mouth.png"
    path.write_bytes(path.read_bytes()[:-200])
    findings = found(copy)
    assert only(findings, SAMPLE) >= {"checksum"}
    assert {finding.where for finding in findings} == {f"{SAMPLE}/mouth.png"}


@pytest.mark.parametrize("at", [0.02, 0.5, 0.98])
def test_a_flipped_byte_in_an_exr(copy, at):
    flip(copy / SAMPLE / "left_eye.exr", at=at)
    findings = found(copy)
    assert only(findings, SAMPLE) >= {"checksum"}
    assert f"{SAMPLE}/left_eye.exr" in {finding.where for finding in findings}


@pytest.mark.parametrize("name", ["sample.json", "right_eye.exr"])
def test_a_missing_file(copy, name):
    (copy / SAMPLE / name).unlink()
    assert found(copy) == (Finding(f"{SAMPLE}/{name}", "is missing", "missing-file", SAMPLE),)


def test_an_extra_sample_beyond_the_dataset_and_one_under_anothers_name(copy):
    shutil.copytree(copy / SAMPLE, copy / "renders" / "000" / "000030")
    shutil.copytree(copy / SAMPLE, copy / "renders" / "000" / "7")
    shutil.copytree(copy / SAMPLE, copy / "renders" / "000" / "000005")
    by_place = {finding.remove: finding for finding in found(copy)}
    assert set(by_place) == {f"renders/000/{name}" for name in ("000030", "7", "000005")}
    assert by_place["renders/000/000030"].kind == "extra-sample"
    assert "has samples 0-29" in by_place["renders/000/000030"].what
    assert "belongs: renders/000/000007" in by_place["renders/000/7"].what
    assert by_place["renders/000/000005"].kind == "label", (
        "a sample in 5's place is not what the spec gives for 5"
    )


def test_extra_files_and_shards(copy):
    (copy / SAMPLE / "notes.txt").write_text("mine")
    (copy / "renders" / "index.html").write_text("mine")
    shutil.copy(copy / SHARD, copy / "keypoints" / "shard-00001.parquet")
    (copy / "mine.txt").write_text("outside of keypoints/ and renders/ a user may keep what he likes")
    kinds = {finding.remove: finding.kind for finding in found(copy)}
    assert kinds == {
        f"{SAMPLE}/notes.txt": "extra-file",
        "renders/index.html": "extra-file",
        "keypoints/shard-00001.parquet": "extra-shard",
    }


def test_what_systems_leave_in_folders_is_no_fault(copy):
    for place in (SAMPLE, "renders/000", "renders", "keypoints", "."):
        for name in (".DS_Store", "._sample.json", "Thumbs.db", ".nfs0000000001"):
            (copy / place / name).write_bytes(b"\0")
    assert found(copy) == ()


def test_a_label_moved_by_5_px_in_a_render(copy):
    def move(record: dict) -> None:
        record["views"]["mouth"]["points_2d"][57][0] += 5

    edit(copy, move)
    findings = found(copy)
    assert only(findings, SAMPLE) >= {"label"}
    said = [finding.what for finding in findings]
    assert any(
        "views.mouth.points_2d: point 57 lies 5.00 px from where the spec puts it" in what for what in said
    )


def test_a_label_and_its_point_moved_together_disagree_with_the_pixels(copy):
    def move(record: dict) -> None:
        view = record["views"]["mouth"]
        landmark = view["visibility"].index(2)
        x, y, z = view["points_camera"][landmark]
        view["points_camera"][landmark] = [x * 1.1, y * 1.1, z * 1.1]  # along its ray: no other pixel

    edit(copy, move)
    assert {"label", "pixels"} <= only(found(copy), SAMPLE)


def test_a_label_moved_by_5_px_in_a_shard(copy):
    table = pq.read_table(copy / SHARD)
    points = column_array(table, "points_2d").copy()
    points[12, 33, 1] += 5
    index = table.schema.get_field_index("points_2d")
    field = table.schema.field(index)
    moved = pa.FixedSizeListArray.from_arrays(pa.array(points.ravel()), type=field.type)
    write_shard(table.set_column(index, field, moved), copy / SHARD)
    findings = found(copy)
    assert only(findings, SHARD) == {"label"}
    assert {finding.where for finding in findings} == {f"{SHARD}, sample 12"}
    assert any("landmark 33 in 3D projects 5.000 px" in finding.what for finding in findings)


def test_a_flipped_byte_in_a_shard(copy):
    flip(copy / SHARD, at=0.4)
    findings = found(copy)
    assert only(findings, SHARD) <= {"checksum", "unreadable"}
    assert len(findings) == 1


def test_a_stale_spec_hash(copy):
    edit(copy, lambda record: record.update(spec_hash="0" * 64))
    (finding,) = found(copy)
    assert (finding.kind, finding.where) == ("spec-hash", f"{SAMPLE}/sample.json")
    assert "000000000000" in finding.what


def test_a_stale_spec_of_the_whole_dataset(copy):
    text = (copy / "dataset.json").read_text()
    record = json.loads(text)
    (copy / "dataset.json").write_text(text.replace(record["spec_hash"], "f" * 64))
    result = CliRunner().invoke(app, ["validate", str(copy)])
    assert "its spec.toml or headset.toml was changed after it was made" in str(result.exception)
    assert result.exception.exit_code == 2


def test_impossible_values(copy):
    def spoil(record: dict) -> None:
        record["weights"]["jawOpen"] = 1.5
        record["views"]["mouth"]["visibility"][3] = 7
        record["eyes"]["left"]["optical_axis"] = [0.0, 0.0, 2.0]

    edit(copy, spoil)
    ranges = [finding.what for finding in found(copy) if finding.kind == "range"]
    assert [what.split(":")[0] for what in ranges] == ["weights", "visibility", "gaze"]


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"sha256": {}}', '{"sha256": {}, "spec_hash": "HASH", "views": 3}']
)
def test_junk_in_a_sidecar_never_ends_the_check(copy, rendered, text):
    (copy / SAMPLE / "sample.json").write_text(text.replace("HASH", rendered.hash))
    assert only(found(copy), SAMPLE)


@pytest.mark.parametrize(
    "camera", [{"model": "pinhloe"}, {"fx": None}, {"fx": "1"}, {"distortion": [0.0] * 6}], ids=str
)
def test_junk_in_a_views_camera_never_ends_the_check(copy, camera):
    edit(copy, lambda record: record["views"]["mouth"]["camera"].update(camera))
    findings = found(copy)
    assert only(findings, SAMPLE) == {"label", "unreadable"}
    (unusable,) = [finding.what for finding in findings if finding.kind == "unreadable"]
    assert unusable.startswith("views.mouth cannot be used")


def test_repair_and_generate_restore_identical_bytes(copy, rendered):
    flip(copy / SHARD, at=0.5)
    path = copy / SAMPLE / "left_eye.png"
    path.write_bytes(path.read_bytes()[:100])
    shutil.copytree(copy / SAMPLE, copy / "renders" / "001" / "001000")
    (copy / "renders" / "000" / "000000" / "notes.txt").write_text("junk")
    run = CliRunner()
    assert run.invoke(app, ["validate", str(copy), "--workers", "1"]).exit_code == 1
    result = run.invoke(app, ["validate", str(copy), "--workers", "1", "--repair", "--json"])
    assert result.exit_code == 75
    said = json.loads(result.stdout.strip().splitlines()[-1])
    assert said["repair"] == {
        "removed": [SHARD, "renders/000/000000/notes.txt", SAMPLE, "renders/001/001000"],
        "samples": "1",
    }
    assert run.invoke(app, ["validate", str(copy), "--workers", "1"]).exit_code == 75
    # a slice, which lacks things on purpose, and something that is too much
    (copy / "renders" / "000" / "000000" / "notes.txt").write_text("junk")
    words = ["validate", str(copy), "--workers", "1", "--partial"]
    assert [run.invoke(app, [*words, *more]).exit_code for more in ([], ["--repair"], [])] == [1, 0, 0]
    assert generate(resolve(load_spec(copy / "spec.toml"), copy), workers=1).made == 2
    for part in ("keypoints", "renders"):
        names = sorted(
            p.relative_to(rendered.folder.path) for p in (rendered.folder.path / part).rglob("*.*")
        )
        assert names == sorted(p.relative_to(copy) for p in (copy / part).rglob("*.*"))
        assert all((copy / n).read_bytes() == (rendered.folder.path / n).read_bytes() for n in names)
    assert run.invoke(app, ["validate", str(copy), "--workers", "1"]).exit_code == 0


def test_repair_removes_no_dataset_as_a_whole(rendered, clean):
    places = tuple(f"renders/000/{number:06d}" for number in range(11))
    verdict = Verdict(
        shards=1,
        renders=20,
        missing_shards="",
        missing_renders="",
        missing=0,
        wrong={"label": 11},
        findings=(),
        invalid=places,
    )
    with pytest.raises(InvalidData, match="too many for damage"):
        repair(rendered, verdict)
    assert clean.renders == len(rendered.folder.rendered())


def test_processes_find_the_same(copy):
    flip(copy / SAMPLE / "left_eye.exr", at=0.5)
    one, two = (validate(open_dataset(copy), workers=n) for n in (1, 2))
    assert one == two
    assert np.sum(list(one.wrong.values())) >= 1


EDITS: dict[str, Callable[[dict], object]] = {
    "unknown key": lambda record: record.update(colour="red"),
    "unknown render key": lambda record: record["render"].update(samples=4),
    "render is a list": lambda record: record.update(render=[]),
    "render as text": lambda record: record["render"].update(samples_per_pixel="4"),
    "checksum of nothing": lambda record: record["sha256"].update({"nose.png": "0" * 64}),
    "checksums are a list": lambda record: record.update(sha256=[]),
    "number as text": lambda record: record["weights"].update(jawOpen=str(record["weights"]["jawOpen"])),
    "numbers as texts": lambda record: record.update(identity=list(map(str, record["identity"]))),
    "true for one": lambda record: record["headset"]["slip"].__setitem__(0, False),
    "true for a number": lambda record: record.update(frame=False),
    "not a number": lambda record: record["keypoints"]["points_2d"][0].__setitem__(0, float("nan")),
    "null for a number": lambda record: record.update(age_years=None),
    "huge": lambda record: record["headset"]["slip"].__setitem__(0, 10**400),
    "huge label": lambda record: record.update(age_years=10**400),
    "huge point": lambda record: record["views"]["mouth"]["points_camera"][0].__setitem__(0, 10**400),
    "huge camera": lambda record: record["views"]["mouth"]["camera"].update(fx=10**400),
    "nested": lambda record: record.update(identity=[[[[[[1.0]]]]]]),
    "views are a list": lambda record: record.update(views=[]),
    "eyes are null": lambda record: record.update(eyes=None),
}


PACKED = {
    *("unknown key", "unknown render key", "render is a list", "render as text", "checksum of nothing"),
    "huge point",
}
"""Edits that packs let through: keys that they do not read, or hand on as they are. All others are refused by all."""


@pytest.mark.parametrize("name", EDITS)
def test_every_edit_of_a_record_is_found_and_no_pack_takes_one_of_another_kind(copy, tmp_path, name):
    edit(copy, EDITS[name])
    assert only(found(copy), SAMPLE) <= {"label", "unreadable", "range", "checksum"}
    for form in ("parquet", "arrays", "coco", "webdataset"):
        result = CliRunner().invoke(app, ["pack", str(copy), "--out", str(tmp_path / form), "--format", form])
        refused = isinstance(result.exception, InvalidData)
        assert refused or result.exception is None, (form, result.exception)
        assert refused != (name in PACKED), form


@pytest.mark.parametrize(
    "content", ["", "[]", "null", "5", '"a"', "[" * 100_000, "{}", '{"a": ' + "9" * 5000 + "}"]
)
def test_a_record_that_is_none_is_found_and_refused(copy, tmp_path, content):
    (copy / SAMPLE / "sample.json").write_text(content)
    assert only(found(copy), SAMPLE) <= {"unreadable", "spec-hash"}
    for command in (
        ["pack", str(copy), "--out", str(tmp_path / "pack")],
        ["develop", str(copy), "--out", str(tmp_path / "developed")],
        ["preview", str(copy), "--out", str(tmp_path / "sheet.png")],
    ):
        assert isinstance(CliRunner().invoke(app, command).exception, InvalidData), command

"""Runs of one spec made apart become one dataset; what does not fit is refused before anything is written."""

import filecmp
import shutil
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InputError, InvalidData
from facegen.spec import parse_spec
from facegen.store import begin, merge, open_dataset, resolve, write_shard
from facegen.work import generate

pytestmark = pytest.mark.usefixtures("anny")

SPEC = {"version": 1, "kind": "still", "seed": 5, "people": 6, "still": {"neutral": 1, "faces": 2}}


def files(folder: Path) -> dict[str, bytes]:
    paths = (p for p in sorted(folder.rglob("*")) if p.is_file())
    return {
        str(p.relative_to(folder)): p.read_bytes() for p in paths if p.relative_to(folder).parts[0] != "logs"
    }


def keypoints(out: Path, **change) -> Path:
    generate(resolve(parse_spec(SPEC | change, where="test"), out), workers=1)
    return out


@pytest.mark.blender
@pytest.mark.slow
@pytest.mark.parametrize("copy", [False, True])
def test_slices_join_to_the_whole(rendered, tmp_path, copy):
    one, two = (Path(shutil.copytree(rendered.folder.path, tmp_path / name)) for name in ("one", "two"))
    shutil.rmtree(one / "renders" / "000" / "000001")
    shutil.rmtree(two / "renders" / "000" / "000000")
    shutil.rmtree(two / "keypoints")
    merged = merge([one, two], tmp_path / "all", copy=copy)
    assert (merged.taken, merged.found) == (3, 0)
    assert files(tmp_path / "all") == files(rendered.folder.path)
    linked = (tmp_path / "all" / "renders/000/000000/mouth.png").stat().st_nlink
    assert linked == (1 if copy else 2)
    again = merge([one, two], tmp_path / "all")
    assert (again.taken, again.found) == (0, 3)
    shutil.rmtree(tmp_path / "all" / "renders")
    assert merge([two], tmp_path / "all").taken == 1
    assert open_dataset(tmp_path / "all").folder.rendered() == [1]


@pytest.mark.blender
@pytest.mark.slow
def test_other_bytes_under_one_name_are_a_conflict_and_nothing_is_written(rendered, tmp_path):
    other = Path(shutil.copytree(rendered.folder.path, tmp_path / "other"))
    path = other / "renders" / "000" / "000001" / "mouth.exr"
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    with pytest.raises(InvalidData, match=r"renders/000/000001: .* hold different bytes"):
        merge([rendered.folder.path, other], tmp_path / "all")
    assert not (tmp_path / "all").exists()


def test_what_systems_leave_beside_samples_is_no_difference_and_links_are_not_read(tmp_path, monkeypatch):
    """Folders of two runs as somebody looked at them; stand-ins for pictures do, as nothing reads them."""
    runs = [keypoints(tmp_path / name) for name in ("one", "two")]
    for run, litter in zip(runs, (".DS_Store", "._mouth.png"), strict=True):
        folder = run / "renders" / "000" / "000003"
        folder.mkdir(parents=True)
        (folder / "mouth.png").write_bytes(b"the same")
        (folder / litter).write_bytes(b"litter")
        (run / "renders" / "000.old" / "000003").mkdir(parents=True)  # moved aside
    merge(runs, tmp_path / "all")
    assert open_dataset(tmp_path / "all").folder.rendered() == [3]
    assert [path.name for path in (tmp_path / "all/renders/000/000003").iterdir()] == ["mouth.png"]
    monkeypatch.setattr(filecmp, "cmp", lambda *_, **__: pytest.fail("a link of the first merge was read"))
    assert merge(runs[:1], tmp_path / "all").taken == 0


def test_a_joined_spec_asks_for_what_any_run_was_asked_for(tmp_path):
    """`render.samples` is no part of a spec's hash: machines render apart by it."""
    runs = []
    for name, samples in (("one", "0-3"), ("two", "4-9,12")):
        dataset = resolve(parse_spec(SPEC | {"render": {"samples": samples}}, where="test"), tmp_path / name)
        generate(dataset, "", shards="0", workers=1)
        runs.append(tmp_path / name)
    merge(runs, tmp_path / "all")
    joined = open_dataset(tmp_path / "all")
    assert list(joined.samples_to_render()) == [*range(10), 12]
    assert joined.hash == open_dataset(runs[0]).hash
    merge(runs, tmp_path / "all")
    assert list(open_dataset(tmp_path / "all").samples_to_render()) == [*range(10), 12]
    alike = merge(runs[:1], tmp_path / "alone")
    assert alike.taken == 1
    assert (tmp_path / "alone/spec.toml").read_bytes() == (runs[0] / "spec.toml").read_bytes()


def test_a_joined_spec_can_be_opened_and_one_that_could_not_is_refused(tmp_path):
    """Numbers written one by one would be longer than what is read of a spec."""
    texts = {"one": "0-17999:10", "two": "3-17999:10"}
    few = {name: ",".join(map(str, range(first, 18_000, 3))) for name, first in (("three", 0), ("four", 1))}
    for name, samples in (texts | few).items():
        table = SPEC | {"people": 6000, "render": {"samples": samples}}
        begin(resolve(parse_spec(table, where="test"), tmp_path / name))
    merge([tmp_path / name for name in texts], tmp_path / "all")
    joined = sorted([*range(0, 18_000, 10), *range(3, 18_000, 10)])
    assert list(open_dataset(tmp_path / "all").samples_to_render()) == joined
    assert open_dataset(tmp_path / "all").spec.render.samples == ",".join(texts.values())
    with pytest.raises(
        InputError, match=r"spec\.toml: would have .* bytes, of which at most 65,536 are read"
    ):
        merge([tmp_path / name for name in few], tmp_path / "more")
    assert not (tmp_path / "more").exists()


def test_other_keypoints_are_a_conflict_and_last_bits_are_none(tmp_path):
    """Processors with AVX-512 and without differ in the last bits of a sine."""
    one, two = keypoints(tmp_path / "one"), keypoints(tmp_path / "two")
    merge([one, two], tmp_path / "all")
    shard = "keypoints/shard-00000.parquet"
    table, number = pq.read_table(two / shard), 15
    assert table.column_names[number] == "camera_from_head"
    poses = table.column(number).combine_chunks()
    for factor, is_same in ((1 + 2**-52, True), (1 + 1e-5, False)):
        values = pa.FixedSizeListArray.from_arrays(poses.flatten().to_numpy() * factor, 16)
        write_shard(table.set_column(number, table.field(number), values), two / shard)
        assert not filecmp.cmp(one / shard, two / shard, shallow=False)
        if is_same:
            assert merge([two], tmp_path / "all").found == 1
            assert filecmp.cmp(one / shard, tmp_path / "all" / shard, shallow=False)
            continue
        with pytest.raises(InvalidData, match=rf"{shard}: .* hold different keypoints"):
            merge([two], tmp_path / "all")
    write_shard(table.slice(0, 4), two / shard)
    with pytest.raises(InvalidData, match=rf"{shard}: .* hold different keypoints"):
        merge([two], tmp_path / "all")


def test_what_is_no_run_of_the_spec_is_refused(tmp_path):
    one, other = keypoints(tmp_path / "one"), keypoints(tmp_path / "other", seed=6)
    with pytest.raises(InputError, match="holds a dataset of another spec"):
        merge([one, other], tmp_path / "all")
    with pytest.raises(InputError, match="holds a dataset of another spec"):
        merge([one], other)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.doc").write_text("mine")
    with pytest.raises(InputError, match="holds no facegen dataset"):
        merge([one], tmp_path / "mine")
    with pytest.raises(InputError, match="nothing to merge"):
        merge([], tmp_path / "all")
    assert not (tmp_path / "all").exists()


def test_the_command_shows_how_far_it_is(tmp_path):
    one = keypoints(tmp_path / "one")
    done = CliRunner().invoke(app, ["merge", str(one), "--out", str(tmp_path / "all")])
    assert done.exit_code == 0, done.output
    assert "shards and rendered samples: 1 of 1" in done.stderr
    assert "1 shard or rendered sample taken over" in done.stdout


def test_a_merge_that_was_killed_at_its_start_goes_on(tmp_path):
    one = keypoints(tmp_path / "one")
    (tmp_path / "all" / "tmp").mkdir(parents=True)
    shutil.copy(one / "spec.toml", tmp_path / "all")
    (tmp_path / "all" / "headset.toml").write_text("mine")
    with pytest.raises(InputError, match=r"headset\.toml: is another"):
        merge([one], tmp_path / "all")
    assert (tmp_path / "all" / "headset.toml").read_text() == "mine"
    (tmp_path / "all" / "headset.toml").unlink()
    assert merge([one], tmp_path / "all").taken == 1


@pytest.mark.parametrize(("option", "links"), [([], 2), (["--copy"], 1)])
def test_files_are_links_unless_copies_are_asked_for(tmp_path, option, links):
    one, two = (keypoints(tmp_path / name) for name in ("one", "two"))
    words = ["merge", str(one), str(two), "--out", str(tmp_path / "all"), *option]
    assert CliRunner().invoke(app, words).exit_code == 0
    (shard,) = (tmp_path / "all" / "keypoints").iterdir()
    assert shard.stat().st_nlink == links
    assert shard.read_bytes() == next((one / "keypoints").iterdir()).read_bytes()

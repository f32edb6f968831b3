"""Runs of one spec made apart become one dataset; what does not fit is refused before anything is written."""

import shutil
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InputError, InvalidData
from facegen.spec import parse_spec
from facegen.store import merge, open_dataset, resolve, write_shard
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


def test_other_keypoints_are_a_conflict(tmp_path):
    one, two = keypoints(tmp_path / "one"), keypoints(tmp_path / "two")
    merge([one, two], tmp_path / "all")
    shard = "keypoints/shard-00000.parquet"
    table = pq.read_table(two / shard)
    write_shard(table.slice(0, 4), two / shard)
    with pytest.raises(InvalidData, match=rf"{shard}: .* hold different bytes"):
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
    assert merge([one], tmp_path / "all").taken == 1

"""People of one dataset have several rigs, and each is as a dataset of that rig alone has them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from facegen.errors import InputError
from facegen.packing import Options, plan_pack, write_pack
from facegen.packing.arrays import array_parts
from facegen.rigs import Rig, load_rig
from facegen.rigs.building import add_rig
from facegen.sampling import plan_dataset, rig_of
from facegen.spec import parse_spec, shares_of, spec_hash, spec_table
from facegen.store import Dataset, begin, column_array, draw_block, label_block, resolve, write_shard
from facegen.validation.keypoints import check_shard
from tests.facegen.rigs.glb_head import write_head

TABLE = {"version": 1, "kind": "still", "seed": 4, "people": 60, "still": {"neutral": 1, "faces": 4}}
SHARES = {"head": 2, "anny": 3}


@pytest.fixture(scope="module")
def head(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> Rig:
    """A user's glTF head, without identities."""
    folder = tmp_path_factory.mktemp("head")
    add_rig(*write_head(anny, folder, lids=True), folder=folder)
    return load_rig("head", folder)


@pytest.fixture(scope="module")
def datasets(anny: Rig, head: Rig, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Dataset]:
    """The same spec with each rig alone, and with both."""
    alone = resolve(parse_spec(TABLE, where="test"), tmp_path_factory.mktemp("several") / "anny")
    mixed = plan_dataset(parse_spec(TABLE | {"rig": SHARES}, where="test"))
    return {
        "anny": alone,
        "head": replace(alone, rigs=(head,)),
        "both": replace(alone, rigs=(anny, head), plan=mixed),
    }


def test_labels_are_those_of_a_dataset_of_the_rig_alone(datasets: dict[str, Dataset]) -> None:
    made = {name: label_block(of, 0, draw_block(of, 0)) for name, of in datasets.items()}
    both = made["both"]
    whose = np.array(both["rig"].to_pylist())
    assert both.schema.equals(datasets["both"].keypoint_schema, check_metadata=True)
    assert {"anny", "head"} == set(whose)
    for name in ("anny", "head"):
        rows = np.flatnonzero(whose == name)
        for column in made["anny"].column_names:
            mine, own = column_array(both, column)[rows], column_array(made[name], column)[rows]
            if column == "identity":
                mine, rest = np.split(mine, [own.shape[1]], axis=1)
                assert not rest.any()
            np.testing.assert_array_equal(mine, own, err_msg=column)
        assert all(datasets["both"].rig_of(int(row)).name == name for row in rows)


def test_people_keep_their_rig_whoever_else_there_is(datasets: dict[str, Dataset]) -> None:
    spec = datasets["both"].spec
    person = np.arange(20_000)
    whose = rig_of(spec, person)
    assert abs(whose.mean() - 0.4) < 0.01  # three standard deviations are 0.0104
    np.testing.assert_array_equal(rig_of(spec, person[7::13]), whose[7::13])
    np.testing.assert_array_equal(rig_of(replace(spec, people=7), person), whose)
    assert not rig_of(datasets["anny"].spec, person).any()


def test_validation_knows_whose_rig_is_whose(datasets: dict[str, Dataset], tmp_path: Path) -> None:
    both = replace(datasets["both"], folder=type(datasets["both"].folder)(tmp_path))
    made = label_block(both, 0, draw_block(both, 0))
    path = both.folder.shard(0)
    path.parent.mkdir(parents=True)
    write_shard(made, path)
    assert not list(check_shard(both, 0))
    place = made.schema.get_field_index("rig")
    names = pa.array(["anny"] * len(made))
    write_shard(made.set_column(place, made.schema.field(place), names), path)
    assert [finding.what[:4] for finding in check_shard(both, 0)] == ["rig "]


def test_a_pack_names_the_rigs_and_their_licences(datasets: dict[str, Dataset], tmp_path: Path) -> None:
    both = replace(datasets["both"], folder=type(datasets["both"].folder)(tmp_path / "both"))
    begin(both)
    both.folder.shard(0).parent.mkdir(parents=True)
    write_shard(label_block(both, 0, draw_block(both, 0)), both.folder.shard(0))
    write_pack(plan_pack(both, "keypoints"), tmp_path / "pack")
    tables = [pq.read_table(path) for path in sorted((tmp_path / "pack").glob("*.parquet"))]
    packed = pa.concat_tables(tables).sort_by("sample")
    assert packed["rig"].to_pylist() == [both.rig_of(sample).name for sample in range(300)]
    card = (tmp_path / "pack" / "README.md").read_text(encoding="utf-8")
    for sentence in (
        "# Synthetic face keypoints (anny, head)",
        "The heads of 60% of the people come from the rig 'anny'",
        "The heads of 40% of the people come from the rig 'head'",
        "license: cc0-1.0",  # of both
        "the rig 'anny': CC0-1.0 and the rig 'head': CC0-1.0",
    ):
        assert sentence in card
    with pytest.raises(InputError, match="takes a dataset of one"):
        array_parts(both, range(2), Options())


def test_what_takes_one_rig_says_so(datasets: dict[str, Dataset]) -> None:
    with pytest.raises(InputError, match=r"several rigs \(anny, head\)"):
        _ = datasets["both"].rig
    assert datasets["head"].rig.name == "head"


def test_a_table_of_rigs_goes_through_toml_and_its_order_does_not_matter() -> None:
    spec = parse_spec(TABLE | {"rig": SHARES}, where="test")
    turned = parse_spec(TABLE | {"rig": dict(reversed(SHARES.items()))}, where="test")
    assert shares_of(spec.rig) == {"anny": 0.6, "head": 0.4}
    assert spec == turned == parse_spec(spec_table(spec), where="test")
    assert hash(spec) == hash(turned)
    assert spec_hash(spec, asset_sha256={}) == spec_hash(turned, asset_sha256={})
    assert spec_hash(spec, asset_sha256={}) != spec_hash(replace(spec, rig="anny"), asset_sha256={})


@pytest.mark.parametrize(
    "rig",
    [
        {},
        {"anny": 1},
        {"anny": 0, "ict": 1},
        {"anny": True, "ict": 1},
        {"anny": "1", "ict": 1},
        {"anny": 1001, "ict": 1},
        {f"rig{number}": 1 for number in range(9)},
        ["anny"],
        3,
    ],
)
def test_other_tables_are_refused(rig: object) -> None:
    with pytest.raises(
        InputError, match=r"^x: rig.*(2 to 8 names with shares|must be a number above 0, up to 1000)"
    ):
        parse_spec(TABLE | {"rig": rig}, where="x")

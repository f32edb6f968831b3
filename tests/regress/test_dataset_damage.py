"""Datasets from strangers: what `regress train`, `evaluate` and `report` read of them is refused in one sentence."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from regress.errors import InputError
from regress.learning.probes.faces import read_faces
from regress.learning.training import read_dataset
from tests.regress.conftest import write_dataset
from tests.regress.drawn import drawn_dataset, drawn_heads

Damage = Callable[[Path], Any]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A dataset of ten people, with all that a report reads of it."""
    dataset, more = drawn_heads(np.random.default_rng(5), people=10)
    write_dataset(dataset, tmp_path / "drawn", more=more)
    return tmp_path / "drawn"


def description(text: str) -> Damage:
    return lambda folder: (folder / "dataset.json").write_bytes(text.encode("latin-1"))


def shard(change: Callable[[pa.Table], pa.Table], *, all_of_them: bool = True) -> Damage:
    def damage(folder: Path) -> None:
        for path in sorted((folder / "keypoints").glob("*"))[: None if all_of_them else 1]:
            pq.write_table(change(pq.read_table(path)), path)

    return damage


def column(name: str, values: Callable[[pa.ChunkedArray], Any], *, all_of_them: bool = True) -> Damage:
    return shard(
        lambda table: table.set_column(table.column_names.index(name), name, values(table[name])),
        all_of_them=all_of_them,
    )


def numbers(change: Callable[[np.ndarray], Any]) -> Callable[[pa.ChunkedArray], pa.Array]:
    def values(column: pa.ChunkedArray) -> pa.Array:
        array = column.combine_chunks().flatten().to_numpy().reshape(len(column), -1).copy()
        array = array if (changed := change(array)) is None else changed
        return pa.FixedSizeListArray.from_arrays(pa.array(array.ravel()), array.shape[1])

    return values


def put(value: float) -> Callable[[np.ndarray], None]:
    return lambda array: array.__setitem__((0, 3), value)


def on_one_point(array: np.ndarray) -> None:
    array[0] = 7


DAMAGES: dict[str, Damage] = {
    **{
        f"dataset.json of {text[:9]}": description(text)
        for text in ("[]", "null", "5", '"x"', "{", "[" * 100_000, '{"a": ' + "1" * 5000 + "}", "\xff")
    },
    "a hash of a number": description('{"spec_hash": 5}'),
    "a licence with half of a character": description(json.dumps({"licence": "\ud800"})),
    "a rig that is not finite": description('{"rig": {"size": NaN}}'),
    "no weights": shard(lambda table: table.drop_columns(["weights"])),
    "weights of 51": column("weights", numbers(lambda array: array[:, :51])),
    "weights of whole numbers": column("weights", numbers(lambda array: array.astype(int))),
    "weights of single numbers": column("weights", lambda values: pa.array([0.5] * len(values))),
    "weights that are missing": column(
        "weights", lambda values: pa.array([None] * len(values), pa.list_(pa.float32(), 52))
    ),
    "weights that are none": column("weights", numbers(put(np.nan))),
    "weights beyond all": column("weights", numbers(put(np.inf))),
    "weights of 1e30": column("weights", numbers(put(1e30))),
    "one shard of other columns": column("weights", numbers(lambda array: array[:, :51]), all_of_them=False),
    "people of words": column("person", lambda values: pa.array(["x"] * len(values))),
    "people who are missing": column("person", lambda values: pa.array([None] * len(values), pa.int64())),
    "people of fractions": column("person", lambda values: pa.array([0.5] * len(values))),
    "neutral of words": column("neutral", lambda values: pa.array(["no"] * len(values))),
    "neutral that is missing": column("neutral", lambda values: pa.array([None] * len(values), pa.bool_())),
    "splits of numbers": column("split", lambda values: pa.array([1] * len(values))),
    "splits that are missing": column("split", lambda values: pa.array([None] * len(values), pa.string())),
    "splits of bytes": column("split", lambda values: pa.array([b"\xff"] * len(values))),
    "a split of a megabyte": column("split", lambda values: pa.array(["x" * 10**6] * len(values))),
    "splits that are another's": column("split", lambda values: pa.array(["mine"] * len(values))),
    "no rows": shard(lambda table: table.slice(0, 0)),
    "more rows than a shard has": shard(lambda table: pa.concat_tables([table] * 600)),
    "a shard that is none": lambda folder: (folder / "keypoints" / "shard-00001.parquet").write_bytes(
        b"PAR1"
    ),
    "a shard that is a folder": lambda folder: (folder / "keypoints" / "shard-9.parquet").mkdir(),
}

POINTS: dict[str, Damage] = {
    "a face on one point": column("detected_2d", numbers(on_one_point)),
    "a point that is none": column("detected_2d", numbers(put(np.nan))),
    "a point beyond all": column("detected_2d", numbers(put(-np.inf))),
    "no face at all": column("detected_2d", numbers(lambda array: array * np.nan)),
}
"""Of what only training and evaluating read."""


@pytest.mark.parametrize("damage", {**DAMAGES, **POINTS})
def test_damaged_datasets_are_refused_in_one_sentence(folder: Path, damage: str):
    {**DAMAGES, **POINTS}[damage](folder)
    with pytest.raises(InputError) as caught:
        read_dataset(folder)
    assert "\n" not in str(caught.value)
    assert "drawn" in str(caught.value)
    assert len(str(caught.value)) < 800


@pytest.mark.parametrize("damage", [name for name in DAMAGES if "shard" in name or "weights" in name])
def test_damaged_datasets_are_refused_for_a_report(folder: Path, damage: str):
    DAMAGES[damage](folder)
    with pytest.raises(InputError) as caught:
        read_faces(folder)
    assert "\n" not in str(caught.value)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_shards_with_changed_bytes_are_refused_or_read(tmp_path: Path, data: st.DataObject):
    folder = tmp_path / "drawn"
    if not folder.exists():
        write_dataset(drawn_dataset(np.random.default_rng(5), people=10), folder)
        shutil.copytree(folder, tmp_path / "whole")
    path = folder / "keypoints" / "shard-00000.parquet"
    content = bytearray((tmp_path / "whole" / "keypoints" / path.name).read_bytes())
    end = data.draw(st.booleans())  # the footer has the claims
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(max(0, len(content) - 3000) if end else 0, len(content) - 1))
        content[place] = data.draw(st.integers(0, 255))
    path.write_bytes(content)
    try:
        dataset = read_dataset(folder)
    except InputError as error:
        said = str(error)
    else:
        said = ""
        assert len(dataset.weights) == len(dataset.points) == len(dataset.split)
    assert "\n" not in said

"""A small dataset on disk and a model trained on it in a second, for all tests of regress."""

import json
import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import regress.cli
from regress.learning.training import KeypointDataset, Recipe, train
from regress.runtime.model import Model, save_model
from tests.regress.drawn import drawn_dataset

QUICK = Recipe(name="default", alphas=(0.3, 3.0), steps=8, search_rows=150, hidden=6)
QUICK_STABLE = replace(
    QUICK,
    calibrated_alignment="stable",
    calibrated_whitening=0.5,
    calibrated_linear=0.3,
    calibrated_gain=True,
    symmetric=True,
)
"""As the default recipe's: networks that compare see points."""


@pytest.fixture(scope="session")
def real() -> Path:
    """Folder of real recordings, which the project may not carry; FACEGEN_REAL says where else it lies."""
    folder = Path(os.environ.get("FACEGEN_REAL", Path(__file__).parents[3] / "shared" / "real"))
    if not folder.is_dir():
        pytest.skip(f"no real recordings in {folder}; FACEGEN_REAL names another folder")
    return folder


@pytest.fixture(scope="session")
def dataset() -> KeypointDataset:
    return drawn_dataset(np.random.default_rng(5), people=80)


@pytest.fixture(scope="session")
def dataset_folder(dataset: KeypointDataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data") / "drawn"
    write_dataset(dataset, folder)
    return folder


@pytest.fixture(scope="session")
def quick_model(dataset: KeypointDataset) -> Model:
    return train(dataset, QUICK, seed=3)


@pytest.fixture(scope="session")
def stable_model(dataset: KeypointDataset) -> Model:
    return train(dataset, QUICK_STABLE)


@pytest.fixture(scope="session")
def quick_model_folder(quick_model: Model, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("models") / "quick"
    save_model(quick_model, folder)
    return folder


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    """Run the program as its console script would; gives exit code, standard output and standard error."""

    def call(*arguments: object) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["regress", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            regress.cli.main()
        said = capsys.readouterr()
        return int(left.value.code or 0), said.out, said.err

    return call


def write_dataset(
    dataset: KeypointDataset,
    folder: Path,
    *,
    without: tuple[str, ...] = (),
    more: dict[str, np.ndarray] | None = None,
) -> None:
    """Write what regress reads of a facegen dataset, in two shards; ``more`` columns hold lists of numbers."""

    def lists(values: np.ndarray) -> pa.Array:
        flat = values.reshape(len(values), -1).astype(np.float32)
        return pa.FixedSizeListArray.from_arrays(pa.array(flat.ravel()), flat.shape[1])

    columns = {
        "sample": np.arange(len(dataset.split)),
        "person": dataset.person,
        "neutral": dataset.neutral,
        "split": pa.array(dataset.split.tolist()),
        "weights": lists(dataset.weights),
        "detected_2d": lists(dataset.points),
        **{name: lists(values) for name, values in (more or {}).items()},
    }
    table = pa.table({name: values for name, values in columns.items() if name not in without})
    (folder / "keypoints").mkdir(parents=True)
    half = len(table) // 2
    pq.write_table(table.slice(0, half), folder / "keypoints" / "shard-00000.parquet")
    pq.write_table(table.slice(half), folder / "keypoints" / "shard-00001.parquet")
    (folder / "dataset.json").write_text(json.dumps({"spec_hash": "abc", "licence": "CC0-1.0"}))

"""A dataset with pictures that tests of several packages share; they copy what they change."""

from pathlib import Path

import pytest

from facegen.spec import load_spec
from facegen.store import Dataset, resolve
from facegen.work import generate

TINY = Path(__file__).resolve().parents[2] / "datasets" / "tiny.toml"


@pytest.fixture(scope="session")
def rendered(anny, tmp_path_factory) -> Dataset:
    """``datasets/tiny.toml`` made in full: one shard, samples 0 and 1 rendered at 96 px by three cameras."""
    dataset = resolve(load_spec(TINY), tmp_path_factory.mktemp("rendered") / "tiny")
    assert generate(dataset, workers=1).left == 0
    return dataset

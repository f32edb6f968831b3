"""A dataset with pictures that tests of several packages share; they copy what they change."""

from pathlib import Path

import pytest

from facegen.spec import load_spec, parse_spec
from facegen.store import Dataset, resolve
from facegen.work import generate

TINY = Path(__file__).resolve().parents[2] / "datasets" / "tiny.toml"


@pytest.fixture(scope="session")
def rendered(anny, tmp_path_factory) -> Dataset:
    """``datasets/tiny.toml`` made in full: one shard, samples 0 and 1 rendered at 96 px by three cameras."""
    dataset = resolve(load_spec(TINY), tmp_path_factory.mktemp("rendered") / "tiny")
    assert generate(dataset, workers=1).left == 0
    return dataset


@pytest.fixture(scope="session")
def recorded(anny, tmp_path_factory) -> Dataset:
    """Two people in clips: 2 s neutral, two expressions and a sentence of 2 s each at 30 fps; keypoints alone."""
    clips = {name: {"count": 1, "seconds": 2.0} for name in ("neutral", "sentence")}
    table = {"version": 1, "kind": "sequence", "seed": 5, "people": 2, "split_shares": [0.5, 0.5, 0.0]}
    table["sequence"] = clips | {"peak": {"count": 2, "seconds": 2.0}}
    table["landmarks"] = {"dropped": 0.1, "bias": 1.0}
    dataset = resolve(parse_spec(table, where="test"), tmp_path_factory.mktemp("recorded") / "clips")
    assert generate(dataset, workers=1).left == 0
    return dataset

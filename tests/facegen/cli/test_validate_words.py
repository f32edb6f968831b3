"""What `facegen validate` says of a dataset that is not whole."""

from types import SimpleNamespace

import pytest

from facegen.cli.validate import _missing
from facegen.validation.repair import Repair


@pytest.mark.parametrize(
    ("removed", "samples", "said"),
    [
        (("renders/.DS_Store",), "", "rendered samples 1 are missing"),
        (("keypoints/shard-00000.parquet",), "", "keypoint shards were removed"),
        (
            ("keypoints/shard-00000.parquet", "renders/000/000002"),
            "2",
            "rendered samples were removed (generate --samples 2), keypoint shards were removed",
        ),
    ],
)
def test_only_what_was_removed_is_called_removed(removed: tuple[str, ...], samples: str, said: str):
    verdict = SimpleNamespace(missing_shards="", missing_renders="1")
    words = _missing(verdict, Repair(removed=removed, samples=samples))
    assert words.endswith(said)
    assert ("shards were removed" in words) == any("shard-" in place for place in removed)

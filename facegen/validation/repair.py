"""Removes what is invalid (``validate --repair``), so that `generate` makes it again, byte for byte."""

import re
import shutil
from dataclasses import dataclass

from facegen.errors import InvalidData
from facegen.files import output_errors
from facegen.spec import format_ranges
from facegen.store import Dataset, staging
from facegen.validation.verdict import Verdict

MANY = 10
"""Up to so many things may all be removed; beyond, at most half: see `repair`."""

_RENDER = re.compile(r"renders/\d+/(\d+)")


@dataclass(frozen=True, kw_only=True)
class Repair:
    """What was removed, below the dataset's folder, and which rendered samples of the dataset these were."""

    removed: tuple[str, ...]
    samples: str


def repair(dataset: Dataset, verdict: Verdict) -> Repair:
    """Remove every shard, rendered sample and extra that a verdict calls invalid.

    Each is renamed into ``tmp/`` first and deleted there, so that none is ever seen in part. Nothing outside
    ``keypoints/`` and ``renders/`` is touched.

    Raises
    ------
    InvalidData
        If that were more than half of a dataset: so much does not rot. Then labels are made another way here
        than where the dataset was made, and removing weeks of pictures for it would be wrong.
    OutputError
        If the folder cannot be written.
    """
    things = verdict.shards + verdict.renders
    extras = {finding.remove for finding in verdict.findings if finding.kind.startswith("extra-")}
    damaged = [place for place in verdict.invalid if place not in extras]
    if len(damaged) > MANY and 2 * len(damaged) > things:
        raise InvalidData(
            f"{dataset.folder.path}: {len(damaged)} of {things} shards and samples are invalid, too many "
            "for damage, so nothing was removed; was it made by another facegen? To make all of it again, "
            "delete the folder"
        )
    removed = []
    with staging(dataset.folder, "repair") as stage, output_errors(dataset.folder.path):
        for number, place in enumerate(verdict.invalid):
            path = dataset.folder.path / place
            if not path.exists() and not path.is_symlink():
                continue  # within a folder that went before it, or another repair was faster
            path.rename(stage / str(number))
            removed.append(place)
            if (stage / str(number)).is_dir() and not (stage / str(number)).is_symlink():
                shutil.rmtree(stage / str(number))
    matches = (_RENDER.fullmatch(place) for place in removed)
    numbers = sorted(int(match[1]) for match in matches if match and match[0] not in extras)
    return Repair(removed=tuple(removed), samples=format_ranges(numbers))

"""Lists a dataset's folder: shards and rendered samples of the spec, and files that do not belong there.

``keypoints/`` and ``renders/`` hold what facegen makes and nothing else, because readers list them; a user's
own files may lie anywhere else in the folder.
"""

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from facegen.console import counted
from facegen.formats.litter import is_litter
from facegen.store import Dataset
from facegen.validation.finding import Finding

_SHARD = re.compile(r"shard-([0-9]{5,15})\.parquet")


@dataclass(frozen=True, kw_only=True)
class Listing:
    """Numbers of the shards and rendered samples that belong there, in order, and everything else."""

    shards: tuple[int, ...]
    renders: tuple[int, ...]
    extras: tuple[Finding, ...]


def list_dataset(dataset: Dataset) -> Listing:
    """Look at the names in a dataset's folder; opens no file."""
    shards: list[int] = []
    renders: list[int] = []
    extras: list[Finding] = []
    for entry in _entries(dataset.folder.path / "keypoints"):
        extra = _shard_or_extra(dataset, entry, shards)
        extras.extend(() if extra is None else (extra,))
    for group in _entries(dataset.folder.path / "renders"):
        if not group.is_dir():
            extras.append(_extra(dataset, group, "is no folder of rendered samples", kind="extra-file"))
            continue
        for entry in _entries(group):
            extra = _render_or_extra(dataset, entry, renders)
            extras.extend(() if extra is None else (extra,))
    return Listing(shards=tuple(sorted(shards)), renders=tuple(sorted(renders)), extras=tuple(sorted(extras)))


def _shard_or_extra(dataset: Dataset, entry: Path, shards: list[int]) -> Finding | None:
    match = _SHARD.fullmatch(entry.name)
    if match is None or dataset.folder.shard(int(match[1])) != entry or not entry.is_file():
        return _extra(dataset, entry, "is no keypoint shard", kind="extra-file")
    if int(match[1]) >= dataset.shards:
        held = f"{counted(dataset.plan.samples, 'sample')} in {counted(dataset.shards, 'shard')}"
        what = f"is a shard beyond the dataset, which has {held}"
        return _extra(dataset, entry, what, kind="extra-shard")
    shards.append(int(match[1]))
    return None


def _render_or_extra(dataset: Dataset, entry: Path, renders: list[int]) -> Finding | None:
    if not (entry.name.isascii() and entry.name.isdigit() and entry.is_dir()):
        return _extra(dataset, entry, "is no rendered sample", kind="extra-file")
    number = int(entry.name)
    if number >= dataset.plan.samples:
        what = f"is a sample beyond the dataset, which has samples 0-{dataset.plan.samples - 1}"
        return _extra(dataset, entry, what, kind="extra-sample")
    if dataset.folder.render(number) != entry:
        proper = dataset.folder.render(number).relative_to(dataset.folder.path)
        what = f"is not where sample {number} belongs: {proper}"
        return _extra(dataset, entry, what, kind="extra-sample")
    renders.append(number)
    return None


def _extra(dataset: Dataset, path: Path, what: str, *, kind: str) -> Finding:
    where = path.relative_to(dataset.folder.path).as_posix()
    return Finding(where, what, kind, remove=where)


def _entries(folder: Path) -> Iterator[Path]:
    try:
        with os.scandir(folder) as entries:
            for entry in entries:
                if not is_litter(entry.name):
                    yield Path(entry.path)
    except FileNotFoundError:
        return  # nothing was made yet

"""Plans a pack: which samples it holds, in which files."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.conventions import SHARD_ROWS, SPLITS
from facegen.errors import InputError
from facegen.spec import without
from facegen.store import Dataset, shards_of


@dataclass(frozen=True, kw_only=True)
class Options:
    """What a user may choose; None is the format's own choice.

    Attributes
    ----------
    samples
        Sample numbers as ranges, ``"0-99,140"``.
    split
        One of `facegen.conventions.SPLITS`.
    shard_size
        Samples a file.
    views
        Names of cameras.
    columns
        Names of columns.
    exr
        Whether the EXR files go in.
    """

    samples: str | None = None
    split: str | None = None
    shard_size: int | None = None
    views: tuple[str, ...] | None = None
    columns: tuple[str, ...] | None = None
    exr: bool | None = None


@dataclass(frozen=True, kw_only=True)
class PackFile:
    """One file of a pack: its name, its samples and, where a format has a file a view, the view."""

    name: str
    samples: Sequence[int]
    view: str | None = None


@dataclass(frozen=True, kw_only=True)
class PackFormat:
    """One way to pack.

    Attributes
    ----------
    description
        A sentence for ``--help`` and the docs.
    rendered
        Whether it packs rendered samples; otherwise it packs the keypoints of all samples.
    options
        Names of the fields of `Options` that it takes, beside ``samples`` and ``split``.
    shard_size
        Samples a file, unless the user chooses.
    parts
        Cuts sample numbers into files.
    write
        Writes one file to a path; equal input gives equal bytes.
    version
        Of the bytes: a change of what equal input gives raises it, so that no pack is half old and half new.
    carded
        Whether a card and Croissant metadata go along, for files that are named after their split.
    """

    description: str
    rendered: bool
    options: frozenset[str]
    shard_size: int
    parts: Callable[[Dataset, Sequence[int], Options], list[PackFile]]
    write: Callable[[Dataset, PackFile, Options, Path], None]
    version: int = 1
    carded: bool = False


def shards(name: str) -> Callable[[Dataset, Sequence[int], Options], list[PackFile]]:
    """Cuts samples into files of ``shard_size``, named by ``name`` (``"shard-{:06d}.tar"``)."""

    def cut(_dataset: Dataset, samples: Sequence[int], options: Options) -> list[PackFile]:
        size = options.shard_size
        starts = range(0, len(samples), size)
        return [
            PackFile(name=name.format(i), samples=samples[start : start + size])
            for i, start in enumerate(starts)
        ]

    return cut


def split_shards(dataset: Dataset, samples: Sequence[int], options: Options) -> list[PackFile]:
    """Cuts the samples of each split into Parquet files of ``shard_size``: ``train-000000.parquet``."""
    parts: list[PackFile] = []
    for split in SPLITS:
        parts += shards(f"{split}-{{:06d}}.parquet")(dataset, _of_split(dataset, samples, split), options)
    return parts


def chosen_samples(dataset: Dataset, options: Options, *, rendered: bool) -> Sequence[int]:
    """Sorted numbers of the samples to pack.

    Without ``samples`` these are all that are there, and none that the spec asks for may be missing: a pack
    cut short by mistake looks like any other.

    Raises
    ------
    InputError
        If samples are missing, or nothing is left to pack.
    InvalidData
        If a shard that tells the split is damaged.
    """
    if rendered:
        rendered_samples = dataset.folder.rendered()
        asked = dataset.samples_to_render(options.samples)
        numbers: Sequence[int] = asked if options.samples is not None else rendered_samples
        missing = without(asked, rendered_samples)
        if missing:
            raise InputError(
                f"{dataset.folder.path}: {sum(map(len, missing))} of the rendered samples to pack are missing, the "
                f"first is sample {missing[0][0]}; make them with facegen generate, or choose with --samples"
            )
    else:
        if options.samples is None:
            numbers, needed = range(dataset.plan.samples), range(dataset.shards)
        else:
            numbers = dataset.samples_to_render(options.samples)
            needed = shards_of(numbers)
        absent = next((path for path in map(dataset.folder.shard, needed) if not path.is_file()), None)
        if absent is not None:
            raise InputError(f"{absent}: is missing; make it with facegen generate")
    if options.split is not None:
        numbers = _of_split(dataset, numbers, options.split)
    if not len(numbers):
        chosen = [f"--{key}" for key in ("samples", "split") if getattr(options, key) is not None]
        cure = f"no sample is that of {' and '.join(chosen)}" if chosen else "generate --samples renders some"
        raise InputError(f"{dataset.folder.path}: has nothing to pack; {cure}")
    return numbers


def _of_split(dataset: Dataset, numbers: Sequence[int], split: str) -> list[int]:
    if split not in SPLITS:
        raise InputError(f"--split: {split!r} is none of {', '.join(SPLITS)}")
    kept: list[int] = []
    chosen = np.asarray(numbers, np.int64)
    for shard in np.unique(chosen // SHARD_ROWS):
        path = dataset.folder.shard(int(shard))
        if not path.is_file():
            raise InputError(
                f"{path}: is missing, so the split of its samples is unknown; run facegen generate"
            )
        splits = dataset.read_shard(path, ["split"]).column("split").to_numpy(zero_copy_only=False)
        inside = chosen[chosen // SHARD_ROWS == shard]
        kept += inside[splits[inside % SHARD_ROWS] == split].tolist()
    return kept

"""Joins runs of one spec that were made apart, on other disks or machines, to one dataset."""

import filecmp
import os
import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from facegen.errors import InputError, InvalidData
from facegen.files import output_errors
from facegen.formats.litter import is_litter
from facegen.number_ranges import format_ranges
from facegen.store.beginning import begin, check_replaceable, spec_text
from facegen.store.dataset import Dataset
from facegen.store.description import read_description
from facegen.store.folder import DatasetFolder, commit_file, commit_folder
from facegen.store.likeness import same_labels
from facegen.store.opening import open_dataset, resolve
from facegen.store.stage import staging, sweep
from facegen.store.versions import check_renderers

_FIRST_THINGS = ("tmp", "spec.toml", "headset.toml", "recording.csv")
"""What a merge leaves if it is killed before ``dataset.json``."""


@dataclass(frozen=True, kw_only=True)
class Merged:
    """What `merge` did: shards and rendered samples taken over, and those found there already, equal."""

    taken: int
    found: int


def merge(
    sources: Sequence[str | Path],
    out: str | Path,
    *,
    copy: bool = False,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> Merged:
    """Join datasets of one spec; run it again after a stop and it goes on.

    All that lies in several of them is compared first, pictures byte by byte and keypoints by their values, whose last
    bits processors make; only then is anything taken over. Logs and quarantines stay where they are: what failed in one
    run may be whole in another.

    Parameters
    ----------
    sources
        Folders of datasets.
    out
        Folder of the joined dataset; new, or a dataset of the same spec.
    copy
        Copy files. Otherwise they become hard links where the file system allows it: they take no space, but
        a file changed in place changes in both datasets (facegen never does that).
    on_progress
        Takes the number of things taken over or found, and how many there are.

    Raises
    ------
    InputError
        If there is no dataset, or one of another spec, if pictures are of two versions of Blender, or if together they
        ask for samples in more ranges than a spec takes.
    InvalidData
        If two datasets hold different keypoints or pictures under one name, or keypoints cannot be read.
    OutputError
        If the folder cannot be written.
    """
    # what has pictures comes first, whose Blender the description names that is taken over
    datasets = sorted(map(open_dataset, sources), key=lambda dataset: not dataset.folder.rendered())
    if not datasets:
        raise InputError("merge: there is nothing to merge; give the folders of datasets")
    first, target = datasets[0], DatasetFolder(Path(out))
    for dataset in datasets[1:]:
        _check_spec(first, dataset.folder, dataset.hash)
    if target.dataset_json.is_file():
        _check_spec(first, target, read_description(target)["spec_hash"])
        datasets.insert(0, open_dataset(out))
    elif target.path.is_dir() and any(
        entry.name not in _FIRST_THINGS and not is_litter(entry.name) for entry in target.path.iterdir()
    ):
        raise InputError(f"{target.path}: is not empty and holds no facegen dataset; choose another folder")
    else:
        _check_first_files(first.folder, target)
    pictured = [dataset for dataset in datasets if dataset.folder.rendered()]
    begun = datasets[:1] if target.dataset_json.is_file() and pictured else []
    check_renderers([*begun, *pictured])
    joined = _asking_for_all(datasets, target)
    origins, doubles = _origins(datasets)
    for name, one, other in doubles:
        if not _equal(one.path / name, other.path / name):
            raise InvalidData(
                f"{name}: {one.path} and {other.path} hold different {_kind(one.path / name)}; facegen validate says "
                "whether one is damaged, and pictures may differ where processors or versions of Blender do: remove one"
            )
    with output_errors(target.path):
        target.path.mkdir(parents=True, exist_ok=True)
    sweep(target)
    _take_description(first.folder, target)
    if joined is not None:
        begin(joined)
    taken = 0
    for done, (name, origin) in enumerate(origins.items()):
        if origin.path != target.path:
            _take(origin.path / name, target, name, copy=copy)
            taken += 1
        on_progress(done + 1, len(origins))
    return Merged(taken=taken, found=len(origins) - taken)


def _asking_for_all(datasets: Sequence[Dataset], target: DatasetFolder) -> Dataset | None:
    """The dataset that asks for what any of them asks for; None where all ask for the same.

    Otherwise runs of which one stopped early would pass as whole.
    """
    if len({format_ranges(dataset.samples_to_render()) for dataset in datasets}) == 1:
        return None
    spec, asked = datasets[0].spec, [dataset.spec.render.samples.split(",") for dataset in datasets]
    wanted = sorted(set().union(*(dataset.samples_to_render() for dataset in datasets)))
    # every tenth number and every tenth beside it are two short ranges, and many numbers
    samples = min(format_ranges(wanted), ",".join(dict.fromkeys(chain.from_iterable(asked))), key=len)
    joined = resolve(replace(spec, render=replace(spec.render, samples=samples)), target.path)
    spec_text(joined)  # refused before anything is written where it gets too long
    return joined


def _check_first_files(source: DatasetFolder, target: DatasetFolder) -> None:
    """See that nothing of a person's is replaced where no dataset is begun yet."""
    with output_errors(target.path):
        for path in _first_files(source):
            there = target.path / path.name
            if path.is_file() and os.path.lexists(there):
                check_replaceable(there, there.is_file() and _same(path, there))


def _first_files(folder: DatasetFolder) -> tuple[Path, ...]:
    """What a dataset is made of, in the order in which it appears."""
    return folder.recording_csv, folder.headset_toml, folder.spec_toml


def _check_spec(first: Dataset, folder: DatasetFolder, found: str) -> None:
    if found != first.hash:
        raise InputError(
            f"{folder.path}: holds a dataset of another spec (its hash is {found[:12]}) than "
            f"{first.folder.path} ({first.hash[:12]}); only runs of one spec can be merged"
        )


def _origins(
    datasets: list[Dataset],
) -> tuple[dict[str, DatasetFolder], list[tuple[str, DatasetFolder, DatasetFolder]]]:
    """Where each shard and rendered sample comes from, and what lies in two datasets."""
    origins: dict[str, DatasetFolder] = {}
    doubles = []
    for dataset in datasets:
        for name in _names(dataset.folder):
            if name in origins:
                doubles.append((name, origins[name], dataset.folder))
            origins.setdefault(name, dataset.folder)
    return origins, doubles


def _names(folder: DatasetFolder) -> Iterator[str]:
    for path in folder.shards():
        yield path.relative_to(folder.path).as_posix()
    for number in folder.rendered():
        yield folder.render(number).relative_to(folder.path).as_posix()


def _equal(one: Path, other: Path) -> bool:
    if one.is_file() or other.is_file():
        return one.is_file() and other.is_file() and (_same(one, other) or same_labels(one, other))
    names, others = (sorted(entry.name for entry in _own(folder)) for folder in (one, other))
    return names == others and all(_same(one / name, other / name) for name in names)


def _kind(path: Path) -> str:
    return "keypoints" if path.is_file() else "bytes"


def _same(one: Path, other: Path) -> bool:
    """Whether two files hold the same; a link that an earlier merge has made is not read."""
    return os.path.samefile(one, other) or filecmp.cmp(one, other, shallow=False)


def _own(folder: Path) -> Iterator[Path]:
    return (entry for entry in folder.iterdir() if not is_litter(entry.name))


def _take(source: Path, target: DatasetFolder, name: str, *, copy: bool) -> None:
    with staging(target, "merge") as stage:
        if source.is_file():
            _link(source, stage / source.name, copy=copy)
            commit_file(stage / source.name, target.path / name)
        else:
            folder = stage / source.name
            folder.mkdir()
            for entry in _own(source):
                _link(entry, folder / entry.name, copy=copy)
            commit_folder(folder, target.path / name)


def _link(source: Path, target: Path, *, copy: bool) -> None:
    if not copy:
        try:
            os.link(source, target)
            return
        except OSError:
            pass  # another file system, or one without hard links
    shutil.copyfile(source, target)


def _take_description(source: DatasetFolder, target: DatasetFolder) -> None:
    """The first dataset's description; the versions in it stay those that made the data, and a card stays as it is."""
    first = (*_first_files(source), source.dataset_json)
    cards = tuple(
        path
        for path in (source.card, source.croissant_json, source.licences_txt)
        if not (target.path / path.name).exists()
    )
    with staging(target, "merge") as stage:
        for path in cards if target.dataset_json.is_file() else first + cards:
            if path.is_file():
                shutil.copyfile(path, stage / path.name)
                commit_file(stage / path.name, target.path / path.name)

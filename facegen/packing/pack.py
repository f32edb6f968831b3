"""Packs a dataset in another form, file by file, each of which appears whole or not at all."""

import contextlib
import hashlib
import os
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from facegen.documents import load_json
from facegen.errors import InputError
from facegen.packing.arrays import ARRAYS
from facegen.packing.card import cards
from facegen.packing.coco import COCO
from facegen.packing.keypoints import KEYPOINTS, chosen_columns
from facegen.packing.livelink import LIVELINK
from facegen.packing.openface import OPENFACE
from facegen.packing.parquet import PARQUET
from facegen.packing.place import begin_place, check_place
from facegen.packing.plan import Options, PackFile, PackFormat, chosen_samples
from facegen.packing.rendered import chosen_views
from facegen.packing.webdataset import WEBDATASET
from facegen.spec import format_ranges
from facegen.store import (
    LICENCES,
    Dataset,
    DatasetFolder,
    commit_file,
    licences,
    read_description,
    recording_of,
    staging,
    sweep,
    write_json,
)

PACK_FORMATS: dict[str, PackFormat] = {
    "webdataset": WEBDATASET,
    "parquet": PARQUET,
    "keypoints": KEYPOINTS,
    "coco": COCO,
    "livelink": LIVELINK,
    "openface": OPENFACE,
    "arrays": ARRAYS,
}
"""Every format there is; a new one is a module and a line here."""

INDEX = "index.json"


@dataclass(frozen=True, kw_only=True)
class PackPlan:
    """A pack to write: the format's name, the options in force, the samples and the files."""

    dataset: Dataset
    name: str
    options: Options
    samples: Sequence[int]
    parts: tuple[PackFile, ...]


@dataclass(frozen=True, kw_only=True)
class Packed:
    """What `write_pack` did: samples in the pack, files written now, files found from an earlier run."""

    samples: int
    written: int
    found: int


def plan_pack(dataset: Dataset, name: str, options: Options | None = None) -> PackPlan:
    """Decide what goes into a pack, in which files; writes nothing.

    Parameters
    ----------
    dataset
        From `facegen.store.open_dataset`.
    name
        One of `PACK_FORMATS`.
    options
        What goes in, and how.

    Raises
    ------
    InputError
        If samples are missing, or the format does not take an option.
    InvalidData
        If a shard that is needed for it is damaged.
    """
    if name not in PACK_FORMATS:
        raise InputError(f"--format: {name!r} is none of {', '.join(PACK_FORMATS)}")
    form = PACK_FORMATS[name]
    checked = _checked(form, name, options or Options())
    # wrong names are refused here, before anything is written
    chosen_columns(dataset, checked)
    chosen_views(dataset, checked)
    samples = chosen_samples(dataset, checked, rendered=form.rendered)
    parts = tuple(form.parts(dataset, samples, checked))
    return PackPlan(dataset=dataset, name=name, options=checked, samples=samples, parts=parts)


def write_pack(
    plan: PackPlan, out: str | Path, *, on_progress: Callable[[int], None] = lambda done: None
) -> Packed:
    """Write a pack; run it again after a stop and it goes on, and after damage it is whole again.

    The folder gets ``pack.json`` (format, dataset, licence, samples) first and ``index.json`` (files with
    sizes and checksums) last: a pack with an index is complete. ``LICENSE.txt`` lies beside them. Packs of Parquet
    have a card and Croissant metadata as well (`facegen.packing.card`).

    Parameters
    ----------
    plan
        From `plan_pack`.
    out
        Folder of the pack; new, or a pack of the same samples in the same form.
    on_progress
        Takes the number of files there are.

    Raises
    ------
    InputError
        If the folder holds something else.
    InvalidData
        If a sample or a shard is damaged.
    OutputError
        If the folder cannot be written.
    """
    folder = DatasetFolder(Path(out))
    try:
        return _write(plan, folder, on_progress)
    finally:
        with contextlib.suppress(OSError):  # not there, or not empty: another run packs the same
            (folder.path / "tmp").rmdir()


def check_pack(dataset: Dataset, out: str | Path, *, samples: Sequence[int], chosen: str | None) -> None:
    """Refuse a folder in which a pack of samples that are not all there yet could not begin; writes nothing.

    Parameters
    ----------
    dataset
        Whose folder has begun.
    out
        Folder of the pack.
    samples
        Numbers of those whose pictures will be there.
    chosen
        ``--samples`` of the command that packs; without, it packs all that is there.

    Raises
    ------
    InputError
        If the folder holds another pack, or anything else.
    """
    name = "webdataset" if len(samples) or dataset.folder.rendered() else "keypoints"
    numbers: Sequence[int] = samples
    if chosen is None:
        numbers = sorted({*samples, *dataset.folder.rendered()})
        numbers = numbers if name == "webdataset" else range(dataset.plan.samples)
    options = _checked(PACK_FORMATS[name], name, Options(samples=chosen))
    plan = PackPlan(dataset=dataset, name=name, options=options, samples=numbers, parts=())
    check_place(DatasetFolder(Path(out)), _description(plan))


def _write(plan: PackPlan, folder: DatasetFolder, on_progress: Callable[[int], None]) -> Packed:
    form = PACK_FORMATS[plan.name]
    begin_place(folder, _description(plan))
    sweep(folder)
    listed = _listed(folder.path)
    entries, written = [], 0
    for done, part in enumerate(plan.parts):
        found = (folder.path / part.name).is_file()
        entry = _entry(folder.path, part) if found else None
        if not found or (listed is not None and entry != listed.get(part.name)):
            with staging(folder, "pack") as stage:
                form.write(plan.dataset, part, plan.options, stage / part.name)
                commit_file(stage / part.name, folder.path / part.name)
            entry = _entry(folder.path, part)
            written += 1
        entries.append(entry)
        on_progress(done + 1)
    with staging(folder, "pack") as stage:
        texts = cards(folder.path, _description(plan), entries) if form.carded else {}
        texts[LICENCES] = licences(plan.dataset)
        for name, content in texts.items():
            (stage / name).write_bytes(content)
            commit_file(stage / name, folder.path / name)
        write_json(stage / INDEX, entries)
        commit_file(stage / INDEX, folder.path / INDEX)
    return Packed(samples=len(plan.samples), written=written, found=len(plan.parts) - written)


def _checked(form: PackFormat, name: str, options: Options) -> Options:
    for key, value in asdict(options).items():
        if value is not None and key not in form.options | {"samples", "split"}:
            flag = "--no-exr" if value is False else "--" + key.replace("_", "-")
            raise InputError(f"{flag}: the format {name!r} does not take this; it takes {_flags(form)}")
    if options.shard_size is None and form.shard_size:
        options = replace(options, shard_size=form.shard_size)
    return options


def _flags(form: PackFormat) -> str:
    return ", ".join("--" + key.replace("_", "-") for key in sorted(form.options | {"samples", "split"}))


def _description(plan: PackPlan) -> dict:
    described = read_description(plan.dataset.folder) | recording_of(plan.dataset.spec)
    options = {key: list(v) if isinstance(v, tuple) else v for key, v in asdict(plan.options).items()}
    return {
        "format": plan.name,
        "version": PACK_FORMATS[plan.name].version,
        "licence": described["licence"],
        "options": options,
        "samples": format_ranges(plan.samples),
        "dataset": described,
    }


def _listed(folder: Path) -> dict[str, dict] | None:
    """Entries of the index by name, where a run before this one ended; of one that cannot be read, none."""
    if not os.path.lexists(folder / INDEX):
        return None
    try:
        return {entry["name"]: entry for entry in load_json(folder / INDEX)}
    except (InputError, TypeError, KeyError):
        return {}


def _entry(folder: Path, part: PackFile) -> dict:
    with open(folder / part.name, "rb") as file:
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
    size = (folder / part.name).stat().st_size
    return {"name": part.name, "samples": len(part.samples), "bytes": size, "sha256": sha256}

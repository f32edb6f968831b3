"""Begins the folder of a dataset: its spec and what that names, what it is, and its card."""

import filecmp
import os
import shutil
from pathlib import Path

import tomli_w

from facegen.conventions import BLENDSHAPES
from facegen.documents import MOST_TOML_BYTES, read_bytes
from facegen.errors import InputError
from facegen.files import output_errors
from facegen.formats.litter import is_litter
from facegen.headsets import headset_path
from facegen.number_ranges import parse_ranges
from facegen.sessions import check_layout
from facegen.spec import LABEL_VERSION, spec_table
from facegen.store.dataset import Dataset, otherwise_built, rigs_of
from facegen.store.description import FORMAT, read_description
from facegen.store.folder import commit_file, write_json
from facegen.store.folder_card import folder_cards
from facegen.store.licences import licences_of_sources, recording_of
from facegen.store.stage import staging
from facegen.store.versions import installed_versions

_FIRST_THINGS = ("tmp", "logs", "farm", "spec.toml", "headset.toml", "recording.csv")
"""What `begin` leaves if it is killed before ``dataset.json``, and what a farm puts there before it."""


def _is_first(name: str) -> bool:
    return name in _FIRST_THINGS or is_litter(name)


def check_folder_is_free(dataset: Dataset) -> None:
    """Refuse a folder that holds anything but this very dataset; writes nothing.

    Raises
    ------
    InputError
        If the folder holds a dataset of another spec, or other files, or a spec, headset or recording that is none of
        this dataset's.
    OutputError
        If the folder cannot be looked into.
    """
    folder = dataset.folder
    with output_errors(folder.path):
        others = folder.path.is_dir() and any(not _is_first(p.name) for p in folder.path.iterdir())
    # looked at after the listing: another worker may be just beginning, and then this file is there by now
    if os.path.lexists(folder.dataset_json):
        described = read_description(folder)
        stored_hash = described["spec_hash"]
        if stored_hash != dataset.hash and (built := otherwise_built(dataset, described)):
            raise InputError(f"{folder.path}: {built}")
        if stored_hash != dataset.hash:
            raise InputError(
                f"{folder.path}: holds a dataset of another spec (its hash is {stored_hash[:12]}, this spec's "
                f"with its rig and headset {dataset.hash[:12]}); choose another folder, or delete this one"
            )
    elif others:
        raise InputError(f"{folder.path}: is not empty and holds no facegen dataset; choose another folder")
    else:
        with output_errors(folder.path):
            _check_first_files(dataset)


def _check_first_files(dataset: Dataset) -> None:
    """See that nothing of a person's is replaced: the very spec that is read may lie in the folder."""
    spec_toml = dataset.folder.spec_toml
    if os.path.lexists(spec_toml):
        check_replaceable(
            spec_toml, spec_toml.is_file() and spec_toml.read_bytes() == spec_text(dataset).encode()
        )
    for path, source in _named(dataset).items():
        if os.path.lexists(path):
            check_replaceable(path, path.is_file() and filecmp.cmp(path, source, shallow=False))


def check_replaceable(path: Path, is_equal: bool) -> None:
    """Refuse to replace a file that stands where a dataset begins and is not what a stopped beginning left.

    Raises
    ------
    InputError
        If it is not equal to what would be written.
    """
    if not is_equal:
        raise InputError(
            f"{path}: is another {path.name} than this dataset's, which would replace it; choose another folder, or "
            "delete the file if a stopped run has left it"
        )


def holds_dataset(dataset: Dataset) -> bool:
    """Whether a dataset's folder holds this very one already."""
    folder = dataset.folder
    return os.path.lexists(folder.dataset_json) and read_description(folder)["spec_hash"] == dataset.hash


def begin(dataset: Dataset) -> None:
    """Write ``spec.toml``, ``dataset.json`` and the card of a new dataset; check an old one.

    An old one's ``spec.toml`` is written again where it is missing, or says otherwise which samples are rendered: its
    readers ask for those of the spec that it was last given. What that names is copied again where it is missing.

    Raises
    ------
    InputError
        If the folder holds a dataset of another spec, or other files, or a layout leaves a person without a headset.
    OutputError
        If the folder cannot be written.
    """
    folder = dataset.folder
    check_folder_is_free(dataset)
    if holds_dataset(dataset):
        _renew(dataset)
        _write_cards(dataset)
        return
    # a spec may name samples that there are not, as long as --samples names others
    ranges = parse_ranges(dataset.spec.render.samples, where="render.samples")
    check_layout(dataset.spec, dataset.rigs, dataset.headset, rendered=sum(map(len, ranges)))
    with output_errors(folder.path):
        folder.path.mkdir(parents=True, exist_ok=True)
    # before anything lies there: it imports modules, and a stop during imports ends the program at once
    text, description = spec_text(dataset), _description(dataset)
    with staging(folder, "begin") as stage:
        _copy(_named(dataset), stage)
        (stage / "spec.toml").write_bytes(text.encode())
        commit_file(stage / "spec.toml", folder.spec_toml)
        write_json(stage / "dataset.json", description)
        commit_file(stage / "dataset.json", folder.dataset_json)
    _write_cards(dataset)


def spec_text(dataset: Dataset) -> str:
    """The resolved spec as TOML; what it names lies beside it in the folder.

    Raises
    ------
    InputError
        If it is longer than what is read.
    """
    folder, table = dataset.folder, spec_table(dataset.spec)
    if dataset.spec.playback is not None:
        table["playback"]["recording"] = folder.recording_csv.name
    table["render"]["headset"] = folder.headset_toml.name
    text = tomli_w.dumps(_without_none(table))
    if len(text.encode()) > MOST_TOML_BYTES:
        raise InputError(
            f"{folder.spec_toml}: would have {len(text.encode()):,} bytes, of which at most {MOST_TOML_BYTES:,} are "
            "read; write render.samples as few ranges, such as 0-99999:10"
        )
    return text


def _named(dataset: Dataset) -> dict[Path, str | Path]:
    """Files that the spec names, by their places in the folder."""
    folder, named = dataset.folder, {}
    if dataset.spec.playback is not None:
        named[folder.recording_csv] = dataset.spec.playback.recording
    return named | {folder.headset_toml: headset_path(dataset.spec.render.headset)}


def _copy(named: dict[Path, str | Path], stage: Path) -> None:
    for path, source in named.items():
        shutil.copyfile(source, stage / path.name)
        commit_file(stage / path.name, path)


def _renew(dataset: Dataset) -> None:
    """Write what is missing or stale; a folder that has all of it may be read-only."""
    folder, text = dataset.folder, spec_text(dataset)
    missing = {path: source for path, source in _named(dataset).items() if not os.path.lexists(path)}
    fresh = (
        os.path.lexists(folder.spec_toml)
        and read_bytes(folder.spec_toml, most_bytes=MOST_TOML_BYTES) == text.encode()
    )
    if fresh and not missing:
        return
    with staging(folder, "spec") as stage:
        _copy(missing, stage)
        if not fresh:
            (stage / "spec.toml").write_bytes(text.encode())
            commit_file(stage / "spec.toml", folder.spec_toml)


def _write_cards(dataset: Dataset) -> None:
    """Write what is missing of ``README.md``, ``croissant.json`` and ``LICENSE.txt``.

    They come last: a folder that holds them alone is somebody else's, and what a person wrote into them stays.
    """
    folder, spec = dataset.folder, dataset.spec
    missing = [
        path
        for path in (folder.card, folder.croissant_json, folder.licences_txt)
        if not os.path.lexists(path)
    ]
    if not missing:
        return
    texts = folder_cards(
        dataset.keypoint_schema,
        read_description(folder),
        views=dataset.headset.camera_names,
        split=spec.split,
        split_shares=spec.split_shares,
    )
    texts[folder.licences_txt.name] = licences_of_sources(dataset).encode()
    with staging(folder, "card") as stage:
        for path in missing:
            (stage / path.name).write_bytes(texts[path.name])
            commit_file(stage / path.name, path)


def _description(dataset: Dataset) -> dict:
    return {
        "format": FORMAT,
        "spec_hash": dataset.hash,
        "label_version": LABEL_VERSION,
        "seed": dataset.spec.seed,
        "samples": dataset.plan.samples,
        "people": dataset.spec.people,
        **rigs_of(dataset),
        "headset": dataset.headset.name,
        "licence": "Pictures and labels derive from " + " and ".join(_sources(dataset)),
        **recording_of(dataset.spec),
        "blendshapes": list(BLENDSHAPES),
        "versions": installed_versions(),
    }


def _sources(dataset: Dataset) -> list[str]:
    """What a dataset derives from, with licences."""
    rigs = [f"the rig {rig.name!r}: {rig.licence}" for rig in dataset.rigs]
    recordings = recording_of(dataset.spec).values()
    return rigs + [f"the recording of {each['credit']}: {each['licence']}" for each in recordings]


def _without_none(table: dict) -> dict:
    return {k: _without_none(v) if isinstance(v, dict) else v for k, v in table.items() if v is not None}

"""Opens and begins datasets: a spec with everything that it names, and the folder of its samples."""

import dataclasses
import hashlib
import importlib.metadata
import json
import os
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
import pyarrow as pa
import tomli_w
from pydantic import TypeAdapter, ValidationError

from facegen import __version__
from facegen.conventions import BLENDSHAPES, SHARD_ROWS
from facegen.errors import InputError, MissingAsset
from facegen.files import output_errors
from facegen.headsets import Headset, headset_path, load_headset
from facegen.refusals import refusal
from facegen.rigs import Rig, load_rig
from facegen.sampling import Plan, plan_dataset, rig_of
from facegen.sessions import check_base
from facegen.spec import (
    LABEL_VERSION,
    Spec,
    load_spec,
    sample_ranges,
    shares_of,
    spec_hash,
    spec_table,
)
from facegen.store.description import FORMAT, read_description
from facegen.store.folder import DatasetFolder, commit_file, shard_samples, write_json
from facegen.store.folder_card import folder_cards
from facegen.store.keypoint_table import column_array, keypoint_schema, read_shard
from facegen.store.sample import read_sample
from facegen.store.stage import staging

_Asset = TypeVar("_Asset")

_PACKAGES = ("numpy", "scipy", "pyarrow", "bpy", "OpenEXR")

DRAWN = "drawn"
"""Name of the headset of a dataset whose people each wear another one."""

_FIRST_THINGS = ("tmp", "logs", "farm", "spec.toml", "headset.toml", "recording.csv")
"""What `begin` leaves if it is killed before ``dataset.json``, and what a farm puts there before it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Dataset:
    """A spec, the assets it names, and where its samples lie.

    Attributes
    ----------
    folder
        Where the dataset is, or will be.
    plan
        The spec, its recording and the number of samples.
    rigs
        What the spec names, in the order of `facegen.spec.shares_of`.
    headset
        What the spec names; its pictures already have the spec's size.
    hash
        `facegen.spec.spec_hash` of all of it.
    """

    folder: DatasetFolder
    plan: Plan
    rigs: tuple[Rig, ...]
    headset: Headset
    hash: str

    @property
    def spec(self) -> Spec:
        """The checked spec."""
        return self.plan.spec

    @property
    def rig(self) -> Rig:
        """The rig of everyone.

        Raises
        ------
        InputError
            If there are several.
        """
        if len(self.rigs) > 1:
            names = ", ".join(rig.name for rig in self.rigs)
            raise InputError(
                f"{self.folder.path}: its people are of several rigs ({names}), and this takes a dataset of one; "
                "make one of each"
            )
        return self.rigs[0]

    def rig_of(self, sample: int) -> Rig:
        """The rig of a sample's person."""
        return self.rigs[int(rig_of(self.spec, np.array([sample // self.plan.frames]))[0])]

    @property
    def shards(self) -> int:
        """Number of keypoint shards when the dataset is complete."""
        return -(-self.plan.samples // SHARD_ROWS)

    @property
    def picture_kinds(self) -> tuple[str, ...]:
        """Extensions of a rendered view's files: exr and png, or png alone where the spec wants no truth."""
        return ("exr", "png") if self.spec.render.truth else ("png",)

    @property
    def licence(self) -> str:
        """Licence of the pictures, as ``dataset.json`` has it."""
        return read_description(self.folder)["licence"]

    @property
    def keypoint_schema(self) -> pa.Schema:
        """Columns of the keypoint shards."""
        return keypoint_schema(self.spec, max(rig.components for rig in self.rigs))

    def samples_to_render(self, ranges: str | None = None) -> Sequence[int]:
        """Sorted numbers of the samples to render: ``ranges`` (``"0-99,140"``) or, without, the spec's own.

        One range stays a range, which may count more than fit into memory.
        """
        text = self.spec.render.samples if ranges is None else ranges
        where = "render.samples" if ranges is None else "--samples"
        return sample_ranges(text, total=self.plan.samples, where=where)

    def keypoints(self) -> pa.Table:
        """All finished keypoint shards as one Arrow table.

        Raises
        ------
        InputError
            If nothing has been made yet.
        InvalidData
            If a shard is damaged.
        """
        return pa.concat_tables([self.read_shard(shard) for shard in self.made_shards()])

    def read_shard(self, path: Path, columns: Sequence[str] | None = None) -> pa.Table:
        """Keypoint shard at a path in this dataset, or some of its columns.

        Raises
        ------
        InvalidData
            If it is damaged, or has other columns or rows than a shard of this dataset.
        """
        number = int(path.stem.removeprefix("shard-"))
        rows = shard_samples(number, total=self.plan.samples)
        return read_shard(path, columns, schema=self.keypoint_schema, rows=len(rows))

    def made_shards(self) -> list[Path]:
        """Files of the finished keypoint shards, in order.

        Raises
        ------
        InputError
            If nothing has been made yet.
        """
        if shards := self.folder.shards():
            return shards
        raise InputError(f"{self.folder.path}: has no keypoints yet; run: facegen generate")

    def array(self, column: str) -> np.ndarray:
        """A keypoint column as (n, ...) array, for example ``array("points_2d")`` (n, 68, 2)."""
        return column_array(self.keypoints(), column)

    def sample(self, number: int) -> dict:
        """``sample.json`` of a rendered sample.

        Raises
        ------
        InvalidData
            If it is damaged, or another sample's.
        """
        path = self.folder.render(number) / "sample.json"
        return read_sample(path, number=number, spec_hash=self.hash, views=self.headset.camera_names)


def resolve(spec: Spec, out: str | Path) -> Dataset:
    """A spec with its assets loaded; reads, writes nothing.

    Raises
    ------
    InputError
        If the rig, the headset or the recording is missing or damaged, or the pictures get too large.
    """
    plan = plan_dataset(spec)
    rigs = tuple(_asset("rig", load_rig, name) for name in shares_of(spec.rig))
    headset = _asset("render.headset", load_headset, spec.render.headset)
    if spec.layout is not None:
        check_base(headset)
    assets = {
        **({"rig": rigs[0].sha256} if len(rigs) == 1 else {f"rig {rig.name}": rig.sha256 for rig in rigs}),
        "headset": _content_sha256(_headset_content(headset)),
    }
    if plan.recording is not None:
        assets["recording"] = hashlib.sha256(np.ascontiguousarray(plan.recording).tobytes()).hexdigest()
    return Dataset(
        folder=DatasetFolder(Path(out)),
        plan=plan,
        rigs=rigs,
        headset=_scaled(_named(headset, spec), spec.render.size_px),
        hash=spec_hash(spec, asset_sha256=assets),
    )


def _asset(key: str, load: Callable[[str], _Asset], name: str) -> _Asset:
    """What a spec names; where there is no such thing, the key begins the sentence."""
    try:
        return load(name)
    except MissingAsset as error:
        raise MissingAsset(f"{key}: {error}") from None


def begin(dataset: Dataset) -> None:
    """Write ``spec.toml``, ``dataset.json`` and the card of a new dataset; check an old one.

    Raises
    ------
    InputError
        If the folder holds a dataset of another spec, or other files.
    OutputError
        If the folder cannot be written.
    """
    folder = dataset.folder
    with output_errors(folder.path):
        others = folder.path.is_dir() and any(p.name not in _FIRST_THINGS for p in folder.path.iterdir())
    # looked at after the listing: another worker may be just beginning, and then this file is there by now
    if os.path.lexists(folder.dataset_json):
        stored_hash = read_description(folder)["spec_hash"]
        if stored_hash != dataset.hash:
            raise InputError(
                f"{folder.path}: holds a dataset of another spec (its hash is {stored_hash[:12]}, this spec's "
                f"with its rig and headset {dataset.hash[:12]}); choose another folder, or delete this one"
            )
        _write_cards(dataset)
        return
    if others:
        raise InputError(f"{folder.path}: is not empty and holds no facegen dataset; choose another folder")
    with output_errors(folder.path):
        folder.path.mkdir(parents=True, exist_ok=True)
    # before anything lies there: it imports modules, and a stop during imports ends the program at once
    table, description = spec_table(dataset.spec), _description(dataset)
    with staging(folder, "begin") as stage:
        if dataset.spec.playback is not None:
            shutil.copyfile(dataset.spec.playback.recording, stage / "recording.csv")
            commit_file(stage / "recording.csv", folder.recording_csv)
            table["playback"]["recording"] = folder.recording_csv.name
        shutil.copyfile(headset_path(dataset.spec.render.headset), stage / "headset.toml")
        commit_file(stage / "headset.toml", folder.headset_toml)
        table["render"]["headset"] = folder.headset_toml.name
        (stage / "spec.toml").write_text(tomli_w.dumps(_without_none(table)), encoding="utf-8")
        commit_file(stage / "spec.toml", folder.spec_toml)
        write_json(stage / "dataset.json", description)
        commit_file(stage / "dataset.json", folder.dataset_json)
    _write_cards(dataset)


def _write_cards(dataset: Dataset) -> None:
    """Write what is missing of ``README.md`` and ``croissant.json``.

    They come last: a folder that holds them alone is somebody else's, and what a person wrote into them stays.
    """
    folder, spec = dataset.folder, dataset.spec
    missing = [path for path in (folder.card, folder.croissant_json) if not os.path.lexists(path)]
    if not missing:
        return
    texts = folder_cards(
        dataset.keypoint_schema,
        read_description(folder),
        views=dataset.headset.camera_names,
        split=spec.split,
        split_shares=spec.split_shares,
    )
    with staging(folder, "card") as stage:
        for path in missing:
            (stage / path.name).write_bytes(texts[path.name])
            commit_file(stage / path.name, path)


def open_dataset(path: str | Path) -> Dataset:
    """Open a dataset on disk.

    Raises
    ------
    InputError
        If there is none, or its rig is no longer the one it was made with.
    """
    folder = DatasetFolder(Path(path))
    described = read_description(folder)
    spec = load_spec(folder.spec_toml)
    dataset = resolve(spec, path)
    if dataset.hash != described["spec_hash"]:
        rigs = " or ".join(map(repr, shares_of(spec.rig)))
        raise InputError(
            f"{path}: was made with another version of rig {rigs}, of its headset.toml or of facegen's labels "
            f"({described['label_version']}, now {LABEL_VERSION}); build that again, or make the dataset anew"
        )
    return dataset


def _description(dataset: Dataset) -> dict:
    return {
        "format": FORMAT,
        "spec_hash": dataset.hash,
        "label_version": LABEL_VERSION,
        "seed": dataset.spec.seed,
        "samples": dataset.plan.samples,
        "people": dataset.spec.people,
        **_rigs(dataset),
        "headset": dataset.headset.name,
        "licence": "Pictures and labels derive from "
        + " and ".join(f"the rig {rig.name!r}: {rig.licence}" for rig in dataset.rigs),
        "blendshapes": list(BLENDSHAPES),
        "versions": _versions(),
    }


def _rigs(dataset: Dataset) -> dict:
    """The key ``rig``, or where there are several, ``rigs`` with their shares."""
    about = [
        {"name": rig.name, **{key: getattr(rig, key) for key in ("sha256", "version", "source", "licence")}}
        for rig in dataset.rigs
    ]
    if len(about) == 1:
        return {"rig": about[0]}
    shares = shares_of(dataset.spec.rig)
    return {"rigs": [{**each, "share": shares[each["name"]]} for each in about]}


def _versions() -> dict[str, str]:
    """Versions of what made the data; OpenCV's is its own word, as any of its four distributions will do."""
    import cv2  # where a dataset begins, not where one is read

    installed = {name: importlib.metadata.version(name) for name in _PACKAGES}
    return {"facegen": __version__, **installed, "opencv": cv2.__version__}


def _headset_content(headset: Headset) -> dict:
    """What a headset's file says, for the hash; a key younger than some datasets stays out where it changes nothing."""
    content = TypeAdapter(Headset).dump_python(headset, mode="json")
    for camera in content["cameras"]:
        if camera["lens"]["blur"] == 0:
            del camera["lens"]["blur"]
    return content


def _named(headset: Headset, spec: Spec) -> Headset:
    """The headset that a spec names; where it is drawn anew for each person, it is called so."""
    return headset if spec.layout is None else dataclasses.replace(headset, name=DRAWN)


def _scaled(headset: Headset, size_px: int) -> Headset:
    for camera in headset.cameras:
        try:
            camera.scaled(size_px)
        except ValidationError as error:
            height = f"{camera.height * size_px / camera.width:.0f}"
            raise InputError(
                f"render.size_px = {size_px}: camera {camera.name!r} of headset {headset.name!r} has "
                f"{camera.width} x {camera.height} px and would have {size_px} x {height}, which is not allowed "
                f"({refusal(error, type(camera))}); choose another size"
            ) from None
    return headset.scaled(size_px)


def _content_sha256(content: object) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _without_none(table: dict) -> dict:
    return {k: _without_none(v) if isinstance(v, dict) else v for k, v in table.items() if v is not None}

"""Opens datasets: a spec with everything that it names, and the folder of its samples."""

import dataclasses
import hashlib
import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
import pyarrow as pa
from pydantic import TypeAdapter, ValidationError

from facegen.conventions import SHARD_ROWS
from facegen.errors import InputError, MissingAsset
from facegen.headsets import Headset, load_headset
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
)
from facegen.store.description import read_description
from facegen.store.folder import DatasetFolder, shard_samples
from facegen.store.keypoint_table import column_array, keypoint_schema, read_shard
from facegen.store.sample import read_sample

_Asset = TypeVar("_Asset")

DRAWN = "drawn"
"""Name of the headset of a dataset whose people each wear another one."""


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


def open_dataset(path: str | Path) -> Dataset:
    """Open a dataset on disk.

    Raises
    ------
    InputError
        If there is none, or its spec, rig, headset or labels are no longer those that it was made with.
    """
    folder = DatasetFolder(Path(path))
    described = read_description(folder)
    if not os.path.lexists(folder.spec_toml):
        raise InputError(
            f"{folder.spec_toml}: is missing; facegen generate SPEC --out {path}, with the spec that the dataset was "
            f"made of, writes it again"
        )
    spec = load_spec(folder.spec_toml)
    dataset = resolve(spec, path)
    if dataset.hash != described["spec_hash"]:
        raise InputError(f"{path}: {_otherness(dataset, described)}")
    return dataset


def _otherness(dataset: Dataset, described: dict) -> str:
    """What of a dataset is no longer as ``dataset.json`` has it, and what to do."""
    if described["label_version"] != LABEL_VERSION:
        return (
            f"has labels of version {described['label_version']}, and this version of facegen makes and reads "
            f"{LABEL_VERSION}; make the dataset anew, or read it with facegen "
            f"{described['versions'].get('facegen', 'of then')}"
        )
    if any(described.get(key, about) != about for key, about in rigs_of(dataset).items()):
        rigs = " or ".join(map(repr, shares_of(dataset.spec.rig)))
        return f"was made with another version of rig {rigs}; build that again, or make the dataset anew"
    return (
        "its spec.toml or headset.toml was changed after it was made; facegen generate SPEC --out "
        f"{dataset.folder.path}, with the spec that it was made of, writes spec.toml again, and headset.toml is a copy "
        "of what that spec names"
    )


def rigs_of(dataset: Dataset) -> dict:
    """What ``dataset.json`` says of rigs: the key ``rig``, or where there are several, ``rigs`` with their shares."""
    about = [
        {"name": rig.name, **{key: getattr(rig, key) for key in ("sha256", "version", "source", "licence")}}
        for rig in dataset.rigs
    ]
    if len(about) == 1:
        return {"rig": about[0]}
    shares = shares_of(dataset.spec.rig)
    return {"rigs": [{**each, "share": shares[each["name"]]} for each in about]}


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

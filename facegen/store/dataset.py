"""Opens datasets: a spec with everything that it names, and the folder of its samples."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa

from facegen.conventions import BLENDSHAPES, SHARD_ROWS
from facegen.errors import InputError
from facegen.headsets import Headset
from facegen.rigs import Rig, rigs_folder
from facegen.sampling import Plan, rig_of
from facegen.spec import (
    Spec,
    sample_ranges,
    shares_of,
)
from facegen.store.arrow_arrays import arrow_array
from facegen.store.description import read_description
from facegen.store.folder import DatasetFolder, shard_samples
from facegen.store.keypoint_table import column_array, keypoint_schema, read_shard
from facegen.store.sample import read_sample


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
        self.check_one_rig()
        return self.rigs[0]

    def check_one_rig(self) -> None:
        """Refuse people of several rigs.

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

    def keypoints(self, columns: Sequence[str] | None = None) -> pa.Table:
        """All finished keypoint shards, or some of their columns, as one Arrow table: up to 9 kB a sample.

        Raises
        ------
        InputError
            If nothing has been made yet.
        InvalidData
            If a shard is damaged.
        """
        return pa.concat_tables([self.read_shard(shard, columns) for shard in self.made_shards()])

    def rows(self, numbers: Sequence[int], columns: Sequence[str]) -> Iterator[pa.Table]:
        """Keypoint columns of samples by ascending number, a table a shard; one shard in memory at a time.

        Raises
        ------
        InvalidData
            If a shard is damaged.
        """
        numbers = np.asarray(numbers, np.int64)
        for shard in np.unique(numbers // SHARD_ROWS):
            table = self.read_shard(self.folder.shard(int(shard)), columns)
            yield table.take(arrow_array(numbers[numbers // SHARD_ROWS == shard] % SHARD_ROWS, pa.int64()))

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
        return column_array(self.keypoints([column]), column)

    def sample(self, number: int) -> dict:
        """``sample.json`` of a rendered sample.

        Raises
        ------
        InvalidData
            If it is damaged, or another sample's.
        """
        path = self.folder.render(number) / "sample.json"
        return read_sample(path, number=number, spec_hash=self.hash, views=self.headset.camera_names)


def rigs_of(dataset: Dataset) -> dict:
    """What ``dataset.json`` says of rigs: the key ``rig``, or where there are several, ``rigs`` with their shares."""
    about = [
        {
            "name": rig.name,
            **{key: getattr(rig, key) for key in ("sha256", "version", "source", "licence")},
            **({"missing": list(rig.missing)} if rig.missing else {}),
        }
        for rig in dataset.rigs
    ]
    if len(about) == 1:
        return {"rig": about[0]}
    shares = shares_of(dataset.spec.rig)
    return {"rigs": [{**each, "share": shares[each["name"]]} for each in about]}


def otherwise_built(dataset: Dataset, described: Mapping) -> str:
    """A sentence where a rig of ``dataset.json`` is of this version but of other bytes, or was shown otherwise.

    Products of matrices end in other last bits on other kinds of processors, and the rig's hash is part of a dataset's.
    Of that rig's values ``dataset.json`` has none, so there is nothing to compare but the hash.
    """
    told = described["rigs"] if "rigs" in described else [described.get("rig")]
    built = {each["name"]: each for each in told if isinstance(each, Mapping) and "name" in each}
    for rig in dataset.rigs:
        then = built.get(rig.name, {})
        if then.get("version") == rig.version and then.get("sha256") != rig.sha256:
            files = f"{rig.name}.npz and {rig.name}.json"
            return (
                f"its rig {rig.name!r} is of the same version as the one here, but was built on another kind of "
                f"processor or from other sources, and has other bytes; copy {files} from where the dataset was made "
                f"into {rigs_folder()}, or let FACEGEN_RIGS name their folder"
            )
        if rig.unseen and then.get("sha256") == rig.sha256 and "missing" not in then:
            return (
                f"its labels hold weights of shapes that its rig {rig.name!r} lacks "
                f"({', '.join(BLENDSHAPES[i] for i in rig.unseen)}), which this version of facegen leaves at 0; make "
                "the dataset anew, or read it with the facegen that made it"
            )
    return ""

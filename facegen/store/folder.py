"""Names the paths of a dataset's folder, and lets files appear in it complete or not at all."""

import errno
import json
import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from facegen.conventions import SHARD_ROWS
from facegen.documents import load_json
from facegen.errors import FormatError, InputError
from facegen.files import sync

SAMPLES_PER_FOLDER = 1000

SHARD_PATTERN = "keypoints/shard-*.parquet"
"""Of the keypoint shards, for readers of the folder."""

NAMES_OF_JSON = {
    list: "a list",
    str: "a text",
    bool: "a truth value",
    int: "a number",
    float: "a number",
    type(None): "nothing (null)",
}
"""What people call values of JSON that are no tables, by Python's type."""


LICENCES = "LICENSE.txt"
"""Licences and credits of what data derive from; packs, developed pictures and models have one too."""

_SHARD = re.compile(r"shard-[0-9]{5,15}\.parquet")
_RENDER = re.compile("[0-9]{6,15}")


@dataclass(frozen=True)
class DatasetFolder:
    """Paths inside a dataset; nothing is read or written by making one."""

    path: Path

    @property
    def dataset_json(self) -> Path:
        """What the dataset is: spec hash, versions, licences."""
        return self.path / "dataset.json"

    @property
    def card(self) -> Path:
        """What the dataset is, for people and Hugging Face's ``datasets``."""
        return self.path / "README.md"

    @property
    def croissant_json(self) -> Path:
        """What the dataset is, for ``mlcroissant``."""
        return self.path / "croissant.json"

    @property
    def licences_txt(self) -> Path:
        """Licences and credits of what the dataset derives from."""
        return self.path / LICENCES

    @property
    def spec_toml(self) -> Path:
        """The resolved spec."""
        return self.path / "spec.toml"

    @property
    def recording_csv(self) -> Path:
        """Copy of the recording of a playback."""
        return self.path / "recording.csv"

    @property
    def headset_toml(self) -> Path:
        """Copy of the headset's file."""
        return self.path / "headset.toml"

    def shard(self, index: int) -> Path:
        """Keypoints of samples ``index * 10,000`` and on."""
        return self.path / "keypoints" / f"shard-{index:05d}.parquet"

    def render(self, sample: int) -> Path:
        """Folder of one rendered sample."""
        return self.path / "renders" / f"{sample // SAMPLES_PER_FOLDER:03d}" / f"{sample:06d}"

    def quarantine(self, name: str) -> Path:
        """Record of a task that failed for good."""
        return self.path / "quarantine" / name

    def shards(self) -> list[Path]:
        """Finished shards, in order."""
        return sorted(p for p in (self.path / "keypoints").glob("shard-*") if _SHARD.fullmatch(p.name))

    def rendered(self) -> list[int]:
        """Numbers of the finished rendered samples, in order."""
        folders = (self.path / "renders").glob("[0-9]*/[0-9]*")
        # beside its group a folder that was moved aside may lie, "000.old", whose samples are nobody's
        return sorted(
            int(p.name) for p in folders if _RENDER.fullmatch(p.name) and p == self.render(int(p.name))
        )


def shard_samples(index: int, *, total: int) -> range:
    """Samples in a shard of a dataset of ``total`` samples."""
    return range(index * SHARD_ROWS, min((index + 1) * SHARD_ROWS, total))


def shards_of(samples: Sequence[int]) -> Sequence[int]:
    """Numbers of the shards that hold samples, sorted."""
    if isinstance(samples, range) and samples.step == 1:
        return range(samples.start // SHARD_ROWS, -(-samples.stop // SHARD_ROWS))
    return sorted({number // SHARD_ROWS for number in samples})


def commit_file(source: Path, target: Path) -> None:
    """Let a finished file appear under its name, at once and whole; an existing file is replaced by its equal."""
    sync(source)
    target.parent.mkdir(parents=True, exist_ok=True)
    _move(os.replace, source, target)
    sync(target.parent)


def commit_folder(source: Path, target: Path) -> bool:
    """Let a finished folder appear under its name; False if another worker was first (its content is equal)."""
    for file in source.iterdir():
        sync(file)
    sync(source)
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        _move(os.rename, source, target)
    except OSError as error:
        if error.errno in (errno.ENOTEMPTY, errno.EEXIST) and target.is_dir():
            return False
        raise
    sync(target.parent)
    return True


def _move(move: Callable[[Path, Path], None], source: Path, target: Path) -> None:
    """Rename; a file server whose answer got lost has done it, and refuses when it is asked again."""
    made = os.stat(source)
    try:
        move(source, target)
    except OSError:
        if (
            os.path.lexists(source)
            or not os.path.lexists(target)
            or not os.path.samestat(os.stat(target), made)
        ):
            raise


def write_json(path: Path, content: object) -> None:
    """Write JSON with sorted keys, one way only, so that equal content gives equal bytes."""
    # not as text: Windows would write other bytes
    path.write_bytes((json.dumps(content, sort_keys=True, indent=1, ensure_ascii=False) + "\n").encode())


def read_json(path: Path) -> dict:
    """Read a table of JSON.

    Raises
    ------
    InputError
        If there is no such file, it cannot be taken in, or it holds no table.
    """
    if not os.path.lexists(path):
        raise InputError(f"{path}: there is no such file, so {path.parent} is not a facegen dataset")
    content = load_json(path)
    if not isinstance(content, dict):
        raise FormatError(
            f"{path}: holds {NAMES_OF_JSON[type(content)]}, but must hold a table of keys and values"
        )
    return content

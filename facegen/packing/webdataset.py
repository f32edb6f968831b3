"""Packs WebDataset shards: tar files that training reads from end to end.

A key is a sample's number; its fields are ``json`` (``sample.json`` as it is), ``VIEW.exr`` and ``VIEW.png``,
sorted. Owners and times are fixed, so that equal samples give equal bytes.
"""

import io
import tarfile
from collections.abc import Sequence
from pathlib import Path

from facegen.errors import InputError
from facegen.packing.plan import Options, PackFile, PackFormat, shards
from facegen.packing.rendered import chosen_views, read_rendered
from facegen.store import Dataset

SHARD_SAMPLES = 1000
"""About 0.7 GB with EXR files and 60 MB without at 256 px: WebDataset's users keep shards below a few GB."""


def tar_parts(dataset: Dataset, samples: Sequence[int], options: Options) -> list[PackFile]:
    """Shards of samples.

    Raises
    ------
    InputError
        If EXR files were asked for and the dataset has none.
    """
    if options.exr and not dataset.spec.render.truth:
        raise InputError(
            f"--exr: {dataset.folder.path} has no EXR files (render.truth = false); leave it out"
        )
    return shards("shard-{:06d}.tar")(dataset, samples, options)


def write_tar(dataset: Dataset, part: PackFile, options: Options, path: Path) -> None:
    """Write one shard, one sample in memory at a time."""
    kinds = ("png",) if options.exr is False else dataset.picture_kinds
    names = [f"{view}.{kind}" for view in chosen_views(dataset, options) for kind in kinds]
    with tarfile.open(path, "w", format=tarfile.USTAR_FORMAT) as archive:
        for sample in read_rendered(dataset, part.samples, names):
            fields = {"json": sample.text} | sample.pictures
            for field in sorted(fields):
                entry = _entry(f"{sample.number:06d}.{field}", fields[field])
                archive.addfile(entry, io.BytesIO(fields[field]))
            archive.members.clear()  # tarfile remembers every entry otherwise


def _entry(name: str, content: bytes) -> tarfile.TarInfo:
    entry = tarfile.TarInfo(name)  # time 0, owner 0, no names
    entry.size = len(content)
    entry.mode = 0o644
    return entry


WEBDATASET = PackFormat(
    description="tar shards of rendered samples for the WebDataset library: labels, PNG and EXR",
    rendered=True,
    options=frozenset({"shard_size", "views", "exr"}),
    shard_size=SHARD_SAMPLES,
    parts=tar_parts,
    write=write_tar,
)

"""Reads rendered samples for packs, one after the other, each checked on the way."""

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from facegen.documents import MOST_JSON_BYTES, read_bytes
from facegen.errors import InputError, InvalidData
from facegen.packing.plan import Options
from facegen.store import Dataset

MOST_PICTURE_BYTES = 2 * 1024**3
"""Of one PNG or EXR file; 4096 x 4096 pixels of an EXR's channels are 0.6 GB before they are compressed."""


@dataclass(frozen=True, kw_only=True)
class RenderedFiles:
    """A rendered sample: its number, ``sample.json`` as text and read, and pictures by file name."""

    number: int
    text: bytes
    record: dict
    pictures: dict[str, bytes]


def chosen_views(dataset: Dataset, options: Options) -> tuple[str, ...]:
    """Names of the cameras to pack, in the headset's order.

    Raises
    ------
    InputError
        If the headset has no such camera, or none is named.
    """
    names = dataset.headset.camera_names
    if options.views is not None and not options.views:
        raise InputError(f"--views names no camera; this dataset's are {', '.join(names)}")
    unknown = sorted(set(options.views or ()) - set(names))
    if unknown:
        raise InputError(f"--views: {unknown[0]!r} is none of this dataset's cameras {', '.join(names)}")
    return tuple(name for name in names if options.views is None or name in options.views)


def read_rendered(dataset: Dataset, numbers: Sequence[int], names: Sequence[str]) -> Iterator[RenderedFiles]:
    """Read samples with the named pictures (``"mouth.png"``), one at a time.

    Raises
    ------
    InvalidData
        If a file is missing or is not what was written: damage must not spread into packs.
    """
    for number in numbers:
        folder = dataset.folder.render(number)
        advice = "run facegen validate --repair, then facegen generate"
        try:
            record = dataset.sample(number)
            text = read_bytes(folder / "sample.json", most_bytes=MOST_JSON_BYTES)
            pictures = {name: read_bytes(folder / name, most_bytes=MOST_PICTURE_BYTES) for name in names}
        except InputError as error:
            raise InvalidData(f"{error}; {advice}") from None
        for name, content in pictures.items():
            if hashlib.sha256(content).hexdigest() != record["sha256"].get(name):
                raise InvalidData(f"{folder / name}: is not what was written (SHA-256 differs); {advice}")
        yield RenderedFiles(number=number, text=text, record=record, pictures=pictures)

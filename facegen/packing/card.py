"""Writes what a pack of Parquet files says of itself: a card that Hugging Face reads, and Croissant metadata.

Both follow from the pack's files alone, so that equal packs have equal cards. ``datasets.load_dataset(FOLDER)`` opens
the pack by its card, and ``mlcroissant`` by ``croissant.json``.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pyarrow.parquet as pq

from facegen.conventions import SPLITS
from facegen.store.card import CARD, card, rig_names
from facegen.store.croissant import CROISSANT, PARQUET, croissant, file_set, table_rows


def cards(folder: Path, about: Mapping, entries: Sequence[Mapping]) -> dict[str, bytes]:
    """Contents of ``README.md`` and ``croissant.json``.

    Parameters
    ----------
    folder
        Of the pack; its files are whole.
    about
        ``pack.json``.
    entries
        ``index.json``: name, samples, bytes and sha256 of each file, at least one.
    """
    schema, described, title = pq.read_schema(folder / entries[0]["name"]), about["dataset"], _title(about)
    samples = {split: sum(each["samples"] for each in entries if _split(each) == split) for split in SPLITS}
    samples = {split: count for split, count in samples.items() if count}
    return {
        CARD: card(
            schema,
            described,
            title=title,
            samples=sum(samples.values()),
            # of a part nobody counts the people
            of=f"out of a dataset of {described['people']:,} synthetic people",
            data_files=[(split, f"{split}-*.parquet") for split in samples],
            contents=_contents(samples),
        ).encode(),
        CROISSANT: croissant(
            described,
            title=title,
            distribution=[*map(_file, entries), file_set("tables", "*.parquet", PARQUET)],
            record_sets=[table_rows("samples", schema, "tables")],
        ).encode(),
    }


def _contents(samples: Mapping[str, int]) -> str:
    rows = "".join(f"| {split} | {count:,} |\n" for split, count in samples.items())
    return f"""| split | samples |
|---|---|
{rows}
Splits share no person, unless the spec splits by session. From Python:

    import datasets
    rows = datasets.load_dataset("FOLDER", split="{next(iter(samples))}")"""


def _file(entry: Mapping) -> dict:
    return {
        "@type": "cr:FileObject",
        "@id": entry["name"],
        "name": entry["name"],
        "contentUrl": entry["name"],
        "contentSize": f"{entry['bytes']} B",
        "encodingFormat": PARQUET,
        "sha256": entry["sha256"],
    }


def _title(about: Mapping) -> str:
    described = about["dataset"]
    if about["format"] == "parquet":
        return f"Synthetic rendered headset pictures ({described['headset']})"
    return f"Synthetic face keypoints ({rig_names(described)})"


def _split(entry: Mapping) -> str:
    return entry["name"].partition("-")[0]

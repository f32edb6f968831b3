"""Writes a dataset folder's card and Croissant metadata.

Both follow from ``dataset.json``, the spec and the headset alone, not from what has been made so far: workers that
begin a dataset together write the same bytes, and nothing is written anew as pictures come.

``datasets`` opens a folder's files of one kind, so the card gives it the keypoint shards, which mix the splits: one
split ``samples``, with a column ``split``. Croissant names pictures and ``sample.json`` as well.
"""

from collections.abc import Mapping, Sequence

import pyarrow as pa

from facegen.conventions import SPLITS
from facegen.store.card import CARD, card, rig_names
from facegen.store.croissant import CROISSANT, PARQUET, PNG, TEXT, croissant, file_rows, file_set, table_rows
from facegen.store.folder import SHARD_PATTERN

SPLIT = "samples"
"""Name of the one split that the card gives; ``all`` is a word of ``datasets``' own."""


def folder_cards(
    schema: pa.Schema,
    described: Mapping,
    *,
    views: Sequence[str],
    split: str,
    split_shares: Sequence[float],
) -> dict[str, bytes]:
    """Contents of ``README.md`` and ``croissant.json``.

    Parameters
    ----------
    schema
        Of the keypoint shards.
    described
        ``dataset.json``.
    views
        Names of the headset's cameras.
    split
        What stays together in the split, ``person`` or ``session``.
    split_shares
        Shares of training, validation and test.
    """
    title = (
        f"Synthetic faces: keypoints and headset pictures ({rig_names(described)}, {described['headset']})"
    )
    return {
        CARD: card(
            schema,
            described,
            title=title,
            samples=described["samples"],
            of=f"of {described['people']:,} synthetic people",
            data_files=[(SPLIT, SHARD_PATTERN)],
            contents=_contents(views, split, split_shares),
        ).encode(),
        CROISSANT: _croissant(schema, described, title, views).encode(),
    }


def _contents(views: Sequence[str], split: str, split_shares: Sequence[float]) -> str:
    shares = "".join(
        f"| {name} | {share:.0%} |\n" for name, share in zip(SPLITS, split_shares, strict=True) if share
    )
    pictures = ", ".join(f"`{view}.png`" for view in views)
    people = "people" if split == "person" else "sessions"
    return f"""| `split` | share of the {people} |
|---|---|
{shares}
Keypoints of all samples are rows of `keypoints/`, of all splits together; the column `split` says which. From Python:

    import datasets
    rows = datasets.load_dataset("FOLDER", split="{SPLIT}")
    train = datasets.load_dataset("FOLDER", split="{SPLIT}", filters=[("split", "==", "train")])

Samples that were rendered have pictures, sample 123 in `renders/000/000123/`: {pictures}, with their labels in
`sample.json`. `croissant.json` names these files for `mlcroissant`. `datasets` opens files of one kind alone: for rows
with pictures run `facegen pack FOLDER --format parquet --out PACK`."""


def _croissant(schema: pa.Schema, described: Mapping, title: str, views: Sequence[str]) -> str:
    sets = [
        file_set("keypoints", SHARD_PATTERN, PARQUET),
        file_set("records", "renders/*/*/sample.json", TEXT),
    ]
    rows = [table_rows("samples", schema, "keypoints")]
    rows += [
        file_rows(
            "rendered",
            "records",
            number=_number("sample.json"),
            content="record",
            description="sample.json: labels of the pictures of a sample",
            kind="sc:Text",
        )
    ]
    for view in views:
        sets.append(file_set(f"{view}_files", f"renders/*/*/{view}.png", PNG))
        rows += [
            file_rows(
                f"{view}_pictures",
                f"{view}_files",
                number=_number(f"{view}.png"),
                content="picture",
                description=f"picture of camera {view}, 8-bit grey",
                kind="sc:ImageObject",
            )
        ]
    return croissant(described, title=title, distribution=sets, record_sets=rows)


def _number(name: str) -> str:
    """What finds a sample's number in the whole path of one of its files."""
    return rf".*[/\\]([0-9]+)[/\\]{name.replace('.', '[.]')}$"

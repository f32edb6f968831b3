"""Writes what a pack of Parquet files says of itself: a card that Hugging Face reads, and Croissant metadata.

Both follow from the pack's files alone, so that equal packs have equal cards. ``datasets.load_dataset(FOLDER)`` opens
the pack by its card, and ``mlcroissant`` by ``croissant.json`` (https://docs.mlcommons.org/croissant/docs/croissant-spec.html).
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import SPLITS

CARD, CROISSANT = "README.md", "croissant.json"

_SIZES = (1_000, 10_000, 100_000, 1_000_000, 10_000_000)
"""Ends of the size classes that a card may name."""

_CONTEXT = Path(__file__).parent / "croissant_context.json"
"""Words of Croissant 1.0, as its specification gives them: readers warn of any other."""

_CC0, _MIT = "https://creativecommons.org/publicdomain/zero/1.0/", "https://opensource.org/license/mit"


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
    schema = pq.read_schema(folder / entries[0]["name"])
    return {
        CARD: card(schema, about, entries).encode(),
        CROISSANT: (json.dumps(croissant(schema, about, entries), indent=1) + "\n").encode(),
    }


def card(schema: pa.Schema, about: Mapping, entries: Sequence[Mapping]) -> str:
    """Text of the card: splits, columns, licence and how the data were made."""
    dataset = about["dataset"]
    samples = {split: sum(each["samples"] for each in entries if _split(each) == split) for split in SPLITS}
    samples = {split: count for split, count in samples.items() if count}
    files = "\n".join(f"  - split: {split}\n    path: {split}-*.parquet" for split in samples)
    splits = "".join(f"| {split} | {count:,} |\n" for split, count in samples.items())
    columns = "".join(f"| `{field.name}` | {_type(field)} | {_described(field)} |\n" for field in schema)
    versions = ", ".join(f"{name} {version}" for name, version in sorted(dataset["versions"].items()))
    return f"""---
pretty_name: {json.dumps(_title(about))}
license: {_licence_tag(dataset)}
task_categories:
- keypoint-detection
tags:
- faces
- synthetic
- blendshapes
- landmarks
size_categories:
- {_size(sum(samples.values()))}
configs:
- config_name: default
  data_files:
{files}
---

# {_title(about)}

{sum(samples.values()):,} samples of {dataset["people"]:,} synthetic people, with exact labels.
Nobody in them exists, and nobody annotated anything.

| split | samples |
|---|---|
{splits}
Splits share no person, unless the spec splits by session. From Python:

    import datasets
    rows = datasets.load_dataset("FOLDER", split="{next(iter(samples))}")

| column | type | what it holds |
|---|---|---|
{columns}
## How it was made

facegen made it from the spec with the hash `{dataset["spec_hash"]}` and the seed {dataset["seed"]}.
The same spec and versions give the same labels again. Label version {dataset["label_version"]}; {versions}.
{_heads(dataset)}

## Licence

{about["licence"]}.
"""


def croissant(schema: pa.Schema, about: Mapping, entries: Sequence[Mapping]) -> dict:
    """Croissant 1.0 metadata of the files and the columns that it can say: numbers, words and lists of numbers."""
    dataset = about["dataset"]
    files = [
        {
            "@type": "cr:FileObject",
            "@id": each["name"],
            "name": each["name"],
            "contentUrl": each["name"],
            "contentSize": f"{each['bytes']} B",
            "encodingFormat": "application/x-parquet",
            "sha256": each["sha256"],
        }
        for each in entries
    ]
    tables = {
        "@type": "cr:FileSet",
        "@id": "tables",
        "name": "tables",
        "includes": "*.parquet",
        "encodingFormat": "application/x-parquet",
    }
    fields = [_croissant_field(field) for field in schema if not pa.types.is_struct(field.type)]
    return {
        "@context": json.loads(_CONTEXT.read_text(encoding="utf-8")),
        "@type": "sc:Dataset",
        "conformsTo": "http://mlcommons.org/croissant/1.0",
        "name": f"facegen-{dataset['spec_hash'][:12]}",
        "description": f"{_title(about)}: synthetic people with exact labels. {about['licence']}.",
        "citeAs": f"{_title(about)}, facegen {dataset['versions']['facegen']}, spec {dataset['spec_hash']}",
        "license": _licence_url(dataset),
        "url": f"urn:sha256:{dataset['spec_hash']}",
        "version": f"{dataset['label_version']}.0.0",
        "distribution": [*files, tables],
        "recordSet": [
            {"@type": "cr:RecordSet", "@id": "samples", "name": "samples", "field": fields},
        ],
    }


def _croissant_field(field: pa.Field) -> dict:
    described = {
        "@type": "cr:Field",
        "@id": f"samples/{field.name}",
        "name": field.name,
        "description": _described(field),
        "dataType": _croissant_type(field.type),
        "source": {"fileSet": {"@id": "tables"}, "extract": {"column": field.name}},
    }
    if pa.types.is_fixed_size_list(field.type):
        described |= {"cr:isArray": True, "cr:arrayShape": str(field.type.list_size)}
    elif pa.types.is_list(field.type):
        described |= {"cr:isArray": True, "cr:arrayShape": "-1"}
    return described


def _croissant_type(kind: pa.DataType) -> str:
    if pa.types.is_list(kind) or pa.types.is_fixed_size_list(kind):
        kind = kind.value_type
    if pa.types.is_boolean(kind):
        return "sc:Boolean"
    if pa.types.is_integer(kind):
        return "sc:Integer"
    return "sc:Float" if pa.types.is_floating(kind) else "sc:Text"


def _title(about: Mapping) -> str:
    kind = "rendered headset pictures" if about["format"] == "parquet" else "face keypoints"
    dataset = about["dataset"]
    rigs = ", ".join(rig["name"] for rig in _rigs(dataset))
    return f"Synthetic {kind} ({dataset['headset'] if about['format'] == 'parquet' else rigs})"


def _rigs(dataset: Mapping) -> list[Mapping]:
    """What ``dataset.json`` says of its rig, or of each of several."""
    return dataset["rigs"] if "rigs" in dataset else [dataset["rig"]]


def _heads(dataset: Mapping) -> str:
    """A sentence for each rig."""
    return "\n".join(
        f"The heads {_of_whom(rig)}come from the rig {rig['name']!r}, {rig['version']}: {rig['source']}."
        for rig in _rigs(dataset)
    )


def _of_whom(rig: Mapping) -> str:
    return f"of {rig['share']:.0%} of the people " if "share" in rig else ""


def _described(field: pa.Field) -> str:
    notes = {key.decode(): text.decode() for key, text in (field.metadata or {}).items()}
    further = [notes[key] for key in ("shape", "unit") if key in notes]
    text = notes.get("description", "")
    return f"{text} ({', '.join(further)})" if further else text


def _type(field: pa.Field) -> str:
    if pa.types.is_struct(field.type):
        return "picture"
    if pa.types.is_fixed_size_list(field.type):
        return f"{field.type.value_type}[{field.type.list_size}]"
    return str(field.type.value_type) + "[]" if pa.types.is_list(field.type) else str(field.type)


def _split(entry: Mapping) -> str:
    return entry["name"].partition("-")[0]


def _size(samples: int) -> str:
    names = ["1K", "10K", "100K", "1M", "10M"]
    for number, end in enumerate(_SIZES):
        if samples < end:
            return f"{names[number - 1]}<n<{names[number]}" if number else "n<1K"
    return f"n>{names[-1]}"


def _licence_tag(dataset: Mapping) -> str:
    tags = {
        "cc0-1.0" if licence.startswith("CC0") else "mit" if licence.startswith("MIT") else "other"
        for licence in (rig["licence"] for rig in _rigs(dataset))
    }
    return tags.pop() if len(tags) == 1 else "other"


def _licence_url(dataset: Mapping) -> str:
    tag = _licence_tag(dataset)
    return {"cc0-1.0": _CC0, "mit": _MIT}.get(tag, "; ".join(rig["licence"] for rig in _rigs(dataset)))

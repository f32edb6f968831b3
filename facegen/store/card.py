"""Writes what a dataset or a pack says of itself in words: a card that Hugging Face reads (``README.md``)."""

import json
from collections.abc import Mapping, Sequence

import pyarrow as pa

CARD = "README.md"

_SIZES = ("1K", "10K", "100K", "1M", "10M", "100M", "1B", "10B", "100B", "1T")
"""Ends of the size classes that a card may name, each ten times the one before; the first is a thousand
(https://github.com/huggingface/hub-docs/blob/main/datasetcard.md)."""


def card(
    schema: pa.Schema,
    described: Mapping,
    *,
    title: str,
    samples: int,
    of: str,
    data_files: Sequence[tuple[str, str]],
    contents: str,
) -> str:
    """Text of a card: what is in it, columns, licence and how the data were made.

    Parameters
    ----------
    schema
        Of its tables; fields may have notes ``description``, ``shape`` and ``unit``.
    described
        ``dataset.json``.
    title
        What people call it.
    samples
        How many there are.
    of
        What they are samples of, ``"of 4,000 synthetic people"``.
    data_files
        For each split its name and the files' pattern, as ``datasets.load_dataset(FOLDER)`` takes them from the head of
        the card (https://huggingface.co/docs/hub/datasets-manual-configuration).
    contents
        What the reader learns before the columns, Markdown.
    """
    files = "\n".join(f"  - split: {split}\n    path: {pattern}" for split, pattern in data_files)
    columns = "".join(f"| `{field.name}` | {_type(field)} | {described_field(field)} |\n" for field in schema)
    versions = ", ".join(f"{name} {version}" for name, version in sorted(described["versions"].items()))
    return f"""---
pretty_name: {json.dumps(title)}
license: {licence_tag(described)}
task_categories:
- keypoint-detection
tags:
- faces
- synthetic
- blendshapes
- landmarks
size_categories:
- {_size(samples)}
configs:
- config_name: default
  data_files:
{files}
---

# {title}

{samples:,} samples {of}, with exact labels.
{_whose(described)}

{contents}

| column | type | what it holds |
|---|---|---|
{columns}
## How it was made

facegen made it from the spec with the hash `{described["spec_hash"]}` and the seed {described["seed"]}.
The same spec and versions give the same labels again. Label version {described["label_version"]}; {versions}.
{_heads(described)}

## Licence

{described["licence"]}.
"""


def described_field(field: pa.Field) -> str:
    """What a column holds, with its shape and unit."""
    notes = {key.decode(): text.decode() for key, text in (field.metadata or {}).items()}
    further = [notes[key] for key in ("shape", "unit") if key in notes]
    text = notes.get("description", "")
    return f"{text} ({', '.join(further)})" if further else text


def rig_names(described: Mapping) -> str:
    """Names of the rigs of a dataset, by its ``dataset.json``."""
    return ", ".join(rig["name"] for rig in _rigs(described))


def licence_tag(described: Mapping) -> str:
    """Hugging Face's word for the licence of a dataset's rigs and recording, ``other`` where they differ."""
    tags = {
        "cc0-1.0" if licence.startswith("CC0") else "mit" if licence.startswith("MIT") else "other"
        for licence in licences_of(described)
    }
    return tags.pop() if len(tags) == 1 else "other"


def licences_of(described: Mapping) -> list[str]:
    """Licence of each rig, and of the recording that is played."""
    recorded = [described["recording"]["licence"]] if "recording" in described else []
    return [rig["licence"] for rig in _rigs(described)] + recorded


def _rigs(described: Mapping) -> list[Mapping]:
    """What ``dataset.json`` says of its rig, or of each of several."""
    return described["rigs"] if "rigs" in described else [described["rig"]]


def _heads(described: Mapping) -> str:
    """A sentence for each rig."""
    return "\n".join(
        f"The heads {_of_whom(rig)}come from the rig {rig['name']!r}, {rig['version']}: {rig['source']}."
        + (f" It lacks shapes: {', '.join(rig['missing'])}." if "missing" in rig else "")
        for rig in _rigs(described)
    )


def _whose(described: Mapping) -> str:
    """A sentence or two on who is in the data."""
    if "recording" not in described:
        return "Nobody in them exists, and nobody annotated anything."
    recording = described["recording"]
    return (
        "Nobody with these heads exists, but all of them move as a real person did in a recording.\n"
        f"Whose recording: {recording['credit']}. Licence of the recording: {recording['licence']}."
    )


def _of_whom(rig: Mapping) -> str:
    return f"of {rig['share']:.0%} of the people " if "share" in rig else ""


def _type(field: pa.Field) -> str:
    if pa.types.is_struct(field.type):
        return "picture"
    if pa.types.is_fixed_size_list(field.type):
        return f"{field.type.value_type}[{field.type.list_size}]"
    return str(field.type.value_type) + "[]" if pa.types.is_list(field.type) else str(field.type)


def _size(samples: int) -> str:
    """Class of a number of samples; one that is an end itself belongs to the class above."""
    number = max(len(str(samples)) - 3, 0)
    if number == 0:
        return f"n<{_SIZES[0]}"
    return f"{_SIZES[number - 1]}<n<{_SIZES[number]}" if number < len(_SIZES) else f"n>{_SIZES[-1]}"

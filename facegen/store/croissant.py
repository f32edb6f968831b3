"""Writes what a dataset or a pack says of itself to programs: Croissant 1.0 metadata (``croissant.json``).

Source: https://docs.mlcommons.org/croissant/docs/croissant-spec.html. ``mlcroissant`` reads it.
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import pyarrow as pa

from facegen.store.card import described_field, licence_tag, licences_of

CROISSANT = "croissant.json"

_CONTEXT = Path(__file__).parent / "croissant_context.json"
"""Words of Croissant 1.0, as its specification gives them: readers warn of any other."""

_LICENCES = {
    "cc0-1.0": "https://creativecommons.org/publicdomain/zero/1.0/",
    "mit": "https://opensource.org/license/mit",
}

PARQUET, PNG, TEXT = "application/x-parquet", "image/png", "text/plain"
"""``sample.json`` goes as text: ``mlcroissant`` parses files of JSON, and then cannot give one whole."""


def croissant(
    described: Mapping, *, title: str, distribution: Sequence[Mapping], record_sets: Sequence[Mapping]
) -> str:
    """Text of the metadata.

    Parameters
    ----------
    described
        ``dataset.json``.
    title
        What people call it.
    distribution
        Files, and sets of them (`file_set`).
    record_sets
        Rows in them (`table_rows`, `file_rows`).
    """
    tag = licence_tag(described)
    content = {
        "@context": json.loads(_CONTEXT.read_text(encoding="utf-8")),
        "@type": "sc:Dataset",
        "conformsTo": "http://mlcommons.org/croissant/1.0",
        "name": f"facegen-{described['spec_hash'][:12]}",
        "description": f"{title}: synthetic people with exact labels. {described['licence']}.",
        "citeAs": f"{title}, facegen {described['versions']['facegen']}, spec {described['spec_hash']}",
        "license": _LICENCES.get(tag, "; ".join(licences_of(described))),
        "url": f"urn:sha256:{described['spec_hash']}",
        "version": f"{described['label_version']}.0.0",
        "distribution": list(distribution),
        "recordSet": list(record_sets),
    }
    return json.dumps(content, indent=1) + "\n"


def file_set(name: str, pattern: str, encoding: str) -> dict:
    """Files of one kind."""
    return {
        "@type": "cr:FileSet",
        "@id": name,
        "name": name,
        "includes": pattern,
        "encodingFormat": encoding,
    }


def table_rows(name: str, schema: pa.Schema, files: str) -> dict:
    """Rows of tables of Parquet, with the columns that Croissant can say: numbers, words and lists of numbers."""
    fields = [_column(name, field, files) for field in schema if not pa.types.is_struct(field.type)]
    return {"@type": "cr:RecordSet", "@id": name, "name": name, "field": fields}


def file_rows(name: str, files: str, *, number: str, content: str, description: str, kind: str) -> dict:
    """A row for each file of a set: the sample's number, from the file's path, and its content.

    Parameters
    ----------
    name, files
        Of the rows, and of the set of files.
    number
        Regular expression whose group is the sample's number, for the file's whole path.
    content, description, kind
        Name of the field of the content, what it is, and its type in Croissant.
    """
    path = {"extract": {"fileProperty": "fullpath"}, "transform": {"regex": number}}
    fields = [
        {**_field(name, "sample", "sc:Integer", files, **path), "description": "number of the sample"},
        {
            **_field(name, content, kind, files, extract={"fileProperty": "content"}),
            "description": description,
        },
    ]
    return {"@type": "cr:RecordSet", "@id": name, "name": name, "field": fields}


def _column(rows: str, field: pa.Field, files: str) -> dict:
    described = _field(rows, field.name, _type(field.type), files, extract={"column": field.name})
    described |= {"description": described_field(field)}
    if pa.types.is_fixed_size_list(field.type):
        described |= {"cr:isArray": True, "cr:arrayShape": str(field.type.list_size)}
    elif pa.types.is_list(field.type):
        described |= {"cr:isArray": True, "cr:arrayShape": "-1"}
    return described


def _field(rows: str, name: str, kind: str, files: str, **how: Mapping) -> dict:
    return {
        "@type": "cr:Field",
        "@id": f"{rows}/{name}",
        "name": name,
        "dataType": kind,
        "source": {"fileSet": {"@id": files}, **how},
    }


def _type(kind: pa.DataType) -> str:
    if pa.types.is_list(kind) or pa.types.is_fixed_size_list(kind):
        kind = kind.value_type
    if pa.types.is_boolean(kind):
        return "sc:Boolean"
    if pa.types.is_integer(kind):
        return "sc:Integer"
    return "sc:Float" if pa.types.is_floating(kind) else "sc:Text"

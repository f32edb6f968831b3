"""Packs Parquet of rendered samples: one row a sample, its labels and its PNG files.

Pictures are structs of ``bytes`` and ``path``, which Hugging Face's datasets decode to images by themselves;
other programs take the bytes. ``record`` is ``sample.json`` whole: what has no column stands there.
"""

import json
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPES
from facegen.errors import InvalidData
from facegen.labels import VIEW_LABEL_KEYS, further_columns
from facegen.packing.plan import Options, PackFile, PackFormat, split_shards
from facegen.packing.rendered import RenderedFiles, chosen_views, read_rendered
from facegen.store import Dataset
from facegen.store.blocks import widest
from facegen.store.columns import RIG
from facegen.store.sample import ADVICE

SHARD_SAMPLES = 1000
ROW_GROUP = 100
"""Rows written, and held in memory, at a time: about 6 MB of 256 px pictures."""

_LABELS = (
    *("sample", "person", "session", "clip", "frame", "time_s", "split", "neutral", "component", "sex"),
    "age_years",
)
_KEYPOINTS = ("points_2d", "detected_2d", "points_3d", "visibility", "camera_from_head", "intrinsics")
_VIEW_KEYS = tuple(key for key in VIEW_LABEL_KEYS if key.parquet is not None)
_ARROW = {"float32": pa.float32(), "uint8": pa.uint8()}
_PICTURE = pa.struct([("bytes", pa.binary()), ("path", pa.string())])


def row_schema(dataset: Dataset, views: tuple[str, ...]) -> pa.Schema:
    """Columns of a pack with these views; labels are typed and described as in the keypoint shards."""
    keypoints = dataset.keypoint_schema
    fields = [keypoints.field(name) for name in (*_LABELS, "weights", "identity", *_keypoints(dataset))]
    fields += [RIG] * (len(dataset.rigs) > 1)
    for view in views:
        picture = {"description": f"PNG of camera {view}, 8-bit grey"}
        fields.append(pa.field(view, _PICTURE, metadata=picture))
        for key in _VIEW_KEYS:
            column, description = key.parquet, key.parquet.description.format(view=view)
            notes = {"description": description, "unit": key.unit, "shape": column.shape}
            notes = {name: text for name, text in notes.items() if text}
            kind = pa.list_(_ARROW[column.kind], column.width)
            fields.append(pa.field(f"{view}_{key.name}", kind, nullable=False, metadata=notes))
    fields.append(pa.field("record", pa.string(), nullable=False, metadata={"description": "sample.json"}))
    features = {"info": {"features": {view: {"_type": "Image"} for view in views}}}
    about = {"licence": dataset.licence, "spec_hash": dataset.hash, "huggingface": json.dumps(features)}
    return pa.schema(fields, metadata=about)


def write_rows(dataset: Dataset, part: PackFile, options: Options, path: Path) -> None:
    """Write one file, a row group in memory at a time."""
    views = chosen_views(dataset, options)
    schema = row_schema(dataset, views)
    with pq.ParquetWriter(path, schema, compression="zstd", write_page_checksum=True) as writer:
        for start in range(0, len(part.samples), ROW_GROUP):
            numbers = part.samples[start : start + ROW_GROUP]
            samples = read_rendered(dataset, numbers, [f"{view}.png" for view in views])
            rows = [_table(dataset, sample, views, schema) for sample in samples]
            writer.write_table(pa.concat_tables(rows).combine_chunks(), row_group_size=ROW_GROUP)


def _table(dataset: Dataset, sample: RenderedFiles, views: tuple[str, ...], schema: pa.Schema) -> pa.Table:
    """Table of one sample; labels that its columns cannot hold are its damage."""
    try:
        row = _row(sample, views, _keypoints(dataset))
        if len(dataset.rigs) > 1:  # sample.json has as many numbers as the person's own rig
            row["identity"] += [0.0] * (widest(dataset.rigs) - len(row["identity"]))
            row["rig"] = sample.record["rig"]
        return pa.Table.from_pylist([row], schema=schema)
    except (KeyError, TypeError, ValueError, OverflowError, pa.ArrowException) as error:
        path = dataset.folder.render(sample.number) / "sample.json"
        raise InvalidData(f"{path}: has labels that no column can hold ({error!r}); {ADVICE}") from None


def _keypoints(dataset: Dataset) -> tuple[str, ...]:
    return (*_KEYPOINTS, *(column.name for column in further_columns(dataset.spec)))


def _row(sample: RenderedFiles, views: tuple[str, ...], keypoints: tuple[str, ...]) -> dict:
    record, row = sample.record, {"record": sample.text.decode()}
    row |= {name: record[name] for name in _LABELS}
    row["weights"] = [record["weights"][name] for name in BLENDSHAPES]
    row["identity"] = record["identity"]
    row |= {name: _flat(record["keypoints"][name]) for name in keypoints}
    for view in views:
        row[view] = {"bytes": sample.pictures[f"{view}.png"], "path": f"{sample.number:06d}.{view}.png"}
        row |= {f"{view}_{key.name}": _flat(record["views"][view][key.name]) for key in _VIEW_KEYS}
    return row


def _flat(values: list) -> list:
    array = np.array(values)
    return array.astype(np.float64).ravel().tolist() if array.dtype == object else array.ravel().tolist()


PARQUET = PackFormat(
    description="Parquet of rendered samples: labels and PNG files, one row a sample",
    rendered=True,
    options=frozenset({"shard_size", "views"}),
    shard_size=SHARD_SAMPLES,
    parts=split_shards,
    write=write_rows,
    carded=True,
)

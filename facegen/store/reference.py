"""Writes docs/labels.md, every label of a sample, from the tables that the labels themselves follow from."""

import pyarrow as pa

from facegen.labels import KEYPOINT_LABELS, VIEW_LABEL_KEYS
from facegen.store.columns import shard_columns

_HEAD = """# Labels

Written by `facegen spec labels > docs/labels.md` from the lists that the labels follow from. A new label of a view is
a module and a line in [`facegen/labels/views.py`](../facegen/labels/views.py), a new column of all samples a module
and a line in [`facegen/labels/keypoints.py`](../facegen/labels/keypoints.py); files, packs, checks and this page
follow. [Reading a dataset](reading-a-dataset.md) shows how to read them, [Conventions](conventions.md) the frames and
orders.

## Keypoint shards

Columns of `keypoints/shard-*.parquet`; arrays are flat in their cells. Columns in italics are there where the spec
asks for them (`[landmarks]`), and in `keypoints` of `sample.json` too. `identity` has as many numbers as the rig has
components. Datasets of several rigs have one column more, `rig`, the name of the person's.

| column | type | shape | unit | meaning |
|---|---|---|---|---|
"""

_VIEWS = """
## Views

Keys of `views.CAMERA` in `sample.json`, beside `camera`, `camera_from_head` and `shot`. Those marked with a star are
columns `CAMERA_KEY` of `facegen pack --format parquet` too.

| key | unit, frame | meaning |
|---|---|---|
"""


def labels_reference() -> str:
    """The page ``docs/labels.md``."""
    further = {column.name for label in KEYPOINT_LABELS for column in label.columns}
    columns = shard_columns(0, [column for label in KEYPOINT_LABELS for column in label.columns])
    shards = [
        f"| {f'*`{c.name}`*' if c.name in further else f'`{c.name}`'} | {_type(c.kind)} "
        f"| {c.shape.replace(' ', ' x ')} | {c.unit} | {c.description} |\n"
        for c in columns
    ]
    views = [
        f"| `{key.name}`{'' if key.parquet is None else ' *'} | {key.unit} | {key.meaning} |\n"
        for key in VIEW_LABEL_KEYS
    ]
    return "".join([_HEAD, *shards, _VIEWS, *views])


def _type(kind: pa.DataType) -> str:
    """``float[136]`` of a list of 136 floats."""
    if pa.types.is_fixed_size_list(kind):
        return f"{kind.value_type}[{kind.list_size}]"
    return f"{kind.value_type}[]" if pa.types.is_list(kind) else str(kind)

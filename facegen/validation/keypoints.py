"""Checks keypoint shards against themselves, and against labels made anew from (spec, sample number)."""

from collections.abc import Iterator

import numpy as np
import pyarrow as pa

from facegen.conventions import BLOCK
from facegen.errors import InvalidData
from facegen.geometry import apply_transform, project_pinhole
from facegen.store import (
    Dataset,
    column_array,
    differing_rows,
    draw_block,
    label_block,
    read_shard,
    shard_samples,
)
from facegen.store.keypoint_table import has_columns
from facegen.validation.finding import Finding
from facegen.validation.ranges import impossible

REPROJECTION_PX = 0.01
"""3D points must project onto their 2D labels this well; float32 rounding is about 1e-4 px at 1,000 px."""
FAR_SHARE = 2e-6
"""Share of its pixels by which a landmark may be off besides: nearly beside a pinhole camera they go into the millions,
and distortion raises the 6e-8 by which 32-bit numbers round to the fifth power of the distance. A narrow view from near
multiplies the rounding of points too."""


def check_shard(dataset: Dataset, number: int) -> Iterator[Finding]:
    """Findings in one shard; Parquet's own page checksums are verified on the way."""
    path = dataset.folder.shard(number)
    where = path.relative_to(dataset.folder.path).as_posix()

    def finding(what: str, kind: str, *, at: str = "") -> Finding:
        return Finding(where + at, what, kind, remove=where)

    try:
        table = read_shard(path)
    except InvalidData as error:
        kind = "checksum" if "crc" in str(error).lower() else "unreadable"
        yield finding(str(error).removeprefix(f"{path}: "), kind)
        return
    if not has_columns(table.schema, dataset.keypoint_schema):
        yield finding("has other columns than this version of facegen writes", "label")
        return
    expected = shard_samples(number, total=dataset.plan.samples)
    if not np.array_equal(table.column("sample").to_numpy(), np.arange(expected.start, expected.stop)):
        rows = f"{expected.start}-{expected.stop - 1}"
        yield finding(f"should hold samples {rows}, one row each, in order", "label")
        return
    for check in (_projections, _ranges, _labels):
        for sample, what, kind in check(dataset, table):
            yield finding(what, kind, at=f", sample {sample}")


def _projections(_dataset: Dataset, table: pa.Table) -> Iterator[tuple[int, str, str]]:
    points = column_array(table, "points_3d").astype(np.float64)
    in_camera = apply_transform(column_array(table, "camera_from_head"), points)
    projected = project_pinhole(in_camera, column_array(table, "intrinsics"))
    error = np.linalg.norm(projected - column_array(table, "points_2d"), axis=-1)
    allowed = REPROJECTION_PX + FAR_SHARE * np.linalg.norm(projected, axis=-1)
    for row, landmark in np.argwhere(~(error <= allowed)):
        distance, most = f"{error[row, landmark]:.3f} px", f"{allowed[row, landmark]:.3f}"
        what = f"landmark {landmark} in 3D projects {distance} from its 2D label (allowed {most})"
        yield table["sample"][int(row)].as_py(), what, "label"


def _ranges(dataset: Dataset, table: pa.Table) -> Iterator[tuple[int, str, str]]:
    wrong = impossible(
        weights=column_array(table, "weights"),
        visibility=column_array(table, "visibility"),
        gaze=column_array(table, "gaze"),
        transforms=column_array(table, "camera_from_head"),
        recorded=dataset.plan.recording is not None,
    )
    for name, row, what in wrong:
        yield table["sample"][row].as_py(), f"{name}: {what}", "range"


def _labels(dataset: Dataset, table: pa.Table) -> Iterator[tuple[int, str, str]]:
    first = table["sample"][0].as_py()
    for start in range(0, len(table), BLOCK):
        stored = table.slice(start, BLOCK)
        block = (first + start) // BLOCK
        made = label_block(dataset, block, draw_block(dataset, block))
        for name in stored.column_names:
            rows = np.flatnonzero(differing_rows(column_array(stored, name), column_array(made, name)))
            if len(rows):
                what = f"{name} is not what the spec gives ({len(rows)} such rows in its block)"
                yield first + start + int(rows[0]), what, "label"

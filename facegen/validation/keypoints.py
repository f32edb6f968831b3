"""Checks of keypoint shards: against themselves, and against labels computed anew from (spec, sample number)."""

from collections.abc import Iterator

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import BLOCK
from facegen.geometry import apply_transform
from facegen.labels import label_keypoints, project_pinhole
from facegen.sampling import draw_samples
from facegen.store import Dataset, column_array, keypoint_schema, keypoint_table, shard_samples
from facegen.validation.finding import Finding

REPROJECTION_PX = 0.01
"""3D points must project onto their 2D labels this well; float32 rounding is about 1e-4 px at 1,000 px."""


def check_shard(dataset: Dataset, number: int) -> Iterator[Finding]:
    """Findings in one shard."""
    path = dataset.folder.shard(number)
    where = str(path.relative_to(dataset.folder.path))
    try:
        table = pq.read_table(path)
    except (OSError, pa.ArrowException) as error:
        yield Finding(where, f"cannot be read as Parquet ({error})")
        return
    if not table.schema.equals(keypoint_schema(dataset.rig.components)):
        yield Finding(where, "has other columns than this version of facegen writes")
        return
    expected = shard_samples(number, total=dataset.plan.samples)
    if not np.array_equal(table.column("sample").to_numpy(), np.arange(expected.start, expected.stop)):
        yield Finding(where, f"should hold samples {expected.start}-{expected.stop - 1}, one row each, in order")
        return
    yield from _check_projection(table, where)
    yield from _check_labels(dataset, table, where)


def _check_projection(table: pa.Table, where: str) -> Iterator[Finding]:
    in_camera = apply_transform(column_array(table, "camera_from_head"), column_array(table, "points_3d").astype(np.float64))
    error = project_pinhole(in_camera, column_array(table, "intrinsics")) - column_array(table, "points_2d")
    for row, landmark in np.argwhere(~(np.linalg.norm(error, axis=-1) <= REPROJECTION_PX)):
        distance = np.linalg.norm(error[row, landmark])
        yield Finding(
            f"{where}, sample {table['sample'][int(row)]}",
            f"landmark {landmark} in 3D projects {distance:.3f} px away from its 2D label (allowed {REPROJECTION_PX})",
        )


def _check_labels(dataset: Dataset, table: pa.Table, where: str) -> Iterator[Finding]:
    spec, first = dataset.spec, table["sample"][0].as_py()
    for start in range(0, len(table), BLOCK):
        stored = table.slice(start, BLOCK)
        samples = draw_samples(dataset.plan, dataset.rig, (first + start) // BLOCK).rows(slice(0, len(stored)))
        size = spec.camera.width_px, spec.camera.height_px
        made = keypoint_table(samples, label_keypoints(spec, dataset.rig, samples), image_size=size)
        for name in stored.column_names:
            if stored[name].combine_chunks().equals(made[name].combine_chunks()):
                continue
            differs = (column_array(stored, name) != column_array(made, name)).reshape(len(stored), -1).any(axis=1)
            rows = np.flatnonzero(differs)
            yield Finding(
                f"{where}, sample {first + start + rows[0]}",
                f"{name} is not what the spec gives for this sample ({len(rows)} such rows in its block)",
            )

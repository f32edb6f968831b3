"""Keypoint shards: the columns of the Parquet files, their writer and their reader."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPES, SPLITS
from facegen.errors import InvalidData
from facegen.labels import Keypoints
from facegen.sampling import COMPONENT_NAMES, Samples


def _field(name: str, kind: pa.DataType, description: str, *, shape: str = "", unit: str = "") -> pa.Field:
    notes = (
        {"description": description} | ({"shape": shape} if shape else {}) | ({"unit": unit} if unit else {})
    )
    return pa.field(name, kind, nullable=False, metadata=notes)


def keypoint_schema(components: int, *, sliding_contour: bool = False) -> pa.Schema:
    """Columns of a shard whose rig has that many identity components; every column says its unit and shape.

    ``sliding_contour`` as in the spec's ``[landmarks]``: it adds two columns.
    """

    def floats(width: int) -> pa.DataType:
        return pa.list_(pa.float32(), width)

    # a rig without identities has lists without entries; of a fixed size of 0, Arrow 22 dies by a division by 0
    identity = floats(components) if components else pa.list_(pa.float32())
    slid = "landmarks 0-16, slid to the face's outline where the face hides them"
    contour = [
        _field("contour_2d", floats(34), slid, shape="17 2", unit="px"),
        _field("contour_3d", floats(51), f"{slid}, in the head frame", shape="17 3", unit="m"),
    ]
    return pa.schema(
        [
            _field("sample", pa.int64(), "number of the sample in the dataset"),
            _field("person", pa.int64(), "number of the person"),
            _field("session", pa.int64(), "number of the session: one donning of the headset"),
            _field("clip", pa.int64(), "number of the clip"),
            _field("frame", pa.int32(), "number of the frame in its clip"),
            _field("time_s", pa.float64(), "time from the start of the clip", unit="s"),
            _field("split", pa.string(), "train, validation or test"),
            _field("neutral", pa.bool_(), "a neutral face"),
            _field("component", pa.string(), "what made the expression: " + " ".join(COMPONENT_NAMES)),
            _field("sex", pa.string(), "female or male"),
            _field("age_years", pa.float32(), "age", unit="years"),
            _field("ancestry", floats(3), "shares of African, Asian and Caucasian ancestry"),
            _field("weights", floats(len(BLENDSHAPES)), "ARKit blendshape weights: " + " ".join(BLENDSHAPES)),
            _field("identity", identity, "coefficients of the rig's identity basis"),
            _field("gaze", floats(6), "unit optical axes, head frame, subject's left eye first", shape="2 3"),
            _field(
                "camera_from_head",
                pa.list_(pa.float64(), 16),
                "head pose in the keypoint camera",
                shape="4 4",
                unit="m",
            ),
            _field("intrinsics", pa.list_(pa.float64(), 4), "fx fy cx cy of the keypoint camera", unit="px"),
            _field(
                "image_size", pa.list_(pa.int32(), 2), "width and height of the keypoint camera", unit="px"
            ),
            _field("points_2d", floats(136), "exact landmarks", shape="68 2", unit="px"),
            _field(
                "detected_2d",
                floats(136),
                "landmarks with detector noise; NaN where no face is found",
                shape="68 2",
                unit="px",
            ),
            _field("points_3d", floats(204), "landmarks in the head frame", shape="68 3", unit="m"),
            _field("visibility", pa.list_(pa.uint8(), 68), "0 outside the picture, 1 hidden, 2 visible"),
            _field("face_width", pa.float32(), "distance between landmarks 0 and 16", unit="px"),
            *(contour if sliding_contour else ()),
        ]
    )


def keypoint_table(samples: Samples, keypoints: Keypoints, *, image_size: tuple[int, int]) -> pa.Table:
    """Table of labelled samples; float64 becomes float32 here, cameras and times stay float64."""
    n = len(samples.sample)
    sliding_contour = keypoints.contour_2d.shape[1] > 0
    schema = keypoint_schema(samples.identity.shape[1], sliding_contour=sliding_contour)
    columns = {
        "sample": samples.sample,
        "person": samples.person,
        "session": samples.session,
        "clip": samples.clip,
        "frame": samples.frame,
        "time_s": samples.time_s,
        "split": np.array(SPLITS, dtype=object)[samples.split],
        "neutral": samples.neutral,
        "component": np.array(COMPONENT_NAMES, dtype=object)[samples.component],
        "sex": np.where(samples.female, "female", "male").astype(object),
        "age_years": samples.age_years,
        "ancestry": samples.ancestry,
        "weights": samples.weights,
        "identity": samples.identity,
        "gaze": samples.gaze,
        "camera_from_head": samples.camera_from_head,
        "intrinsics": samples.intrinsics,
        "image_size": np.broadcast_to(image_size, (n, 2)),
        "points_2d": keypoints.points_2d,
        "detected_2d": keypoints.detected_2d,
        "points_3d": keypoints.points_3d,
        "visibility": keypoints.visibility,
        "face_width": keypoints.face_width,
        "contour_2d": keypoints.contour_2d,
        "contour_3d": keypoints.contour_3d,
    }
    return pa.table([_column(columns[field.name], field.type) for field in schema], schema=schema)


_NUMPY = {
    pa.float32(): np.float32,
    pa.float64(): np.float64,
    pa.int32(): np.int32,
    pa.int64(): np.int64,
    pa.uint8(): np.uint8,
    pa.bool_(): np.bool_,
}


def _column(values: np.ndarray, kind: pa.DataType) -> pa.Array:
    if pa.types.is_string(kind):
        return pa.array(values, type=kind)
    if pa.types.is_fixed_size_list(kind):
        flat = np.ascontiguousarray(values, dtype=_NUMPY[kind.value_type]).ravel()
        return pa.FixedSizeListArray.from_arrays(pa.array(flat), type=kind)
    if pa.types.is_list(kind):
        return pa.array([[]] * len(values), type=kind)
    return pa.array(np.ascontiguousarray(values, dtype=_NUMPY[kind]), type=kind)


def write_shard(table: pa.Table, path: Path) -> None:
    """Write a shard, every page with a checksum; equal tables give equal bytes with one version of pyarrow.

    Only columns of few values get a dictionary: floats rarely repeat, and looking made files half as large again and
    writing four times as slow.
    """
    pq.write_table(
        table,
        path,
        compression="zstd",
        use_dictionary=["split", "sex", "component", "image_size.list.element"],
        row_group_size=len(table),
        write_statistics=True,
        write_page_checksum=True,
    )


def read_shard(path: Path, columns: Sequence[str] | None = None) -> pa.Table:
    """Read a shard, or some of its columns; the checksums of all pages read are verified.

    Raises
    ------
    InvalidData
        If the file cannot be read, or is not what was written.
    """
    try:
        return pq.read_table(
            path, columns=None if columns is None else list(columns), page_checksum_verification=True
        )
    except (OSError, pa.ArrowException) as error:
        raise InvalidData(
            f"{path}: cannot be read as Parquet ({error}); run facegen validate --repair, then facegen generate"
        ) from error


def column_array(table: pa.Table, name: str) -> np.ndarray:
    """A column as (n, ...) array in the shape its field's metadata tells."""
    column = table.column(name).combine_chunks()
    field = table.schema.field(name)
    if pa.types.is_list(field.type):
        return np.empty((len(column), 0), _NUMPY[field.type.value_type])
    if not pa.types.is_fixed_size_list(field.type):
        return column.to_numpy(zero_copy_only=False)
    shape = (field.metadata or {}).get(b"shape", str(field.type.list_size).encode()).decode()
    return column.flatten().to_numpy().reshape(len(column), *(int(size) for size in shape.split()))

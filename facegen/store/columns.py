"""Lists the columns of the keypoint shards: what each says of itself in the file, and where its values come from."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pyarrow as pa

from facegen.conventions import BLENDSHAPES, SPLITS
from facegen.labels import Keypoints
from facegen.labels.keypoint_label import KeypointColumn
from facegen.sampling import COMPONENT_NAMES, Samples

IDENTITY = "identity"
"""The column whose width is the rig's number of identity components."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """One column.

    Attributes
    ----------
    name, kind
        Name, and Arrow's type of a row.
    values
        Takes n rows and their labels, gives (n, ...).
    description, shape, unit
        What the file says of it; a shape has its numbers apart (``"68 2"``).
    """

    name: str
    kind: pa.DataType
    values: Callable[[Samples, Keypoints], np.ndarray]
    description: str
    shape: str = ""
    unit: str = ""

    @property
    def field(self) -> pa.Field:
        """The column as a schema has it."""
        notes = {"description": self.description, "shape": self.shape, "unit": self.unit}
        return pa.field(
            self.name, self.kind, nullable=False, metadata={key: text for key, text in notes.items() if text}
        )


def _drawn(name: str, kind: pa.DataType, description: str, *, shape: str = "", unit: str = "") -> Column:
    """A column that is a field of `Samples`."""
    return Column(
        name=name,
        kind=kind,
        values=lambda samples, _: getattr(samples, name),
        description=description,
        shape=shape,
        unit=unit,
    )


def _labelled(name: str, kind: pa.DataType, description: str, *, shape: str = "", unit: str = "") -> Column:
    """A column that is a field of `Keypoints`."""
    return replace(
        _drawn(name, kind, description, shape=shape, unit=unit),
        values=lambda _, keypoints: getattr(keypoints, name),
    )


def _further(column: KeypointColumn) -> Column:
    """A column of a further label."""
    return Column(
        name=column.name,
        kind=_floats(int(np.prod(column.shape))),
        values=lambda _, keypoints: keypoints.further[column.name],
        description=column.description,
        shape=" ".join(map(str, column.shape)),
        unit=column.unit,
    )


def _named(names: Sequence[str], numbers: np.ndarray) -> np.ndarray:
    return np.array(names, dtype=object)[numbers]


def _floats(width: int) -> pa.DataType:
    return pa.list_(pa.float32(), width)


_COLUMNS = (
    _drawn("sample", pa.int64(), "number of the sample in the dataset"),
    _drawn("person", pa.int64(), "number of the person"),
    _drawn("session", pa.int64(), "number of the session: one donning of the headset"),
    _drawn("clip", pa.int64(), "number of the clip"),
    _drawn("frame", pa.int32(), "number of the frame in its clip"),
    _drawn("time_s", pa.float64(), "time from the start of the clip", unit="s"),
    Column(
        name="split",
        kind=pa.string(),
        values=lambda samples, _: _named(SPLITS, samples.split),
        description="train, validation or test",
    ),
    _drawn("neutral", pa.bool_(), "a neutral face"),
    Column(
        name="component",
        kind=pa.string(),
        values=lambda samples, _: _named(COMPONENT_NAMES, samples.component),
        description="what made the expression: " + " ".join(COMPONENT_NAMES),
    ),
    Column(
        name="sex",
        kind=pa.string(),
        values=lambda samples, _: np.where(samples.female, "female", "male").astype(object),
        description="female or male",
    ),
    _drawn("age_years", pa.float32(), "age", unit="years"),
    _drawn("ancestry", _floats(3), "shares of African, Asian and Caucasian ancestry"),
    _drawn("weights", _floats(len(BLENDSHAPES)), "ARKit blendshape weights: " + " ".join(BLENDSHAPES)),
    _drawn(IDENTITY, pa.list_(pa.float32()), "coefficients of the rig's identity basis"),
    _drawn("gaze", _floats(6), "unit optical axes, head frame, subject's left eye first", shape="2 3"),
    _drawn(
        "camera_from_head",
        pa.list_(pa.float64(), 16),
        "head pose in the keypoint camera",
        shape="4 4",
        unit="m",
    ),
    _drawn("intrinsics", pa.list_(pa.float64(), 4), "fx fy cx cy of the keypoint camera", unit="px"),
    _labelled("image_size", pa.list_(pa.int32(), 2), "width and height of the keypoint camera", unit="px"),
    _labelled("points_2d", _floats(136), "exact landmarks", shape="68 2", unit="px"),
    _labelled(
        "detected_2d",
        _floats(136),
        "landmarks with detector noise; NaN where no face is found",
        shape="68 2",
        unit="px",
    ),
    _labelled("points_3d", _floats(204), "landmarks in the head frame", shape="68 3", unit="m"),
    _labelled("visibility", pa.list_(pa.uint8(), 68), "0 outside the picture, 1 hidden, 2 visible"),
    _labelled("face_width", pa.float32(), "distance between landmarks 0 and 16", unit="px"),
)


def shard_columns(components: int, further: Sequence[KeypointColumn] = ()) -> tuple[Column, ...]:
    """Columns of a shard.

    Parameters
    ----------
    components
        Identity components of the rig.
    further
        What the spec asks for besides (`facegen.labels.further_columns`).
    """
    # a rig without identities has lists without entries; of a fixed size of 0, Arrow 22 dies by a division by 0
    own = (
        replace(column, kind=_floats(components)) if column.name == IDENTITY and components else column
        for column in _COLUMNS
    )
    return (*own, *map(_further, further))

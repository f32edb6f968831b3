"""Lists the columns of the keypoint shards: what each says of itself in the file, and where its values come from."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
import pyarrow as pa

from facegen.conventions import BLENDSHAPES, SPLITS
from facegen.labels import Keypoints
from facegen.labels.keypoint_label import KeypointColumn
from facegen.sampling import COMPONENT_NAMES, Samples

_DRAWN = {field.name for field in fields(Samples)}

IDENTITY = "identity"
"""The column whose width is the rig's number of identity components, or the most that one of several rigs has."""

RIG = pa.field(
    "rig",
    pa.string(),
    nullable=False,
    metadata={"description": "name of the person's rig, where there are several"},
)
"""The last column of datasets of several rigs; others have none."""


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


def _column(
    name: str,
    kind: pa.DataType,
    description: str,
    *,
    values: Callable[[Samples, Keypoints], np.ndarray] | None = None,
    shape: str = "",
    unit: str = "",
) -> Column:
    """A column; without ``values`` it holds the field of its name of the rows, or else of their labels."""

    def own(samples: Samples, keypoints: Keypoints) -> np.ndarray:
        return getattr(samples if name in _DRAWN else keypoints, name)

    return Column(name=name, kind=kind, values=values or own, description=description, shape=shape, unit=unit)


def _further(column: KeypointColumn) -> Column:
    """A column of a further label."""
    return _column(
        column.name,
        _floats(int(np.prod(column.shape))),
        column.description,
        values=lambda _, keypoints: keypoints.further[column.name],
        shape=" ".join(map(str, column.shape)),
        unit=column.unit,
    )


def _named(names: Sequence[str], numbers: np.ndarray) -> np.ndarray:
    return np.array(names, dtype=object)[numbers]


def _floats(width: int) -> pa.DataType:
    return pa.list_(pa.float32(), width)


_COLUMNS = (
    _column("sample", pa.int64(), "number of the sample in the dataset"),
    _column("person", pa.int64(), "number of the person"),
    _column("session", pa.int64(), "number of the session: one donning of the headset"),
    _column("clip", pa.int64(), "number of the clip"),
    _column("frame", pa.int32(), "number of the frame in its clip"),
    _column("time_s", pa.float64(), "time from the start of the clip", unit="s"),
    _column(
        "split",
        pa.string(),
        "train, validation or test",
        values=lambda samples, _: _named(SPLITS, samples.split),
    ),
    _column("neutral", pa.bool_(), "a neutral face"),
    _column(
        "component",
        pa.string(),
        "what made the expression: " + " ".join(COMPONENT_NAMES),
        values=lambda samples, _: _named(COMPONENT_NAMES, samples.component),
    ),
    _column(
        "sex",
        pa.string(),
        "female or male",
        values=lambda samples, _: np.where(samples.female, "female", "male").astype(object),
    ),
    _column("age_years", pa.float32(), "age", unit="years"),
    _column("ancestry", _floats(3), "shares of African, Asian and Caucasian ancestry"),
    _column("weights", _floats(len(BLENDSHAPES)), "ARKit blendshape weights: " + " ".join(BLENDSHAPES)),
    _column(IDENTITY, pa.list_(pa.float32()), "coefficients of the rig's identity basis"),
    _column("gaze", _floats(6), "unit optical axes, head frame, subject's left eye first", shape="2 3"),
    _column(
        "camera_from_head",
        pa.list_(pa.float64(), 16),
        "head pose in the keypoint camera",
        shape="4 4",
        unit="m",
    ),
    _column("intrinsics", pa.list_(pa.float64(), 4), "fx fy cx cy of the keypoint camera", unit="px"),
    _column("image_size", pa.list_(pa.int32(), 2), "width and height of the keypoint camera", unit="px"),
    _column("points_2d", _floats(136), "exact landmarks", shape="68 2", unit="px"),
    _column(
        "detected_2d",
        _floats(136),
        "landmarks with detector noise; NaN where no face is found",
        shape="68 2",
        unit="px",
    ),
    _column("points_3d", _floats(204), "landmarks in the head frame", shape="68 3", unit="m"),
    _column("visibility", pa.list_(pa.uint8(), 68), "0 outside the picture, 1 hidden, 2 visible"),
    _column("face_width", pa.float32(), "distance between landmarks 0 and 16", unit="px"),
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

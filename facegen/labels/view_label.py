"""Says what a label of a view is: a record of its own type, made for all views of a sample at once."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Protocol, Self

from facegen.rigs import Rig
from facegen.sessions import SampleScene


@dataclass(frozen=True, kw_only=True)
class ParquetColumn:
    """The column ``CAMERA_KEY`` of a key in packs of the format ``parquet``.

    Attributes
    ----------
    description
        What the file says of it; ``{view}`` stands for the camera's name.
    kind, width
        ``"float32"`` or ``"uint8"``, and how many numbers a row has.
    shape
        Shape of a row (``"68 2"``); without one it is flat.
    """

    description: str
    kind: Literal["float32", "uint8"]
    width: int
    shape: str = ""


@dataclass(frozen=True, kw_only=True)
class LabelKey:
    """One key of a view in ``sample.json``.

    Attributes
    ----------
    name
        The key, ``"points_2d"``.
    meaning
        What it holds, in Markdown, for docs/labels.md.
    unit
        Unit and frame, ``"px"`` or ``"m, camera"``.
    parquet
        Its column in packs of the format ``parquet``; without one it stands in their column ``record`` alone.
    """

    name: str
    meaning: str
    unit: str = ""
    parquet: ParquetColumn | None = None


class ViewLabel(Protocol):
    """A label of a view: a frozen dataclass in a module of its own, and a line in `facegen.labels.views.ViewLabels`."""

    KEYS: ClassVar[tuple[LabelKey, ...]]

    @classmethod
    def of_sample(cls, rig: Rig, sample: SampleScene) -> dict[str, Self]:
        """Make the label of every view, by camera name."""

    def record(self) -> dict[str, Any]:
        """Values of `KEYS`: arrays, which are written as float32 and with null for NaN, or dicts and lists of them."""

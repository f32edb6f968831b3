"""Reads adjustments from a JSON file.

::

    {"format": "regress-adjustment", "shapes": {"jawOpen": {"gain": 1.3}, "*": {"dead_zone": 0.05}}}
"""

import os
from pathlib import Path
from typing import Annotated, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    FiniteFloat,
    ValidationError,
    model_validator,
)

from facegen.conventions import BLENDSHAPES
from facegen.refusals import refusal
from regress.errors import InputError
from regress.runtime.documents import read_document
from regress.runtime.stages.adjustment import ShapeAdjustment

MOST_BYTES = 2**20
"""Of the file: 53 entries are some 5 kB."""

LARGEST = 1000.0
"""Of a factor, an addend or a limit, either way: a gain of it makes a switch of a weight."""

_Number = Annotated[FiniteFloat, Field(ge=-LARGEST, le=LARGEST)]


def _known_shape(name: str) -> str:
    if name != "*" and name not in BLENDSHAPES:
        raise ValueError("is not one of the 52 ARKit names, nor *")
    return name


class _Shape(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)

    gain: _Number = 1.0
    offset: _Number = 0.0
    dead_zone: Annotated[FiniteFloat, Field(ge=0, lt=1)] = 0.0
    low: _Number = 0.0
    high: _Number = 1.0

    @model_validator(mode="after")
    def _ordered(self) -> "_Shape":
        if self.low > self.high:
            raise ValueError(f"low {self.low} is above high {self.high}")
        return self


class _AdjustmentFile(BaseModel):
    model_config = ConfigDict(extra="ignore")

    format: Literal["regress-adjustment"]
    shapes: dict[Annotated[str, AfterValidator(_known_shape)], _Shape] = Field(default_factory=dict)


def read_adjustments(path: str | os.PathLike[str]) -> dict[str, ShapeAdjustment]:
    """Read an adjustment file: JSON with ``format``, and under ``shapes`` a ShapeAdjustment by name.

    The name ``"*"`` stands for every shape that is not named.

    Raises
    ------
    InputError
        Where the file is missing or says something that is not known.
    """
    path = Path(path)
    try:
        document = _AdjustmentFile.model_validate(read_document(path, most_bytes=MOST_BYTES))
    except ValidationError as error:
        raise InputError(f"{path}: {refusal(error, _AdjustmentFile)}") from error
    return {name: ShapeAdjustment(**entry.model_dump()) for name, entry in document.shapes.items()}

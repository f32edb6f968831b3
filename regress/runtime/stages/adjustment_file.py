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
from regress.runtime.stages.adjustment import ShapeAdjustment


def _known_shape(name: str) -> str:
    if name != "*" and name not in BLENDSHAPES:
        raise ValueError("is not one of the 52 ARKit names, nor *")
    return name


class _Shape(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)

    gain: FiniteFloat = 1.0
    offset: FiniteFloat = 0.0
    dead_zone: Annotated[FiniteFloat, Field(ge=0, lt=1)] = 0.0
    low: FiniteFloat = 0.0
    high: FiniteFloat = 1.0

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
        document = _AdjustmentFile.model_validate_json(path.read_bytes())
    except OSError as error:
        raise InputError(f"{path} is not a readable JSON file: {error}") from error
    except ValidationError as error:
        raise InputError(f"{path}: {refusal(error, _AdjustmentFile)}") from error
    return {name: ShapeAdjustment(**entry.model_dump()) for name, entry in document.shapes.items()}

"""Reads retargetings from TOML files: those that come with the package, and a user's own.

::

    title = "my avatar"
    source = "where names and factors come from"

    [shapes]                                        # one line a column of the result
    Smile = { mouthSmileLeft = 0.5, mouthSmileRight = 0.5 }
    JawSide = { jawRight = 1.0, jawLeft = -1.0 }
    EarWiggle = {}                                  # nothing drives it: always 0

    [limits]                                        # 0 to 1 where a shape is not named
    JawSide = [-1.0, 1.0]
"""

import os
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    FiniteFloat,
    ValidationError,
    model_validator,
)

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.documents import load_toml
from facegen.refusals import refusal
from regress.errors import InputError
from regress.runtime.stages.retargeting.matrix import Retargeting
from regress.runtime.stages.retargeting.shipped import TARGETS, shipped_targets

MOST_SHAPES = 2000
"""Of a target: columns of every table; avatars have some hundreds."""

LARGEST = 1000.0
"""Of a factor or a limit, either way: a factor of it makes a switch of a weight."""


def _arkit_name(name: str) -> str:
    if name not in BLENDSHAPE_INDEX:
        raise ValueError("is not one of the 52 ARKit names")
    return name


def _about_zero(limits: tuple[float, float]) -> tuple[float, float]:
    if not limits[0] <= 0 <= limits[1]:
        raise ValueError("must be two numbers [low, high] about 0")
    return limits


_Number = Annotated[FiniteFloat, Field(strict=True, ge=-LARGEST, le=LARGEST)]
_Shape = Annotated[str, Field(min_length=1, max_length=200)]


class _TargetFile(BaseModel):
    model_config = ConfigDict(extra="forbid")

    title: str = ""
    source: str = ""
    shapes: Annotated[
        dict[_Shape, dict[Annotated[str, AfterValidator(_arkit_name)], _Number]],
        Field(min_length=1, max_length=MOST_SHAPES),
    ]
    limits: dict[str, Annotated[tuple[_Number, _Number], AfterValidator(_about_zero)]] = Field(
        default_factory=dict
    )

    @model_validator(mode="after")
    def _limits_of_shapes(self) -> "_TargetFile":
        for shape in self.limits:
            if shape not in self.shapes:
                raise ValueError(f"limits.{shape} is not among the shapes")
        return self


def read_retargeting(name: str) -> Retargeting:
    """Read a shipped target by name, or a user's ``.toml`` file.

    Raises
    ------
    InputError
        Where there is no such target or file, or the file says something that is not known.
    """
    shipped = shipped_targets()
    path = Path(str(TARGETS / f"{name}.toml")) if name in shipped else Path(name)
    if name not in shipped and not os.path.lexists(path):
        raise InputError(f"no target {name!r}: {', '.join(shipped)} are known, or give a .toml file")
    try:
        document = _TargetFile.model_validate(load_toml(path))
    except ValidationError as error:
        raise InputError(f"{path}: {refusal(error, _TargetFile)}") from error
    bounds = [document.limits.get(shape, (0.0, 1.0)) for shape in document.shapes]
    low, high = np.array(bounds, dtype=np.float64).T
    columns = [[factors.get(name, 0.0) for name in BLENDSHAPES] for factors in document.shapes.values()]
    return Retargeting(
        title=document.title or name,
        source=document.source,
        names=tuple(document.shapes),
        factors=np.array(columns, dtype=np.float64).T,
        low=low,
        high=high,
    )

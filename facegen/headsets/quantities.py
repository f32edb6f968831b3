"""Kinds of numbers that headset files hold, and the record that refuses unknown keys."""

from functools import partial
from typing import Annotated

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

CONFIG = ConfigDict(extra="forbid", allow_inf_nan=False)
record = partial(dataclass, frozen=True, kw_only=True, config=CONFIG)
"""Decorator of every table of a headset file."""

Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]
Fraction = Annotated[float, Field(ge=0, le=1)]
Pair = tuple[float, float]
Vector = tuple[float, float, float]
Spread = tuple[NotNegative, NotNegative, NotNegative]
MM = 1e-3

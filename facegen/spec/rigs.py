"""Names the rigs of a spec: one for everyone, or several with shares of the people."""

from math import isfinite
from typing import Annotated, Any

from pydantic import PlainSerializer, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

MOST_RIGS = 8
"""Of one spec: each is loaded whole, some 100 MB, by every worker, and every block is drawn for each."""

LARGEST_SHARE = 1000.0

Shares = tuple[tuple[str, float], ...]
"""Names with shares, in the names' order: a spec has to be hashable, and how its table is written does not matter."""


def _check(value: Any) -> str | Shares:
    if isinstance(value, str):
        return value
    if isinstance(value, tuple):  # of a spec that is checked again: JSON has none
        value = dict(value)
    if not isinstance(value, dict) or not 2 <= len(value) <= MOST_RIGS:
        raise PydanticCustomError(
            "rigs",
            "must be the name of a rig, or a table of 2 to {most} names with shares, as {anny = 0.5, ict = 0.5}",
            {"most": MOST_RIGS},
        )
    for name, share in value.items():
        number = isinstance(share, int | float) and not isinstance(share, bool)
        if not number or not isfinite(share) or not 0 < share <= LARGEST_SHARE:
            raise PydanticCustomError(
                "rigs",
                "the share of {name} must be a number above 0, up to {largest}",
                {"name": repr(name), "largest": f"{LARGEST_SHARE:g}"},
            )
    return tuple((name, float(value[name])) for name in sorted(value))


def _as_data(rigs: str | Shares) -> str | dict[str, float]:
    return rigs if isinstance(rigs, str) else dict(rigs)


Rigs = Annotated[
    str | Shares,
    PlainValidator(_check),
    PlainSerializer(_as_data),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "string"},
                {
                    "type": "object",
                    "minProperties": 2,
                    "maxProperties": MOST_RIGS,
                    "additionalProperties": {
                        "type": "number",
                        "exclusiveMinimum": 0,
                        "maximum": LARGEST_SHARE,
                    },
                },
            ]
        }
    ),
]
"""Type of the key ``rig``."""


def shares_of(rigs: str | Shares) -> dict[str, float]:
    """Shares of the people by rig, adding up to 1, in the names' order."""
    table = ((rigs, 1.0),) if isinstance(rigs, str) else rigs
    whole = sum(share for _, share in table)
    return {name: share / whole for name, share in table}

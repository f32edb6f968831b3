"""Numbers that vary, as data: ``12``, ``{uniform = [-20, 20]}`` or ``{normal = [0, 6], within = [-20, 20]}``."""

from dataclasses import dataclass
from math import isfinite
from typing import Annotated, Any, Literal

import numpy as np
import scipy
from pydantic import BeforeValidator, PlainSerializer, WithJsonSchema
from pydantic_core import PydanticCustomError

DEFAULT_SDS = 3.0
"""A normal distribution without ``within`` is cut at this many standard deviations."""
FARTHEST_SDS = 6.0
"""Shares of a normal beyond 8 are not told from none in double precision, and every draw would be a bound."""


@dataclass(frozen=True, kw_only=True)
class Distribution:
    """A number, uniform or truncated normal; ``low`` and ``high`` bound every draw."""

    kind: Literal["constant", "uniform", "normal"]
    low: float
    high: float
    mean: float = 0.0
    sd: float = 0.0


def draw(distribution: Distribution, rng: np.random.Generator, size: int | tuple[int, ...]) -> np.ndarray:
    """Values (size) of a distribution: exactly one random number each, so later draws never shift."""
    unit = rng.random(size)
    if distribution.kind == "normal":
        below, above = (
            scipy.special.ndtr((edge - distribution.mean) / distribution.sd)
            for edge in (distribution.low, distribution.high)
        )
        value = distribution.mean + distribution.sd * scipy.special.ndtri(below + unit * (above - below))
        return np.clip(value, distribution.low, distribution.high)
    return distribution.low + unit * (distribution.high - distribution.low)


def _pair(value: Any, what: str) -> tuple[float, float]:
    if (
        not isinstance(value, list | tuple)
        or len(value) != 2
        or any(isinstance(x, bool) or not isinstance(x, int | float) or not isfinite(x) for x in value)
    ):
        raise PydanticCustomError("distribution", "{what} must be two finite numbers", {"what": what})
    return float(value[0]), float(value[1])


def _normal(value: dict[str, Any]) -> Distribution:
    mean, sd = _pair(value["normal"], "normal = [mean, standard deviation]")
    if sd <= 0:
        raise PydanticCustomError("distribution", "the standard deviation of a normal must be above 0")
    low, high = mean - DEFAULT_SDS * sd, mean + DEFAULT_SDS * sd
    if "within" in value:
        low, high = _pair(value["within"], "within = [low, high]")
        if max(low - mean, mean - high) > FARTHEST_SDS * sd:
            raise PydanticCustomError(
                "distribution",
                "within lies more than {sds} standard deviations from the mean, where next to nothing is drawn",
                {"sds": f"{FARTHEST_SDS:g}"},
            )
    return Distribution(kind="normal", low=low, high=high, mean=mean, sd=sd)


def parse(value: Any) -> Distribution:
    """Distribution of a TOML value; raises ``PydanticCustomError`` with one sentence if it is none."""
    if isinstance(value, Distribution):
        return value
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Distribution(kind="constant", low=float(value), high=float(value))
    if isinstance(value, dict) and set(value) == {"uniform"}:
        low, high = _pair(value["uniform"], "uniform = [low, high]")
        result = Distribution(kind="uniform", low=low, high=high)
    elif isinstance(value, dict) and "normal" in value and set(value) <= {"normal", "within"}:
        result = _normal(value)
    else:
        raise PydanticCustomError(
            "distribution",
            "must be a number, {uniform = [low, high]} or {normal = [mean, sd], within = [low, high]}",
        )
    if not result.low < result.high:
        raise PydanticCustomError("distribution", "the lower bound must be below the upper one")
    return result


def as_data(distribution: Distribution) -> float | dict[str, list[float]]:
    """The TOML value of a distribution; `parse` takes it back."""
    if distribution.kind == "constant":
        return distribution.low
    bounds = [distribution.low, distribution.high]
    if distribution.kind == "uniform":
        return {"uniform": bounds}
    return {"normal": [distribution.mean, distribution.sd], "within": bounds}


def _schema(low: float, high: float, unit: str) -> WithJsonSchema:
    number = {"type": "number", "minimum": low, "maximum": high}

    def pair(first: dict, second: dict) -> dict:
        return {"type": "array", "prefixItems": [first, second], "items": False, "minItems": 2}

    def table(required: str, **properties: dict) -> dict:
        return {
            "type": "object",
            "properties": properties,
            "required": [required],
            "additionalProperties": False,
        }

    bounds = pair(number, number)
    normal = pair({"type": "number"}, {"type": "number", "exclusiveMinimum": 0})
    return WithJsonSchema(
        {
            "anyOf": [
                number,
                table("uniform", uniform=bounds),
                table("normal", normal=normal, within=bounds),
            ],
            "x-unit": unit,
        }
    )


def quantity(low: float, high: float, unit: str) -> Any:
    """Type of a spec's key whose every draw must lie in ``[low, high]``, given in ``unit``."""

    def check(value: Any) -> Distribution:
        result = parse(value)
        if not low <= result.low <= result.high <= high:
            drawn = ""
            if result.kind == "normal" and isinstance(value, dict) and "within" not in value:
                drawn = f"; this draws from {result.low:g} to {result.high:g}, give within"
            raise PydanticCustomError(
                "quantity",
                "must lie between {low} and {high} {unit}{drawn}",
                {"low": f"{low:g}", "high": f"{high:g}", "unit": unit, "drawn": drawn},
            )
        return result

    return Annotated[Distribution, BeforeValidator(check), PlainSerializer(as_data), _schema(low, high, unit)]

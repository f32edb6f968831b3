"""A retargeting matrix and the TOML file it stands in.

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

import sys
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.errors import InputError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_SECTIONS = ("title", "source", "shapes", "limits")


@dataclass(frozen=True, kw_only=True)
class Retargeting:
    """From the 52 ARKit weights to those of k other shapes: a product, then limits.

    Parameters
    ----------
    title, source
        What it is for, and where names and factors come from.
    names
        The k shapes, in the order of the result.
    factors : (52, k) float64
        Rows in `BLENDSHAPES` order.
    low, high : (k,) float64
        Limits of the result; 0 lies between them, so that a neutral face stays one.
    """

    title: str
    source: str
    names: tuple[str, ...]
    factors: np.ndarray
    low: np.ndarray
    high: np.ndarray

    def apply(self, weights: np.ndarray) -> np.ndarray:
        """Weights (n, k) of the target from ARKit weights (n, 52); rows of NaN stay NaN."""
        missing = np.isnan(weights).any(axis=1, keepdims=True)
        moved = np.clip(np.where(missing, 0.0, weights) @ self.factors, self.low, self.high)
        return np.where(missing, np.nan, moved)


def shipped_targets() -> tuple[str, ...]:
    """Names that `read_retargeting` knows without a file."""
    return tuple(sorted(path.name.removesuffix(".toml") for path in _shipped().iterdir()))


def read_retargeting(name: str) -> Retargeting:
    """Read a shipped target by name, or a user's ``.toml`` file.

    Raises
    ------
    InputError
        Where there is no such target or file, or the file says something that is not known.
    """
    known = shipped_targets()
    place = _shipped() / f"{name}.toml" if name in known else Path(name)
    try:
        document = tomllib.loads(place.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise InputError(f"no target {name!r}: {', '.join(known)} are known, or give a .toml file") from error
    except (OSError, ValueError) as error:
        raise InputError(f"{place} is not a readable TOML file: {error}") from error
    for section in document:
        if section not in _SECTIONS:
            raise InputError(f"{place}: {section} is not known; known are {', '.join(_SECTIONS)}")
    shapes = _table(document, "shapes", place)
    limits = _table(document, "limits", place)
    if not shapes:
        raise InputError(f"{place} names no shape; each is a line under [shapes]")
    for shape in limits:
        if shape not in shapes:
            raise InputError(f"{place}: limits.{shape} is not among the shapes")
    bounds = [_limits(limits.get(shape, (0.0, 1.0)), shape, place) for shape in shapes]
    low, high = np.array(bounds, dtype=np.float64).T
    return Retargeting(
        title=str(document.get("title", name)),
        source=str(document.get("source", "")),
        names=tuple(shapes),
        factors=np.stack([_factors(entry, shape, place) for shape, entry in shapes.items()], axis=1),
        low=low,
        high=high,
    )


def _shipped() -> Any:
    return resources.files("regress.runtime.stages.retargeting") / "targets"


def _table(document: dict[str, Any], section: str, place: Path) -> dict[str, Any]:
    table = document.get(section, {})
    if not isinstance(table, dict):
        raise InputError(f"{place}: {section} is {table!r}; a table [{section}] is needed")
    return table


def _factors(entry: Any, shape: str, place: Path) -> np.ndarray:
    if not isinstance(entry, dict):
        raise InputError(f"{place}: shapes.{shape} is {entry!r}; a table like {{ jawOpen = 1.0 }} is needed")
    column = np.zeros(len(BLENDSHAPES))
    for name, factor in entry.items():
        if name not in BLENDSHAPE_INDEX:
            raise InputError(f"{place}: shapes.{shape}.{name} is not one of the 52 ARKit names")
        if not _is_number(factor):
            raise InputError(f"{place}: shapes.{shape}.{name} is {factor!r}; a finite number is needed")
        column[BLENDSHAPE_INDEX[name]] = factor
    return column


def _limits(entry: Any, shape: str, place: Path) -> tuple[float, float]:
    pair = isinstance(entry, list | tuple) and len(entry) == 2 and all(map(_is_number, entry))
    if not pair or not entry[0] <= 0 <= entry[1]:
        raise InputError(f"{place}: limits.{shape} is {entry!r}; two numbers [low, high] about 0 are needed")
    return float(entry[0]), float(entry[1])


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and bool(np.isfinite(value))

"""Faces as data: emotions, visemes and voluntary movements, each as weights at full strength (``templates/*.toml``).

In a template, and in every draw before `facegen.expression.couplings.close_lips`, the column of
mouthClose holds the *closing*: the share of jawOpen over which the lips stay closed, so that a template can be
made weaker without its lips parting.
"""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.documents import load_toml

CLOSING = BLENDSHAPE_INDEX["mouthClose"]
"""Column that holds the closing until the lips are closed."""

_FOLDER = Path(__file__).parent / "templates"


@dataclass(frozen=True, kw_only=True, eq=False)
class Templates:
    """A family of templates.

    Attributes
    ----------
    names
        K names, in the file's order.
    weights
        (K, 52) weights of both sides at full strength; `CLOSING` holds the closing.
    """

    names: tuple[str, ...]
    weights: np.ndarray

    def __len__(self) -> int:
        return len(self.names)


@dataclass(frozen=True, kw_only=True, eq=False)
class Emotions:
    """Emotions as action units.

    Attributes
    ----------
    names
        E names.
    always, sometimes
        (E, A) bool: action units that everyone shows with it, and those that some do.
    units
        The A action units as templates, named by their FACS numbers.
    """

    names: tuple[str, ...]
    always: np.ndarray
    sometimes: np.ndarray
    units: Templates


@cache
def load_templates(family: str) -> Templates:
    """The family ``"visemes"``, ``"mouth"``, ``"eyes"`` or ``"action_units"``."""
    table = load_toml(_FOLDER / f"{family}.toml")
    rows = [_row(entry["weights"], entry.get("close", 1.0)) for entry in table.values()]
    return Templates(names=tuple(table), weights=np.array(rows))


@cache
def load_emotions() -> Emotions:
    """All emotions of ``templates/emotions.toml``."""
    table = load_toml(_FOLDER / "emotions.toml")
    units = load_templates("action_units")

    def mask(key: str) -> np.ndarray:
        return np.array([[int(unit) in entry[key] for unit in units.names] for entry in table.values()])

    return Emotions(names=tuple(table), always=mask("always"), sometimes=mask("sometimes"), units=units)


def columns(name: str) -> list[int]:
    """Columns of a shape; those of both sides for a name without Left or Right, such as ``"mouthSmile"``."""
    both = (name,) if name in BLENDSHAPE_INDEX else (f"{name}Left", f"{name}Right")
    return [BLENDSHAPE_INDEX[side] for side in both]


def _row(weights: dict[str, float], closing: float) -> np.ndarray:
    row = np.zeros(len(BLENDSHAPES))
    for name, value in weights.items():
        row[columns(name)] = value
    row[CLOSING] = closing
    return row

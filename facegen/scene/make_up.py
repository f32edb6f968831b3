"""Make-up as infra-red cameras see it: mascara and eyeliner stay dark, lipstick all but vanishes."""

from dataclasses import dataclass, replace

import numpy as np

from facegen.scene.looks import Look
from facegen.scene.materials import MATERIALS

BUNCH = 5
"""Neighbouring lashes that mascara sticks together."""


@dataclass(frozen=True, kw_only=True)
class MakeUp:
    """What a person wears in one session; 0 is none.

    Attributes
    ----------
    mascara
        0 to 1: how much thicker and darker lashes are, and how far neighbours stick together.
    liner
        0 to 1: share of the light that the line along the upper lashes absorbs.
    lipstick
        Factor on the albedo of the lips.
    """

    mascara: float
    liner: float
    lipstick: float


def draw_make_up(rng: np.random.Generator) -> MakeUp:
    """A session's make-up.

    Black pigments of mascara and liner are carbon black and iron oxide, which absorb in the near infra-red as they do
    in the visible; the dyes of lipsticks mostly do not. How much is a guess: no measurement at 850 nm is known to us.
    """
    mascara, lined, liner, lipstick = rng.random(4)
    return MakeUp(
        mascara=float(0.3 + 0.7 * mascara),
        liner=float(0.3 + 0.5 * liner) if lined < 0.6 else 0.0,
        lipstick=float(0.93 + 0.09 * lipstick),
    )


def made_up(look: Look, make_up: MakeUp) -> Look:
    """A person's look with make-up on."""
    materials = {name: dict(values) for name, values in look.materials.items()}
    for name, key, factor in (
        ("lashes", "albedo", 1.0 - 0.4 * make_up.mascara),
        ("lips", "albedo", make_up.lipstick),
    ):
        values = materials.setdefault(name, {})
        values[key] = values.get(key, MATERIALS[name][key]) * factor
    materials.setdefault("skin", {})["liner"] = make_up.liner
    thicker = 1.0 + 0.5 * make_up.mascara
    lashes = replace(
        look.lashes,
        radius_m=tuple(radius * thicker for radius in look.lashes.radius_m),
        place=tuple(_stuck(place, make_up.mascara) for place in look.lashes.place),
        aside_m=tuple(_stuck(aside[..., None], make_up.mascara)[..., 0] for aside in look.lashes.aside_m),
    )
    return replace(look, lashes=lashes, materials=materials)


def _stuck(strands: np.ndarray, share: float) -> np.ndarray:
    """Strands (s, p, d), roots first and in their order along the lid, whose tips go to those of their bunches."""
    bunch = np.arange(len(strands)) // BUNCH
    middle = np.stack([strands[bunch == b].mean(axis=0) for b in range(bunch.max(initial=-1) + 1)])[bunch]
    way = share * np.linspace(0.0, 1.0, strands.shape[1])[:, None]
    return strands + way * (middle - strands)

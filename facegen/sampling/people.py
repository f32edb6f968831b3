"""Draws people: traits that the rig knows, and the coefficients of its identity basis."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from facegen.conventions import BLOCK, SPLITS
from facegen.randomness import stream
from facegen.rigs import Rig
from facegen.rigs.threads import one_blas_thread
from facegen.sampling.blocks import blocks_of
from facegen.spec import Spec, draw, shares_of

LARGEST_SCORE = 2.5
"""Standard normal draws are cut here: identities further out fold the skin at nose and lips."""

YOUNG_YEARS, OLD_YEARS = 25.0, 90.0
"""Ages of the rig's "young" and "old" adults (MakeHuman's anchors); younger adults take the young shape."""


@dataclass(frozen=True, kw_only=True, eq=False)
class People:
    """Traits and identity coefficients of people.

    Attributes
    ----------
    female
        (n,) bool.
    age_years
        (n,) years.
    ancestry
        (n, 3) shares of African, Asian and Caucasian ancestry, adding up to 1.
    identity
        (n, K) coefficients of the rig's identity basis.
    """

    female: np.ndarray
    age_years: np.ndarray
    ancestry: np.ndarray
    identity: np.ndarray


def draw_people(spec: Spec, rig: Rig, block: int) -> People:
    """The 1,000 people of one block of people."""
    traits_rng = stream(spec.seed, "traits", block)
    female = traits_rng.random(BLOCK) < spec.identity.female
    age_years = draw(spec.identity.age_years, traits_rng, BLOCK)
    ancestry = traits_rng.dirichlet([spec.identity.ancestry_concentration] * 3, BLOCK)
    edge = scipy.special.ndtr(LARGEST_SCORE)
    unit = stream(spec.seed, "identity", block).random((BLOCK, rig.components))
    scores = scipy.special.ndtri((1 - edge) + unit * (2 * edge - 1)) * spec.identity.spread
    known = {
        "one": np.ones(BLOCK),
        "female": female.astype(np.float64),
        "age": np.clip((age_years - YOUNG_YEARS) / (OLD_YEARS - YOUNG_YEARS), 0.0, 1.0),
        "african": ancestry[:, 0],
        "asian": ancestry[:, 1],
    }
    with one_blas_thread():
        identity = scores @ rig.identity_residual.T
        if rig.traits:
            identity += np.stack([known[name] for name in rig.traits], axis=-1) @ rig.identity_from_traits.T
    return People(female=female, age_years=age_years, ancestry=ancestry, identity=identity)


def people_of(spec: Spec, rig: Rig, person: np.ndarray) -> People:
    """People by number (n,); whole blocks of people are drawn, then picked from."""
    blocks, row = blocks_of(person)
    drawn = [draw_people(spec, rig, block) for block in blocks]

    def pick(name: str) -> np.ndarray:
        return np.concatenate([getattr(people, name) for people in drawn])[row]

    return People(**{name: pick(name) for name in ("female", "age_years", "ancestry", "identity")})


def rig_of(spec: Spec, person: np.ndarray) -> np.ndarray:
    """Index into the spec's rigs (`facegen.spec.shares_of`) of people (n,); each is drawn by the rigs' shares."""
    edges = np.cumsum(list(shares_of(spec.rig).values()))[:-1]
    if not len(edges):
        return np.zeros(len(person), np.int64)
    blocks, row = blocks_of(person)
    unit = np.concatenate([stream(spec.seed, "rig", block).random(BLOCK) for block in blocks])[row]
    return np.searchsorted(edges, unit, side="right")


def split_of(spec: Spec, unit: np.ndarray) -> np.ndarray:
    """Index into `facegen.conventions.SPLITS` of people (n,), or of sessions where ``split = "session"``.

    A random partition of all of them by the spec's shares.
    """
    total = spec.people
    if spec.split == "session" and spec.kind != "playback":  # which is one session
        total *= (spec.sequence if spec.kind == "sequence" else spec.still).sessions
    everyone = _split_of_everyone(spec.seed, total, tuple(spec.split_shares))
    return everyone[np.minimum(unit, total - 1)]


_CHUNK = 1_000_000
"""People at a time: of a hundred million all at once, the places and edges would take 1.6 GB beside the order."""


@lru_cache(maxsize=2)
def _split_of_everyone(seed: int, total: int, shares: tuple[float, ...]) -> np.ndarray:
    """(total,) int8; kept, because every block asks and a million people take 25 ms."""
    order = stream(seed, "split", 0).permutation(total)
    edges = np.round(np.cumsum(shares) * total).astype(int)
    split = np.empty(total, np.int8)
    for start in range(0, total, _CHUNK):
        place = np.arange(start, min(start + _CHUNK, total))
        split[order[place]] = np.minimum(np.searchsorted(edges, place, side="right"), len(SPLITS) - 1)
    split.flags.writeable = False
    return split

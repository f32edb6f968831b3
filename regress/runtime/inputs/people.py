"""Tells which face of a film's picture is whose, where the file does not say."""

from collections import Counter
from collections.abc import Hashable, Sequence
from itertools import groupby

import numpy as np


def places_of(pictures: Sequence[Hashable], *, first: int = 0) -> list[str]:
    """Which face of its picture each is, by their order, counted from ``first``."""
    seen: Counter[Hashable] = Counter()
    places = []
    for picture in pictures:
        places.append(str(first + seen[picture]))
        seen[picture] += 1
    return places


def people_of(points: np.ndarray, pictures: Sequence[Hashable], *, first: int = 0) -> list[str]:
    """Who each face is: the nearest to where that person was before, as detectors give faces in any order.

    There are as many people as faces in the picture that has most; rows without a face are of who is left.

    Parameters
    ----------
    points : (n, 68, 2) float64
        NaN where a row has no face.
    pictures
        That each row is of, those of one behind one another.
    first
        What people are counted from.
    """
    middles = points.mean(axis=1)
    people = np.zeros(len(points), dtype=int)
    last = np.empty((0, 2))
    for _, group in groupby(range(len(points)), key=pictures.__getitem__):
        rows = np.array(list(group))
        last = np.concatenate([last, np.full((max(0, len(rows) - len(last)), 2), np.nan)])
        people[rows] = _nearest(middles[rows], last)
        seen = rows[np.isfinite(middles[rows]).all(axis=1)]
        last[people[seen]] = middles[seen]
    return [str(first + person) for person in people]


def _nearest(middles: np.ndarray, last: np.ndarray) -> list[int]:
    """A person of n for each of k faces (k <= n), the nearest pair first; who is nowhere yet comes behind, by order."""
    apart = np.linalg.norm(middles[:, None] - last, axis=2)
    nowhere = np.isnan(apart)  # sorted behind all others
    chosen = [-1] * len(middles)
    left = set(range(len(last)))
    for pair in np.argsort(apart, axis=None, kind="stable").tolist():
        face, person = divmod(pair, len(last))
        if chosen[face] < 0 and person in left and not nowhere[face, person]:
            chosen[face] = person
            left.remove(person)
    missing = np.isnan(middles).any(axis=1)
    for face in sorted(
        (face for face, person in enumerate(chosen) if person < 0), key=lambda face: missing[face]
    ):
        chosen[face] = min(left)
        left.remove(chosen[face])
    return chosen

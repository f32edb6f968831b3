"""Sets answers about one eye's gaze right by targets that were looked at, and makes one of several.

Each answer gets a map of its own, near that of the mean person as far as the targets say nothing of it. An answer
counts by how far it is off at targets that its map was not fitted to.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

FEWEST_TARGETS = 3
"""That say how far an answer is off: one or two are met by any map."""

_FEWEST_KEPT = 5
"""Targets that are left where others are left out: each has two angles, and a map six numbers."""

_TIMES_OFF, _OFF_DEG = 3.0, 3.0
"""A target that is missed by as many times what others are in the median, and by as many degrees, was not looked at:
the eye was half shut, or elsewhere."""

_LEAST_DEG = 0.5
"""Error that any answer has: people look no nearer to a target."""

_STEADY_DEG = 10.0
"""Root of the trust in the mean person's map against a target that was looked at to a degree: five targets decide, one
moves the map and leaves its slopes."""


@dataclass(frozen=True, kw_only=True)
class OwnGaze:
    """What sets several answers about one eye's gaze right, and how they become one.

    Parameters
    ----------
    maps
        (2, 3) of each answer: yaw and pitch in degrees from the answer's yaw and pitch and 1.
    shares : (answers,)
        Adding up to 1.
    error_deg
        Of all together at the targets.
    decided
        Whether there were targets enough to tell which answer is better; the first one stands alone without.
    missed_deg
        By how much targets were missed that are left out, by their number: they were not looked at.
    """

    maps: tuple[np.ndarray, ...]
    shares: np.ndarray
    error_deg: float
    decided: bool = True
    missed_deg: Mapping[int, float] = field(default_factory=dict)

    def apply(self, gazes_deg: Sequence[np.ndarray]) -> np.ndarray:
        """One gaze (n, 2) of the answers (n, 2)."""
        better = [_mapped(gaze, one) for gaze, one in zip(gazes_deg, self.maps, strict=True)]
        return np.tensordot(self.shares, np.array(better), axes=1)


def correction(looked: np.ndarray, targets_deg: np.ndarray) -> np.ndarray:
    """Map (2, 3) to targets (k, 2) in degrees from where an answer says they were looked for (k, 2), and 1.

    The slopes and turns of the map stay near those of the mean person as far as the targets say nothing of them: one
    target moves the map, five or nine over the field decide it.
    """
    middle_looked, middle_target = looked.mean(axis=0), targets_deg.mean(axis=0)
    beside, wanted = looked - middle_looked, targets_deg - middle_target
    gram = beside.T @ beside + _STEADY_DEG**2 * np.eye(2)
    slopes = np.linalg.solve(gram, beside.T @ wanted + _STEADY_DEG**2 * np.eye(2)).T
    return np.column_stack([slopes, middle_target - slopes @ middle_looked])


def corrected(gaze_deg: np.ndarray, looked: np.ndarray, targets_deg: np.ndarray) -> np.ndarray:
    """Gaze (n, 2) in degrees through the `correction` by targets (k, 2) at which it was said to be ``looked``."""
    return _mapped(gaze_deg, correction(looked, targets_deg))


def _mapped(gaze_deg: np.ndarray, one: np.ndarray) -> np.ndarray:
    return gaze_deg @ one[:, :2].T + one[:, 2]


def own_gaze(looked: Sequence[np.ndarray], targets_deg: np.ndarray) -> OwnGaze:
    """What targets (k, 2) in degrees say of several answers (k, 2) at them.

    An answer counts by the inverse of its squared error at the targets. What it is off by is told by maps of the other
    targets, for six numbers fit five targets well. Fewer than `FEWEST_TARGETS` show no errors; the first answer
    then stands alone. A target that is missed by far more than the others is left out where `_FEWEST_KEPT` remain.
    """
    missed: dict[int, float] = {}
    if len(targets_deg) >= FEWEST_TARGETS:
        shares, off = _weighed(looked, targets_deg)
        kept = np.arange(len(targets_deg))
        while len(kept) > _FEWEST_KEPT:
            worst = int(np.argmax(off))
            rest = np.delete(kept, worst)
            # one wrong target bends the maps by which others are judged
            weighed = _weighed([each[rest] for each in looked], targets_deg[rest])
            if off[worst] < max(_TIMES_OFF * np.median(weighed[1]), _OFF_DEG):
                break
            missed[int(kept[worst])] = float(off[worst])
            kept, (shares, off) = rest, weighed
        looked, targets_deg = [each[kept] for each in looked], targets_deg[kept]
    maps = tuple(correction(each, targets_deg) if len(each) else np.eye(2, 3) for each in looked)
    if len(targets_deg) < FEWEST_TARGETS:
        return OwnGaze(maps=maps, shares=np.eye(len(maps))[0], error_deg=1.0, decided=False)
    error_deg = float(np.sqrt((off**2).mean() + _LEAST_DEG**2))
    return OwnGaze(maps=maps, shares=shares, error_deg=error_deg, missed_deg=missed)


def _weighed(looked: Sequence[np.ndarray], targets_deg: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How much each answer counts, and by how many degrees all together are off at each target (k,)."""
    off = np.array([_off_at_others(each, targets_deg) for each in looked])
    shares = 1 / ((off**2).sum(axis=2).mean(axis=1) + _LEAST_DEG**2)
    shares /= shares.sum()
    return shares, np.linalg.norm(np.tensordot(shares, off, axes=1), axis=1)


def _off_at_others(looked: np.ndarray, targets_deg: np.ndarray) -> np.ndarray:
    """By how many degrees (k, 2) an answer is off at each target (k, 2), by the map of all others."""
    off = np.empty_like(targets_deg)
    for row in range(len(targets_deg)):
        others = np.arange(len(targets_deg)) != row
        off[row] = (
            _mapped(looked[row : row + 1], correction(looked[others], targets_deg[others])) - targets_deg[row]
        )
    return off


def fused(gazes_deg: Sequence[np.ndarray], looked: Sequence[int], targets_deg: np.ndarray) -> np.ndarray:
    """Several answers (n, 2) in degrees as one, each corrected by targets (k, 2) at ``looked`` rows."""
    rows = list(looked)
    return own_gaze([gaze[rows] for gaze in gazes_deg], targets_deg).apply(gazes_deg)

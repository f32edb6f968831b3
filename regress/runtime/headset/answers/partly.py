"""Answers of frames of which some cameras have a neutral picture and others none, as they failed when it was taken."""

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.parts import is_of_one_eye, part_of, side_of


def seen_shapes(cameras: Collection[str]) -> np.ndarray:
    """(52,) bool: shapes that any of these cameras is made to see."""
    seen = {name for camera in cameras for name in part_of(camera)}
    return np.array([name in seen for name in BLENDSHAPES])


def partly_compared(
    compared: Estimates, plain: Estimates, *, known: Collection[str], lost: Collection[str]
) -> Estimates:
    """What was compared with neutral pictures; of what only cameras without any see, what was seen alone.

    Parameters
    ----------
    compared
        Of the cameras that have neutral pictures, by themselves.
    plain
        Of all cameras, without neutral pictures.
    known, lost
        Names of the cameras with neutral pictures, and of those without.
    """
    alone = seen_shapes(lost) & ~seen_shapes(known)
    sides = np.array([_sees(side, lost) and not _sees(side, known) for side in ("left", "right")])
    return replace(
        compared,
        weights=np.where(alone, plain.weights, compared.weights),
        deviation=np.where(alone, plain.deviation, compared.deviation),
        shares=np.where(alone, plain.shares, compared.shares),
        gaze=np.where(sides[:, None], plain.gaze, compared.gaze),
    )


def _sees(side: str, cameras: Collection[str]) -> bool:
    return any(is_of_one_eye(name) and side_of(name) == side for name in cameras)

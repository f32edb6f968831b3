"""Lids that close on the eye and stop where they touch: the rig's one part that is not linear."""

import numpy as np

from facegen.rigs.rig import Rig


def close_lids(
    rig: Rig,
    vertices: np.ndarray,
    *,
    weights: np.ndarray,
    eye_center: np.ndarray,
    eye_radius: np.ndarray,
    gaze: np.ndarray,
) -> None:
    """Move the lid vertices of (n, V or cage, 3) ``vertices`` in place."""

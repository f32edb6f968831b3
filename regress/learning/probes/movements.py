"""Learns from a dataset how one shape alone moves the points: no rig is needed to move a face."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_COUNT, LANDMARK_GROUPS
from regress.learning.probes.faces import ProbeFaces

_LIDS = {side: list(LANDMARK_GROUPS[f"{side.lower()}_eye"]) for side in ("Left", "Right")}
_FITS: tuple[tuple[list[int], str | None], ...] = (
    ([point for point in range(LANDMARK_COUNT) if point not in _LIDS["Left"] + _LIDS["Right"]], None),
    (_LIDS["Left"], "Right"),
    (_LIDS["Right"], "Left"),
)
"""Points that are fitted together, and the side whose eye shapes have no part in them."""


@dataclass(frozen=True, kw_only=True)
class Movements:
    """Displacements of the points in the head, per unit of weight.

    Parameters
    ----------
    per_weight_m : (52, 68, 3) float64
        Least squares over faces less the same people's neutral ones; an eye's points follow no shape of the other
        eye, for eyes that nearly always move together cannot be told apart. Rigs are linear but for lids that close
        on the ball and lips that meet.
    residual_m : float
        Root mean square of a coordinate's displacement that is left unexplained.
    """

    per_weight_m: np.ndarray
    residual_m: float

    def moved(self, neutral: ProbeFaces, **weights: float) -> np.ndarray:
        """Neutral faces with some shapes at the given weights; points in the head, (n, 68, 3)."""
        points_m = neutral.points_m.copy()
        for name, weight in weights.items():
            points_m += weight * self.per_weight_m[BLENDSHAPE_INDEX[name]]
        return points_m


def movements(faces: ProbeFaces, neutral: ProbeFaces) -> Movements:
    """Fit displacements to faces, row by row beside the same people's neutral ones."""
    weights = faces.weights - neutral.weights
    shifts_m = faces.points_m - neutral.points_m
    per_weight_m = np.zeros((weights.shape[1], LANDMARK_COUNT, 3))
    for points, other_side in _FITS:
        shapes = [row for row, name in enumerate(BLENDSHAPES) if not _is_eye_of(name, other_side)]
        flat_m = shifts_m[:, points].reshape(len(weights), -1)
        moved_m, *_ = np.linalg.lstsq(weights[:, shapes], flat_m, rcond=None)
        per_weight_m[np.ix_(shapes, points)] = moved_m.reshape(len(shapes), len(points), 3)
    residual_m = shifts_m - np.einsum("ns,spd->npd", weights, per_weight_m)
    return Movements(per_weight_m=per_weight_m, residual_m=float(np.sqrt(np.mean(residual_m**2))))


def _is_eye_of(name: str, side: str | None) -> bool:
    return side is not None and name.startswith("eye") and name.endswith(side)

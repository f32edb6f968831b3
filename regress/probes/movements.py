"""What one shape alone does to the points, learned from a dataset: no rig is needed to move a face."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.probes.faces import ProbeFaces


@dataclass(frozen=True, kw_only=True)
class Movements:
    """Displacements of the points in the head, per unit of weight.

    Parameters
    ----------
    per_weight_m : (52, 68, 3) float64
        Least squares over faces less the same people's neutral ones. Rigs are linear but for lids that close on
        the ball and lips that meet.
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
    shifts_m = (faces.points_m - neutral.points_m).reshape(len(weights), -1)
    per_weight_m, *_ = np.linalg.lstsq(weights, shifts_m, rcond=None)
    residual_m = shifts_m - weights @ per_weight_m
    return Movements(
        per_weight_m=per_weight_m.reshape(weights.shape[1], -1, 3),
        residual_m=float(np.sqrt(np.mean(residual_m**2))),
    )

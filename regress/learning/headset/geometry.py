"""Measures errors of weights in millimetres on the face: how far vertices are from their true positions."""

from dataclasses import dataclass

import numpy as np

_BLOCK_BYTES = 64_000_000
"""Of displaced vertices at a time."""


@dataclass(frozen=True, kw_only=True)
class FaceGeometry:
    """The rig's face skin, on the mean person.

    Parameters
    ----------
    displacement : (52, V, 3) float32
        Metres by which a weight of 1 moves each vertex, head frame, ``BLENDSHAPES`` order.
    rest : (V, 3) float32
        Metres; the resting face.
    """

    displacement: np.ndarray
    rest: np.ndarray

    def error_mm(self, predicted: np.ndarray, true: np.ndarray) -> np.ndarray:
        """Mean distance of the face's vertices from their true places, for each frame.

        Weights add up linearly here; lids that follow the eyeball and contact are left out.

        Parameters
        ----------
        predicted, true : (n, 52) float

        Returns
        -------
        (n,) float64
            Millimetres.
        """
        error = np.asarray(predicted, np.float32) - np.asarray(true, np.float32)
        flat = self.displacement.reshape(len(self.displacement), -1).astype(np.float32) * np.float32(1000)
        rows = max(1, _BLOCK_BYTES // (4 * flat.shape[1]))
        means = [
            np.linalg.norm(
                (error[start : start + rows] @ flat).reshape(-1, flat.shape[1] // 3, 3), axis=2
            ).mean(axis=1, dtype=np.float64)
            for start in range(0, len(error), rows)
        ]
        return np.concatenate(means) if means else np.zeros(0)

    def gram_mm2(self) -> np.ndarray:
        """(52, 52) float64: ``e @ gram @ e`` is the mean squared distance in mm² that errors ``e`` make."""
        flat = self.displacement.reshape(len(self.displacement), -1).astype(np.float64) * 1000
        return flat @ flat.T / (flat.shape[1] // 3)

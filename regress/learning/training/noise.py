"""Landmarks as detectors give them: bias that stays, drift from frame to frame, jitter.

Two detectors disagree by a constant, because they mean different points: jaw points slide along the contour,
brows are drawn wider or higher. On one face that constant stays, and one neutral frame shows it. Jitter is
what smoothing removes. The two are kept apart here.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from facegen.conventions import (
    BIAS_ALONE,
    BIAS_BENDS,
    BIAS_SMOOTH,
    BIAS_TOGETHER,
    DETECTOR_DISAGREEMENT,
    LANDMARK_COUNT,
    LANDMARK_GROUPS,
)

_EYES = (*LANDMARK_GROUPS["right_eye"], *LANDMARK_GROUPS["left_eye"])

OUTER_EYES = (36, 45)
"""Landmarks whose distance is the unit of noise, and whose direction is a face's x axis."""


@dataclass(frozen=True, kw_only=True)
class DetectorNoise:
    """How training faces are displaced.

    Parameters
    ----------
    bias
        Standard deviation of what stays on one face, in units of what two detectors disagree by.
    drift
        The same of what comes and goes from frame to frame, shaped like a bias.
    jitter
        Of each coordinate by itself, in outer-eye distances.
    jitter_most
        Where not None, a face's jitter is log-uniform from ``jitter`` to this: detectors on good and bad
        pictures. Networks that know one level alone fail at others (R2 at 1 % falls from .38 to .24).
    clean
        Share of the faces that stay as they are.
    unbiased
        Share of the faces with jitter alone, as where landmarks mean the dataset's very points.
    eyes
        Factor on the jitter of the twelve points of the eyes: lids open by a few pixels, and with all of the jitter
        networks read winks as blinks.
    movement
        Least share of a movement away from the neutral face that is shown: a detector's own by region, log-uniform from
        this to 1 (``regress.learning.training.shrinking``). Faces without a neutral frame stay.
    copies
        How often each face is trained on, displaced anew each time.
    """

    bias: float
    drift: float = 0.1
    jitter: float = 0.001
    jitter_most: float | None = None
    clean: float = 0.5
    unbiased: float = 0.0
    eyes: float = 1.0
    movement: float = 1.0
    copies: int = 1

    def draw_bias_offsets(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """What stays on each of ``count`` faces (count, 68, 2), outer-eye distances."""
        return self.bias * draw_bias(rng, count)

    def draw_drift_offsets(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """What one frame of each has besides jitter (count, 68, 2)."""
        return self.drift * draw_bias(rng, count)


def draw_bias(
    rng: np.random.Generator, count: int, *, apart: Mapping[str, float] = DETECTOR_DISAGREEMENT
) -> np.ndarray:
    """What ``count`` detectors put their points beside the truth by.

    Parameters
    ----------
    apart
        Root mean square of how far, by group of landmarks, outer-eye distances.

    Returns
    -------
    (count, 68, 2) float64
        Outer-eye distances; x along the eyes, towards the subject's left.
    """
    offsets = np.empty((count, LANDMARK_COUNT, 2))
    for group, numbers in LANDMARK_GROUPS.items():
        along = (np.arange(len(numbers)) + 0.5) / len(numbers)  # with ends, short groups bend by more
        bends = np.sqrt(2) * np.cos(np.pi * np.outer(np.arange(1, BIAS_BENDS + 1), along))
        together = rng.standard_normal((count, 1, 2)) * np.sqrt(BIAS_TOGETHER)
        smooth = np.einsum("ckd,kn->cnd", rng.standard_normal((count, BIAS_BENDS, 2)), bends)
        alone = rng.standard_normal((count, len(numbers), 2)) * np.sqrt(BIAS_ALONE)
        shape = together + smooth * np.sqrt(BIAS_SMOOTH / BIAS_BENDS) + alone
        offsets[:, list(numbers)] = shape * (apart[group] / np.sqrt(2))
    return offsets


def draw_displacements(
    noise: DetectorNoise, rng: np.random.Generator, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Displacements of ``count`` frames and of the same faces' neutral frames: one bias, two drifts.

    Returns
    -------
    frame, neutral : (count, 68, 2) float64
        Outer-eye distances.
    """
    kind = rng.random((count, 1, 1))
    moved, biased = kind >= noise.clean, kind >= noise.clean + noise.unbiased
    bias = biased * noise.draw_bias_offsets(rng, count)
    jitter = noise.jitter
    if noise.jitter_most is not None:
        jitter = np.exp(rng.uniform(np.log(noise.jitter), np.log(noise.jitter_most), (count, 1, 1)))

    quiet = np.ones((LANDMARK_COUNT, 1))
    quiet[list(_EYES)] = noise.eyes

    def draw_passing() -> np.ndarray:
        drift = biased * noise.draw_drift_offsets(rng, count)
        return drift + moved * quiet * jitter * rng.standard_normal(bias.shape)

    return bias + draw_passing(), bias + draw_passing()


def displace(points: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    """Faces (n, 68, 2) in any unit, moved by offsets (n, 68, 2) that follow each face's size and roll."""
    right, left = OUTER_EYES
    across = points[:, left] - points[:, right]
    down = np.stack([-across[:, 1], across[:, 0]], axis=1)
    return points + offsets[..., :1] * across[:, None] + offsets[..., 1:] * down[:, None]

"""Measures faces that do nothing: weights of a neutral face, and how outputs tremble on a still one."""

from dataclasses import dataclass

import numpy as np

from regress.learning.probes.faces import ProbeFaces
from regress.learning.probes.methods import Method
from regress.learning.training.noise import displace
from regress.targets import OUTPUTS

JITTER_PERCENT = (0.1, 0.5)
"""Of the outer-eye distance: a tracker that smooths, and a detector that looks at each frame by itself."""

_FACES, _FRAMES = 50, 40
_NOISE_SEED = 68


@dataclass(frozen=True, kw_only=True)
class Stillness:
    """Outputs of one method on faces that do not move.

    Parameters
    ----------
    method : str
    calibrated : bool
    neutral_mean, neutral_high : (O,) float64
        Mean and 95th percentile of each output on neutral faces as their cameras see them; NaN where a dataset has
        none. A method that sees a neutral frame is given the same face frontally, so that what is left is the pose.
    jitter : (J, O) float64
        Standard deviation of each output over frames of a still face with an expression, root mean square over
        faces, at each of ``JITTER_PERCENT``.
    """

    method: str
    calibrated: bool
    neutral_mean: np.ndarray
    neutral_high: np.ndarray
    jitter: np.ndarray


def stillness(method: Method, faces: ProbeFaces, neutral: ProbeFaces, people: ProbeFaces | None) -> Stillness:
    """Ask a method about still faces.

    Parameters
    ----------
    faces, neutral
        With an expression, and row by row the same people's neutral ones.
    people
        One neutral face a person, where there are any.
    """
    at_rest = np.full((1, len(OUTPUTS)), np.nan)
    if people is not None:
        at_rest = method.predict(people.points_px, people.turned(yaw_deg=0, pitch_deg=0))
    held, beside = faces.some(_FACES).points_px, neutral.some(_FACES).points_px
    held, beside = (np.repeat(points, _FRAMES, axis=0) for points in (held, beside))
    jitter = []
    for percent in JITTER_PERCENT:
        rng = np.random.default_rng(_NOISE_SEED)
        shown = displace(held, percent / 100 * rng.standard_normal(held.shape))
        frames = method.predict(shown, beside).reshape(-1, _FRAMES, len(OUTPUTS))
        jitter.append(np.sqrt(frames.var(axis=1).mean(axis=0)))
    return Stillness(
        method=method.name,
        calibrated=method.calibrated,
        neutral_mean=at_rest.mean(axis=0),
        neutral_high=np.percentile(at_rest, 95, axis=0),
        jitter=np.array(jitter),
    )

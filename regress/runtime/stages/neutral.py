"""Estimates a person's neutral face from a recording in which nobody said which frames are neutral."""

from collections.abc import Sequence

import numpy as np

from regress.errors import InputError
from regress.runtime.calm import CalmFrames
from regress.runtime.frame_noise import frame_noise
from regress.runtime.model import Model
from regress.runtime.stages.frame_clock import USUAL_FPS
from regress.targets import VISIBLE_SHAPES

FEWEST_FRAMES = 20
"""Usable frames below which nothing is certain."""

SHARES, _FEWEST_CALM = (0.1, 0.05, 0.02), 5
"""Shares of the frames taken for calm, those that show least: the first with which the face is surely at rest, as a
minute of talking begins with two seconds of it; and no fewer than five frames, as one of two may be a blink."""

_FEWEST_OF_LESS = 30
"""Calm frames that a smaller share must have, a second of most cameras: fewer are found between any two syllables."""

_ROUNDS = 3
"""How often the calm frames are asked for anew; more change nothing."""

_AGREEMENT = 0.1
"""Largest weight of a visible shape by which an early and a late half of the calm frames may differ."""

_APART_S = (0.1, 0.2)
"""Seconds, a tenth and a fifth of a second, over which a face that rests stays as it is; two, as syllables repeat."""

_STILL_NOISES, _STILL, _RESTLESS = 3.5, 0.06, 0.15
"""A face moves where a visible shape changes by more than so many standard deviations of its noise and by more than
so much; or by so much more that noise says nothing, as where all frames of a quick talk differ.

Of pieces of takes of 30 s five in six change by less about their calm frames, and of those from which all rest was cut
one in fifteen (of 10 s: three in four, and one in five; benchmarks/bench_neutral.py).
"""

_STILL_SHARE = 0.75
"""Share of the calm frames that must be still: of a talking mouth half may be, between two syllables."""

_LEAST_NOISE = 0.004
"""Standard deviation of a weight from frame to frame that every detector is taken to have."""


def frame_rate(time_s: np.ndarray | None) -> float:
    """Frames a second by their times (n,) in seconds; `USUAL_FPS` where they do not say."""
    steps = np.diff(np.array([]) if time_s is None else time_s)
    steps = steps[np.isfinite(steps) & (steps > 0)]
    return float(1 / np.median(steps)) if len(steps) else USUAL_FPS


def estimate_neutral(
    model: Model, points: np.ndarray, fps: float = USUAL_FPS, *, shares: Sequence[float] = SHARES
) -> CalmFrames:
    """Find the calm frames of a recording of one person.

    The calibrated networks compare all frames with the median face, then with the median of the calmest tenth, and
    again. They cancel what the person is like; which of two faces is the resting one the networks that see a frame
    alone say beside them. Where that tenth is not at rest, less of a long recording is tried. The calm frames are
    neutral if they agree, early ones and late ones, and if the face is still about them: someone who talks all the time
    is told of as not at rest. Someone who smiles throughout is taken for neutral: a frame named by a person is better
    than an estimate.

    Parameters
    ----------
    model
        With calibrated networks.
    points : (n, 68, 2) float64
        In the order of time; frames with NaN are left out.
    fps
        Frames a second, by which it is told how long a face was still.
    shares
        Of the frames, those that may be taken for calm, the largest first.

    Raises
    ------
    InputError
        Where the model has no calibrated networks, or no frame is usable.
    """
    usable = np.flatnonzero(np.isfinite(points).all(axis=(1, 2)))
    if model.calibrated is None:
        raise InputError("the model has no calibrated networks, so a neutral frame is of no use to it")
    if not len(usable):
        raise InputError("no frame is usable: each has missing landmarks")
    faces = points[usable]
    alone = _standard(model.predict(faces).sum(axis=1))
    first = None
    for share in shares:
        count = min(len(faces), max(_FEWEST_CALM, round(share * len(faces))))
        if first is not None and count < _FEWEST_OF_LESS:
            break
        calm = np.arange(len(faces))
        for _ in range(_ROUNDS):
            compared = model.calibrate(faces[calm]).predict(faces).sum(axis=1)
            calm = np.sort(np.argsort(_standard(compared) + alone, kind="stable")[:count])
        sure, reason = _judged(model, faces, calm, fps)
        found = CalmFrames(frames=usable[calm], sure=sure, reason=reason)
        if sure:
            return found
        first = first or found
    return first


def _judged(model: Model, faces: np.ndarray, calm: np.ndarray, fps: float) -> tuple[bool, str]:
    """Whether calm frames, by their numbers, are a resting face; and why, in a sentence."""
    if len(faces) < FEWEST_FRAMES:
        return False, f"{len(faces)} frames are usable, and {FEWEST_FRAMES} are needed"
    visible = [name in VISIBLE_SHAPES for name in model.outputs]
    shown = model.calibrate(faces[calm]).predict_raw(faces)[:, visible]
    early, late = (np.median(shown[half], axis=0) for half in np.array_split(calm, 2))
    between = np.abs(early - late).max()
    if between > _AGREEMENT:
        return (
            False,
            f"early and late calm frames differ by weights of {between:.2f}, and {_AGREEMENT} is allowed",
        )
    moved, noises = _movement(shown, calm, fps)
    if not np.isfinite(moved):
        return False, f"the recording is too short to tell whether a face is still over {_APART_S[1]:g} s"
    if moved > _RESTLESS or (noises > _STILL_NOISES and moved > _STILL):
        return (
            False,
            f"the face is not at rest: even around its calmest frames weights move by {moved:.2f}, "
            f"{noises:.1f} times their noise",
        )
    return (
        True,
        f"{len(calm)} calm frames of {len(faces)} agree to {between:.2f} and are still to {moved:.2f}",
    )


def _movement(shown: np.ndarray, calm: np.ndarray, fps: float) -> tuple[float, float]:
    """How far the face moves before or after calm frames, whichever is less: in weights, and in their noise.

    Of weights (n, k) the one that moves most; of calm frames the share that must be still moves by less.
    """
    noise = frame_noise(shown)
    noise = np.maximum(noise, _LEAST_NOISE) * 2**0.5  # of a difference of two frames
    apart = np.maximum(np.round(np.multiply(_APART_S, fps)), 1).astype(int)
    sides = np.full((2, len(calm), 2), np.inf)
    for side, sign in zip(sides, (-1, 1), strict=True):
        others = calm[:, None] + sign * apart
        there = ((others >= 0) & (others < len(shown))).all(axis=1)
        change = np.abs(shown[others[there]] - shown[calm[there], None]).max(axis=1)
        side[there] = np.stack([change.max(axis=1), (change / noise).max(axis=1)], axis=1)
    moved, noises = np.quantile(sides.min(axis=0), _STILL_SHARE, axis=0)
    return float(moved), float(noises)


def _standard(activity: np.ndarray) -> np.ndarray:
    """Less its median, in standard deviations; zeros where nothing moves."""
    spread = activity.std()
    return (activity - np.median(activity)) / spread if spread > 0 else np.zeros_like(activity)

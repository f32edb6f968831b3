"""From footage to weights, gaze and confidence: calibration, a change of seat, and what a person asked for."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from facegen.conventions import SIDES
from regress.errors import InputError
from regress.runtime.adjustment import ShapeAdjustment, adjust, mirror
from regress.runtime.headset.confidence import confidence
from regress.runtime.headset.estimates import Estimates
from regress.runtime.headset.footage import Footage
from regress.runtime.headset.neutral import Neutral
from regress.runtime.headset.predictor import HeadsetPredictor
from regress.runtime.headset.seats import seat_change
from regress.runtime.headset.temporal import convolve
from regress.runtime.predict import Output
from regress.runtime.smoothing import EYES_FASTER, OneEuroStream, moving_average, one_euro

ASSUMED_FPS = 30.0
"""Frames a second where nobody says: only the patience with a changed seat depends on it."""

AMPLIFIED = tuple(f"{stem}{side.title()}" for side in SIDES for stem in ("eyeBlink", "eyeWide", "eyeSquint"))
"""Shapes of the lids, which the paper lets people exaggerate."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Performance:
    """What a recording shows.

    Parameters
    ----------
    names
        Of the k columns of ``weights``.
    weights : (n, k) float64
        NaN where no camera has a picture.
    gaze : (n, 4) float64
        Left yaw, left pitch, right yaw, right pitch in radians, yaw to the subject's left; NaN as well.
    confidence : (n, 52) float64 or None
        Of the ARKit weights; 0 where no camera has a picture. None for a model without scores.
    reseated
        Rows from which neutral pictures were no longer used.
    taps_fps
        Frames a second of the clips on which the taps that were used were found; None where none were.
    """

    names: tuple[str, ...]
    weights: np.ndarray
    gaze: np.ndarray
    confidence: np.ndarray | None
    reseated: tuple[int, ...] = ()
    taps_fps: float | None = None


def estimate_footage(
    predictor: HeadsetPredictor,
    footage: Footage,
    neutrals: Sequence[Neutral] = (),
    *,
    keep_neutral: bool = False,
) -> tuple[Estimates, np.ndarray, tuple[int, ...]]:
    """Run the network on footage, calibrated as long as the headset stays in the seat of the neutral pictures.

    Parameters
    ----------
    neutrals
        Each counts from its row to the next one's; the first from the beginning, wherever it was taken.
    keep_neutral
        Stay calibrated after a change of seat: another seat's neutral picture of the same person is worth more than
        none, another person's is not.

    Returns
    -------
    estimates
    calibrated : (n,) bool
        Frames that were compared with neutral pictures.
    reseated
        Rows at which the seat was no longer that of the neutral pictures that count there.
    """
    present = footage.present
    if not neutrals:
        return predictor.predict(footage.pictures, present=present), np.zeros(len(present), dtype=bool), ()
    rows = np.arange(len(present))
    starts = [0, *(neutral.row for neutral in neutrals[1:])]
    which = np.searchsorted(starts, rows, side="right") - 1
    pictures = {
        name: np.stack([neutral.pictures[name] for neutral in neutrals])[which]
        for name in neutrals[0].pictures
    }
    estimates = predictor.predict(footage.pictures, present=present, neutral=pictures)
    calibrated, reseated = np.ones(len(rows), dtype=bool), []
    for number in range(len(neutrals)):
        span = rows[which == number]
        change = seat_change(estimates.same_seat[span], present[span].any(axis=1), fps=_fps(footage))
        if change is not None:
            reseated.append(int(span[change]))
            calibrated[span[change:]] = keep_neutral
    if not calibrated.all():
        estimates = predictor.predict(
            footage.pictures, present=present, neutral=pictures, calibrated=calibrated
        )
    return estimates, calibrated, tuple(reseated)


def perform(
    predictor: HeadsetPredictor,
    footage: Footage,
    neutrals: Sequence[Neutral] = (),
    *,
    output: Output | None = None,
    amplify_eyes: float = 1.0,
    keep_neutral: bool = False,
    temporal: bool = False,
) -> Performance:
    """Weights, gaze and confidence of footage, finished as asked.

    Parameters
    ----------
    neutrals, keep_neutral
        As ``estimate_footage`` takes them.
    output
        What happens after the network; nothing by default. Smoothing of landmarks has no meaning here.
    amplify_eyes
        Factor on blink, wide and squint of each eye, before everything but smoothing.
    temporal
        Let the frames before count, as the model's taps say.

    Raises
    ------
    InputError
        Where the model has no taps and they are asked for; where One-Euro smoothing is, and times are not known.
    """
    output = output or Output()
    if output.one_euro is not None and footage.time_s is None:
        raise InputError(
            f"{footage.source} does not say when its frames were taken; One-Euro smoothing needs it"
        )
    estimates, calibrated, reseated = estimate_footage(
        predictor, footage, neutrals, keep_neutral=keep_neutral
    )
    seen = footage.present.any(axis=1)
    weights = np.where(seen[:, None], np.clip(estimates.weights.astype(np.float64), 0, 1), np.nan)
    gaze = np.where(seen[:, None], estimates.gaze.astype(np.float64).reshape(-1, 4), np.nan)
    if temporal:
        weights, gaze = _convolved(predictor, weights, gaze)
    weights, gaze = _smoothed(weights, gaze, footage.time_s, output)
    if amplify_eyes != 1:
        weights = adjust(weights, dict.fromkeys(AMPLIFIED, ShapeAdjustment(gain=amplify_eyes)))
    trust = None
    if predictor.model.scores:
        trust = confidence(predictor.model, estimates.deviation, footage.present, calibrated)
    if output.mirror:
        gaze = gaze[:, [2, 3, 0, 1]] * [-1, 1, -1, 1]
        trust = None if trust is None else mirror(trust)
    return Performance(
        names=output.names,
        weights=output.finish(weights),
        gaze=gaze,
        confidence=trust,
        reseated=reseated,
        taps_fps=predictor.model.temporal.fps if temporal else None,
    )


def _convolved(
    predictor: HeadsetPredictor, weights: np.ndarray, gaze: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    found = predictor.model.temporal
    if found is None:
        raise InputError(
            "the model does not know what the frames before are worth; `regress headset temporal` finds it on clips"
        )
    starts = np.arange(len(weights)) == 0
    values = convolve(np.concatenate([weights, gaze], axis=1), starts, np.array(found.taps))
    columns = weights.shape[1]
    return np.clip(values[:, :columns], 0, 1), values[:, columns:]


def _smoothed(
    weights: np.ndarray, gaze: np.ndarray, time_s: np.ndarray | None, output: Output
) -> tuple[np.ndarray, np.ndarray]:
    if output.smooth > 1:
        weights = moving_average(weights, output.smooth)
        # that mean is of numbers from 0 to 1
        gaze = (2 * moving_average(gaze / (2 * np.pi) + 0.5, output.smooth) - 1) * np.pi
    if output.one_euro is not None:
        weights = one_euro(weights, time_s, output.one_euro)
        stream = OneEuroStream(output.one_euro, np.full(4, EYES_FASTER * output.one_euro.cutoff_hz))
        gaze = np.array([stream.step(float(time), row) for time, row in zip(time_s, gaze, strict=True)])
    return weights, gaze


def _fps(footage: Footage) -> float:
    if footage.time_s is None or len(footage.time_s) < 2:
        return ASSUMED_FPS
    return 1 / float(np.median(np.diff(footage.time_s)))

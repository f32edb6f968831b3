"""Finds the taps of the temporal convolution on clips of people whom the network has not seen."""

import numpy as np

from regress.errors import InputError
from regress.learning.headset.accuracy import summary
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.evaluation import Condition, are_unseen, estimate
from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.figures import ClipSummary
from regress.runtime.headset.network.model import Temporal
from regress.runtime.headset.network.outputs import MIRROR, WEIGHTS
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.network.temporal import TAPS, convolve, lagged

_RIDGE = 1e-3
"""Of the mean squared difference between frames: an output that says the same throughout keeps its own frame alone."""


def fit_taps(estimated: np.ndarray, true: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Taps (56, TAPS) of least squared error; both sides of the face share theirs.

    As taps add up to 1, the error of the mean is the frame's own error plus the differences to the frames before, each
    times its tap: a small regression for each output.

    Parameters
    ----------
    estimated, true : (n, 56)
        Weights, then gaze angles, clip after clip.
    starts : (n,) bool
        First frames of clips.
    """
    history = lagged(estimated, starts)
    change = history[:, 1:] - history[:, :1]
    gram = np.einsum("nio,njo->oij", change, change)
    moment = np.einsum("nio,no->oi", change, true - estimated)
    gram, moment = gram + gram[MIRROR], moment + moment[MIRROR]
    ridge = _RIDGE * np.trace(gram, axis1=1, axis2=2) / (TAPS - 1) + 1e-12
    before = np.linalg.solve(gram + ridge[:, None, None] * np.eye(TAPS - 1), moment[..., None])[..., 0]
    return np.concatenate([1 - before.sum(axis=1, keepdims=True), before], axis=1)


def fit_temporal(predictor: HeadsetPredictor, arrays: HeadsetArrays) -> Temporal:
    """Taps from the clips of the arrays' training people, and what they do for those of the test people.

    Raises
    ------
    InputError
        Where the arrays are no clips, have no training or test people, or are of other cameras.
    """
    if arrays.clip_starts().all():
        raise InputError(
            f'{arrays.folder} holds no frames that follow one another; pack a dataset of kind "sequence" '
            "(datasets/headset-clips.toml)"
        )
    rows = {split: arrays.rows(split) for split in ("train", "test")}
    for split, numbers in rows.items():
        if not len(numbers):
            raise InputError(f"{arrays.folder} has no {split} people; split_shares in its spec gives some")
    estimates = {
        split: estimate(predictor.graph, predictor.model, arrays, numbers, Condition())
        for split, numbers in rows.items()
    }
    starts = arrays.clip_starts()
    taps = fit_taps(_joined(estimates["train"]), _true(arrays, rows["train"]), starts[rows["train"]])
    even = np.full_like(taps, 1 / TAPS)
    alone = np.zeros_like(taps)
    alone[:, 0] = 1
    chosen_on, judged_on = (np.unique(arrays.person[rows[split]]) for split in ("train", "test"))
    known = int(np.isin(judged_on, chosen_on).sum())
    return Temporal(
        fps=arrays.frames_a_second(),
        taps=tuple(map(tuple, taps.tolist())),
        people=len(chosen_on),
        dataset_hash=arrays.description.get("dataset_hash", ""),
        unseen=not known and are_unseen(predictor.model, arrays, known),
        scores={
            name: _scores(arrays, rows["test"], estimates["test"], one)
            for name, one in (("one frame", alone), ("mean of five", even), ("taps", taps))
        },
    )


def _scores(arrays: HeadsetArrays, rows: np.ndarray, estimates: Estimates, taps: np.ndarray) -> ClipSummary:
    starts = arrays.clip_starts()[rows]
    values = convolve(_joined(estimates), starts, taps)
    weights, gaze = np.clip(values[:, :WEIGHTS], 0, 1), values[:, WEIGHTS:].reshape(-1, 2, 2)
    true = arrays.weights[rows]
    figures = summary(arrays.face, weights, gaze, true, arrays.gaze[rows].reshape(-1, 2, 2))
    shake = np.diff(weights - true, axis=0)[~starts[1:]]
    return ClipSummary(**vars(figures), shake=float(np.sqrt(np.mean(shake**2))))


def _joined(estimates: Estimates) -> np.ndarray:
    return np.concatenate([estimates.weights, estimates.gaze.reshape(-1, 4)], axis=1).astype(np.float64)


def _true(arrays: HeadsetArrays, rows: np.ndarray) -> np.ndarray:
    return np.concatenate([arrays.weights[rows], arrays.gaze[rows]], axis=1).astype(np.float64)

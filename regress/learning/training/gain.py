"""Stretches the answers of calibrated networks, so that a full movement reads full and a neutral face reads nothing.

Networks that are unsure answer towards the mean (a regression's slope is below 1 by the share of the variance that it
cannot see). About the neutral face's own answer, which is taken for 0, every shape is stretched until answers for
people of the validation split spread as far as their true weights do. Gaze stays: 68 points let it be guessed only,
from lids, and a stretched guess moves eyes that look ahead.
"""

from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, mirrored_name
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.noise import DetectorNoise
from regress.learning.training.preparation import draw_detected, faces_of
from regress.learning.training.scores import predicted_outputs
from regress.runtime.model import Model
from regress.runtime.networks import FoldedNetworks, evaluate

SEEN = DetectorNoise(bias=1.0, jitter=0.01, clean=0.0)
"""A tracked face at 100 px between the outer corners of the eyes, jittered by 1 px."""

LARGEST_GAIN = 2.0
"""Beyond it, what is stretched is noise: shapes that 68 points hardly show would ask for 2 to 8."""

_SEED = 27


def stretched(model: Model, dataset: KeypointDataset) -> Model:
    """The model with offset and gain of its calibrated networks folded into their last layer."""
    about_zero = _finished(model, np.ones(len(model.outputs)))
    faces = draw_detected(
        faces_of(dataset, "validation", calibrated=True), SEEN, np.random.default_rng(_SEED)
    )
    truth = faces.weights[:, [BLENDSHAPE_INDEX[name] for name in model.outputs]]
    return _finished(
        model, gain_of(predicted_outputs(about_zero, faces.points, faces.neutral), truth, model.outputs)
    )


def gain_of(answers: np.ndarray, truth: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
    """Gains (K,) with which answers (n, K) spread as far as true weights (n, K); of both sides the same."""
    spread = answers.std(axis=0)
    gain = np.clip(truth.std(axis=0) / np.where(spread > 0, spread, np.inf), 1.0, LARGEST_GAIN)
    gain[[name.startswith("eyeLook") for name in names]] = 1.0
    partner = [names.index(mirrored_name(name)) for name in names]
    return (gain + gain[partner]) / 2


def _finished(model: Model, gain: np.ndarray) -> Model:
    calibrated = model.calibrated
    networks = calibrated.networks
    neutral = evaluate(networks, np.zeros((1, calibrated.features.count)))[0]
    return replace(model, calibrated=replace(calibrated, networks=_scaled(networks, neutral, gain)))


def _scaled(networks: FoldedNetworks, offset: np.ndarray, gain: np.ndarray) -> FoldedNetworks:
    """Networks that answer ``gain (y - offset)`` where these answer y."""
    return replace(networks, w2=networks.w2 * gain[:, None], b2=(networks.b2 - offset) * gain)

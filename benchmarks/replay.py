"""Plays recorded weights on people of a rig, and judges what a model makes of the points that a detector would see.

Two takes of an iPhone's 52 weights (Live Link Face) are played by people of a rig, projected to 68 points of 100 px
between the outer eye corners, and disturbed as detectors disturb them: noise of every point and frame, and a bias that
stays. Ten neutral frames are given. The truth is the take itself.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from small_movements import project

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.formats import read_live_link
from facegen.rigs import Rig
from regress import Model
from regress.learning.training.baseline import Baseline
from regress.learning.training.noise import displace, draw_bias
from regress.learning.training.preparation import OUTPUT_COLUMNS
from regress.runtime.features import extract
from regress.targets import OUTPUTS

TAKES = {"range of motion": "livelink/alex_rom_3.csv", "speech": "livelink/S07-001.csv"}
MOVES_SD = 0.05
"""A shape counts in a take where its weight's standard deviation reaches this."""
NOISE_PX = (0.0, 0.5, 1.0, 2.0)
NEUTRAL_FRAMES = 10
SEED = 7
"""Of the people on whom settings were chosen; any other gives other people."""

Figures = dict[str, dict[str, float]]
"""By shape: r, mean absolute error, and how far it moves as a share of how far the true one does."""


@dataclass(frozen=True, kw_only=True)
class Played:
    """A take, played by people.

    Attributes
    ----------
    take
        Its name.
    weights : (n, 52) float64
        What is true.
    exact
        Of each person the points of rest and take, (NEUTRAL_FRAMES + n, 68, 2), pixels.
    biases : (people, 68, 2) float64
        Each one's detector.
    seed
        Of people, detectors and noise.
    """

    take: str
    weights: np.ndarray
    exact: list[np.ndarray]
    biases: np.ndarray
    seed: int = SEED

    @property
    def moving(self) -> list[str]:
        """Shapes that count."""
        return [name for name in OUTPUTS if self.weights[:, BLENDSHAPE_INDEX[name]].std() >= MOVES_SD]

    def seen(self, noise_px: float, *, biased: bool) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Neutral frames and frames of each person, as a detector gives them."""
        noise = np.random.default_rng([self.seed, int(10 * noise_px)])
        for points, bias in zip(self.exact, self.biases, strict=True):
            where = displace(points, np.broadcast_to(bias, points.shape)) if biased else points
            where = where + noise_px * noise.standard_normal(points.shape)
            yield where[:NEUTRAL_FRAMES], where[NEUTRAL_FRAMES:]


def play(real: Path, rig: Rig, people: int, step: int, seed: int = SEED) -> list[Played]:
    """Every ``step``-th frame of the takes, played by people of a rig."""
    rng = np.random.default_rng(seed)
    identities = rng.standard_normal((people, rig.components))
    biases = draw_bias(rng, people)
    rest = np.zeros((NEUTRAL_FRAMES, len(BLENDSHAPES)))
    played = []
    for take, path in TAKES.items():
        weights = np.clip(read_live_link(real / path).weights[::step], 0, 1)
        exact = [project(rig, identity, np.concatenate([rest, weights])) for identity in identities]
        played.append(Played(take=take, weights=weights, exact=exact, biases=biases, seed=seed))
    return played


def replay(
    model: Model,
    ridges: dict[str, Baseline],
    played: list[Played],
    *,
    noises: Sequence[float] = NOISE_PX,
    biased: Sequence[bool] = (False, True),
) -> list[dict]:
    """A row for every take, bias and noise; ``all`` holds mean absolute errors over all shapes, moving or not.

    ``by person`` has mean absolute error and median r of the model for each person. ``model`` knows the neutral frames,
    as the ridges do; ``alone`` is the same model without them.
    """
    rows = []
    for take in played:
        true = np.broadcast_to(take.weights, (len(take.exact), *take.weights.shape))
        for bias in biased:
            for noise_px in noises:
                answers = {name: [] for name in ("model", "alone", *ridges)}
                for neutral, frames in take.seen(noise_px, biased=bias):
                    answers["model"].append(model.calibrate(neutral).predict(frames))
                    answers["alone"].append(model.predict(frames))
                    for name, ridge in ridges.items():
                        answers[name].append(predict_ridge(ridge, model, frames, neutral))
                stacked = {name: np.stack(each) for name, each in answers.items()} | {
                    "zero": np.zeros_like(true)
                }
                rows.append(
                    {
                        "take": take.take,
                        "noise_px": noise_px,
                        "bias": bias,
                        "all": {
                            name: float(np.abs(each - true)[..., OUTPUT_COLUMNS].mean())
                            for name, each in stacked.items()
                        },
                        "by person": [
                            (mean_mae(one), median_r(one))
                            for one in (
                                judge(said[None], take.weights[None], take.moving)
                                for said in stacked["model"]
                            )
                        ],
                        **{name: judge(each, true, take.moving) for name, each in stacked.items()},
                    }
                )
    return rows


def predict_ridge(ridge: Baseline, model: Model, points: np.ndarray, neutral: np.ndarray) -> np.ndarray:
    """The floor's weights (n, 52) of points (n, 68, 2), given neutral frames (m, 68, 2)."""
    features = model.calibrated.features
    origin = np.median(extract(features, neutral), axis=0)
    weights = np.zeros((len(points), len(BLENDSHAPES)))
    weights[:, OUTPUT_COLUMNS] = ridge.predict(extract(features, points) - origin)
    return weights


def correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Pearson's r; 0 where one of them never moves."""
    if first.std() < 1e-9 or second.std() < 1e-9:
        return 0.0
    return float(np.corrcoef(first, second)[0, 1])


def judge(predicted: np.ndarray, true: np.ndarray, shapes: list[str]) -> Figures:
    """r, mean absolute error and share of the movement of shapes; rows may hold several people, whose r is averaged."""
    figures = {}
    for name in shapes:
        column = BLENDSHAPE_INDEX[name]
        pairs = zip(predicted[..., column], true[..., column], strict=True)
        figures[name] = {
            "r": float(np.mean([correlation(one, other) for one, other in pairs])),
            "mae": float(np.abs(predicted[..., column] - true[..., column]).mean()),
            "moves": float(predicted[..., column].std(axis=1).mean() / true[..., column].std(axis=1).mean()),
        }
    return figures


def median_r(figures: Figures) -> float:
    """Median r over shapes."""
    return float(np.median([found["r"] for found in figures.values()]))


def mean_mae(figures: Figures) -> float:
    """Mean over shapes."""
    return float(np.mean([found["mae"] for found in figures.values()]))

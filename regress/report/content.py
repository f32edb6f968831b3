"""Holds what a report says, as plain records: read from a model once, then only drawn and printed."""

from dataclasses import dataclass

import numpy as np

from regress.targets import VISIBLE_SHAPES

SEEN_R2, PARTLY_R2 = 0.7, 0.3
"""Where a reader may trust a shape, and where it is no better than a hint."""


def grade(r2: float) -> str:
    """``"seen"``, ``"partly"`` or ``"hidden"``, by an R2; ``"unmoved"`` without one: also a cell's class."""
    if np.isnan(r2):
        return "unmoved"
    return "seen" if r2 >= SEEN_R2 else "partly" if r2 >= PARTLY_R2 else "hidden"


@dataclass(frozen=True, kw_only=True)
class Figures:
    """How well one method gives one shape, on the test split.

    Parameters
    ----------
    r2 : float
        1 is perfect, 0 is as good as always saying the mean; NaN where the shape never moves.
    mae : float
        Mean absolute error in weights (0 to 1).
    pearson : float
        Correlation; NaN where the shape never moves, or a method always says the same.
    """

    r2: float
    mae: float
    pearson: float


@dataclass(frozen=True, kw_only=True)
class ShapeScores:
    """One shape, predicted by the networks and by the two methods that anything must beat."""

    name: str
    region: str
    network: Figures
    ridge: Figures
    mean: Figures

    @property
    def inferred(self) -> bool:
        """Whether it scores well enough although no landmark shows it: the rig's skin gives it away."""
        return self.name not in VISIBLE_SHAPES and self.grade in ("seen", "partly")

    @property
    def grade(self) -> str:
        """The `grade` of the network's R2."""
        return grade(self.network.r2)


@dataclass(frozen=True, kw_only=True)
class LearningCurve:
    """Mean squared error in z-scored targets after each step, from the start (step 0).

    Parameters
    ----------
    name : str
        Of the network, or of what is averaged.
    train, validation, test : (steps + 1,) float64
        Empty where a recipe has none.
    best_step : int or None
        The step whose weights were kept; None where that differs by network.
    """

    name: str
    train: np.ndarray
    validation: np.ndarray
    test: np.ndarray
    best_step: int | None


@dataclass(frozen=True, kw_only=True)
class RegressionPlot:
    """Predicted against true weights of one split, all shapes together.

    Parameters
    ----------
    split : str
    counts : (c, c) int64
        Values with the truth in a row's cell and the prediction in a column's; cells are centred on c equal
        steps from 0 to 1.
    slope, intercept, pearson : float
        Of the least-squares line through the values; NaN where nothing moves.
    """

    split: str
    counts: np.ndarray
    slope: float
    intercept: float
    pearson: float


@dataclass(frozen=True, kw_only=True)
class CalibrationRow:
    """What a neutral frame of the person brings: mean R2 without and with one.

    Parameters
    ----------
    landmarks, shapes : str
        On which landmarks, over which shapes.
    alone, calibrated : float
    """

    landmarks: str
    shapes: str
    alone: float
    calibrated: float


@dataclass(frozen=True, kw_only=True)
class Accuracy:
    """The figures that a report opens with: mean R2 of the visible shapes on one kind of points.

    Parameters
    ----------
    points : str
    alone, calibrated : float
        From a frame alone, and beside the person's neutral face; NaN where a model has no such networks.
    alone_ridge, calibrated_ridge : float
        Of ridge regression on the same: of exact points trained on such, of others on the networks' own rows; NaN where
        a record lacks it.
    """

    points: str
    alone: float
    calibrated: float
    alone_ridge: float
    calibrated_ridge: float


@dataclass(frozen=True, kw_only=True)
class Headline:
    """One large figure with what it means below it."""

    value: str
    caption: str


@dataclass(frozen=True, kw_only=True)
class ReportContent:
    """Everything in a report, in the order of the page.

    Parameters
    ----------
    title, summary : str
    unseen : str
        What of the test split the networks have never seen: people, or faces alone where training has some of these.
    people_in_training : int
        People of the test split who are in training too.
    accuracy : tuple of Accuracy
        Exact points first; detected ones where the record has them.
    headlines : tuple of Headline
    scores : tuple of ShapeScores
        In the networks' order, region by region.
    constant : tuple of str
        Shapes that are always 0, because 68 points do not show them.
    curve : LearningCurve
        Mean over the networks.
    curves : tuple of LearningCurve
        Each network.
    noisy_training : bool
        Whether training faces were displaced and test faces were not.
    floor : float or None
        Mean R2 over the visible shapes of ridge regression on the networks' own displaced rows.
    regressions : tuple of RegressionPlot
    calibration : tuple of CalibrationRow
        Empty where a model has no calibrated networks.
    provenance : tuple of (str, str)
        How the model came about: what, and its value.
    """

    title: str
    summary: str
    unseen: str
    people_in_training: int
    accuracy: tuple[Accuracy, ...]
    headlines: tuple[Headline, ...]
    scores: tuple[ShapeScores, ...]
    constant: tuple[str, ...]
    curve: LearningCurve
    curves: tuple[LearningCurve, ...]
    noisy_training: bool
    floor: float | None
    regressions: tuple[RegressionPlot, ...]
    calibration: tuple[CalibrationRow, ...]
    provenance: tuple[tuple[str, str], ...]


def mean_curve(curves: tuple[LearningCurve, ...]) -> LearningCurve:
    """Average of all networks; one that stopped early goes on at its last error."""

    def average(series: str) -> np.ndarray:
        values = [getattr(curve, series) for curve in curves]
        values = [value for value in values if len(value)]
        longest = max(map(len, values), default=0)
        padded = [np.pad(value, (0, longest - len(value)), mode="edge") for value in values]
        return np.mean(padded, axis=0) if padded else np.zeros(0)

    train, validation, test = map(average, ("train", "validation", "test"))
    return LearningCurve(
        name=f"mean of {len(curves)} networks", train=train, validation=validation, test=test, best_step=None
    )

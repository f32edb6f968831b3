"""Holds how a model of 68 points was trained and how well it does, as model.json has it under ``record``."""

from dataclasses import asdict, dataclass, field
from typing import Annotated, Any

from annotated_types import Ge, Len

Count = Annotated[int, Ge(0)]

MOST_STEPS = 100_000
"""Of one network's training: a hundred times what the longest recipe has."""

MOST_CELLS = 200
"""Of a regression's counts, each way: pages draw each of them."""

Errors = Annotated[list[Annotated[float, Ge(0)]], Len(0, MOST_STEPS)]
"""Mean squares, one a step."""


@dataclass(frozen=True, kw_only=True)
class Scores:
    """Figures of one shape; None where they are undefined (a shape that never moves has no R2).

    Parameters
    ----------
    r2
        Share of the variance explained: 1 is perfect, 0 is as good as the mean of the scored rows.
    mae
        Mean absolute error, in weights.
    pearson
        Correlation of prediction and truth.
    """

    r2: float | None
    mae: float
    pearson: float | None


@dataclass(frozen=True, kw_only=True)
class MeanScores:
    """Mean R2 over all shapes, over the visible ones, and over networks (two-sided shapes count once)."""

    mean_r2: float | None
    mean_r2_visible: float | None
    mean_r2_networks: float | None


@dataclass(frozen=True, kw_only=True)
class Regression:
    """Predicted against true weights of one split, all shapes of all faces together.

    Parameters
    ----------
    counts
        ``counts[i][j]`` values with the truth in cell i and the prediction in cell j.
    slope, intercept
        Of the least-squares line: predicted = slope true + intercept; None where no weight moves.
    pearson
        Correlation; None where no weight or no prediction moves.
    """

    counts: Annotated[list[list[Count]], Len(2, MOST_CELLS)]
    slope: float | None
    intercept: float | None
    pearson: float | None

    def __post_init__(self) -> None:
        """Refuse counts that are not as many one way as the other."""
        sides = {len(self.counts), *map(len, self.counts)}
        if len(sides) != 1:
            raise ValueError(
                f"counts are {len(self.counts)} rows of {sorted(map(len, self.counts))[:3]} cells"
            )


@dataclass(frozen=True, kw_only=True)
class ErrorCurves:
    """Mean squared error in z-scored targets from the start (step 0) on, by split."""

    train: Errors
    validation: Errors
    test: Errors


@dataclass(frozen=True, kw_only=True)
class NetworkTraining:
    """How one network's training went.

    Parameters
    ----------
    alpha
        The chosen L2 strength.
    search
        Validation errors by strength, of those that were tried.
    outcome, reason
        Why its iterations ended: a name, and a sentence.
    steps, best_step
        Steps taken, and the one whose weights were kept.
    curves
        Its errors.
    """

    alpha: float
    search: dict[str, float]
    outcome: str
    reason: str
    steps: Count
    best_step: Count
    curves: ErrorCurves


@dataclass(frozen=True, kw_only=True)
class DatasetRecord:
    """The dataset of a training.

    Parameters
    ----------
    name, spec_hash, rig, licence
        As dataset.json has them; None where it does not.
    keypoints_sha256
        Of all shards.
    samples
        By split.
    people
        In all splits.
    people_in_training
        By split, people who are in training too; older records do not say.
    """

    name: str
    spec_hash: str | None
    keypoints_sha256: str
    rig: Any
    licence: Any
    samples: dict[str, Count]
    people: Count
    people_in_training: dict[str, Count] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class TrainingRecord:
    """Everything about a training, every figure unrounded.

    ``scores`` and ``summary`` are of the test split as the dataset has it: ``network`` and ``ridge`` see a frame
    alone, ``calibrated`` and ``calibrated_ridge`` a neutral frame as well; ``mean`` is the training mean. These ridges
    are trained on faces as the dataset has them; where the networks' faces are displaced, ``ridge_same_rows`` and
    ``calibrated_ridge_same_rows`` are trained on the very rows that the networks were.

    Parameters
    ----------
    recipe
        Every setting of ``regress.learning.training.recipes``, as JSON data.
    seed, dataset, training_rows
        What it was trained with.
    licence
        Of the weights.
    versions
        Of the programs, by name.
    floors
        What each baseline was trained on, by method.
    summary, as_detected
        Means by method: of faces as the dataset has them, and with detectors' bias and jitter.
    scores
        By shape, then by method.
    regression
        By split.
    networks, calibrated_networks
        By the network's key; None without calibrated networks.
    """

    recipe: dict[str, Any]
    seed: int
    dataset: DatasetRecord
    training_rows: Count
    licence: str
    versions: dict[str, str]
    floors: dict[str, str] = field(default_factory=dict)
    summary: dict[str, MeanScores]
    as_detected: dict[str, MeanScores] = field(default_factory=dict)
    scores: dict[str, dict[str, Scores]]
    regression: dict[str, Regression] = field(default_factory=dict)
    networks: dict[str, NetworkTraining]
    calibrated_networks: dict[str, NetworkTraining] | None = None


def record_to_json(record: TrainingRecord | None) -> dict[str, Any]:
    """JSON data of a record; empty for a model that ``regress train`` did not make."""
    if record is None:
        return {}
    document = asdict(record)
    if record.calibrated_networks is None:
        del document["calibrated_networks"]
    return document

"""Counts what a dataset holds: weights, their correlations, heads, poses, gaze, visibility."""

from dataclasses import dataclass

import numpy as np
import pyarrow as pa

from facegen.conventions import SHARD_ROWS, Visibility
from facegen.geometry import angles_from_direction, angles_from_rotation
from facegen.rigs import measures_mm
from facegen.sampling import rig_of
from facegen.sampling.cameras import FACING
from facegen.store import Dataset, column_array

MOST_ROWS = 100_000
"""Rows read at most: whole shards, evenly spread over the dataset. Percentiles do not move with more."""

_COLUMNS = (
    *("person", "split", "component", "sex", "age_years", "weights", "identity"),
    *("gaze", "camera_from_head", "visibility", "neutral"),
)


@dataclass(frozen=True, kw_only=True)
class Measure:
    """A length over people, millimetres: mean, standard deviation, 1st and 99th percentile."""

    name: str
    sex: str
    people: int
    mean: float
    sd: float | None
    low: float
    high: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Statistics:
    """What rows of a dataset hold.

    Attributes
    ----------
    rows, people
        How many were read.
    counts
        Rows by value, of split, component and sex.
    age_years
        (people,).
    weights
        (n, 52).
    head_deg
        (n, 3) yaw, pitch and roll of the head before its camera, degrees, as specs count them.
    gaze_deg
        (m, 2) yaw and pitch of the left eye's optical axis in the head, degrees, of faces that are not neutral.
    visible
        (68,) share of rows in which each landmark is visible.
    measures
        Of the people's neutral faces, as docs/population.md has them.
    """

    rows: int
    people: int
    counts: dict[str, dict[str, int]]
    age_years: np.ndarray
    weights: np.ndarray
    head_deg: np.ndarray
    gaze_deg: np.ndarray
    visible: np.ndarray
    measures: tuple[Measure, ...]

    @property
    def coactivation(self) -> np.ndarray:
        """(52, 52) correlations of the weights; NaN for shapes that never move."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.corrcoef(self.weights.T)


def dataset_statistics(dataset: Dataset) -> Statistics:
    """Read the keypoints of a dataset, or an even choice of its shards.

    Raises
    ------
    InputError
        If nothing has been made yet.
    InvalidData
        If a shard is damaged.
    """
    table = _read(dataset)
    column = {name: column_array(table, name) for name in _COLUMNS}
    people, first = np.unique(column["person"], return_index=True)
    return Statistics(
        rows=len(table),
        people=len(people),
        counts={name: _counts(column[name]) for name in ("split", "component", "sex")},
        age_years=column["age_years"][first],
        weights=column["weights"],
        head_deg=head_angles_deg(column["camera_from_head"].reshape(-1, 4, 4)),
        gaze_deg=np.degrees(np.stack(angles_from_direction(column["gaze"][~column["neutral"], 0]), axis=-1)),
        visible=(column["visibility"] == Visibility.VISIBLE).mean(axis=0),
        measures=_measures(dataset, column),
    )


def head_angles_deg(camera_from_head: np.ndarray) -> np.ndarray:
    """Yaw, pitch and roll (n, 3), degrees, of heads (n, 4, 4) before their cameras; 0 is a face that looks at it."""
    angles = angles_from_rotation(FACING.T @ camera_from_head[:, :3, :3])
    return np.degrees(np.stack(angles, axis=-1))


def _read(dataset: Dataset) -> pa.Table:
    shards = dataset.made_shards()
    count = min(len(shards), MOST_ROWS // SHARD_ROWS)
    chosen = np.linspace(0, len(shards) - 1, count).round().astype(int)
    return pa.concat_tables([dataset.read_shard(shards[index], _COLUMNS) for index in chosen])


def _counts(values: np.ndarray) -> dict[str, int]:
    names, counts = np.unique(values.astype(str), return_counts=True)
    return dict(sorted(zip(names.tolist(), counts.tolist(), strict=True), key=lambda item: -item[1]))


def _measures(dataset: Dataset, column: dict[str, np.ndarray]) -> tuple[Measure, ...]:
    _, rows = np.unique(column["person"], return_index=True)
    identity, whose = (
        column["identity"][rows].astype(np.float64),
        rig_of(dataset.spec, column["person"][rows]),
    )
    lengths: dict[str, np.ndarray] = {}
    for index, rig in enumerate(dataset.rigs):
        for name, values in measures_mm(rig, identity[whose == index, : rig.components]).items():
            lengths.setdefault(name, np.full(len(rows), np.nan))[whose == index] = values
    return tuple(
        Measure(
            name=name,
            sex=sex,
            people=int(of.sum()),
            mean=float(values[of].mean()),
            sd=float(values[of].std()) if of.sum() > 1 else None,
            low=float(np.percentile(values[of], 1)),
            high=float(np.percentile(values[of], 99)),
        )
        for name, values in lengths.items()
        for sex in ("female", "male")
        if (of := (column["sex"][rows] == sex) & np.isfinite(values)).any()
    )

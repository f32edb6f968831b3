"""Holds a headset network's figures on frames with exact labels, as model.json and reports have them."""

from dataclasses import asdict, dataclass, field
from typing import Annotated, Any

from annotated_types import Ge

from facegen.conventions import BLENDSHAPES

Count = Annotated[int, Ge(0)]
Size = Annotated[float, Ge(0)]
"""Of an error; none is below 0."""


@dataclass(frozen=True, kw_only=True)
class Summary:
    """Figures over frames; None where they are undefined.

    Parameters
    ----------
    rows
        Frames.
    geometry_mm
        Mean distance of the face's vertices from their true places.
    r2
        Mean over the 51 shapes that cameras can see (not tongueOut) of the share of variance explained.
    mae, rmse
        Of the 51 weights.
    blink_r2
        Mean of both lids.
    gaze_deg
        Mean angle between predicted and true optical axes.
    gaze_open_deg
        The same of open eyes: nobody sees where a closed eye looks.
    """

    rows: Count
    geometry_mm: Size
    r2: float | None
    mae: Size
    rmse: Size
    blink_r2: float | None
    gaze_deg: Size
    gaze_open_deg: float | None = None


@dataclass(frozen=True, kw_only=True)
class ClipSummary(Summary):
    """Figures over the frames of clips.

    Parameters
    ----------
    shake
        Root mean square change of a weight's error from frame to frame.
    """

    shake: Size


@dataclass(frozen=True, kw_only=True)
class ShapeFigures:
    """Figures of one shape; ``r2`` is None where it never moves."""

    r2: float | None
    mae: Size
    rmse: Size


@dataclass(frozen=True, kw_only=True)
class GroupErrors:
    """Mean geometry errors of a group of frames.

    Parameters
    ----------
    rows
        Frames.
    mm
        By condition.
    """

    rows: Count
    mm: dict[str, Size]


@dataclass(frozen=True, kw_only=True)
class DeviationFigures:
    """How well predicted standard deviations are calibrated.

    Parameters
    ----------
    squared_error_over_variance
        Mean squared error over mean predicted variance; 1 is calibrated.
    correlation
        Of absolute error and predicted deviation; None where all deviations are equal.
    """

    squared_error_over_variance: float
    correlation: float | None


FEW_ROWS = 200
"""Frames of a split below which a shape may hardly move in any of them."""


@dataclass(frozen=True, kw_only=True)
class Evaluation:
    """All figures of a network on one split of arrays, unrounded; fields with a default are younger than some models.

    Parameters
    ----------
    split, rows, people
        Which frames, how many, and of how many people.
    people_in_training
        How many of these people the arrays' training split has too.
    unseen
        Whether it is known that the network was trained on none of these people.
    dataset_hash
        Of the arrays.
    conditions, combined
        Summaries by condition: of ordinary frames, and of frames of the component ``combined``.
    floors
        Summaries of the baselines ``mean`` (always the training mean) and ``rest`` (always the resting face).
    shapes
        By shape, then by calibration.
    cameras
        R2 by camera, then by shape: from this camera alone.
    components, people_mm
        Errors by component of the sampler, and by person.
    deviation
        How well predicted deviations are calibrated.
    seat
        By calibration, share of frames whose neutral pictures the network takes for those of the frame's seat.
    """

    split: str
    rows: Count
    people: Count
    people_in_training: Count = 0
    unseen: bool = False
    dataset_hash: str = ""
    conditions: dict[str, Summary]
    combined: dict[str, Summary] = field(default_factory=dict)
    floors: dict[str, Summary]
    shapes: dict[str, dict[str, ShapeFigures]]
    cameras: dict[str, dict[str, float | None]]
    components: dict[str, GroupErrors]
    people_mm: dict[str, GroupErrors]
    deviation: DeviationFigures
    seat: dict[str, float]

    def __post_init__(self) -> None:
        """Refuse tables that lack a shape, and groups that were not measured under the same conditions."""
        for what, table in (("shapes", self.shapes), *((f"cameras.{k}", v) for k, v in self.cameras.items())):
            lacking = [name for name in BLENDSHAPES if name not in table]
            if lacking:
                raise ValueError(f"{what} has no {lacking[0]}")
        groups = {
            "shapes": list(self.shapes.values()),
            "components": [group.mm for group in self.components.values()],
            "people_mm": [group.mm for group in self.people_mm.values()],
        }
        for what, entries in groups.items():
            if any(entry.keys() != entries[0].keys() or "uncalibrated" not in entry for entry in entries):
                raise ValueError(f"{what} are not all of the same conditions, uncalibrated among them")
        if not self.floors.keys() <= {"mean", "rest"}:
            raise ValueError("floors may be mean and rest")

    @property
    def few(self) -> str:
        """A sentence where these frames are too few for R2 by shape; else empty."""
        if self.rows >= FEW_ROWS:
            return ""
        return (
            f"Of {self.rows:,} frames R2 by shape says little: a shape that hardly moves in them gets a large negative "
            f"number. Measure {FEW_ROWS} or more."
        )


_GROUPED = ("components", "people_mm")


def evaluation_to_json(evaluation: Evaluation) -> dict[str, Any]:
    """JSON data of an evaluation; a group's errors stand beside its rows."""
    document = asdict(evaluation)
    for name in _GROUPED:
        document[name] = {
            key: {"rows": group["rows"], **group["mm"]} for key, group in document[name].items()
        }
    return document


def evaluation_from_json(document: Any) -> Any:
    """The same data with the keys of `Evaluation` and its records, not yet checked."""
    if not isinstance(document, dict):
        return document
    grouped = {}
    for name in _GROUPED:
        groups = document.get(name, {})
        grouped[name] = (
            {key: _group(group) for key, group in groups.items()} if isinstance(groups, dict) else groups
        )
    return {**document, **grouped}


def _group(group: object) -> object:
    """A group's errors beside its rows; what is no table is left to the check."""
    if not isinstance(group, dict):
        return group
    errors = {name: value for name, value in group.items() if name != "rows"}
    return {"rows": group.get("rows"), "mm": errors}

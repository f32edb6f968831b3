"""Prepares probes for the page: a part for the networks alone, one for those beside a neutral frame."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from markupsafe import Markup

from regress.learning.probes import Measured
from regress.learning.probes.crosstalk import WEIGHT, CrossTalk
from regress.learning.probes.examples import Example, Reading
from regress.learning.probes.observability import NOISE_PERCENT, Observability
from regress.learning.probes.people import PersonErrors
from regress.learning.probes.poses import PITCH_DEG, WITHIN_DEG, YAW_DEG, PoseErrors
from regress.learning.probes.stillness import JITTER_PERCENT, Stillness
from regress.learning.probes.winks import SHUT, Winks
from regress.report.head import head_image
from regress.report.heatmap import leak_map, pose_map
from regress.report.histogram import histogram
from regress.report.portraits import portrait
from regress.targets import NETWORKS, OUTPUTS, VISIBLE_SHAPES

_VISIBLE = [OUTPUTS.index(name) for name in VISIBLE_SHAPES]
_REGIONS = [network.region for network in NETWORKS for _ in network.outputs]


@dataclass(frozen=True, kw_only=True)
class ProbedPart:
    """Figures and drawings of one set of networks.

    Parameters
    ----------
    title : str
        Which landmarks it sees.
    noise, pose, stillness : tuple of (region, tuple of (shape, figures))
        Rows of tables; figures are floats in the order of the table's head.
    pose_map, people, leaks : Markup
        Drawings; no ``leaks`` without neutral faces.
    pose_worst : tuple of (str, float)
        Visible shapes that turning costs most R2.
    pose_loss, pose_mae_rise : float
        Mean over the visible shapes.
    person_median, person_high, person_worst : float
        Of the mean absolute error: median, 95th percentile and the worst.
    wink : Winks or None
    largest_leaks : tuple of (moved, output, change)
    neutral_worst : tuple of (str, float)
    neutral_mean : float
        Mean over all shapes.
    jitter : (J,) float64
        Mean over the visible shapes.
    worst : tuple of (true head, predicted head, face)
    """

    title: str
    noise: tuple
    pose: tuple
    stillness: tuple
    pose_map: Markup
    people: Markup
    leaks: Markup | None
    pose_worst: tuple[tuple[str, float], ...]
    pose_loss: float
    pose_mae_rise: float
    person_median: float
    person_high: float
    person_worst: float
    wink: Winks | None
    largest_leaks: tuple[tuple[str, str, float], ...]
    neutral_worst: tuple[tuple[str, float], ...]
    neutral_mean: float
    jitter: np.ndarray
    worst: tuple


@dataclass(frozen=True, kw_only=True)
class DrawnExample:
    """A face by its points and true weights, and what networks made of it.

    Parameters
    ----------
    title : str
    points, true : Markup
    readings : tuple of (head, points that were seen, with what, error)
    """

    title: str
    points: Markup
    true: Markup
    readings: tuple[tuple[Markup, str, str, float], ...]


@dataclass(frozen=True, kw_only=True)
class Probed:
    """Everything that the page says of probes.

    Parameters
    ----------
    faces, people : int
    pose_spread_deg : (2,) float64
    movement_residual_mm : float
    noise_percent, jitter_percent : tuple of float
    within_deg, weight, shut : float
    two_ridges : bool
        Whether the networks' rows were displaced, so that two ridge regressions are shown.
    summary : tuple of (title, method, over, figures)
        Mean R2 of every method at every level of noise.
    parts : tuple of ProbedPart
    examples : tuple of DrawnExample
    """

    faces: int
    people: int
    pose_spread_deg: np.ndarray
    movement_residual_mm: float
    noise_percent: tuple[float, ...]
    jitter_percent: tuple[float, ...]
    within_deg: float
    weight: float
    shut: float
    two_ridges: bool
    summary: tuple
    parts: tuple[ProbedPart, ...]
    examples: tuple[DrawnExample, ...]


def probed_of(measured: Measured) -> Probed:
    """Prepare what was measured for the page."""
    most = max(errors.mae[..., _VISIBLE].mean(axis=-1).max() for errors in measured.poses)
    nothing = (None,) * len(measured.poses)  # known of leaks and winks without neutral faces
    parts = zip(
        measured.poses,
        measured.people_errors,
        measured.cross_talk or nothing,
        measured.winks or nothing,
        measured.stillness,
        strict=True,
    )
    return Probed(
        faces=measured.faces,
        people=measured.people,
        pose_spread_deg=measured.pose_spread_deg,
        movement_residual_mm=1000 * (measured.movement_residual_m or 0.0),
        noise_percent=NOISE_PERCENT,
        jitter_percent=JITTER_PERCENT,
        within_deg=WITHIN_DEG,
        weight=WEIGHT,
        shut=SHUT,
        two_ridges=any(one.method == "ridge, same rows" for one in measured.observability),
        summary=_summary(measured.observability),
        parts=tuple(_part(measured.observability, *found, most=float(most)) for found in parts),
        examples=tuple(map(_drawn, measured.examples)),
    )


def _drawn(example: Example) -> DrawnExample:
    person = f"person {example.person}"

    def reading(one: Reading) -> tuple[Markup, str, str, float]:
        points = "detected points" if one.detected else "exact points"
        sees = _title(one.calibrated)
        return head_image(one.weights, f"{person}: predicted from {points}, {sees}"), points, sees, one.mae

    return DrawnExample(
        title=f"{person}: {100 * example.better:.0f} % of the faces are read better",
        points=Markup(portrait(example.points, f"{person}: 68 points")),
        true=head_image(example.true, f"{person}: true weights"),
        readings=tuple(map(reading, example.readings)),
    )


def _title(calibrated: bool) -> str:
    return "with a neutral frame" if calibrated else "a frame alone"


def _summary(found: Sequence[Observability]) -> tuple:
    return tuple(
        (_title(one.calibrated), one.method, over, np.nanmean(one.r2[:, columns], axis=1))
        for calibrated in (False, True)
        for over, columns in (("visible", _VISIBLE), ("all", slice(None)))
        for one in found
        if one.calibrated == calibrated
    )


def _part(
    observed: Sequence[Observability],
    poses: PoseErrors,
    people: PersonErrors,
    talk: CrossTalk | None,
    wink: Winks | None,
    still: Stillness,
    *,
    most: float,
) -> ProbedPart:
    same = {one.method: one.r2 for one in observed if one.calibrated == poses.calibrated}
    networks, floor = same["networks"], same.get("ridge, same rows", same["ridge, undisplaced rows"])
    visible = np.zeros(len(OUTPUTS), dtype=bool)
    visible[_VISIBLE] = True
    return ProbedPart(
        title=_title(poses.calibrated),
        noise=_by_region(np.stack([networks, floor], axis=1).reshape(-1, len(OUTPUTS)).T),
        pose=_by_region(np.stack([poses.frontal_r2, poses.turned_r2, poses.loss, poses.mae_rise], axis=1)),
        stillness=_by_region(np.stack([still.neutral_mean, still.neutral_high, *still.jitter], axis=1)),
        pose_map=Markup(
            pose_map(poses.mae[..., _VISIBLE].mean(axis=-1), yaw_deg=YAW_DEG, pitch_deg=PITCH_DEG, most=most)
        ),
        people=Markup(histogram(people.mae, "mean absolute error of the weights")),
        leaks=talk and Markup(leak_map(talk.change, OUTPUTS, full=WEIGHT)),
        pose_worst=_largest(np.where(visible, poses.loss, np.nan), 5),
        pose_loss=float(np.nanmean(poses.loss[_VISIBLE])),
        pose_mae_rise=float(poses.mae_rise[_VISIBLE].mean()),
        person_median=float(np.median(people.mae)),
        person_high=float(np.percentile(people.mae, 95)),
        person_worst=float(people.mae[0]),
        wink=wink,
        largest_leaks=() if talk is None else talk.largest(12),
        neutral_worst=_largest(still.neutral_mean, 5),
        neutral_mean=float(still.neutral_mean.mean()),
        jitter=still.jitter[:, _VISIBLE].mean(axis=1),
        worst=tuple(
            (
                head_image(face.true, f"person {face.person}: true weights"),
                head_image(face.predicted, f"person {face.person}: predicted weights"),
                face,
            )
            for face in people.worst
        ),
    )


def _by_region(figures: np.ndarray) -> tuple:
    """Rows (O, F) as (region, rows) of (shape, figures), in the networks' order."""
    rows = zip(_REGIONS, OUTPUTS, figures.tolist(), strict=True)
    return tuple(
        (region, tuple((name, values) for _, name, values in group))
        for region, group in groupby(rows, key=lambda row: row[0])
    )


def _largest(values: np.ndarray, count: int) -> tuple[tuple[str, float], ...]:
    order = np.argsort(np.where(np.isnan(values), np.inf, -values), kind="stable")[:count]
    return tuple((OUTPUTS[row], float(values[row])) for row in order if not np.isnan(values[row]))

"""What a person asked for after the networks: smoothing, taste, a mirror, another avatar's shapes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from facegen.conventions import BLENDSHAPES, BLINK_INDICES
from regress.errors import InputError
from regress.runtime.sample import Sample
from regress.runtime.stages.adjustment import ShapeAdjustment, adjust, blend_sides, mirror
from regress.runtime.stages.filters import FILTERS, Kalman, Mean
from regress.runtime.stages.kalman import LIDS, KalmanSmoothing
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.own_blinks import TakeBlinks
from regress.runtime.stages.retargeting.matrix import Retargeting
from regress.runtime.stages.smoothing import MeanSmoothing, MovingAverage, OneEuroSmoothing
from regress.runtime.stages.stage import BatchStage, Stage


@dataclass(frozen=True, kw_only=True)
class Output:
    """What happens before and after the networks, in this order.

    Parameters
    ----------
    smooth_landmarks_hz
        Cutoff of a landmark at rest, of One-Euro smoothing before the networks; None for none.
    filter
        Name of the filter over weights and gaze (`FILTERS`); None for none. One that looks ahead holds samples back.
    smooth
        Frames of the moving average; 1 leaves weights as they are.
    one_euro
        One-Euro smoothing by the frames' times; None for none.
    own_blinks
        Whether blinks are stretched by the fullest ones of the take, which is held back until its end.
    few_told
        Whether a take with too few blinks for it is told of.
    amplify_eyes
        Factor on blink, wide and squint of each eye, which the second paper lets people exaggerate.
    adjustments
        Gain, offset, dead zone and limits by shape.
    left_right_blend
        0 leaves left and right, 1 gives both their mean.
    mirror
        Exchange left and right.
    retargeting
        To other shapes than ARKit's, at the end.

    Raises
    ------
    InputError
        Where no filter has that name.
    """

    smooth_landmarks_hz: float | None = None
    filter: str | None = None
    smooth: int = 1
    one_euro: OneEuro | None = None
    own_blinks: bool = False
    few_told: bool = True
    amplify_eyes: float = 1.0
    adjustments: dict[str, ShapeAdjustment] = field(default_factory=dict)
    left_right_blend: float = 0.0
    mirror: bool = False
    retargeting: Retargeting | None = None

    def __post_init__(self) -> None:
        """Refuse a filter that is not known."""
        if self.filter is not None and self.filter not in FILTERS:
            raise InputError(f"there is no filter {self.filter!r}; {', '.join(FILTERS)} are known")

    @property
    def names(self) -> tuple[str, ...]:
        """What the columns that leave are called."""
        return BLENDSHAPES if self.retargeting is None else self.retargeting.names

    @property
    def needs_times(self) -> bool:
        """Whether every frame must have a time."""
        filtered_by_time = self.filter is not None and FILTERS[self.filter].needs_times
        by_time = self.one_euro is not None or self.smooth_landmarks_hz is not None
        return filtered_by_time or by_time or self.own_blinks

    @property
    def changes_lids(self) -> bool:
        """Whether somebody has said how blinks are to be changed; a dead zone alone leaves the full ones."""
        every = self.adjustments.get("*", ShapeAdjustment())
        lids = [self.adjustments.get(BLENDSHAPES[index], every) for index in BLINK_INDICES]
        return self.amplify_eyes != 1 or any(replace(lid, dead_zone=0.0) != ShapeAdjustment() for lid in lids)

    def with_own_blinks(self, *, film: bool) -> "Output":
        """The output with own blinks, unasked, of a film; as it is otherwise, and where lids are changed."""
        return replace(self, own_blinks=True, few_told=False) if film and not self.changes_lids else self

    def stages(self, say: Callable[[str], None] = lambda message: None) -> list[Stage]:
        """Stages behind the networks, new ones for each take; only those asked for. ``say`` is told of blinks."""
        made: list[Stage] = []
        if self.filter is not None:
            made.append(filter_stage(self.filter))
        if self.smooth > 1:
            made.append(MovingAverage(self.smooth))
        if self.one_euro is not None:
            made.append(OneEuroSmoothing(self.one_euro))
        if self.own_blinks:
            made.append(TakeBlinks(say, few_told=self.few_told))
        if self.amplify_eyes != 1:
            lids = dict.fromkeys(LIDS, ShapeAdjustment(gain=self.amplify_eyes))
            made.append(WeightMap(partial(adjust, adjustments=lids)))
        if self.adjustments:
            made.append(WeightMap(partial(adjust, adjustments=self.adjustments)))
        if self.left_right_blend > 0:
            made.append(WeightMap(partial(blend_sides, share=self.left_right_blend)))
        if self.mirror:
            made.append(Mirror())
        if self.retargeting is not None:
            made.append(WeightMap(self.retargeting.apply))
        return made


def filter_stage(name: str) -> Stage:
    """A new stage of the filter with that name in `FILTERS`."""
    settings = FILTERS[name].settings
    if isinstance(settings, Mean):
        return MeanSmoothing(settings.behind, settings.ahead)
    if isinstance(settings, Kalman):
        return KalmanSmoothing(settings.ahead_s, lids_ahead_s=settings.lids_ahead_s)
    return OneEuroSmoothing(settings)


class WeightMap(BatchStage):
    """Weights of each frame by themselves, by a function of (n, k) arrays."""

    def __init__(self, change: Callable[[np.ndarray], np.ndarray]) -> None:
        self._change = change

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """Samples with changed weights."""
        weights = self._change(np.stack([sample.weights for sample in samples]))
        return [replace(sample, weights=row) for sample, row in zip(samples, weights, strict=True)]


class Mirror(Stage):
    """What a mirror shows: left and right of weights, gaze, head and confidence exchanged."""

    def step(self, sample: Sample) -> Sample:
        """The sample of the mirrored face."""
        gaze, head, trust = sample.gaze, sample.head, sample.confidence
        return replace(
            sample,
            weights=mirror(sample.weights[None])[0],
            gaze=None if gaze is None else gaze[[2, 3, 0, 1]] * [-1, 1, -1, 1],
            eyes=None if sample.eyes is None else sample.eyes.mirrored,
            head=None if head is None else head * [-1, 1, 1, -1, 1, -1],
            confidence=None if trust is None else mirror(trust[None])[0],
        )

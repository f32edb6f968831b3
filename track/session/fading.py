"""What an avatar does while the face is gone: it holds, goes to rest, and comes back without a jump."""

from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage

HOLD_S, REST_S, BACK_S = 0.3, 0.8, 0.2
"""Seconds from the last face until it leaves what it showed, until it is at rest; and from its return until it shows
the face again. Detectors miss a face for some frames where a hand passes."""

SILENT_S = 2.0
"""Seconds after which nothing is said any more: by then the zeros of rest have been sent dozens of times, should some
get lost, and formats that can say "no face" say it."""

JUMP = 0.5
"""Widths of a face by which its middle moves between two frames only if it is another face: at 30 frames a second a
head that crosses the picture in half a second moves by .3."""

JUMP_WITHIN_S = 0.15
"""Frames farther apart than this may differ as they like: at 7 frames a second a head gets anywhere."""


class Fading(Stage):
    """Fades weights, gaze and the head's turn to rest where there is no face, and back to the face where there is one.

    A face elsewhere than a frame ago is another one: it is faded to as well.
    """

    def __init__(self) -> None:
        self._shown: Sample | None = None
        self._held: Sample | None = None
        self._from: Sample | None = None
        self._seen_s = -np.inf
        self._missed_s = -np.inf
        self._blend_s, self._blend_since_s = 0.0, -np.inf
        self._place: tuple[np.ndarray, float] | None = None

    @property
    def under_way(self) -> bool:
        """Whether the face is gone and the avatar has not been told enough yet."""
        return self._shown is not None and self._missed_s > self._seen_s

    def step(self, sample: Sample) -> Sample:
        """The sample with what the avatar shows at its time."""
        if sample.weights is None or np.isnan(sample.weights).any():
            return self._without(sample)
        if self._from is None:
            self._begin(sample, since_s=sample.time_s, during_s=BACK_S)
        elif self._missed_s > self._seen_s:
            # after one missed frame the next one counts in full; after many the way back takes its time
            self._begin(sample, since_s=self._missed_s, during_s=min(BACK_S, self._missed_s - self._seen_s))
        elif self._jumped(sample):
            self._begin(sample, since_s=self._seen_s, during_s=BACK_S)
        self._seen_s = sample.time_s
        passed = sample.time_s - self._blend_since_s
        if passed < self._blend_s:
            sample = _between(self._from, sample, passed / self._blend_s)
        self._shown = self._held = sample
        return sample

    def _begin(self, sample: Sample, *, since_s: float, during_s: float) -> None:
        self._from = self._shown or _rest(self._held or sample)
        self._blend_since_s, self._blend_s = since_s, during_s

    def _without(self, sample: Sample) -> Sample:
        self._missed_s, self._place = sample.time_s, None
        gone_s = sample.time_s - self._seen_s
        if self._shown is None or gone_s > SILENT_S:
            self._shown = self._from = None
            unknown = np.full(len(BLENDSHAPES), np.nan)
            return replace(sample, weights=unknown, gaze=np.full(4, np.nan), head=np.full(6, np.nan))
        share = np.clip((gone_s - HOLD_S) / (REST_S - HOLD_S), 0.0, 1.0)
        self._shown = shown = _between(self._held, _rest(self._held), float(share))
        return replace(sample, weights=shown.weights, gaze=shown.gaze, head=shown.head)

    def _jumped(self, sample: Sample) -> bool:
        before = self._place
        if sample.points is None or np.isnan(sample.points).any():
            self._place = None
            return False
        low, high = sample.points.min(axis=0), sample.points.max(axis=0)
        middle, width = (low + high) / 2, float(high[0] - low[0])
        self._place = middle, width
        if before is None or sample.time_s - self._seen_s > JUMP_WITHIN_S:
            return False
        return bool(np.linalg.norm(middle - before[0]) > JUMP * max(width, before[1]))


def _rest(last: Sample) -> Sample:
    """A face at rest that looks ahead, with the head where it was last."""
    head = None if last.head is None else np.concatenate([last.head[:3], np.zeros(3)])
    gaze = None if last.gaze is None else np.zeros(4)
    return Sample(weights=np.zeros(len(BLENDSHAPES)), gaze=gaze, head=head)


def _between(one: Sample, other: Sample, share: float) -> Sample:
    """The second sample with weights, gaze and head so far on the way from the first one's."""
    mixed = {}
    for name in ("weights", "gaze", "head"):
        start, end = getattr(one, name), getattr(other, name)
        if end is None or start is None or not (np.isfinite(start).all() and np.isfinite(end).all()):
            mixed[name] = end if end is not None else start
        else:
            mixed[name] = start + (end - start) * share
    return replace(other, **mixed)

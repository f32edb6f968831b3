"""Faces that cannot be right leave the way: missing, collapsed, mirrored, or out of the order of time."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from regress.errors import InputError
from regress.runtime.inputs import Fault, TimeOrder, face_faults
from regress.runtime.sample import Sample
from regress.runtime.stages.smoothing import LONGEST_GAP_S
from regress.runtime.stages.stage import BatchStage


class Soundness(BatchStage):
    """Finds what is wrong with each face, and takes its points away.

    Parameters
    ----------
    needs_times
        Whether a later stage smooths over time: each time must then be known and later than those before.
    live
        Whether frames come as they are made: a clock that is set is followed then, half a second later.
    unit
        What a frame of the source is called in a sentence, for example ``"line"``.
    """

    def __init__(self, *, needs_times: bool, live: bool = False, unit: str = "row") -> None:
        self._needs_times, self._unit = needs_times, unit
        self._order = TimeOrder(strictly=needs_times, set_after_s=LONGEST_GAP_S if live else None)

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """Samples, with NaN for the points and a fault of those that cannot be used.

        Raises
        ------
        InputError
            Where a sound face has no time at all and one is needed.
        """
        faults = face_faults(np.stack([sample.points for sample in samples]))
        timed = [
            row for row, sample in enumerate(samples) if faults[row] is None and sample.time_s is not None
        ]
        for row, fault in zip(timed, self._order.run([samples[row].time_s for row in timed]), strict=True):
            faults[row] = fault
        return [self._judged(sample, fault) for sample, fault in zip(samples, faults, strict=True)]

    def _judged(self, sample: Sample, fault: Fault | None) -> Sample:
        if fault is None and sample.time_s is None and self._needs_times:
            raise InputError(f"{self._unit} {sample.label} has no time, which smoothing needs; give --fps")
        if fault is None:
            return sample
        # what its reader found says more than that no face is there
        fault = sample.faults.get("points", fault)
        return replace(sample, points=np.full_like(sample.points, np.nan), faults={"points": fault})

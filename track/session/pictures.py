"""A headset's pictures as they come: one grey level a pixel, and what is wrong with each."""

from dataclasses import replace

import cv2
import numpy as np

from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.recordings.soundness import PictureSoundness
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage


class Soundness(PictureSoundness):
    """Of a camera that gives nothing its source knows more than that its picture is missing."""

    def step(self, sample: Sample) -> Sample:
        found = super().step(sample)
        known = {
            name: fault for name, fault in sample.faults.items() if found.faults.get(name) is Fault.MISSING
        }
        return replace(found, faults={**found.faults, **known})


class Grey(Stage):
    """One grey level a pixel, as infra-red cameras have it; of the same picture the same array."""

    def __init__(self) -> None:
        self._last: dict[str, tuple[np.ndarray, np.ndarray]] = {}

    def step(self, sample: Sample) -> Sample:
        for name, picture in (sample.pictures or {}).items():
            if name not in self._last or self._last[name][0] is not picture:
                grey = picture if picture.ndim == 2 else cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY)
                self._last[name] = picture, grey
        return replace(sample, pictures={name: self._last[name][1] for name in sample.pictures or {}})

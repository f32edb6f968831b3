"""Whether eyes are upright and on their own side in a headset's pictures: exchanged cameras are told at once."""

from collections import deque
from collections.abc import Sequence

import numpy as np

from regress.runtime.headset.network.parts import is_of_one_eye, side_of
from regress.runtime.headset.placing.compass import eye_compass
from regress.runtime.headset.placing.orientation import told_of_shares
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage

EVERY_S = 0.25
"""Between pictures at which the compass looks: eyes move within it, and a look costs a millisecond."""

FEWEST, MOST = 12, 40
"""Looks from which something is told, and how many of the latest count: three to ten seconds."""


class UprightWatch(Stage):
    """Looks at a picture of each eye now and then; changes nothing.

    Attributes
    ----------
    told
        What is to be said of cameras, by name; of those whose eye is upright nothing.
    """

    def __init__(self, cameras: Sequence[str]) -> None:
        self.told: dict[str, str] = {}
        self._seen = {name: deque(maxlen=MOST) for name in cameras if is_of_one_eye(name)}
        self._last_s = -np.inf

    def step(self, sample: Sample) -> Sample:
        """The sample as it is."""
        if 0 <= sample.time_s - self._last_s < EVERY_S:
            return sample
        self._last_s = sample.time_s
        for name, shares in self._seen.items():
            picture = (sample.pictures or {}).get(name)
            if picture is None:
                continue
            shares.append(eye_compass().log_shares(picture[None], of_right_eye=side_of(name) == "right"))
            told = told_of_shares(name, np.mean(shares, axis=0)) if len(shares) >= FEWEST else None
            self.told.pop(name, None)
            if told is not None:
                self.told[name] = f"{name}: {told}"
        return sample

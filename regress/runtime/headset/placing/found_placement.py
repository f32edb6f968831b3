"""A placement that was found, and how good the network and the compass find what is seen there."""

from dataclasses import dataclass

import numpy as np

from regress.runtime.headset.pictures.placement import CameraPlacement

_LIKENESS = 0.5
"""How much the likeness to training's mean picture counts. With it a film of a real eye, on either side, is traced with
half of the error or less; from 1.0 on eyes in other headsets' places are missed."""

_UPRIGHT = 1.5
"""How much the compass counts that an eye is upright and not in a mirror: the doubt is divided by the share it gives.

Of two films of real eyes, each in 18 changes (benchmarks/changed_eyes.py), 3 lie on the wrong side with `headset-any`
at 1, and 1 at 1.5 and 2; with `headset-tracking3` one at 1 and another one at 1.5.
"""

_UPRIGHT_DEG = 70.0
"""Roll up to which an eye stands upright: that of drawn headsets is 30 degrees at most, and a strap adds a few."""


@dataclass(frozen=True, kw_only=True)
class FoundPlacement:
    """A placement, and how good the network finds what it sees there.

    Parameters
    ----------
    placement
        Without levels.
    deviation
        Mean predicted deviation of the camera's own shapes.
    unrest
        How far points move with the view, as a share of the traced eye's width; 0.06 is about half of the moves
        themselves. Of the usual eye's width it would fall with the size of the view alone.
    unsettled
        How far a further step would go if nothing held it: of the size, of the view's width, or of a radian.
    likeness
        Correlation of the mean view with the model's typical picture; 0 where it has none.
    upright
        Mean logarithm of the share that the compass gives to an eye upright and not in a mirror, of whole pictures that
        are mirrored and turned by quarters as the placement is.
    lost
        Whether the search was held at its limits: the placement is then that of the whole picture.
    """

    placement: CameraPlacement
    deviation: float
    unrest: float
    unsettled: float
    likeness: float = 0.0
    upright: float = 0.0
    lost: bool = False

    @property
    def turned(self) -> bool:
        """Whether the eye lies on its side, or upside down."""
        return abs(self.placement.roll_deg) > _UPRIGHT_DEG

    @property
    def doubt(self) -> float:
        """How little the network suits what it sees there."""
        # of 20 drawn cameras 19 were told from their mirror images so, and 17 by the deviation itself
        certain = self.deviation**0.5 * self.unrest * (1 + 6 * self.unsettled)
        return certain * float(np.exp(-_LIKENESS * self.likeness))

    @property
    def score(self) -> float:
        """The doubt, and the compass's as well; the smaller, the better."""
        return self.doubt * float(np.exp(-_UPRIGHT * self.upright))

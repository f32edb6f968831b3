"""Names the points by which pictures of a mouth are placed: the base of the nose, and the corners of the lips."""

from dataclasses import dataclass

import numpy as np

from regress.runtime.headset.network.predictor import HeadsetPredictor

_NOSE = tuple(f"landmark_{number}" for number in range(31, 36))
_CORNERS = ("landmark_48", "landmark_54")


@dataclass(frozen=True, kw_only=True)
class MouthPoints:
    """Columns of what a mouth's camera traces.

    Parameters
    ----------
    nose, corners
        Base of the nose from side to side, and both corners of the lips.
    usual : (P, 2)
        Mean pixels of all points in training.
    """

    nose: list[int]
    corners: list[int]
    usual: np.ndarray

    @classmethod
    def of(cls, predictor: HeadsetPredictor, camera: str) -> "MouthPoints | None":
        """Those of a camera; None where it traces no mouth, or the model does not know how its pictures looked."""
        looks, names = predictor.model.looks.get(camera), predictor.model.points.get(camera, ())
        if looks is None or not len(looks.points) or not {*_NOSE, *_CORNERS} <= set(names):
            return None
        if any("_pupil" in name for name in names):
            return None
        return cls(
            nose=[names.index(name) for name in _NOSE],
            corners=[names.index(name) for name in _CORNERS],
            usual=np.array(looks.points),
        )

    @property
    def followed(self) -> list[int]:
        """Columns that stay on the same pixels of a picture where the view is moved."""
        return self.nose + self.corners

    @property
    def ends(self) -> tuple[int, int]:
        """Columns whose distance is the mouth's width."""
        return self.corners[0], self.corners[1]

    def seen_from_usual(self, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Turn and size (2, 2), and shift (2,), that take usual points nearest to the median of those seen (n, P, 2).

        The jaw and the lips move, the corners of the lips too, so five points of seven are the nose's.
        """
        usual, middle = self.usual[self.followed], np.nanmedian(seen[:, self.followed], axis=0)
        across, found = usual - usual.mean(axis=0), middle - middle.mean(axis=0)
        along = (across * found).sum()
        turned = (across[:, 0] * found[:, 1] - across[:, 1] * found[:, 0]).sum()
        turn = np.array([[along, -turned], [turned, along]]) / (across**2).sum()
        return turn, middle.mean(axis=0) - turn @ usual.mean(axis=0)

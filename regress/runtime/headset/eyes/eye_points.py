"""Names the columns of what an eye's camera traces: pupil, iris, lids, brow."""

from dataclasses import dataclass

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.network.predictor import HeadsetPredictor


@dataclass(frozen=True, kw_only=True)
class EyePoints:
    """Columns of what an eye's camera traces.

    Parameters
    ----------
    pupil
        One column.
    iris, upper, lower, brow
        Outline, lids from the inner corner on, and brow; some may be empty.
    usual : (P, 2)
        Mean pixels of all in training.
    """

    pupil: int
    iris: list[int]
    upper: list[int]
    lower: list[int]
    brow: list[int]
    usual: np.ndarray

    @classmethod
    def of(cls, predictor: HeadsetPredictor, camera: str) -> "EyePoints":
        """Those of a camera.

        Raises
        ------
        InputError
            Where the model does not trace an eye there, or does not know how its pictures looked.
        """
        looks = predictor.model.looks.get(camera)
        names = predictor.model.points.get(camera, ())
        eye = None if looks is None else cls.among(names, np.array(looks.points))
        if eye is None:
            raise InputError(
                f"{camera}: the model says too little of its points or its looks to place pictures by them; train it "
                f"with this version"
            )
        return eye

    @classmethod
    def among(cls, names: tuple[str, ...], usual: np.ndarray) -> "EyePoints | None":
        """Those among names of points, whose mean pixels are usual (P, 2); None where they are not one eye's."""
        columns = {
            part: [column for column, name in enumerate(names) if mark in name]
            for part, mark in (
                ("pupil", "_pupil"),
                ("iris", "_iris_"),
                ("upper", "_upper_lid_"),
                ("lower", "_lower_lid_"),
            )
        }
        if not all(columns.values()) or not len(usual):
            return None
        lids = {"landmark_42", "landmark_43", "landmark_44", "landmark_45", "landmark_46", "landmark_47"}
        lids |= {f"landmark_{number}" for number in range(36, 42)}
        brow = [
            column for column, name in enumerate(names) if name.startswith("landmark_") and name not in lids
        ]
        return cls(
            pupil=columns["pupil"][0],
            iris=columns["iris"],
            upper=columns["upper"],
            lower=columns["lower"],
            brow=brow,
            usual=usual,
        )

    @property
    def followed(self) -> list[int]:
        """Columns that stay on the same pixels of a picture where the view is moved."""
        return self.upper + self.lower + self.iris

    @property
    def ends(self) -> tuple[int, int]:
        """Columns whose distance is the eye's width."""
        return self.upper[0], self.upper[-1]

    def seen_from_usual(self, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Turn and size (2, 2), and shift (2,), that take the usual eye to the one that is seen (n, P, 2).

        The size is the iris's, which is nearly the same in all people; the place is that of the lids' middle, and
        upright is the line between the eye's corners.
        """
        size = np.nanmedian(_diameters(seen[:, self.iris])) / _diameters(self.usual[None, self.iris])[0]
        lids = self.upper + self.lower
        middle = np.nanmedian(seen[:, lids], axis=0)
        corners = [0, len(self.upper) - 1]
        turned = _angle(middle[corners]) - _angle(self.usual[lids][corners])
        turn = size * np.array([[np.cos(turned), -np.sin(turned)], [np.sin(turned), np.cos(turned)]])
        return turn, middle.mean(axis=0) - turn @ self.usual[lids].mean(axis=0)


def _diameters(outlines: np.ndarray) -> np.ndarray:
    """(n,) of irises (n, k, 2): their points lie on ellipses, evenly."""
    return 2 * np.linalg.norm(outlines - outlines.mean(axis=1, keepdims=True), axis=2).mean(axis=1)


def _angle(corners: np.ndarray) -> float:
    across, down = corners[1] - corners[0]
    return float(np.arctan2(down, across))


def traces_an_eye(predictor: HeadsetPredictor, camera: str) -> bool:
    """Whether a camera's points are those of one eye: pupil, iris, both lids."""
    names = predictor.model.points.get(camera, ())
    parts = ("_pupil", "_iris_", "_upper_lid_", "_lower_lid_")
    return sum("_pupil" in name for name in names) == 1 and all(
        any(part in name for name in names) for part in parts
    )

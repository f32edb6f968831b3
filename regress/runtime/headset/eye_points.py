"""Names the columns of what an eye's camera traces: pupil, iris, lids, brow."""

from dataclasses import dataclass

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.predictor import HeadsetPredictor


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


def traces_an_eye(predictor: HeadsetPredictor, camera: str) -> bool:
    """Whether a camera's points are those of one eye: pupil, iris, both lids."""
    names = predictor.model.points.get(camera, ())
    parts = ("_pupil", "_iris_", "_upper_lid_", "_lower_lid_")
    return sum("_pupil" in name for name in names) == 1 and all(
        any(part in name for name in names) for part in parts
    )

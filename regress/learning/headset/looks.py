"""Describes how a camera's training pictures look, person by person, for a model that is to judge others' pictures."""

import numpy as np

from facegen.conventions import VIEW_POINTS
from regress.learning.headset.arrays import HeadsetArrays
from regress.runtime.even_rows import even_rows
from regress.runtime.headset.answers.traced_eyes import eye_features
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.pictures.looks import CameraLooks, looks_of

_FEWEST = 50
"""Frames that show all of an eye, of which a map to its gaze is made."""

_PEOPLE = 200
"""Evenly chosen, of whom looks are measured: a hundredth of them are two."""


def camera_looks(
    arrays: HeadsetArrays, camera: str, rows: np.ndarray, points: tuple[str, ...]
) -> CameraLooks:
    """Looks of a camera's pictures over people.

    Parameters
    ----------
    rows
        Of the training.
    points
        Names of what the camera traces, in order.
    """
    people = np.unique(arrays.person[rows])
    chosen = people[even_rows(len(people), _PEOPLE)]
    takes = [looks_of(arrays.pictures[camera][rows[arrays.person[rows] == person]]) for person in chosen]

    def over_people(name: str) -> tuple[float, ...]:
        found = np.percentile([getattr(take, name) for take in takes], [1, 50, 99])
        return tuple(round(float(value), 4) for value in found)

    columns = [VIEW_POINTS.index(name) for name in points]
    shown = arrays.points[camera][rows][:, columns]
    # a point that no picture shows has no place; it is traced nowhere near the others either
    there = np.isfinite(shown).any(axis=(0, 2))
    usual = np.zeros((len(columns), 2))
    usual[there] = np.nanmean(shown[:, there], axis=0, dtype=np.float64)
    return CameraLooks(
        low=over_people("low"),
        high=over_people("high"),
        saturated=over_people("saturated"),
        sharpness=over_people("sharpness"),
        rim=over_people("rim"),
        points=tuple((round(float(x), 2), round(float(y), 2)) for x, y in usual),
        gaze=_gaze_map(shown, arrays.gaze[rows], points, usual),
    )


def _gaze_map(
    shown: np.ndarray, gaze: np.ndarray, points: tuple[str, ...], usual: np.ndarray
) -> tuple[tuple[float, ...], ...] | None:
    """Least squares from an eye's points (n, P, 2) to its gaze, of frames that show them all; None of no single eye."""
    if sum("_pupil" in name for name in points) != 1:
        return None
    eye = EyePoints.among(points, usual)
    if eye is None:
        return None
    there = np.isfinite(shown[:, eye.iris + eye.upper + eye.lower + [eye.pupil]]).all(axis=(1, 2))
    if there.sum() < _FEWEST:
        return None
    left = points[eye.pupil].startswith("left")
    angles = np.degrees(gaze[there][:, :2] if left else gaze[there][:, 2:])
    pupil, _ = eye_features(shown[there].astype(np.float64), eye)
    found = np.linalg.lstsq(np.column_stack([pupil, np.ones(len(pupil))]), angles, rcond=None)[0]
    return tuple(tuple(round(float(value), 3) for value in column) for column in found.T)

"""Reads from an eye's traced points how far its lids are open and where it looks, set right by what was looked at.

The unit of length is the iris, nearly the same in all people. Where the eye looks follows from where the pupil lies
between the eye's corners, by a linear map (`regress.runtime.headset.eyes.gaze_map`) that is of the mean person.
Targets that a person has looked at correct it for the person, camera and seat. The network's direct answer is corrected
alike, and both are fused by how far each is off at the targets: of a camera unlike the training's the direct one says
little. Where both eyes have a camera, their lines of sight meet in front (``regress.runtime.headset.eyes.vergence``).
"""

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.answers.eye_reader import HALF_SHUT, HIDDEN_DEG
from regress.runtime.headset.eyes.eye_corners import between_corners, calm_corners
from regress.runtime.headset.eyes.eye_points import EyePoints, traces_an_eye
from regress.runtime.headset.eyes.gaze_lead import led_take
from regress.runtime.headset.eyes.gaze_map import IRIS_MM, gaze_map
from regress.runtime.headset.eyes.glances import glances
from regress.runtime.headset.eyes.lid_ends import lid_ends_mm, usual_opening_mm
from regress.runtime.headset.eyes.own_gaze import FEWEST_TARGETS, own_gaze
from regress.runtime.headset.eyes.pupils import pupil_share
from regress.runtime.headset.eyes.vergence import meeting
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.recordings.footage import Footage
from regress.runtime.stages.frame_clock import FrameClock


@dataclass(frozen=True, kw_only=True)
class TracedEye:
    """What one camera's points say of an eye in n frames; NaN where the camera has no picture that counts.

    Parameters
    ----------
    openness_mm : (n,) float64
        Mean distance of the lids' margins.
    openness : (n,) float64
        As a share of the way from the person's own shut eye to the open one (`lid_ends_mm`). Where too few blinks were
        seen, 0 is lids that are traced upon each other, and a real shut eye reads about .5.
    pupil : (n,) float64
        Diameter of the pupil over that of the iris; NaN where it is hidden.
    gaze_deg : (n, 2) float64
        Yaw to the subject's left and pitch upwards.
    error_deg : (n,) float64
        Of the gaze: at the targets, and more where the eye is half shut.
    left_out
        Numbers of frames whose targets say nothing: the eye was shut then, or looked elsewhere.
    """

    openness_mm: np.ndarray
    openness: np.ndarray
    pupil: np.ndarray
    gaze_deg: np.ndarray
    error_deg: np.ndarray
    left_out: tuple[int, ...] = ()


def eye_features(points: np.ndarray, eye: EyePoints) -> tuple[np.ndarray, np.ndarray]:
    """Where the pupil lies between the eye's corners (n, 2), and the lids' distance (n,), both in irises.

    Parameters
    ----------
    points : (n, P, 2)
        Pixels of what the camera traces.
    """
    diameter = iris_diameter(points, eye)
    apart = np.linalg.norm(points[:, eye.upper] - points[:, eye.lower], axis=2).mean(axis=1)
    return (points[:, eye.pupil] - between_corners(points, eye)) / diameter, apart / diameter


def iris_diameter(points: np.ndarray, eye: EyePoints) -> float:
    """Of a take's points (n, P, 2), in pixels; NaN where no frame shows the eye."""
    iris = points[:, eye.iris]
    diameter = 2 * np.linalg.norm(iris - iris.mean(axis=1, keepdims=True), axis=2).mean(axis=1)
    # an iris whose half is hidden is traced too small; a take's own hardly changes
    return float(np.nanmedian(diameter)) if np.isfinite(diameter).any() else float("nan")


def calm_pupil(points: np.ndarray, eye: EyePoints, *, shut: np.ndarray, seconds: np.ndarray) -> np.ndarray:
    """Where the pupil lies (n, 2) in irises between the eye's corners as they were over about a second.

    Parameters
    ----------
    points : (n, P, 2)
        Pixels of what the camera traces in a take.
    shut : (n,) bool
        Frames whose lids are more shut than open.
    seconds : (n,)
        Since the frame before.
    """
    iris = iris_diameter(points, eye)
    corners = calm_corners(points, eye, iris=iris, shut=shut, seconds=seconds)
    return (points[:, eye.pupil] - corners) / iris


def traced_eyes(
    predictor: HeadsetPredictor,
    footage: Footage,
    targets: Mapping[int, tuple[float, float]] | None = None,
) -> dict[str, TracedEye]:
    """What each eye's camera of a take says, by camera.

    Parameters
    ----------
    targets
        Yaw and pitch in degrees of what was looked at, by the numbers of frames.

    Raises
    ------
    InputError
        Where no camera with pictures traces an eye, the model has no map from points to the gaze, or a target's frame
        is not in the take.
    """
    cameras = [name for name in footage.cameras if traces_an_eye(predictor, name)]
    cameras = [name for name in cameras if footage.present[:, footage.cameras.index(name)].any()]
    if not cameras:
        raise InputError("no camera that traces an eye has pictures, so nothing is said of eyes")
    for name in cameras:
        if gaze_map(predictor, name) is None:
            raise InputError(
                f"{name}: the model has no map from points to the gaze; train it with this version"
            )
    rows = _rows(footage, targets or {})
    clock = FrameClock()
    seconds = np.array([clock.step(sample.time_s) for sample in footage.samples()])
    # the clock's steps are bounded for filters, and a slow film's neighbours are no moment of a target's
    time_s = np.cumsum(seconds) if footage.time_s is None else np.asarray(footage.time_s, dtype=np.float64)
    targets_deg = np.array(list(rows.values())).reshape(-1, 2)
    pictures = {name: footage.pictures[name] for name in cameras}
    estimates, traced = predictor.graph.see(pictures, present=footage.present)
    direct = np.degrees(estimates.gaze.astype(np.float64))
    eyes = {}
    for name in cameras:
        points = traced[name].astype(np.float64)
        points[~footage.present[:, footage.cameras.index(name)]] = np.nan
        eye = EyePoints.of(predictor, name)
        _, apart = eye_features(points, eye)
        own_mm, shut_mm = lid_ends_mm(IRIS_MM * apart, time_s, usual_mm=usual_opening_mm(eye))
        openness = np.maximum((IRIS_MM * apart - shut_mm) / (own_mm - shut_mm), 0)
        pupil = calm_pupil(points, eye, shut=openness < HALF_SHUT, seconds=seconds)
        gaze = np.column_stack([pupil, np.ones(len(pupil))]) @ gaze_map(predictor, name).T
        answers = [gaze, direct[:, int(_is_right(predictor, name))]]
        if predictor.model.of_many_headsets:
            # of many headsets the map does not know what is straight ahead: the network's own answer stands alone, led
            # by points where they move farther
            answers.reverse()
            if len(rows) < FEWEST_TARGETS:
                pupil_seen = np.nan_to_num(np.clip(openness / HALF_SHUT, 0, 1))
                answers[0] = led_take(gaze, answers[0], seen=pupil_seen, seconds=seconds)
        looked = glances(answers, openness, time_s, list(rows))
        seen = np.flatnonzero(np.isfinite(looked).all(axis=(0, 2)))
        own = own_gaze([each[seen] for each in looked], targets_deg[seen])
        left_out = set(range(len(rows))) - set(seen.tolist()) | {int(seen[each]) for each in own.missed_deg}
        eyes[name] = TracedEye(
            openness_mm=IRIS_MM * apart,
            openness=openness,
            pupil=np.array(
                [
                    pupil_share(picture, at, eye)
                    for picture, at in zip(footage.pictures[name], points, strict=True)
                ]
            ),
            gaze_deg=own.apply(answers),
            error_deg=own.error_deg + HIDDEN_DEG * np.clip(1 - openness / HALF_SHUT, 0, 1),
            left_out=tuple(int(footage.numbers[list(rows)[place]]) for place in sorted(left_out)),
        )
    return _meeting(predictor, eyes)


def _meeting(predictor: HeadsetPredictor, eyes: dict[str, TracedEye]) -> dict[str, TracedEye]:
    """Both eyes looking at one place; one eye by itself as it is."""
    sides = sorted(eyes, key=lambda name: _is_right(predictor, name))
    if [_is_right(predictor, name) for name in sides] != [False, True]:
        return eyes
    gaze, error = (
        np.stack([getattr(eyes[name], part) for name in sides], axis=1) for part in ("gaze_deg", "error_deg")
    )
    met = meeting(gaze, error**2)
    return {name: replace(eyes[name], gaze_deg=met[:, sides.index(name)]) for name in eyes}


def eyes_csv(eyes: Mapping[str, TracedEye], numbers: Sequence[int]) -> str:
    """A row a frame; cells of absent cameras are empty."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    columns = ("openness_mm", "openness", "pupil", "yaw_deg", "pitch_deg")
    table.writerow(["frame", *(f"{name}.{column}" for name in eyes for column in columns)])
    for row, number in enumerate(numbers):
        values = [
            value
            for eye in eyes.values()
            for value in (eye.openness_mm[row], eye.openness[row], eye.pupil[row], *eye.gaze_deg[row])
        ]
        table.writerow([int(number), *("" if np.isnan(value) else f"{value:.3f}" for value in values)])
    return text.getvalue()


def _is_right(predictor: HeadsetPredictor, camera: str) -> bool:
    """Whether a camera traces the subject's right eye: the second of the network's gaze."""
    return any(name.startswith("right_pupil") for name in predictor.model.points[camera])


def _rows(footage: Footage, targets: Mapping[int, tuple[float, float]]) -> dict[int, tuple[float, float]]:
    known = {int(number): row for row, number in enumerate(footage.numbers)}
    for number in targets:
        if number not in known:
            first, last = footage.numbers[[0, -1]]
            raise InputError(
                f"--looked-at {number}: no frame of {footage.source} has this number ({first}-{last})"
            )
    return {known[number]: target for number, target in targets.items()}

"""Reads both eyes of a frame: lids, pupils and gaze, by what the network traces and says, and by what is known of the
person."""

from collections.abc import Mapping

import numpy as np

from regress.runtime.headset.eyes.eye_corners import EyeCorners, between_corners, calm_corners
from regress.runtime.headset.eyes.eye_points import EyePoints, traces_an_eye
from regress.runtime.headset.eyes.gaze_lead import GazeLead
from regress.runtime.headset.eyes.gaze_map import IRIS_MM, gaze_map
from regress.runtime.headset.eyes.iris_diameter import IrisDiameter, diameter_of, mean_length
from regress.runtime.headset.eyes.lid_ends import usual_opening_mm
from regress.runtime.headset.eyes.pupils import pupil_share
from regress.runtime.headset.eyes.vergence import meeting
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.person.person import OwnEye, Person
from regress.runtime.sample import EyeMeasures

HALF_SHUT = 0.5
"""Openness below which an eye's pupil is hidden in part: its gaze then follows the other eye's."""

_UNSEEN_DEG = 100.0
"""Of an eye that no camera sees now, the network guesses the gaze: one that is seen leads."""

HIDDEN_DEG = 20.0
"""Error of the gaze of an eye that is shut."""

_PUPIL_EVERY_S = 0.13
"""A pupil takes half a second to change, and measuring one 0.3 ms."""

_ROUNDING_S = 1e-6


class EyeReader:
    """Reads eyes frame by frame.

    Parameters
    ----------
    predictor
        The model; those of its cameras that trace an eye are read.
    person
        Whose own ends and gaze count; without, openness is against training's people, and gaze is the network's.

    Attributes
    ----------
    sides : dict of int
        Which eye each camera traces: 0 is the subject's left one.
    """

    def __init__(self, predictor: HeadsetPredictor, person: Person | None = None) -> None:
        looks = predictor.model.looks
        self._eyes = {
            name: EyePoints.of(predictor, name)
            for name in predictor.sizes
            if traces_an_eye(predictor, name) and name in looks
        }
        self._maps = {name: gaze_map(predictor, name) for name in self._eyes}
        self.sides = {
            name: int(any(point.startswith("right_pupil") for point in predictor.model.points[name]))
            for name in self._eyes
        }
        self._irises = {name: IrisDiameter() for name in self._eyes}
        self._corners = {name: EyeCorners() for name in self._eyes}
        self._leads = {name: GazeLead() for name in self._eyes}
        # the eyes' turns do not fall on one frame
        self._pupils = {name: _Pupil(first_s=side * _PUPIL_EVERY_S / 2) for name, side in self.sides.items()}
        self._usual = {
            name: OwnEye(shut_mm=0.0, rest_mm=usual_opening_mm(eye)) for name, eye in self._eyes.items()
        }
        self.use_person(person)

    def use_person(self, person: Person | None) -> None:
        """Count with what is known of a person from now on."""
        self._own = {} if person is None else dict(person.eyes)

    def hold_diameters(self, points: Mapping[str, np.ndarray]) -> None:
        """Take the irises for as large as in frames of open eyes (n, P, 2) by camera, whatever comes later."""
        for name in self._eyes.keys() & points.keys():
            self._irises[name].held = float(
                np.median([diameter_of(frame.astype(np.float64), self._eyes[name]) for frame in points[name]])
            )

    def read(
        self,
        seconds: float,
        pictures: Mapping[str, np.ndarray],
        points: Mapping[str, np.ndarray],
        gaze_rad: np.ndarray,
    ) -> tuple[EyeMeasures, np.ndarray]:
        """What is measured of the eyes, and their gaze (4,) in radians, as samples have it.

        Parameters
        ----------
        seconds
            Since the frame before.
        pictures : mapping of (h, w) uint8
            By camera, as the network sees them.
        points : mapping of (P, 2)
            Pixels of what it traces in them.
        gaze_rad : (4,)
            Its direct answer.
        """
        openness_mm, openness, pupil = np.full((3, 2), np.nan)
        direct = np.degrees(gaze_rad).reshape(2, 2)
        gaze_deg, variance = direct.copy(), np.full(2, _UNSEEN_DEG**2)
        for name, eye in self._eyes.items():
            if name not in points or name not in pictures:
                self._pupils[name].forget()
                self._corners[name].forget()
                continue
            side, seen = self.sides[name], points[name].astype(np.float64)
            own = self._own.get(name, OwnEye())
            apart_mm, open_to = self._learn(name, own, seconds, seen, direct[side])
            if self._pupils[name].due(seconds):
                self._pupils[name].share = pupil_share(pictures[name], seen, eye)
            hidden = np.clip(1 - open_to / HALF_SHUT, 0, 1) if np.isfinite(open_to) else 0.0
            error = own.error_deg**2 + (HIDDEN_DEG * hidden) ** 2
            if not error < variance[side]:
                continue  # another camera of this eye is surer
            openness_mm[side], openness[side], variance[side] = apart_mm, open_to, error
            pupil[side] = self._pupils[name].share
            gaze_deg[side] = self._own_gaze(name, own, seen, direct[side])
        met = meeting(gaze_deg[None], variance)[0]
        measured = EyeMeasures(openness_mm=openness_mm, openness=openness, pupil=pupil)
        return measured, np.radians(met).ravel()

    def led(
        self, seconds: float, points: Mapping[str, np.ndarray], gaze_rad: np.ndarray
    ) -> tuple[np.ndarray, float]:
        """Gaze (4,) in radians by the answer that leads of each eye, and how much traced points count at most.

        Nothing is measured, and eyes need not meet: where the network's own answer leads, it stays as it is.
        """
        gaze_deg, most = np.degrees(gaze_rad).reshape(2, 2), 0.0
        for name, seen in points.items():
            if name not in self._eyes:
                continue
            side, seen = self.sides[name], seen.astype(np.float64)
            direct = gaze_deg[side].copy()
            self._learn(name, OwnEye(), seconds, seen, direct)
            if self._leads[name].share:
                traced = self.traced_gaze(name, seen, self._corners[name].middle)
                gaze_deg[side] = self._leads[name].led(traced, direct)
                most = max(most, self._leads[name].share)
        return (np.radians(gaze_deg).ravel() if most else gaze_rad), most

    def _learn(
        self, name: str, own: OwnEye, seconds: float, seen: np.ndarray, direct_deg: np.ndarray
    ) -> tuple[float, float]:
        """Lids' distance of a frame's points (P, 2) in mm and as a share; iris, corners and lead are learnt of it."""
        eye = self._eyes[name]
        diameter = self._irises[name].step(seconds, diameter_of(seen, eye))
        apart_mm = IRIS_MM * _apart(seen, eye) / diameter
        known = own if own.rest_mm is not None and own.shut_mm is not None else self._usual[name]
        open_to = known.openness(apart_mm)
        shut = open_to < HALF_SHUT
        corners = self._corners[name].step(seconds, between_corners(seen, eye), iris=diameter, shut=shut)
        pupil = min(max(open_to / HALF_SHUT, 0.0), 1.0) if np.isfinite(open_to) else 1.0
        self._leads[name].step(seconds, self.traced_gaze(name, seen, corners), direct_deg, seen=pupil)
        return apart_mm, open_to

    def traced_gaze(self, camera: str, points: np.ndarray, corners: np.ndarray) -> np.ndarray:
        """Yaw and pitch (..., 2) in degrees of pupils of points (..., P, 2) between calm corners (..., 2).

        The iris is as large as in the frames that were read. NaN of models without such a map.
        """
        one = self._maps[camera]
        if one is None:
            return np.full(corners.shape, np.nan)
        pupil = (points[..., self._eyes[camera].pupil, :] - corners) / self._irises[camera].median
        return pupil @ one[:, :2].T + one[:, 2]

    def traced_take(
        self, camera: str, points: np.ndarray, *, shut: np.ndarray, seconds: np.ndarray
    ) -> np.ndarray:
        """The same (n, 2) of a take's points (n, P, 2) that was read, with the corners of the frames about each."""
        iris = self._irises[camera].median
        corners = calm_corners(points, self._eyes[camera], iris=iris, shut=shut, seconds=seconds)
        return self.traced_gaze(camera, points, corners)

    def _own_gaze(self, camera: str, own: OwnEye, points: np.ndarray, direct_deg: np.ndarray) -> np.ndarray:
        """Both answers (2,) in degrees, each set right, by their shares; where targets did not say, by which leads."""
        lead, traced = self._leads[camera], self.traced_gaze(camera, points, self._corners[camera].middle)
        if own.traced is None and own.direct is None:
            return lead.led(traced, direct_deg)
        traced_share = own.traced_share or lead.share
        answers, shares = [], []
        for answer, affine, share in (
            (traced, own.traced, traced_share),
            (direct_deg, own.direct, 1 - traced_share),
        ):
            if affine is not None and np.isfinite(answer).all():
                answers.append(np.array(affine) @ np.append(answer, 1.0))
                shares.append(share)
        return np.average(answers, axis=0, weights=shares) if sum(shares) > 0 else direct_deg


class _Pupil:
    """The share of a pupil of now, or of just now.

    Parameters
    ----------
    first_s
        How much of the time to the second measurement is over at the first one.
    """

    def __init__(self, *, first_s: float) -> None:
        self._first_s = first_s
        self.forget()

    def forget(self) -> None:
        """Measure the next frame's: the eye was not seen."""
        self.share, self._age_s = float("nan"), float("inf")

    def due(self, seconds: float) -> bool:
        """Whether the pupil of a frame is to be measured."""
        first = self._age_s == float("inf")
        self._age_s += seconds
        if not first and self._age_s < _PUPIL_EVERY_S - _ROUNDING_S:
            return False
        self._age_s = self._first_s if first else 0.0
        return True


def _apart(points: np.ndarray, eye: EyePoints) -> float:
    return mean_length(points[eye.upper] - points[eye.lower])

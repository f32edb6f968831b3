"""Makes a person's own ends of a guided minute: takes of rest and of named faces, as one network reads them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLINK_INDICES, EYE_LOOK_INDICES
from regress.errors import InputError
from regress.runtime.headset.answers.eye_reader import HALF_SHUT, EyeReader
from regress.runtime.headset.eyes.lid_ends import OWN_OPENNESS
from regress.runtime.headset.guided.gaze import gaze_centred, gaze_of_targets
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.person.person import (
    HIGHEST_KEPT,
    HIGHEST_REST,
    LEAST_SPAN,
    OwnEye,
    Person,
    kept_openness,
    packed_picture,
)
from regress.runtime.stages.frame_clock import USUAL_FPS

REST, LOOK = "rest", "look"

FACES: Mapping[str, tuple[str, ...]] = {
    REST: (),
    "shut": ("eyeBlinkLeft", "eyeBlinkRight"),
    "wide": ("eyeWideLeft", "eyeWideRight"),
    "jaw_open": ("jawOpen",),
    "lips_rolled": ("mouthRollUpper", "mouthRollLower"),
    "smile": ("mouthSmileLeft", "mouthSmileRight"),
    "cheeks": ("cheekPuff",),
    "brows_up": ("browInnerUp", "browOuterUpLeft", "browOuterUpRight"),
    "pucker": ("mouthPucker",),
    LOOK: (),
}
"""Faces of a guided minute, in the order of asking, and the shapes that are whole in each."""

_FULL = 0.6
"""Quantile of a take that is the full movement: people need a third of the time to get there."""

WAY_INTO_FACE = 1 / 3
"""Share of a take in which people get there: what is seen there is no full movement yet."""

_SHUT = 0.7
"""Of the lids' distance at rest, above which lids are not shut, or not seen."""

_MISREAD = 4
"""Shapes that a network reads high in a face at rest before cameras unlike the training's: as many were seen."""

_LEAST_REST = 0.005
"""Reading at rest below which a shape is left out of the file."""

_CLEARLY = 0.8
"""Share from which traced lids count: lids follow the gaze too, so where eyeBlink reads well they cost 3 % of accuracy.
"""

_LEAST_ERROR = 0.02
"""Of a blink in own units: what any reading is off by."""


@dataclass(frozen=True, kw_only=True, eq=False)
class GuidedTake:
    """Frames of one face.

    Parameters
    ----------
    pictures
        (n, h, w) uint8 by camera, as the network sees them.
    targets_deg
        Yaw and pitch of what was looked at from between the eyes, by frame.
    distance_m
        Of what was looked at: near targets turn both eyes inwards.
    fps
        Frames a second.
    """

    pictures: Mapping[str, np.ndarray]
    targets_deg: Mapping[int, tuple[float, float]]
    distance_m: float = np.inf
    fps: float = USUAL_FPS


@dataclass(frozen=True, kw_only=True, eq=False)
class Readings:
    """What a network says of a take's frames: weights (n, 52), openness (n, 2) in mm and as a share of the take's own,
    answers (n, 2) of each eye."""

    weights: np.ndarray
    openness_mm: np.ndarray
    openness: np.ndarray
    traced_deg: Mapping[str, np.ndarray]
    direct_deg: Mapping[str, np.ndarray]


def person_of(
    predictor: HeadsetPredictor,
    takes: Mapping[str, GuidedTake],
    *,
    unlevelled: Mapping[str, np.ndarray] | None = None,
) -> tuple[Person, tuple[str, ...]]:
    """A person's own ends, and a sentence for each face that said nothing.

    Parameters
    ----------
    takes
        By `FACES`; ``rest`` is needed.
    unlevelled
        Pictures of ``rest`` as they were before levels were set, for the neutral ones of the file; the take's own
        without.

    Raises
    ------
    InputError
        Where there is no ``rest``, or the face was not at rest.
    """
    looks = {BLENDSHAPES[index] for index in EYE_LOOK_INDICES}
    if REST not in takes:
        raise InputError(f"--{REST} is needed: other faces are told by how they differ from it")
    reader = EyeReader(predictor)
    # of shut eyes no iris is seen
    reader.hold_diameters(predictor.see(takes[REST].pictures)[1])
    row = neutral_row(predictor, takes[REST].pictures)
    neutral = None
    if predictor.model.calibration != "none":
        neutral = {name: frames[row] for name, frames in takes[REST].pictures.items()}
    readings = {face: _read(predictor, reader, take, neutral) for face, take in takes.items()}
    at_rest = np.median(readings[REST].weights, axis=0)
    # where somebody looks at rest is theirs
    strange = _strange(
        {name: value for name, value in zip(BLENDSHAPES, at_rest, strict=True) if name not in looks}
    )
    full, notes = _full(readings, at_rest)
    notes += strange
    eyes = {}
    for camera, side in reader.sides.items():
        if camera in takes[REST].pictures:
            eyes[camera] = _own_eye(camera, side, readings, takes, notes)
    kept = takes[REST].pictures if unlevelled is None else unlevelled
    person = Person(
        network_sha256=predictor.model.network_sha256,
        rest={
            name: round(float(min(value, HIGHEST_KEPT)), 4)
            for name, value in zip(BLENDSHAPES, at_rest, strict=True)
            if value >= _LEAST_REST and name not in looks
        },
        full=full,
        eyes=eyes,
        neutral={} if neutral is None else {name: packed_picture(kept[name][row]) for name in neutral},
    )
    return person, tuple(notes)


def _strange(at_rest: Mapping[str, float]) -> list[str]:
    """A sentence for each shape that reads high in a face at rest: a network may take a face for one that it makes.

    Raises
    ------
    InputError
        Where these are more than `_MISREAD`, eyes are shut, or one is above `HIGHEST_KEPT`: then nobody was at rest,
        or rest would still show.
    """
    high = sorted((name for name, value in at_rest.items() if value > HIGHEST_REST), key=at_rest.get)[::-1]
    shut = any(BLENDSHAPE_INDEX[name] in BLINK_INDICES for name in high)
    if len(high) > _MISREAD or shut or (high and at_rest[high[0]] > HIGHEST_KEPT):
        worst = high[0]
        raise InputError(
            f"--{REST}: {worst} reads {at_rest[worst]:.2f} there; at most {HIGHEST_REST} is a resting face"
        )
    return [
        f"{REST}: the network reads {name} {at_rest[name]:.2f} there, where {HIGHEST_REST} is high; it counts as rest"
        for name in high
    ]


def neutral_row(predictor: HeadsetPredictor, pictures: Mapping[str, np.ndarray]) -> int:
    """The frame that is nearest to the median of all: a mean of pictures would be blurred."""
    weights = predictor.predict(pictures).weights
    return int(np.argmin(np.abs(weights - np.median(weights, axis=0)).sum(axis=1)))


def _read(
    predictor: HeadsetPredictor,
    reader: EyeReader,
    take: GuidedTake,
    neutral: Mapping[str, np.ndarray] | None,
) -> Readings:
    estimates, traced = predictor.see(take.pictures, neutral=neutral)
    count = len(estimates.weights)
    openness_mm = np.empty((count, 2))
    for row in range(count):
        points = {name: pixels[row] for name, pixels in traced.items()}
        frame = {name: frames[row] for name, frames in take.pictures.items()}
        openness_mm[row] = reader.read(0.0, frame, points, estimates.gaze[row].ravel())[0].openness_mm
    seen = np.isfinite(openness_mm).any(axis=0)
    openness = np.full((count, 2), np.nan)
    openness[:, seen] = openness_mm[:, seen] / np.nanpercentile(openness_mm[:, seen], OWN_OPENNESS, axis=0)
    found = {
        name: reader.traced_take(
            name,
            traced[name].astype(np.float64),
            shut=openness[:, side] < HALF_SHUT,
            seconds=np.full(count, 1 / take.fps),
        )
        for name, side in reader.sides.items()
        if name in traced
    }
    direct = np.degrees(estimates.gaze.astype(np.float64))
    return Readings(
        weights=estimates.weights.astype(np.float64),
        openness_mm=openness_mm,
        openness=openness,
        traced_deg=found,
        direct_deg={name: direct[:, reader.sides[name]] for name in found},
    )


def _full(readings: Mapping[str, Readings], at_rest: np.ndarray) -> tuple[dict[str, float], list[str]]:
    """Readings of full movements by shape, and sentences on those that the network does not see."""
    full, notes = {}, []
    for face, shapes in FACES.items():
        if face not in readings:
            continue
        top = np.quantile(readings[face].weights, _FULL, axis=0)
        for name in shapes:
            column = BLENDSHAPE_INDEX[name]
            if top[column] - at_rest[column] < LEAST_SPAN:
                notes.append(
                    f"{face}: the network reads {name} {top[column]:.2f} there and {at_rest[column]:.2f} at rest; its "
                    f"range stays as it is"
                )
            else:
                full[name] = round(float(min(top[column], 1.0)), 4)
    return full, notes


def _own_eye(
    camera: str,
    side: int,
    readings: Mapping[str, Readings],
    takes: Mapping[str, GuidedTake],
    notes: list[str],
) -> OwnEye:
    def lids(face: str) -> float | None:
        if face not in readings or not np.isfinite(readings[face].openness_mm[:, side]).any():
            return None
        return kept_openness(np.nanmedian(readings[face].openness_mm[:, side]))

    shut, rest, wide = map(lids, ("shut", REST, "wide"))
    looked = LOOK in takes and camera in readings[LOOK].traced_deg
    if rest is None:
        shut = None
    elif shut is not None and shut > _SHUT * rest:
        notes.append(
            f"shut: {camera} traces lids {shut:.1f} mm apart there and {rest:.1f} at rest: they say nothing"
        )
        shut = None
    gaze = {}
    if looked:
        reading, take = readings[LOOK], takes[LOOK]
        answers = {"traced": reading.traced_deg[camera], "direct": reading.direct_deg[camera]}
        # of models without a map from points to the gaze no points say anything of it
        answers = {name: each for name, each in answers.items() if np.isfinite(each).any()}
        if take.targets_deg:
            gaze, said = gaze_of_targets(
                camera,
                side,
                answers,
                reading.openness[:, side],
                take.targets_deg,
                distance_m=take.distance_m,
                fps=take.fps,
            )
            notes += said
        else:
            gaze = gaze_centred(answers)
    return OwnEye(
        shut_mm=shut,
        rest_mm=rest,
        wide_mm=wide,
        lids=0.0 if shut is None else _lids_share(side, readings, shut, rest),
        **gaze,
    )


def _lids_share(side: int, readings: Mapping[str, Readings], shut_mm: float, rest_mm: float) -> float:
    """How much traced lids count against eyeBlink: the inverse of the squares of what each is off, in own units."""
    column = BLINK_INDICES[side]
    still = [face for face in (REST, LOOK) if face in readings]
    blink_rest = float(np.median(readings[REST].weights[:, column]))
    blink_span = float(np.median(readings["shut"].weights[:, column])) - blink_rest
    if blink_span < LEAST_SPAN:
        return 1.0

    def squares(shut: Sequence[float], open_: Sequence[float]) -> float:
        values = [(np.clip(shut, 0, 1) - 1) ** 2, np.clip(open_, 0, 1) ** 2]
        return sum(float(np.mean(each)) for each in values) + _LEAST_ERROR**2

    def blinks(face: str) -> np.ndarray:
        return (readings[face].weights[:, column] - blink_rest) / blink_span

    def by_lids(face: str) -> np.ndarray:
        gaps = readings[face].openness_mm[:, side]
        return (rest_mm - gaps[np.isfinite(gaps)]) / (rest_mm - shut_mm)

    off_blink, off_lids = (
        squares(of("shut"), np.concatenate([of(face) for face in still])) for of in (blinks, by_lids)
    )
    share = off_blink / (off_blink + off_lids)
    return round(share, 4) if share > _CLEARLY else 0.0

"""Judges whether a headset's unlabelled frames are such as a model was trained on, camera by camera, in sentences."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from regress.errors import InputError
from regress.runtime.even_rows import even_rows
from regress.runtime.headset.eyes.eye_points import EyePoints, traces_an_eye
from regress.runtime.headset.fitness.both_eyes import told_apart
from regress.runtime.headset.fitness.camera_fitness import CameraFitness
from regress.runtime.headset.fitness.misfits import Misfit, few, light_findings
from regress.runtime.headset.fitness.misplacement import lost, place_findings, quarters, turned
from regress.runtime.headset.fitness.shape import RecordedShape, two_views, without_bars
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.pictures.looks import MEASURED_FRAMES, looks_of
from regress.runtime.headset.pictures.picture_file import fit_picture, has_shape_of, whole_of_shape
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.placing.found_placement import FoundPlacement
from regress.runtime.headset.placing.mouth_points import MouthPoints
from regress.runtime.headset.placing.orientation import told_orientation
from regress.runtime.headset.placing.placement_search import CALM_MOUTH, find_placement
from regress.runtime.headset.recordings.footage import Footage

FEWEST_FRAMES = 20
"""Of a camera's usable frames: fewer show neither how the light changes nor where the eye usually is."""

_PLACES = frozenset((Misfit.MIRRORED, Misfit.UPSIDE_DOWN, Misfit.SIDEWAYS, Misfit.PLACED, Misfit.LOST))
"""What a placement makes good."""

_STRETCHED = 0.65
"""What the score of narrow pictures stretched has to be of that as they come. Shrunk to half of their width, two films
of real eyes, a real mouth and rendered ones of two headsets have .25 to .64, cut to .56 of their width .69 to 3.8."""

_FOLLOWED, _CHOSEN = 300, 300
"""Frames from a take's first one on, by which flicker is seen, and others all over it: a minute of three cameras of
1280 x 800 would take tens of gigabytes."""


def checked_rows(count: int) -> np.ndarray:
    """Which of a take's frames are judged."""
    return np.union1d(np.arange(min(count, _FOLLOWED)), even_rows(count, _CHOSEN))


def judge(predictor: HeadsetPredictor, footage: Mapping[str, np.ndarray]) -> list[CameraFitness]:
    """Judge each camera's frames (n, h, w) uint8, in the order of time and of any size.

    Raises
    ------
    InputError
        Where the model does not say how its training looked, or all cameras have too few frames.
    """
    for name in footage:
        if name not in predictor.model.looks:
            raise InputError(
                f"the model does not say how the pictures of {name} looked in training; train it with this version"
            )
    fewer = {name: pictures for name, pictures in footage.items() if len(pictures) < FEWEST_FRAMES}
    shapes = {name: without_bars(pictures) for name, pictures in footage.items() if name not in fewer}
    enough = {name: shape.pictures for name, shape in shapes.items()}
    found = {name: few(name, len(pictures), FEWEST_FRAMES) for name, pictures in fewer.items()}
    if not enough:
        raise InputError("; ".join(one.sentence for one in found.values()))
    told = _told_by_typical(predictor, enough)
    judged = [_judge_camera(predictor, name, shape, told.get(name)) for name, shape in shapes.items()]
    judged = {one.camera: one for one in told_apart(judged, enough)}
    for name, finding in found.items():
        judged[name] = CameraFitness(
            camera=name, looks=None, found=None, placement=CameraPlacement(), findings=(finding,)
        )
    return [judged[name] for name in footage]


def _judge_camera(
    predictor: HeadsetPredictor, name: str, shape: RecordedShape, told: str | None
) -> CameraFitness:
    known = predictor.model.looks[name]
    mouth = MouthPoints.of(predictor, name)
    views = [] if mouth is None else list(two_views(name, shape.pictures))
    traces = (mouth is not None and not views) or traces_an_eye(predictor, name)
    shape, found = _found(predictor, name, shape) if traces else (shape, None)
    pictures = shape.pictures
    width, height = predictor.sizes[name]
    size = (pictures.shape[2], pictures.shape[1])
    # as `predict` takes them that nobody placed
    whole = replace(whole_view(size, (width, height)), aspect=None)
    placement = whole if found is None else found.placement
    measured = pictures[even_rows(len(pictures), MEASURED_FRAMES)]
    looks = looks_of(np.stack([placement.view(one, width=width, height=height) for one in measured]))
    # what lies outside of the picture is repeated and moves with its edge: a rim and the lamps are seen in all of it
    seen = looks_of(pictures)
    looks = replace(looks, rim=seen.rim, flicker=seen.flicker, saturated=seen.saturated)
    findings = [*views, *shape.findings(name), *light_findings(name, looks, known)]
    if found is not None:
        points = mouth or EyePoints.of(predictor, name)
        # a rim that training did not have makes mean pictures look like anything
        rimmed = any(one.misfit is Misfit.RIM for one in findings)
        # and of a mouth, moved by a fifth, as of a turned one; the search itself sees which way it stands
        turns_only = mouth is not None and not found.lost and "its own" in (told or "")
        sure = mouth is not None and found.unrest < CALM_MOUTH and not found.lost
        told = None if rimmed or sure or turns_only else told
        findings += place_findings(name, placement, points, picture=size, view=(width, height), told=told)
        if found.lost:
            findings.append(lost(name, "eye" if mouth is None else "mouth"))
    elif told is not None and not views:
        findings.append(turned(name, told))
    misfits = {one.misfit for one in findings}
    if mouth is not None and not misfits & {Misfit.PLACED, Misfit.LOST}:
        placement = replace(whole, roll_deg=90.0 * quarters(placement))
    elif has_shape_of(size, (width, height)) and not misfits & _PLACES:
        # within what people of the training differ by: a network that knows them gains nothing by being moved
        placement = whole
    return CameraFitness(
        camera=name,
        looks=looks,
        found=found,
        placement=shape.of_recorded(placement),
        findings=tuple(findings),
    )


def _found(
    predictor: HeadsetPredictor, name: str, shape: RecordedShape
) -> tuple[RecordedShape, FoundPlacement]:
    """Where the eye or the mouth is found, in pictures as they are or, of narrow ones, stretched where it is surer."""
    found = find_placement(predictor, name, shape.pictures)
    if not shape.may_be_shrunk(predictor.sizes[name]):
        return shape, found
    wide = shape.stretched()
    other = find_placement(predictor, name, wide.pictures)
    surer = other.score < _STRETCHED * found.score and (found.lost or not other.lost)
    return (wide, other) if surer else (shape, found)


def _told_by_typical(predictor: HeadsetPredictor, footage: Mapping[str, np.ndarray]) -> dict[str, str]:
    """What mean pictures say: of an eye whose pictures have the model's shape, of others of any usual shape.

    An eye in pictures of another shape seldom lies where it did in training.
    """
    scaled = {}
    for name, pictures in footage.items():
        width, height = predictor.sizes[name]
        size = (pictures.shape[2], pictures.shape[1])
        placement = None if traces_an_eye(predictor, name) else whole_of_shape(size, (width, height))
        if placement is not None or has_shape_of(size, (width, height)):
            seen = [fit_picture(one, width=width, height=height, placement=placement) for one in pictures]
            scaled[name] = np.stack([one.picture for one in seen])
    if not scaled:
        return {}
    count = min(map(len, scaled.values()))
    blank = {
        name: np.zeros((count, height, width), np.uint8) for name, (width, height) in predictor.sizes.items()
    }
    lined_up = Footage(
        cameras=tuple(predictor.sizes),
        numbers=np.arange(count),
        pictures=blank | {name: pictures[:count] for name, pictures in scaled.items()},
        faults={name: (None if name in scaled else Fault.MISSING,) * count for name in predictor.sizes},
        time_s=None,
        source="",
        notes=(),
    )
    lines = told_orientation(lined_up, predictor.typical)
    return {line.split(":")[0]: line.split(": ", 1)[1] for line in lines}

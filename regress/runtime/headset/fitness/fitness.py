"""Judges whether a headset's unlabelled frames are such as a model was trained on, camera by camera, in sentences."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regress.errors import InputError
from regress.runtime.even_rows import even_rows
from regress.runtime.headset.eyes.eye_points import EyePoints, traces_an_eye
from regress.runtime.headset.fitness.misfits import Finding, Misfit, few, light_findings
from regress.runtime.headset.fitness.misplacement import lost, place_findings, quarters, turned
from regress.runtime.headset.network.parts import mirror_partner
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.pictures.looks import MEASURED_FRAMES, TakeLooks, looks_of
from regress.runtime.headset.pictures.picture_file import fit_picture, has_shape_of, whole_of_shape
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.placing.found_placement import FoundPlacement
from regress.runtime.headset.placing.mouth_points import MouthPoints
from regress.runtime.headset.placing.orientation import told_orientation
from regress.runtime.headset.placing.placement_search import CALM_MOUTH, find_placement
from regress.runtime.headset.recordings.footage import Footage

FEWEST_FRAMES = 20
"""Of a camera's usable frames: fewer show neither how the light changes nor where the eye usually is."""

_SAME_PICTURES = 0.97
"""Correlation over pixels and frames from which two cameras show one picture."""

_COMPARED, _COMPARED_PX = 32, 160
"""Frames that are compared for it, and pixels of their longer side: all of a minute's take tens of gigabytes."""

_BOTH = 1.8
"""Width over height from which a picture may be two, side by side."""

_PLACES = frozenset((Misfit.MIRRORED, Misfit.UPSIDE_DOWN, Misfit.SIDEWAYS, Misfit.PLACED, Misfit.LOST))
"""What a placement makes good."""


_FOLLOWED, _CHOSEN = 300, 300
"""Frames from a take's first one on, by which flicker is seen, and others all over it: a minute of three cameras of
1280 x 800 would take tens of gigabytes."""


@dataclass(frozen=True, kw_only=True)
class CameraFitness:
    """How a camera's frames fit.

    Parameters
    ----------
    camera
        Its name.
    looks
        Of its frames where the network looks, levels as they are; None of too few.
    found
        Where the network finds the eye or the mouth; None where it traces neither, or in too few frames.
    placement
        What `predict` should take, levels included.
    findings
        What is wrong; none where the frames fit.
    """

    camera: str
    looks: TakeLooks | None
    found: FoundPlacement | None
    placement: CameraPlacement
    findings: tuple[Finding, ...]


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
    enough = {name: pictures for name, pictures in footage.items() if name not in fewer}
    found = {name: few(name, len(pictures), FEWEST_FRAMES) for name, pictures in fewer.items()}
    if not enough:
        raise InputError("; ".join(one.sentence for one in found.values()))
    told = _told_by_typical(predictor, enough)
    judged = [_judge_camera(predictor, name, pictures, told.get(name)) for name, pictures in enough.items()]
    judged = {one.camera: one for one in _told_apart(judged, enough)}
    for name, finding in found.items():
        judged[name] = CameraFitness(
            camera=name, looks=None, found=None, placement=CameraPlacement(), findings=(finding,)
        )
    return [judged[name] for name in footage]


def _judge_camera(
    predictor: HeadsetPredictor, name: str, pictures: np.ndarray, told: str | None
) -> CameraFitness:
    known = predictor.model.looks[name]
    mouth = MouthPoints.of(predictor, name)
    traces = mouth is not None or traces_an_eye(predictor, name)
    found = find_placement(predictor, name, pictures) if traces else None
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
    findings = [*light_findings(name, looks, known)]
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
    elif told is not None:
        findings.append(turned(name, told))
    misfits = {one.misfit for one in findings}
    if mouth is not None and not misfits & {Misfit.PLACED, Misfit.LOST}:
        placement = replace(whole, roll_deg=90.0 * quarters(placement))
    elif has_shape_of(size, (width, height)) and not misfits & _PLACES:
        # within what people of the training differ by: a network that knows them gains nothing by being moved
        placement = whole
    return CameraFitness(camera=name, looks=looks, found=found, placement=placement, findings=tuple(findings))


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


def _told_apart(judged: list[CameraFitness], footage: Mapping[str, np.ndarray]) -> list[CameraFitness]:
    """Findings of eyes of which both are wrong in the same way, in words for both."""
    by_name = {one.camera: one for one in judged}
    for name, one in list(by_name.items()):
        partner = mirror_partner(name)
        if partner not in by_name or partner <= name:
            continue
        other = by_name[partner]
        same = _are_the_same(footage[name], footage[partner])
        both = all(any(f.misfit is Misfit.MIRRORED for f in each.findings) for each in (one, other))
        if same or both:
            misfit = Misfit.OTHER if same else Misfit.EXCHANGED
            text = (
                _same_eye(name, partner, footage[name])
                if same
                else f"{name} and {partner} are exchanged, or both mirrored; exchange their paths, or take --placement "
                "where the pictures are mirrored: of exchanged cables it would turn gaze to the wrong side"
            )
            for each in (one, other):
                kept = [f for f in each.findings if f.misfit is not Misfit.MIRRORED]
                by_name[each.camera] = replace(
                    each, findings=(Finding(camera=each.camera, misfit=misfit, sentence=text), *kept)
                )
    return list(by_name.values())


def _same_eye(name: str, partner: str, pictures: np.ndarray) -> str:
    height, width = pictures.shape[1:]
    if width >= _BOTH * height:
        return (
            f"{name} and {partner} show the same wide picture: if it has both eyes side by side, put #left behind one "
            "path and #right behind the other"
        )
    return f"{name} and {partner} show the same eye: one is of the other eye; check the paths and the cables"


def _small(pictures: np.ndarray) -> np.ndarray:
    import cv2

    width, height = (
        max(1, round(side * _COMPARED_PX / max(pictures.shape[1:]))) for side in pictures.shape[:0:-1]
    )
    small = [cv2.resize(one, (width, height), interpolation=cv2.INTER_AREA) for one in pictures]
    return np.stack(small).astype(np.float64).ravel()


def _are_the_same(one: np.ndarray, other: np.ndarray) -> bool:
    if one.shape[1:] != other.shape[1:]:
        return False
    # of the same moments, and small: eyes of one face look alike, and the same pictures are the same at any size
    chosen = even_rows(min(len(one), len(other)), _COMPARED)
    first, second = (_small(stack[chosen]) for stack in (one, other))
    if first.std() == 0 or second.std() == 0:
        return False
    return float(np.corrcoef(first, second)[0, 1]) > _SAME_PICTURES

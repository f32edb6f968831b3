"""Judges whether a headset's unlabelled frames are such as a model was trained on, camera by camera, in sentences."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regress.errors import InputError
from regress.runtime.even_rows import even_rows
from regress.runtime.headset.eye_points import EyePoints, traces_an_eye
from regress.runtime.headset.faults import Fault
from regress.runtime.headset.footage import Footage
from regress.runtime.headset.found_placement import FoundPlacement
from regress.runtime.headset.looks import MEASURED_FRAMES, TakeLooks, looks_of
from regress.runtime.headset.misfits import Finding, Misfit, light_findings, lost, place_findings, turned
from regress.runtime.headset.orientation import told_orientation
from regress.runtime.headset.parts import mirror_partner
from regress.runtime.headset.pictures import has_shape_of
from regress.runtime.headset.placement import CameraPlacement
from regress.runtime.headset.placement_search import find_placement
from regress.runtime.headset.predictor import HeadsetPredictor

FEWEST_FRAMES = 20
"""Of a camera's usable frames: fewer show neither how the light changes nor where the eye usually is."""

_SAME_PICTURES = 0.97
"""Correlation over pixels and frames from which two cameras show one picture."""

_COMPARED, _COMPARED_PX = 32, 160
"""Frames that are compared for it, and pixels of their longer side: all of a minute's take tens of gigabytes."""

_BOTH = 1.8
"""Width over height from which a picture may be two, side by side."""

_PLACES = (Misfit.MIRRORED, Misfit.UPSIDE_DOWN, Misfit.SIDEWAYS, Misfit.PLACED, Misfit.LOST)
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
        Of its frames where the network looks, levels as they are.
    found
        Where the network finds the eye; None where it does not trace one, as in a mouth's picture.
    placement
        What `predict` should take, levels included.
    findings
        What is wrong; none where the frames fit.
    """

    camera: str
    looks: TakeLooks
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
        Where the model does not say how its training looked, or a camera has too few frames.
    """
    for name, pictures in footage.items():
        if name not in predictor.model.looks:
            raise InputError(
                f"the model does not say how the pictures of {name} looked in training; train it with this version"
            )
        if len(pictures) < FEWEST_FRAMES:
            usable = f"{len(pictures)} usable frame{'' if len(pictures) == 1 else 's'}"
            raise InputError(f"{name} has {usable}; at least {FEWEST_FRAMES} are needed, best 100-300")
    told = _told_by_typical(predictor, footage)
    judged = [_judge_camera(predictor, name, pictures, told.get(name)) for name, pictures in footage.items()]
    return _told_apart(judged, footage)


def _judge_camera(
    predictor: HeadsetPredictor, name: str, pictures: np.ndarray, told: str | None
) -> CameraFitness:
    known = predictor.model.looks[name]
    found = find_placement(predictor, name, pictures) if traces_an_eye(predictor, name) else None
    placement = CameraPlacement() if found is None else found.placement
    width, height = predictor.sizes[name]
    measured = pictures[even_rows(len(pictures), MEASURED_FRAMES)]
    looks = looks_of(np.stack([placement.view(one, width=width, height=height) for one in measured]))
    # what lies outside of the picture is repeated and moves with its edge: a rim and the lamps are seen in all of it
    whole = looks_of(pictures)
    looks = replace(looks, rim=whole.rim, flicker=whole.flicker, saturated=whole.saturated)
    findings = [*light_findings(name, looks, known)]
    if found is not None:
        points = EyePoints.of(predictor, name)
        size = (pictures.shape[2], pictures.shape[1])
        # a rim that training did not have makes mean pictures look like anything
        rimmed = any(one.misfit is Misfit.RIM for one in findings)
        told = None if rimmed else told
        findings += place_findings(name, placement, points, picture=size, view=(width, height), told=told)
        if found.lost:
            findings.append(lost(name))
    elif told is not None:
        findings.append(turned(name, told))
    misplaced = any(one.misfit in _PLACES for one in findings)
    if has_shape_of((pictures.shape[2], pictures.shape[1]), (width, height)) and not misplaced:
        # within what people of the training differ by: a network that knows them gains nothing by being moved
        placement = CameraPlacement()
    return CameraFitness(camera=name, looks=looks, found=found, placement=placement, findings=tuple(findings))


def _told_by_typical(predictor: HeadsetPredictor, footage: Mapping[str, np.ndarray]) -> dict[str, str]:
    """What mean pictures say of cameras whose pictures have the model's shape."""
    import cv2

    scaled = {
        name: np.stack(
            [cv2.resize(one, predictor.sizes[name], interpolation=cv2.INTER_AREA) for one in pictures]
        )
        for name, pictures in footage.items()
        if pictures.shape[2] * predictor.sizes[name][1] == pictures.shape[1] * predictor.sizes[name][0]
    }
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

"""Judges whether a headset's unlabelled frames are such as a model was trained on, camera by camera, in sentences."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.eye_points import EyePoints, traces_an_eye
from regress.runtime.headset.faults import Fault
from regress.runtime.headset.footage import Footage
from regress.runtime.headset.looks import CameraLooks, TakeLooks, looks_of
from regress.runtime.headset.orientation import told_orientation
from regress.runtime.headset.parts import mirror_partner
from regress.runtime.headset.pictures import ASPECT
from regress.runtime.headset.placement import CameraPlacement
from regress.runtime.headset.placement_search import FoundPlacement, find_placement
from regress.runtime.headset.predictor import HeadsetPredictor

FEWEST_FRAMES = 20
"""Of a camera's usable frames: fewer show neither how the light changes nor where the eye usually is."""

_DARKER = 0.75
"""Of the darkest training's bright level: down to that, stretched levels lose nothing but grain."""

_CLIPPED = 0.01
"""Share of saturated pixels from which skin has lost its shape: glints alone have a tenth of it."""

_SOFTER = 0.85
"""Of the softest training's sharpness."""

_RIM = 0.08
"""Share of the picture by which a dark rim is larger than any in training."""

_FLICKER = 0.03
"""Change of light from frame to frame: a steady lamp's is a hundredth or less (60 clips of 60 people)."""

_SIZE, _SHIFT, _ROLL_DEG = 0.25, 0.18, 10.0
"""Of a placement, from which frames are worth placing (log of the size, share of the view's width): in training people
differ by .09 and .067, standard deviations."""

_SAME_PICTURES = 0.97
"""Correlation over pixels and frames from which two cameras show one picture."""

_BROW = 0.5
"""Share of the brow's points that lie outside of the picture, from which it counts as cropped."""


class Misfit(Enum):
    """What is wrong with a camera's frames; the value is what a person calls it."""

    DARK = "too dark"
    BRIGHT = "too bright"
    CLIPPED = "clipped"
    SOFT = "soft"
    MIRRORED = "mirrored, or of the other eye"
    UPSIDE_DOWN = "upside down"
    EXCHANGED = "exchanged"
    OTHER = "of the other eye"
    TURNED = "turned or mixed up"
    BROW = "cropped at the brow"
    RIM = "in a lens circle"
    FLICKER = "flickering"
    PLACED = "elsewhere"
    LOST = "not found"


_PLACES = (Misfit.MIRRORED, Misfit.UPSIDE_DOWN, Misfit.PLACED, Misfit.LOST)
"""What a placement makes good."""


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One thing that is wrong with a camera's frames, and what to do about it in a sentence."""

    camera: str
    misfit: Misfit
    sentence: str


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
            raise InputError(
                f"{name} has {len(pictures)} usable frames; at least {FEWEST_FRAMES} are needed, best 100-300"
            )
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
    looks = looks_of(np.stack([placement.view(one, width=width, height=height) for one in pictures]))
    # what lies outside of the picture is repeated and moves with its edge: a rim and the lamps are seen in all of it
    whole = looks_of(pictures)
    looks = replace(looks, rim=whole.rim, flicker=whole.flicker, saturated=whole.saturated)
    findings = [
        Finding(camera=name, misfit=misfit, sentence=text) for misfit, text in _of_light(name, looks, known)
    ]
    if found is not None:
        points = EyePoints.of(predictor, name)
        size = (pictures.shape[2], pictures.shape[1])
        # a rim that training did not have makes mean pictures look like anything
        rimmed = any(one.misfit is Misfit.RIM for one in findings)
        told = None if rimmed else told
        texts = _of_place(name, placement, points, picture=size, view=(width, height), told=told)
        findings += [Finding(camera=name, misfit=misfit, sentence=text) for misfit, text in texts]
        if found.lost:
            findings.append(Finding(camera=name, misfit=Misfit.LOST, sentence=_lost_words(name)))
    elif told is not None:
        findings.append(
            Finding(camera=name, misfit=Misfit.TURNED, sentence=f"{name} is turned or mixed up: {told}")
        )
    misplaced = any(one.misfit in _PLACES for one in findings)
    same_shape = abs(pictures.shape[2] * height / (pictures.shape[1] * width) - 1) <= ASPECT
    if same_shape and not misplaced:
        # within what people of the training differ by: a network that knows them gains nothing by being moved
        placement = CameraPlacement()
    if not (known.low[0] <= looks.low <= known.low[2] and known.high[0] <= looks.high <= known.high[2]):
        placement = replace(placement, low=looks.low, high=max(looks.high, looks.low + 1))
    return CameraFitness(camera=name, looks=looks, found=found, placement=placement, findings=tuple(findings))


def _of_light(name: str, looks: TakeLooks, known: CameraLooks) -> Iterator[tuple[Misfit, str]]:
    if looks.high < _DARKER * known.high[0]:
        factor = known.high[1] / max(looks.high, 1)
        yield (
            Misfit.DARK,
            f"{name} is too dark: its bright levels are about {looks.high:.0f}, training's {known.high[0]:.0f} to "
            f"{known.high[2]:.0f}; expose {factor:.1f} times as long, or multiply sensor.exposure in the headset's "
            f"TOML by {1 / factor:.2f} and render anew",
        )
    elif looks.low > known.low[2] + 40:
        yield (
            Misfit.BRIGHT,
            f"{name} is too bright: its dark levels are about {looks.low:.0f}, training's {known.low[0]:.0f} to "
            f"{known.low[2]:.0f}; lower the camera's gain or black level (sensor.black_level in the headset's TOML)",
        )
    if looks.saturated > max(_CLIPPED, 3 * known.saturated[2]):
        yield (
            Misfit.CLIPPED,
            f"{name} is clipped: {100 * looks.saturated:.0f} % of its pixels are saturated, training's at most "
            f"{100 * known.saturated[2]:.1f} %; expose less, or dim the lamp that is nearest to the skin",
        )
    if looks.sharpness < _SOFTER * known.sharpness[0]:
        yield (
            Misfit.SOFT,
            f"{name} is soft: its detail is {looks.sharpness:.3f} of its contrast, training's "
            f"{known.sharpness[0]:.3f} to {known.sharpness[2]:.3f}; focus or clean the lens, or compress less",
        )
    if looks.rim > known.rim[2] + _RIM:
        yield (
            Misfit.RIM,
            f"{name} is seen in a lens circle: a dark rim covers {100 * looks.rim:.0f} % of its picture, training's "
            f"{100 * known.rim[0]:.0f} to {100 * known.rim[2]:.0f} %; move the camera nearer to the lens's middle, or "
            f"set lens.aperture_radius of this camera in the headset's TOML",
        )
    if looks.flicker > _FLICKER:
        yield (
            Misfit.FLICKER,
            f"{name} is flickering: its light changes by {100 * looks.flicker:.0f} % from frame to frame; run the "
            f"lamps with direct current, or expose for whole periods of them",
        )


def _of_place(
    name: str,
    placement: CameraPlacement,
    points: EyePoints,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
    told: str | None,
) -> Iterator[tuple[Misfit, str]]:
    upside_down = abs(placement.roll_deg) > 135
    if upside_down:
        yield (
            Misfit.UPSIDE_DOWN,
            f"{name} is upside down; turn the camera, or take --placement, which turns it",
        )
    if placement.mirror:
        yield (
            Misfit.MIRRORED,
            f"{name} is mirrored, or of the other eye; check which camera is which, or take --placement, which mirrors "
            f"it",
        )
    if told is not None and not (upside_down or placement.mirror):
        yield Misfit.TURNED, f"{name} is turned or mixed up: {told}"
    matrix = placement.picture_from_view(picture, view)
    brow = points.usual[points.brow] @ matrix[:, :2].T + matrix[:, 2]
    outside = ((brow < -0.5) | (brow > np.array(picture) - 0.5)).any(axis=1)
    inside_of_view = ((points.usual[points.brow] > 0) & (points.usual[points.brow] < view)).all(axis=1)
    if points.brow and outside[inside_of_view].mean() >= _BROW:
        yield (
            Misfit.BROW,
            f"{name} is cropped at the brow: {outside.sum()} of its {len(outside)} points lie outside, so its "
            f"shapes are guesses; tilt the camera up, or widen its view",
        )
    roll_deg = placement.roll_deg - np.sign(placement.roll_deg) * 180 if upside_down else placement.roll_deg
    across, down = placement.x - 0.5, (placement.y - 0.5) * picture[1] / picture[0]
    if (
        abs(np.log(placement.size)) > _SIZE
        or np.hypot(across, down) > _SHIFT * placement.size
        or abs(roll_deg) > _ROLL_DEG
    ):
        yield (
            Misfit.PLACED,
            f"{name} shows the eye elsewhere: {placement.size:.2f} times as large as in training, the view's middle at "
            f"{100 * placement.x:.0f} % of the width and {100 * placement.y:.0f} % of the height, turned by "
            f"{roll_deg:.0f}°; take --placement, or render for this camera: multiply its fx and fy in the headset's "
            f"TOML by {placement.size:.2f} and move its target there",
        )


def _lost_words(name: str) -> str:
    return (
        f"{name}: the eye is not found: wherever the model looks, it traces one farther out; the placement is "
        f"the whole picture: look at --sheet, write x, y and size into --out by hand, or try another model"
    )


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
                f"{name} and {partner} show the same eye: one is of the other eye; check the paths and the cables"
                if same
                else f"{name} and {partner} are exchanged, or both mirrored; exchange their paths, or take --placement"
            )
            for each in (one, other):
                kept = [f for f in each.findings if f.misfit is not Misfit.MIRRORED]
                by_name[each.camera] = replace(
                    each, findings=(Finding(camera=each.camera, misfit=misfit, sentence=text), *kept)
                )
    return list(by_name.values())


def _are_the_same(one: np.ndarray, other: np.ndarray) -> bool:
    if one.shape[1:] != other.shape[1:]:
        return False
    count = min(len(one), len(other))
    first, second = (stack[:count].astype(np.float32).ravel() for stack in (one, other))
    if first.std() == 0 or second.std() == 0:
        return False
    return float(np.corrcoef(first, second)[0, 1]) > _SAME_PICTURES

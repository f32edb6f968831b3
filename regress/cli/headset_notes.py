"""What `regress headset predict` refuses or says of a model, its footage and how the answers came about."""

from collections.abc import Iterator, Mapping
from pathlib import Path

from facegen.console import say
from regress.errors import InputError
from regress.runtime.headset.answers.points import check_points
from regress.runtime.headset.answers.traced_eyes import TracedEye
from regress.runtime.headset.network.parts import mirror_partner
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.network.temporal import TAPS
from regress.runtime.headset.pictures.looks import levels_of
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.compass import eye_compass
from regress.runtime.headset.placing.orientation import told_by_compass, told_orientation
from regress.runtime.headset.recordings.footage import Footage

_SAME_RATE = 0.05
"""Relative difference of frame rates that --temporal does not speak of: 29.97 are 30."""


def check_model(
    predictor: HeadsetPredictor, folder: Path, *, trust: Path | None, points: Path | None
) -> None:
    """Refuse tables that the model cannot fill."""
    if trust is not None and not predictor.model.scores:
        raise InputError(f"{folder} has no scores on a test split, from which confidence is made")
    if points is not None:
        check_points(predictor)


def same_path_notes(paths: Mapping[str, Path]) -> Iterator[str]:
    """A sentence for each pair of eyes' cameras that have one path."""
    for name, path in paths.items():
        partner = mirror_partner(name)
        if name < partner and paths.get(partner) == path:
            yield (
                f"{name} and {partner} have the same path, {path}: where its pictures show both eyes, put #left behind "
                f"one and #right behind the other; where they show one, its gaze and lids stand for both"
            )


def tell_of(footage: Footage, predictor: HeadsetPredictor, *, strict: bool) -> None:
    """Say what is wrong with pictures and how they look; where ``strict``, a fault is an error."""
    if strict and not footage.present[:, footage.recorded].all():
        raise InputError(f"{'; '.join(footage.notes)}; without --strict the other cameras' pictures count")
    # a network of many headsets has no mean picture that says how an eye lies
    many = predictor.model.of_many_headsets
    turned = told_by_compass(footage, eye_compass()) if many else told_orientation(footage, predictor.typical)
    for note in (*footage.notes, *turned):
        say(note)


def level_notes(
    footage: Footage, predictor: HeadsetPredictor, placement: Mapping[str, CameraPlacement]
) -> Iterator[str]:
    """A sentence for each camera whose grey levels are none that people had in training, or are held by a placement."""
    there = dict(zip(footage.cameras, footage.present.T, strict=True))
    for name, known in predictor.model.looks.items():
        if name not in there or not there[name].any():
            continue
        held = placement.get(name)
        if held is not None and held.low is not None:
            yield (
                f"{name}: its placement holds the grey levels {held.low:.0f} to {held.high:.0f}, also where the light "
                "changes; without low and high there each picture is levelled by its own brightness"
            )
            continue
        low, high = levels_of(footage.pictures[name][there[name]])
        if not (known.low[0] <= low <= known.low[2] and known.high[0] <= high <= known.high[2]):
            yield (
                f"{name}: its grey levels are {low:.0f} to {high:.0f}, and become {known.low[1]:.0f} to "
                f"{known.high[1]:.0f}, as in training"
            )


def target_notes(eyes: Mapping[str, TracedEye]) -> Iterator[str]:
    """A sentence for each target that says nothing of an eye."""
    for name, eye in eyes.items():
        for number in eye.left_out:
            yield f"--looked-at {number}: {name} was shut or looked elsewhere there; the target is left out"


def seat_notes(reseated: tuple[str, ...], *, keep_neutral: bool) -> Iterator[str]:
    """A sentence for each frame from which the headset sits otherwise."""
    worth = "less well calibrated" if keep_neutral else "not calibrated (--keep-neutral for the same person)"
    for frame in reseated:
        yield (
            f"frame {frame}: the headset does not sit as in the neutral pictures; weights are {worth} "
            f"from here on, until a --neutral frame of the new seat"
        )


def rate_note(taps_fps: float, footage_fps: float | None) -> Iterator[str]:
    """A sentence where the taps are for another rate than the recording's."""
    if footage_fps is not None and abs(footage_fps / taps_fps - 1) > _SAME_RATE:
        yield (
            f"--temporal: the model's taps are for {taps_fps:g} frames a second and the take has {footage_fps:.4g}; "
            f"they reach {1000 * (TAPS - 1) / footage_fps:.0f} ms back in place of {1000 * (TAPS - 1) / taps_fps:.0f}"
        )

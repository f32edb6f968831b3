"""Reads what `regress headset check` judges, and places a take's cameras as it would (`predict --placement auto`)."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from facegen.console import say
from regress.runtime.headset.fitness.fitness import FEWEST_FRAMES, checked_rows, judge
from regress.runtime.headset.fitness.misfits import Misfit
from regress.runtime.headset.fitness.shape import without_bars
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.pictures.faults import fault_sentences
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.recordings.recorded_paths import recorded_size
from regress.runtime.headset.recordings.recording import read_recording

_UNSURE = {
    Misfit.LOST,
    Misfit.TURNED,
    Misfit.MIRRORED,
    Misfit.EXCHANGED,
    Misfit.OTHER,
    Misfit.VIEWS,
    Misfit.NOSE,
}
"""What a person has to look at: of exchanged cables a placement would turn the gaze to the wrong side."""

_SET_RIGHT = {Misfit.UPSIDE_DOWN, Misfit.SIDEWAYS, Misfit.PLACED, Misfit.BARS, Misfit.SHRUNK}
"""What a placement that is taken sets right: to advise it would be too late."""


def checked_footage(paths: Mapping[str, Path], *, bits: int | None) -> dict[str, np.ndarray]:
    """Sound pictures (n, h, w) uint8 of each camera, as recorded, of those rows that are judged; faults are said."""
    footage = {}
    for name, path in paths.items():
        width, height = recorded_size(path)
        recording = read_recording(
            path, name, width=width, height=height, bits=bits, choose=checked_rows, as_recorded=True
        )
        noted = [recording.note] if recording.film and recording.note else []
        for note in (*noted, *fault_sentences(name, recording.numbers, recording.faults)):
            say(note)
        sound = np.array([fault is None for fault in recording.faults])
        footage[name] = recording.pictures if sound.all() else recording.pictures[sound]
    return footage


def recorded_aspect(pictures: np.ndarray) -> float:
    """Width over height of pictures (n, h, w)."""
    return pictures.shape[2] / pictures.shape[1]


def placed_by_search(
    predictor: HeadsetPredictor, paths: Mapping[str, Path], *, bits: int | None
) -> dict[str, CameraPlacement]:
    """What `regress headset check` finds of each camera in which an eye or a mouth is surely found; it is said."""
    footage = checked_footage(paths, bits=bits)
    enough = {
        name: pictures
        for name, pictures in footage.items()
        if name in predictor.model.looks and len(pictures) >= FEWEST_FRAMES
    }
    for name in footage.keys() - enough.keys():
        say(
            f"{name}: --placement auto has too few frames or too old a model to look for a place; "
            f"{_seen_unplaced(footage[name])}"
        )
    placements = {}
    for one in judge(predictor, enough) if enough else ():
        unsure = one.found is None or bool(_UNSURE & {finding.misfit for finding in one.findings})
        for finding in one.findings:
            if unsure or finding.misfit not in _SET_RIGHT:
                say(finding.sentence)
        if unsure:
            say(
                f"{one.camera}: --placement auto is not sure of a place, and "
                f"{_seen_unplaced(footage[one.camera])}"
            )
            continue
        placed = placements[one.camera] = replace(one.placement, aspect=recorded_aspect(footage[one.camera]))
        left = " of what its bars leave" if any(placed.cut) else ""
        stretched = f", its pixels {placed.stretch:g} times as wide as high" if placed.stretch != 1 else ""
        say(
            f"{one.camera}: placed at {100 * placed.x:.0f} % of the width and {100 * placed.y:.0f} % of the height"
            f"{left}{stretched}, size {placed.size:.2f}, turned by {placed.roll_deg:.0f}°; `regress headset check "
            f"--sheet` shows it"
        )
    return placements


def _seen_unplaced(pictures: np.ndarray) -> str:
    """What is seen of pictures (n, h, w) that nobody places, in words."""
    return f"all of each picture{' but its bars' if any(without_bars(pictures).cut) else ''} is seen"

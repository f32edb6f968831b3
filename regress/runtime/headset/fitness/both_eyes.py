"""Says of both eyes' cameras together what is wrong with both: exchanged, or of one and the same picture."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from regress.runtime.even_rows import even_rows
from regress.runtime.headset.fitness.camera_fitness import CameraFitness
from regress.runtime.headset.fitness.misfits import Finding, Misfit
from regress.runtime.headset.network.parts import mirror_partner

_SAME_PICTURES = 0.97
"""Correlation over pixels and frames from which two cameras show one picture."""

_COMPARED, _COMPARED_PX = 32, 160
"""Frames that are compared for it, and pixels of their longer side: all of a minute's take tens of gigabytes."""

_BOTH = 1.7
"""Width over height from which a picture may be two, side by side: those of 640 x 360 have 1.78."""


def told_apart(judged: list[CameraFitness], footage: Mapping[str, np.ndarray]) -> list[CameraFitness]:
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
            "path and #right behind the other; if it has one eye, a path or a cable is of the other camera"
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

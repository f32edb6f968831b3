"""Knows how detectors that people use put their points: a table of offsets and noise, each with its source."""

import json
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from importlib import resources

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from regress.errors import InputError
from regress.learning.training.noise import DetectorNoise, draw_bias
from regress.learning.training.recipes import Recipe

_MEAN_TO_RMS = 2 / np.sqrt(np.pi)
"""Root mean square of a distance in the plane over its mean, where both coordinates are normal (Rayleigh)."""


@dataclass(frozen=True, kw_only=True)
class Detector:
    """How far a detector's points lie from those of the dataset, by group, in outer-eye distances.

    Parameters
    ----------
    staying
        Root mean square of what stays on a face.
    passing
        Of what comes and goes with expressions and turns of the head: smooth along contours, and slow, so two frames a
        second apart have nothing of it in common.
    """

    staying: dict[str, float]
    passing: dict[str, float]


@lru_cache
def detectors() -> dict[str, Detector]:
    """Those of the table whose distance from other points was measured, by name.

    A distance has three parts: what all faces share, and of the rest, which differs from frame to frame and face to
    face, what stays on a face and what passes. How the rest divides was not measured: each gets half of its variance.
    """
    text = (resources.files("regress") / "data" / "detectors.json").read_text(encoding="utf-8")
    table = json.loads(text)["detectors"]
    return {name: _detector(entry) for name, entry in table.items() if "distance" in entry}


def _detector(entry: dict) -> Detector:
    staying, passing = {}, {}
    for group in LANDMARK_GROUPS:
        whole, rest = (_MEAN_TO_RMS * entry[part][group] for part in ("distance", "rest"))
        staying[group] = float(np.sqrt(whole**2 - rest**2 / 2))
        passing[group] = float(rest / np.sqrt(2))
    return Detector(staying=staying, passing=passing)


@dataclass(frozen=True, kw_only=True)
class KnownDetector(DetectorNoise):
    """Displaces faces as one detector of the table does; ``bias`` and ``drift`` are 1 where it is as measured.

    Parameters
    ----------
    detector
        Its name.
    """

    detector: str

    def draw_bias_offsets(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """What stays on each of ``count`` faces (count, 68, 2)."""
        return self.bias * draw_bias(rng, count, apart=detectors()[self.detector].staying)

    def draw_drift_offsets(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """What one frame of each has besides jitter (count, 68, 2)."""
        return self.drift * draw_bias(rng, count, apart=detectors()[self.detector].passing)


def noise_of(record: dict) -> DetectorNoise:
    """The noise that a model's record tells of."""
    return KnownDetector(**record) if "detector" in record else DetectorNoise(**record)


def detector_noise(name: str) -> KnownDetector:
    """Offsets as one detector was measured to have, those that stay and those that pass, and a tracked face's jitter.

    Raises
    ------
    InputError
        Where the table has no such detector.
    """
    _check_known(name)
    return KnownDetector(bias=1.0, drift=1.0, jitter=0.001, clean=0.0, detector=name)


def _check_known(name: str) -> None:
    if name not in detectors():
        raise InputError(f"--detector is {name!r}, but must be one of {', '.join(detectors())}")


def for_detector(recipe: Recipe, name: str) -> Recipe:
    """A recipe whose training rows are displaced as one detector displaces points; its jitter stays.

    Raises
    ------
    InputError
        Where the table has no such detector, or the recipe displaces no rows.
    """
    _check_known(name)
    if recipe.noise is None or recipe.calibrated_noise is None:
        raise InputError(
            f"--detector {name} needs a recipe that learns from displaced points, and {recipe.name!r} does not"
        )
    return replace(
        recipe, noise=_known(recipe.noise, name), calibrated_noise=_known(recipe.calibrated_noise, name)
    )


def _known(noise: DetectorNoise, name: str) -> KnownDetector:
    return KnownDetector(**{**asdict(noise), "bias": 1.0, "drift": 1.0, "detector": name})

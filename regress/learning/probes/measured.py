"""Runs all probes of one model on one dataset."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from regress.errors import InputError
from regress.learning.probes.crosstalk import CrossTalk, cross_talk
from regress.learning.probes.examples import Example, examples
from regress.learning.probes.faces import read_faces
from regress.learning.probes.methods import networks_of, ridges_of
from regress.learning.probes.movements import movements
from regress.learning.probes.observability import NOISE_PERCENT, Observability, observability
from regress.learning.probes.people import PersonErrors, person_errors
from regress.learning.probes.poses import PITCH_DEG, YAW_DEG, PoseErrors, pose_errors
from regress.learning.probes.stillness import JITTER_PERCENT, Stillness, stillness
from regress.learning.probes.winks import Winks, winks
from regress.learning.training import read_dataset
from regress.runtime.model import Model
from regress.targets import OUTPUTS


@dataclass(frozen=True, kw_only=True)
class Measured:
    """What the probes found; of the networks alone and, where a model has them, of those beside a neutral frame.

    Parameters
    ----------
    faces, people : int
        Of the test split: faces with an expression, and people.
    pose_spread_deg : (2,) float64
        Standard deviation of yaw and pitch over the training faces.
    movement_residual_m : float or None
        See :class:`regress.learning.probes.movements.Movements`; None where the dataset has no neutral faces.
    observability : tuple of Observability
        Networks first, then the ridge regressions.
    poses : tuple of PoseErrors
    people_errors : tuple of PersonErrors
    cross_talk : tuple of CrossTalk
    winks : tuple of Winks
        Both empty where the dataset has no neutral faces.
    stillness : tuple of Stillness
    examples : tuple of Example
    """

    faces: int
    people: int
    pose_spread_deg: np.ndarray
    movement_residual_m: float | None
    observability: tuple[Observability, ...]
    poses: tuple[PoseErrors, ...]
    people_errors: tuple[PersonErrors, ...]
    cross_talk: tuple[CrossTalk, ...]
    winks: tuple[Winks, ...]
    stillness: tuple[Stillness, ...]
    examples: tuple[Example, ...]


def measure(model: Model, folder: Path) -> Measured:
    """Probe a model on the test people of the dataset that it was trained on; equal inputs give equal figures.

    Raises
    ------
    InputError
        Where the dataset is another than the model's, or lacks a column.
    """
    dataset = read_dataset(folder)
    expected = None if model.record is None else model.record.dataset.keypoints_sha256
    if dataset.sha256 != expected:
        raise InputError(
            f"{folder} holds keypoints with SHA-256 {dataset.sha256}, and the model was trained on "
            f"{expected}; give the dataset that it was trained on, whose test faces it has not seen"
        )
    everyone = read_faces(folder)
    seen = everyone.take(np.flatnonzero(everyone.split == "train"))
    networks = networks_of(model)
    if dataset.has_neutral_frames:
        faces, neutral = everyone.beside_neutral("test")
        _, first = np.unique(neutral.person, return_index=True)
        people = neutral.take(first)
        moves = movements(*everyone.beside_neutral("train"))
    else:  # then the model has no networks that would look at a neutral frame
        faces = neutral = everyone.take(np.flatnonzero(everyone.split == "test"))
        people = moves = None
    return Measured(
        faces=len(faces.person),
        people=len(np.unique(faces.person)),
        pose_spread_deg=np.array([angle.std() for angle in seen.pose_deg]),
        movement_residual_m=None if moves is None else moves.residual_m,
        observability=observability((*networks, *ridges_of(model, dataset)), faces, neutral),
        poses=pose_errors(networks, faces, neutral),
        people_errors=tuple(person_errors(method, faces, neutral) for method in networks),
        cross_talk=() if moves is None else tuple(cross_talk(method, people, moves) for method in networks),
        winks=() if moves is None else tuple(winks(method, faces, neutral) for method in networks),
        stillness=tuple(stillness(method, faces, neutral, people) for method in networks),
        examples=examples(networks, faces, neutral),
    )


def figures_of(measured: Measured) -> dict[str, Any]:
    """All figures unrounded as JSON data, with the axes that arrays run over; None where a figure is undefined."""
    poses = [
        {
            **dataclasses.asdict(errors),
            **{name: getattr(errors, name) for name in ("frontal_r2", "turned_r2", "loss", "mae_rise")},
        }
        for errors in measured.poses
    ]
    return _plain(
        {
            "shapes": OUTPUTS,
            "noise_percent": NOISE_PERCENT,
            "yaw_deg": YAW_DEG,
            "pitch_deg": PITCH_DEG,
            "jitter_percent": JITTER_PERCENT,
            **dataclasses.asdict(measured),
            "poses": poses,
        }
    )


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value

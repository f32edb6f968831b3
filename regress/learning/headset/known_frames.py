"""Says which weights of a guided minute's frames are known: rest is none, what was asked for is whole."""

from collections.abc import Mapping

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.errors import InputError
from regress.learning.headset.adaptation import KnownFrames
from regress.runtime.headset.guided.minute import FACES, LOOK, REST, WAY_INTO_FACE, GuidedTake, neutral_row
from regress.runtime.headset.network.predictor import HeadsetPredictor

STRETCHES = 8
"""Of time, into which frames with a table of weights are parted to be held out."""

_MOST_OF_FACE, _MOST_OF_TAKE = 8, 240
"""Frames that count, evenly chosen: those that follow one another are nearly the same, and time grows as the cube."""

_UPPER, _LOWER = (
    [number for number, name in enumerate(BLENDSHAPES) if name.startswith(stems)]
    for stems in (("eyeBlink", "eyeWide", "brow"), ("jaw", "mouth", "cheekPuff", "tongue"))
)
_LOOKS = [number for number, name in enumerate(BLENDSHAPES) if name.startswith("eyeLook")]


def known_frames(
    predictor: HeadsetPredictor,
    takes: Mapping[str, GuidedTake],
    labelled: tuple[Mapping[str, np.ndarray], np.ndarray] | None = None,
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray] | None, KnownFrames]:
    """Pictures (n, h, w) by camera, neutral ones of each frame, and what is known of the frames.

    A face of the brows and lids leaves the mouth alone, and the other way round.

    Parameters
    ----------
    labelled
        Pictures by camera, and their weights (m, 52), NaN where they are not known.

    Raises
    ------
    InputError
        Where there is no rest, or too little to hold anything out.
    """
    if REST not in takes:
        raise InputError("--rest is needed: frames are compared with it")
    stacks = [
        _thinned(takes[face].pictures, _MOST_OF_FACE, first=0.0 if face == REST else WAY_INTO_FACE)[0]
        for face in takes
        if face != LOOK
    ]
    faces = [face for face in takes if face != LOOK]
    parts = [_of_face(face, shown) for face, shown in zip(faces, stacks, strict=True)]
    if labelled is not None:
        pictures, chosen = _thinned(labelled[0], _MOST_OF_TAKE)
        weights = labelled[1][chosen]
        stretch = np.arange(len(weights)) * STRETCHES // max(len(weights), 1)
        parts.append((np.nan_to_num(weights), np.isfinite(weights), stretch))
        stacks.append(pictures)
    if len({name for shown in stacks for name in shown}) > min(map(len, stacks)):
        raise InputError("faces and take are of different cameras; give the same ones of all")
    folds, first = [], 0
    for _, _, fold in parts:
        folds.append(fold + first)
        first += int(fold.max()) + 1
    if first < 3:
        raise InputError(
            "one or two faces cannot be adapted to: the others have to say whether it was any good"
        )
    frames = KnownFrames(
        weights=np.concatenate([part[0] for part in parts]),
        known=np.concatenate([part[1] for part in parts]),
        fold=np.concatenate(folds),
    )
    pictures = {name: np.concatenate([shown[name] for shown in stacks]) for name in stacks[0]}
    if predictor.model.calibration == "none":
        return pictures, None, frames
    row = neutral_row(predictor, takes[REST].pictures)
    count = len(frames.fold)
    neutral = {name: np.repeat(one[[row]], count, axis=0) for name, one in takes[REST].pictures.items()}
    return pictures, neutral, frames


def _thinned(
    pictures: Mapping[str, np.ndarray], most: int, *, first: float = 0.0
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Pictures of as many frames at most, and which ones; none of the ``first`` share."""
    count = len(next(iter(pictures.values())))
    start = int(first * count)
    chosen = np.unique(np.linspace(start, count - 1, min(count - start, most)).round().astype(int))
    return {name: frames[chosen] for name, frames in pictures.items()}, chosen


def _of_face(face: str, pictures: Mapping[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    count = len(next(iter(pictures.values())))
    weights, known = np.zeros((count, len(BLENDSHAPES))), np.zeros((count, len(BLENDSHAPES)), dtype=bool)
    asked = [BLENDSHAPE_INDEX[name] for name in FACES[face]]
    if face == REST:
        known[:] = True
    else:
        known[:, _LOWER if asked[0] in _UPPER else _UPPER] = True
    weights[:, asked], known[:, asked] = 1.0, True
    known[:, _LOOKS] = False
    return weights, known, np.zeros(count, dtype=int)

"""Reads the takes of a guided minute: a folder for each face, or frames of one take of them all."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facegen.formats.film import FILMS
from regress.errors import InputError

if TYPE_CHECKING:
    from regress.runtime.headset.guided.minute import GuidedTake
    from regress.runtime.headset.network.predictor import HeadsetPredictor
    from regress.runtime.headset.pictures.placement import CameraPlacement
    from regress.runtime.headset.recordings.footage import Footage

_RANGE = re.compile(r"(\d{1,18})-(\d{1,18})")


_LABELLED = "labelled"
"""Beside the faces: frames with a table of weights."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Minute:
    """A guided minute's frames.

    Parameters
    ----------
    takes
        By face, at the levels of training.
    unlevelled
        Pictures (n, h, w) by camera of the face at rest, as they were before; empty without it.
    notes
        What is wrong with cameras and pictures, a sentence each.
    labels
        Pictures by camera, levelled, and weights (m, 52) of frames of the take with a table of weights; NaN of shapes
        that it has not.
    places
        Through which cameras were looked at.
    """

    takes: "dict[str, GuidedTake]"
    unlevelled: dict[str, np.ndarray]
    notes: tuple[str, ...]
    labels: tuple[dict[str, np.ndarray], np.ndarray] | None = None
    places: "dict[str, CameraPlacement]" = field(default_factory=dict)


def read_minute(
    predictor: "HeadsetPredictor",
    given: Sequence[str | None],
    camera: Sequence[str],
    short: Mapping[str, Path | None],
    *,
    looked_at: Sequence[str] = (),
    distance_m: float = float("inf"),
    from_start: bool = False,
    fps: float | None = None,
    bits: int | None = None,
    placement: Path | None = None,
    labels: Path | None = None,
) -> Minute:
    """Frames of each face in which every given camera has a picture.

    Parameters
    ----------
    given
        What the options of `FACES` say, in their order: a folder, or ``FIRST-LAST`` of the take.
    camera, short
        The take: ``NAME=PATH`` of its cameras, and paths by the names that have an option of their own.
    looked_at
        ``FRAME:YAW:PITCH`` of frames of ``look``.
    distance_m
        Of what was looked at there.
    from_start, fps
        Whether cameras' first frames are matched, and their rate, which goes before that of films.
    placement
        TOML with the cameras' places.
    labels
        CSV with weights of frames of the take.

    Raises
    ------
    InputError
        Where a face's frames cannot be read, or there are none.
    """
    from regress.cli.headset_input import camera_paths, read_footage, targets_of
    from regress.runtime.headset.guided.minute import FACES, LOOK, REST, GuidedTake
    from regress.runtime.headset.placing.levels import levels_in
    from regress.runtime.headset.placing.placement_file import read_placement
    from regress.runtime.stages.frame_clock import USUAL_FPS

    named = {face: text for face, text in zip(FACES, given, strict=False) if text is not None}
    paths = camera_paths(predictor, camera, {name: path for name, path in short.items() if path is not None})
    places = {} if placement is None else read_placement(placement, predictor.model)

    def read(cameras: dict[str, Path]) -> "Footage":
        return read_footage(
            predictor, None, cameras, from_start=from_start, fps=fps, bits=bits, placement=places
        )

    targets = targets_of(looked_at)
    if targets and LOOK not in named:
        raise InputError("--looked-at is for frames of --look; give --look too")
    whole = read(paths) if paths else None
    notes, pictures, numbers = list(whole.notes) if whole is not None else [], {}, {}
    rates = {}
    for face, text in named.items():
        option = f"--{face.replace('_', '-')}"
        span = _RANGE.fullmatch(text)
        if span and whole is not None:
            footage = whole
            chosen = _within(whole.numbers, int(span[1]), int(span[2]), f"{option} {text}")
        else:
            footage = read(_cameras_in(Path(text), predictor, option))
            chosen = np.ones(len(footage.numbers), dtype=bool)
            notes += [f"{text}: {note}" for note in footage.notes]
        chosen &= footage.present[:, footage.given].all(axis=1)
        if not chosen.any():
            raise InputError(f"{option} {text}: no frame there has a picture of every camera")
        pictures[face] = {name: frames[chosen] for name, frames in _given(footage).items()}
        rates[face] = fps or footage.fps or USUAL_FPS
        numbers[face] = {int(number): row for row, number in enumerate(footage.numbers[chosen])}
    known = None
    if labels is not None:
        if whole is None:
            raise InputError(
                f"--weights {labels} is of frames of a take; give it by --left-eye and the others"
            )
        rows, known = _labels(labels, whole)
        pictures[_LABELLED] = {name: frames[rows] for name, frames in _given(whole).items()}
    levels = {}
    for name, looks in predictor.model.looks.items():
        seen = [frames[name] for frames in pictures.values() if name in frames]
        if seen:
            levels[name] = levels_in(seen, looks, places.get(name))
    lost = [frame for frame in targets if frame not in numbers[LOOK]]
    if lost:
        raise InputError(
            f"--looked-at {lost[0]}: no frame of --look has this number and a picture of every camera"
        )
    takes = {
        face: GuidedTake(
            pictures={
                name: levels[name].apply(frames) if name in levels else frames
                for name, frames in shown.items()
            },
            targets_deg={numbers[LOOK][frame]: angles for frame, angles in targets.items()}
            if face == LOOK
            else {},
            distance_m=distance_m,
            fps=rates.get(face, USUAL_FPS),
        )
        for face, shown in pictures.items()
    }
    labelled = takes.pop(_LABELLED, None)
    return Minute(
        takes=takes,
        unlevelled=pictures.get(REST, {}),
        notes=tuple(dict.fromkeys(notes)),
        labels=None if labelled is None else (dict(labelled.pictures), known),
        places=places,
    )


def _within(numbers: np.ndarray, first: int, last: int, option: str) -> np.ndarray:
    """Which frames of a take lie between two that it has."""
    if first > last:
        raise InputError(f"{option}: {first}-{last} runs backwards; write {last}-{first}")
    if not (numbers.min() <= first and last <= numbers.max()):
        raise InputError(f"{option}: the take has frames {numbers.min()}-{numbers.max()}")
    return (numbers >= first) & (numbers <= last)


def _given(footage: "Footage") -> dict[str, np.ndarray]:
    """Pictures of cameras that have any."""
    return {
        name: footage.pictures[name]
        for name, there in zip(footage.cameras, footage.given, strict=True)
        if there
    }


def _labels(path: Path, footage: "Footage") -> tuple[np.ndarray, np.ndarray]:
    """Rows of the footage that a table of weights speaks of and that have all pictures, and their weights (m, 52)."""
    from facegen.conventions import BLENDSHAPES
    from facegen.formats.csv_rows import CsvRows, numbers_in

    found = {}
    with CsvRows(path) as table:
        shapes = [name for name in BLENDSHAPES if name in table.columns]
        if "frame" not in table.columns or not shapes:
            raise InputError(f"--weights {path}: a column frame and columns of ARKit's names are needed")
        columns = [table.columns[name] for name in ("frame", *shapes)]
        for row in table:
            try:
                number, *values = numbers_in(row, columns)
            except ValueError as error:
                raise InputError(f"--weights {path}: a cell is not a number ({error})") from error
            if np.isfinite([number, *values]).all() and min(values) >= 0 and max(values) <= 1:
                found[number] = values
    usable = footage.present[:, footage.given].all(axis=1)
    rows = [row for row, number in enumerate(footage.numbers) if usable[row] and float(number) in found]
    if not rows:
        raise InputError(
            f"--weights {path}: no frame of {footage.source} has weights from 0 to 1 there and all pictures"
        )
    weights = np.full((len(rows), len(BLENDSHAPES)), np.nan)
    weights[:, [BLENDSHAPES.index(name) for name in shapes]] = [
        found[float(footage.numbers[row])] for row in rows
    ]
    return np.array(rows), weights


def _cameras_in(folder: Path, predictor: "HeadsetPredictor", option: str) -> dict[str, Path]:
    """A face's folder of pictures or film of each camera, by the camera's name."""
    found = {}
    for name in predictor.sizes:
        beside = sorted(folder.glob(f"{name}.*")) if folder.is_dir() else []
        films = [path for path in beside if path.suffix.lower() in FILMS]
        if (folder / name).is_dir():
            found[name] = folder / name
        elif len(films) > 1:
            raise InputError(
                f"{option} {folder}: {' and '.join(path.name for path in films)} are of one camera; keep one"
            )
        elif films:
            found[name] = films[0]
    if not found:
        raise InputError(
            f"{option} {folder}: no folder with {', '.join(predictor.sizes)} as folders of pictures or films; frames "
            f"of a take are FIRST-LAST, beside --left-eye and the others"
        )
    return found

"""What `regress headset predict` sees: the cameras' frames and the neutral pictures that its options name."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facegen.console import say
from regress.errors import InputError
from regress.runtime.ready_made import HEADSET, ready_made_models

_FARTHEST_DEG = 60.0
"""To which side a target may lie: eyes turn less."""

if TYPE_CHECKING:
    from regress.runtime.headset.network.predictor import HeadsetPredictor
    from regress.runtime.headset.person.neutral import Neutral
    from regress.runtime.headset.pictures.placement import CameraPlacement
    from regress.runtime.headset.placing.levels import CameraLevels
    from regress.runtime.headset.recordings.footage import Footage


def model_and_dataset(
    arguments: Sequence[Path], chosen: str | None, *, cameras: bool
) -> tuple[str | Path, Path | None]:
    """Which model sees what: of two arguments the model comes first, one is the dataset if it has pictures.

    Parameters
    ----------
    arguments, chosen
        Of the command line, and of ``--model``.
    cameras
        Whether paths of cameras are given as well; a single argument is then the model.

    Raises
    ------
    InputError
        Where there are more arguments, or the model is given twice.
    """
    rest = list(arguments)
    if chosen is not None:
        rest.insert(0, chosen)
    elif not rest or (len(rest) == 1 and not cameras and (rest[0] / "renders").is_dir()):
        if HEADSET not in ready_made_models():
            raise InputError("no model of headset pictures comes with this installation; name one's folder")
        rest.insert(0, HEADSET)
    if len(rest) > 2:
        raise InputError(
            f"one model and one dataset at most are needed; {', '.join(map(str, rest))} are given"
        )
    return rest[0], rest[1] if len(rest) == 2 else None


def camera_paths(
    predictor: "HeadsetPredictor", pairs: Sequence[str], short: dict[str, Path]
) -> dict[str, Path]:
    """Paths by camera, of all options.

    Raises
    ------
    InputError
        Where a pair is no pair, or names a camera twice or one that the model does not have.
    """
    paths = dict(short)
    for pair in pairs:
        name, sign, path = pair.partition("=")
        if not (sign and name and path):
            raise InputError(f"--camera {pair!r} is not NAME=PATH, as --camera mouth=take/mouth")
        if name in paths:
            raise InputError(f"camera {name} is given twice: {paths[name]} and {path}")
        paths[name] = Path(path)
    for name in paths:
        if name not in predictor.sizes:
            raise InputError(
                f"--camera {name}=…: the model has no camera {name!r}; it has {', '.join(predictor.sizes)}"
            )
    return paths


def told_of(predictor: "HeadsetPredictor", headset: str | None) -> "HeadsetPredictor":
    """The predictor, told where its cameras are by a headset's name or file; None tells nothing.

    Raises
    ------
    InputError
        Where the headset has none of the model's cameras, or the model does not listen.
    """
    if headset is None:
        return predictor
    from facegen.headsets import told_cameras

    return predictor.told(told_cameras(headset, predictor.sizes))


def targets_of(named: Sequence[str]) -> dict[int, tuple[float, float]]:
    """Targets of ``FRAME:YAW:PITCH``, by frames.

    Raises
    ------
    InputError
        Where one is none, or nobody can look there.
    """
    targets = {}
    for text in named:
        frame, *angles = text.split(":")
        try:
            yaw, pitch = map(float, angles)
        except ValueError:
            yaw, pitch = float("nan"), float("nan")
        if not (
            frame.isdecimal()
            and len(frame) < 20
            and abs(yaw) <= _FARTHEST_DEG
            and abs(pitch) <= _FARTHEST_DEG
        ):
            raise InputError(
                f"--looked-at {text!r} is not FRAME:YAW:PITCH with angles up to {_FARTHEST_DEG:g} degrees, as 120:-10:5"
            )
        if int(frame) in targets:
            raise InputError(f"--looked-at names frame {int(frame)} twice; a frame shows one look")
        targets[int(frame)] = (yaw, pitch)
    return targets


def check_stills(**asked: bool) -> None:
    """Refuse options that need a take where there is a dataset, by their names.

    Raises
    ------
    InputError
        Where any is asked for.
    """
    for name, there in asked.items():
        if there:
            why = "its pictures have 8 bits" if name == "bits" else "its pictures do not follow one another"
            raise InputError(f"--{name.replace('_', '-')} needs a take, and this is a dataset: {why}")


def placement_of(
    predictor: "HeadsetPredictor", named: Path | None, paths: Mapping[str, Path], *, bits: int | None
) -> "dict[str, CameraPlacement]":
    """What ``--placement`` names, or what is found in the cameras' recordings by ``auto``.

    Raises
    ------
    InputError
        Where the file is none of this model, or a dataset's pictures are to be placed.
    """
    from regress.runtime.headset.placing.placement_file import read_placement

    if named is None:
        return {}
    if named != Path("auto"):
        return read_placement(named, predictor.model)
    if not paths:
        raise InputError("--placement auto looks for eyes in a take's cameras; a dataset needs no placement")
    from regress.cli.headset_checked import placed_by_search

    return placed_by_search(predictor, paths, bits=bits)


def read_footage(
    predictor: "HeadsetPredictor",
    dataset: Path | None,
    paths: dict[str, Path],
    *,
    from_start: bool,
    fps: float | None,
    bits: int | None = None,
    placement: "Mapping[str, CameraPlacement] | None" = None,
) -> "Footage":
    """The cameras' frames, side by side, from a dataset or from a path each.

    Raises
    ------
    InputError
        Where neither or both are given, or they cannot be read.
    """
    from regress.runtime.headset.recordings.footage import line_up
    from regress.runtime.headset.recordings.recording import read_recording, read_rendered

    if (dataset is None) == (not paths):
        raise InputError(
            f"give either a dataset or the cameras' paths ({', '.join(predictor.sizes)}), as --camera NAME=PATH"
        )
    if dataset is not None and not (dataset / "renders").is_dir():
        raise InputError(f"{dataset} is no dataset with pictures: it has no folder renders")
    recordings = {}
    for name, (width, height) in predictor.sizes.items():
        if dataset is not None:
            recordings[name] = read_rendered(dataset, name, width=width, height=height)
        elif name in paths:
            recordings[name] = read_recording(
                paths[name],
                name,
                width=width,
                height=height,
                bits=bits,
                placement=(placement or {}).get(name),
            )
    return line_up(recordings, predictor.sizes, from_start=from_start, still=dataset is not None, fps=fps)


def read_neutrals(
    predictor: "HeadsetPredictor",
    footage: "Footage",
    named: Sequence[str],
    *,
    still: bool,
    bits: int | None = None,
    placement: "Mapping[str, CameraPlacement] | None" = None,
    levels: "Mapping[str, CameraLevels] | None" = None,
) -> "list[Neutral]":
    """Neutral pictures as the options ask for them; none where frames are to be seen alone.

    Raises
    ------
    InputError
        Where the model, the footage or the options have no use for them.
    """
    from regress.runtime.headset.person.neutral import Neutral, neutral_of_frame

    if not named or list(named) == ["none"]:
        return []
    if predictor.model.calibration == "none":
        raise InputError("the model was trained without calibration, so a neutral frame is of no use to it")
    if still:
        raise InputError(
            "a dataset has many people, and --neutral is for a recording of one; regress headset evaluate gives "
            "each its own"
        )
    if len(named) == 1:
        return _one_neutral(predictor, footage, named[0], bits, placement or {}, levels or {})
    rows = [_row(footage, name) for name in named]
    if rows != sorted(set(rows)):
        raise InputError(f"--neutral frames {', '.join(named)} are not in the order of time")
    return [Neutral(row=row, pictures=neutral_of_frame(footage, row)) for row in rows]


def _is_frame(footage: "Footage", named: str) -> bool:
    """Whether this is a frame's number; those of files fit 64 bits."""
    return named.isdecimal() and len(named) < 20 and int(named) in footage.numbers


def _row(footage: "Footage", named: str) -> int:
    """Row of a frame by its number, where several neutral frames are named."""
    if not _is_frame(footage, named):
        first, last = footage.numbers[[0, -1]]
        raise InputError(
            f"--neutral {named!r} is no frame of {footage.source} ({first}-{last}), as each of several has to be"
        )
    return int(np.flatnonzero(footage.numbers == int(named))[0])


def _one_neutral(
    predictor: "HeadsetPredictor",
    footage: "Footage",
    named: str,
    bits: int | None,
    placement: "Mapping[str, CameraPlacement]",
    levels: "Mapping[str, CameraLevels]",
) -> "list[Neutral]":
    """A frame, a folder's pictures or the calmest frame; nothing where none can be relied on."""
    from regress.runtime.headset.person.neutral import Neutral, calmest_frame, neutral_of_frame, read_neutral

    present = footage.present
    if named == "auto":
        usable = present[:, footage.given].all(axis=1)
        found = calmest_frame(predictor.predict(footage.pictures, present=present).weights, usable)
        if not found.sure:
            say(f"{footage.source}: no neutral frame found, weights are not calibrated: {found.reason}")
            return []
        say(f"{footage.source}: frame {footage.numbers[found.row]} is taken for neutral: {found.reason}")
        return [Neutral(row=found.row, pictures=neutral_of_frame(footage, found.row))]
    if _is_frame(footage, named):
        row = int(np.flatnonzero(footage.numbers == int(named))[0])
        return [Neutral(row=row, pictures=neutral_of_frame(footage, row))]
    if Path(named).is_dir():
        sizes = zip(predictor.sizes.items(), footage.given, strict=True)
        needed = {name: size for (name, size), there in sizes if there}
        # a single picture does not say that it has bars
        barred = {name: one for name, one in footage.placement.items() if any(one.cut)}
        pictures = read_neutral(Path(named), needed, bits=bits, placement={**barred, **placement})
        pictures = {
            name: levels[name].apply(picture) if name in levels else picture
            for name, picture in pictures.items()
        }
        return [Neutral(row=0, pictures=pictures)]
    first, last = footage.numbers[[0, -1]]
    raise InputError(
        f"--neutral {named!r} is neither a frame of {footage.source} ({first}-{last}), nor a folder; "
        f"auto and none are allowed too"
    )

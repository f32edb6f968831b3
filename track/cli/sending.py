"""Opens what answers go to, and refuses before that to record over what is read, or over another recording."""

import contextlib
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from track.errors import InputError
from track.profile.places import ENDING, profile_folder

if TYPE_CHECKING:
    from track.cli.opening import Wishes
    from track.sinks.sink import Sink
    from track.sinks.targets import Target

RECORDINGS = {".csv": "csv", ".glb": "gltf", ".vrma": "vrma"}
"""Sinks by a recording's ending."""

NAMED = ("csv", "gltf")
"""Sinks that take any other avatar's names."""

MODEL_FILES = ("model.json", "weights.npz", "network.onnx")
"""In a model's folder."""


def named_targets(
    to: Sequence[str] = (), record: Sequence[Path] = (), retarget: str | None = None
) -> "list[tuple[str, Target]]":
    """Where answers go, each with the option that says so; the arguments are `RunOptions`'.

    Raises
    ------
    InputError
        Where a sink is not known, or its address or an option cannot be used.
    """
    from track.sinks.targets import Target, parse_target

    targets = [("--to", parse_target(each)) for each in to]
    for path in record:
        if path.suffix.lower() not in RECORDINGS:
            raise InputError(f"--record {path}: a recording ends with {', '.join(RECORDINGS)}")
        targets.append(("--record", Target(name=RECORDINGS[path.suffix.lower()], place=str(path))))
    if retarget is None:
        return targets
    if not any(target.name in NAMED for _, target in targets):
        raise InputError(
            f"--retarget {retarget} is for tables and animations, and none is written; --record FILE.csv or FILE.glb "
            "writes one"
        )
    return [
        (
            option,
            replace(target, options={"names": retarget, **target.options})
            if target.name in NAMED
            else target,
        )
        for option, target in targets
    ]


def paths_of(targets: "Sequence[tuple[str, Target]]") -> set[Path]:
    """Whole paths of the files that recordings become."""
    return {Path(os.path.realpath(target.path)) for _, target in targets if target.is_file}


def check_files(
    targets: "Sequence[tuple[str, Target]]", wishes: "Wishes", texts: dict[str, str], avatar: Path | None
) -> None:
    """Refuse to record over what this run reads, and two recordings of one name.

    ``texts`` are the cameras', as `open_cameras` takes them, and the avatar is the page's.

    Raises
    ------
    InputError
        Where that was asked for.
    """
    from regress.runtime.headset.pictures.picture_file import PICTURES
    from regress.runtime.ready_made import model_folder
    from track.sinks.overwriting import refuse_overwriting

    names = [wishes.neutral, wishes.headset]  # each a file's, or of what comes with us
    names += [value for _, target in targets for value in target.options.values()]
    names += ["/dev/stdin" if text == "-" else text for text in texts.values()]
    read = [Path(name) for name in names if name is not None]
    read += filter(None, (avatar, wishes.placement, wishes.detector_file))
    if wishes.model is not None:
        read += [model_folder(wishes.model) / name for name in MODEL_FILES]
    named_profile = wishes.profile is not None and wishes.profile.endswith(ENDING)
    refuse_overwriting(
        targets,
        read=read,
        folders=[(profile_folder(), (ENDING,)), *((Path(text), PICTURES) for text in texts.values())],
        written={Path(os.path.realpath(wishes.profile)): "--profile"} if named_profile else {},
    )


def open_sinks(
    targets: "Sequence[tuple[str, Target]]",
    say: Callable[[str], None],
    closing: contextlib.ExitStack,
    opened: contextlib.ExitStack,
) -> "list[Sink]":
    """Sinks as they were written; ``closing`` says at its end which files are there, and ``opened`` lets all sinks go.

    Raises
    ------
    InputError, OutputError
        Where the place of one cannot be used.
    """
    from track.sinks.targets import open_sink

    sinks = []
    for _, target in targets:
        replaces = target.is_file and target.path.is_file()
        sinks.append(open_sink(target, say))
        opened.callback(sinks[-1].close)
        closing.callback(_tell_kept, sinks[-1], say)
        say(f"sending {target.title}{', in place of the file that is there' * replaces}")
    return sinks


def _tell_kept(sink: "Sink", say: Callable[[str], None]) -> None:
    if sink.kept:
        say(f"recorded {sink.title}")

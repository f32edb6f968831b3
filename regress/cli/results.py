"""Where predicted weights go: a table on standard output or in a file, or an avatar's animation."""

import shlex
import sys
from collections.abc import Iterable
from pathlib import Path

from facegen.console import counted, say
from facegen.conventions import BLENDSHAPES
from facegen.files import refuse_ending, refuse_sources, write_whole
from regress.cli.options import TableFormat
from regress.errors import InputError
from regress.runtime.prediction import Prediction
from regress.runtime.writers.avatar import animated_avatar
from regress.runtime.writers.tables import TABLES

STANDARD_OUTPUT = Path("-")


def check_targets(
    table_format: TableFormat,
    *,
    out: Path | None,
    gltf: Path | None,
    retargeted: bool,
    tables: dict[str, Path | None],
    film: Path | None = None,
    sources: Iterable[Path | None] = (),
) -> None:
    """Refuse options that cannot all be had, and names that promise another kind of file than what is written.

    ``tables`` are the files of other options, by option, and ``film`` that of ``--video``. Nothing is written over
    ``sources``, the avatar or another of these files.

    Raises
    ------
    InputError
        Where they cannot.
    """
    if TABLES[table_format.value].arkit_only and (retargeted or gltf is not None):
        raise InputError(
            f"--format {table_format.value} has the app's own columns: leave out --retarget and --gltf"
        )
    if gltf is not None and out in (None, STANDARD_OUTPUT):
        raise InputError(f"--gltf {gltf} needs --out for the animated avatar")
    if gltf is not None:
        refuse_ending(out, ".glb", ".vrm", what="an animated avatar")
    elif out not in (None, STANDARD_OUTPUT):
        refuse_ending(out, ".csv", what="a table of weights")
    for option, path in tables.items():
        if path is not None:
            refuse_ending(path, ".csv", what="a table", option=option)
    read = [path for path in (*sources, gltf) if path is not None]
    written: dict[Path, str] = {}
    for option, path in {"--out": out, **tables, "--video": film}.items():
        if path in (None, STANDARD_OUTPUT):
            continue
        refuse_sources(path, read, option=option)
        if (other := written.setdefault(path.resolve(), option)) != option:
            raise InputError(f"{other} and {option} are both {path}; give each a name of its own")


def needs_times(table_format: TableFormat, gltf: Path | None) -> bool:
    """Whether what is written has a time for every frame."""
    return gltf is not None or TABLES[table_format.value].needs_times


def write_prediction(
    prediction: Prediction, table_format: TableFormat, *, out: Path | None, gltf: Path | None
) -> None:
    """Write a table to a file or to standard output, or an animated avatar, and say which shapes that lacks.

    What was written is said as well, and how to look at it.
    """
    if gltf is None:
        table = TABLES[table_format.value]
        text = table.text(prediction)
        if out in (None, STANDARD_OUTPUT):
            sys.stdout.write(text)
            sys.stdout.flush()
            return
        write_whole(out, text)
        played = prediction.names == BLENDSHAPES and len(prediction.weights) > 1
        look = (
            f"; facegen preview --weights {shlex.quote(str(out))} --out face.webp plays it on a head (factory extra)"
            if played
            else ""
        )
        frames = counted(len(prediction.weights), "frame")
        say(f"{out}: {frames} of {len(prediction.names)} weights{look}")
        return
    avatar = animated_avatar(prediction, gltf)
    if avatar.missing:
        count = f"{len(avatar.missing)} of {len(prediction.names)} shapes"
        say(f"{gltf} has no morph target for {count}: {', '.join(avatar.missing)}")
    if avatar.headless:
        say(f"{gltf} has no bone called head that can be turned: the head's pose is left out")
    if avatar.compressed:
        say(
            f"{gltf} is compressed, which hides whether morph targets turn its eyes: their bones are left alone; "
            "export it without compression"
        )
    write_whole(out, avatar.content)
    say(f"{out}: {gltf.name} with an animation of {counted(len(prediction.weights), 'frame')}")

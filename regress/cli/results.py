"""Where predicted weights go: a table on standard output or in a file, or an avatar's animation."""

import sys
from enum import Enum
from pathlib import Path

import numpy as np

from facegen.console import say
from facegen.files import write_whole
from facegen.formats import live_link_csv
from facegen.formats.gltf_animation import animate_avatar
from regress.errors import InputError
from regress.runtime.predict import Prediction, prediction_csv


class Format(str, Enum):
    """Tables that `regress predict` writes."""

    csv = "csv"
    livelink = "livelink"


def write_table(
    prediction: Prediction, chosen: Format, out: Path | None, *, rotations: np.ndarray | None = None
) -> None:
    """Write a table to a file, or to standard output; ``rotations`` (n, 9) are Live Link's angles."""
    if chosen is Format.livelink:
        text = live_link_csv(prediction.weights, _known_times(prediction), rotations=rotations)
    else:
        text = prediction_csv(prediction)
    if out is None:
        sys.stdout.write(text)
        sys.stdout.flush()
    else:
        write_whole(out, text)


def write_confidence(prediction: Prediction, trust: np.ndarray, out: Path) -> None:
    """Write a table (n, 52) of how far each ARKit weight can be trusted, row by row that of the weights."""
    write_whole(out, prediction_csv(Prediction(weights=trust, frames=prediction.frames)))


def write_points(table: str, out: Path) -> None:
    """Write a table of traced points."""
    write_whole(out, table)


def write_avatar(prediction: Prediction, avatar: Path, out: Path) -> None:
    """Write an avatar with the prediction as an animation more, and say which shapes it lacks."""
    title = Path(prediction.frames.source).stem
    made = animate_avatar(avatar, prediction.names, prediction.weights, _known_times(prediction), title=title)
    if made.missing:
        count = f"{len(made.missing)} of {len(prediction.names)} shapes"
        say(f"{avatar} has no morph target for {count}: {', '.join(made.missing)}")
    write_whole(out, made.content)


def _known_times(prediction: Prediction) -> np.ndarray:
    """Seconds of every row; a row without a time, which has no weights either, takes that of the row before."""
    time_s = prediction.frames.time_s
    if time_s is None:
        raise InputError(f"{prediction.frames.source} does not say when its frames were taken; give --fps")
    known = np.flatnonzero(np.isfinite(time_s))
    last = np.searchsorted(known, np.arange(len(time_s)), side="right") - 1
    return time_s[known[np.maximum(last, 0)]] if len(known) else np.zeros(len(time_s))

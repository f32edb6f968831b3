"""Writes what browsers are told: a greeting, one JSON text a frame, and the cameras' pictures as JPEG.

Angles are radians, yaw to the subject's left, pitch upwards, roll towards the left shoulder; the head's position is in
glTF's frame (`track.sinks.axes`), in metres from the camera. What is not known is null.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict

import cv2
import numpy as np

from facegen.conventions import BLENDSHAPES
from track.messages import Moment
from track.sinks.axes import head_pose

VERSION = 1
"""Of these messages; a page of another version asks to be loaded again."""

LARGEST_SIDE = 640
"""Pixels of a picture's longer side on its way: what a page shows at most, in 20 to 40 kB."""

JPEG_QUALITY = 75


def hello(
    *, cameras: Sequence[str], steps: Sequence[str], settings: Mapping[str, object], shared: bool = False
) -> str:
    """What a browser is told first: names that later messages use by their places, and whether others may look."""
    return _json(
        {
            "type": "hello",
            "version": VERSION,
            "shapes": BLENDSHAPES,
            "cameras": list(cameras),
            "steps": list(steps),
            "settings": dict(settings),
            "shared": shared,
        }
    )


def refused(sentence: str) -> str:
    """What a browser is told whose message was not understood."""
    return _json({"type": "refused", "text": sentence})


def frame(moment: Moment, number: int, *, cameras: Sequence[str]) -> str:
    """One frame.

    Parameters
    ----------
    moment
        What to tell.
    number
        Of the frame; it rises.
    cameras
        Names by their places in ``hello``.
    """
    sample, pose = moment.sample, head_pose(moment.sample.head)
    weights = (
        sample.weights if sample.weights is not None and len(sample.weights) == len(BLENDSHAPES) else None
    )
    return _json(
        {
            "type": "frame",
            "number": number,
            "time": sample.time_s,
            "weights": _numbers(weights, 4),
            "gaze": _numbers(sample.gaze, 4),
            "head": None if pose is None else _numbers(np.concatenate([pose.position, pose.angles_rad]), 4),
            "cameras": {
                name: {
                    "size": [picture.shape[1], picture.shape[0]],
                    "points": _numbers(moment.points.get(name), 1),
                }
                for name in cameras
                if (picture := moment.pictures.get(name)) is not None
            },
            "fps": moment.fps,
            "latency": dict(moment.latency_ms),
            "faults": list(moment.faults),
            "step": None if moment.step is None else asdict(moment.step),
            "said": moment.said,
            "settings": dict(moment.settings),
        }
    )


def jpeg(picture: np.ndarray) -> bytes:
    """A picture (h, w, 3) or (h, w) uint8 as JPEG, made smaller where a page would not show it whole."""
    factor = LARGEST_SIDE / max(picture.shape[:2])
    if factor < 1:
        picture = cv2.resize(picture, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)
    _, coded = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    return coded.tobytes()


def _json(message: dict[str, object]) -> str:
    # JSON has no NaN, so that browsers refuse what holds one
    return json.dumps(_known(message), separators=(",", ":"), allow_nan=False)


def _known(value: object) -> object:
    """The same with null for every number that is none, whoever gave it."""
    if isinstance(value, Mapping):
        return {str(key): _known(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_known(each) for each in value]
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    return value.item() if isinstance(value, np.generic) else value


def _numbers(values: np.ndarray | None, places: int) -> list[object] | None:
    return None if values is None else np.round(np.asarray(values, dtype=np.float64), places).tolist()

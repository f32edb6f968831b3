"""What the networks trace in the pictures, as a table: lids, pupils, irises, brows, nose and lips in pixels."""

import csv
import io

import numpy as np

from regress.errors import ModelError
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.recordings.footage import Footage


def check_points(predictor: HeadsetPredictor) -> None:
    """Refuse models without points.

    Raises
    ------
    ModelError
        Where the model traces none, or was trained before they were given out.
    """
    if not predictor.model.points:
        raise ModelError(
            "the model gives no points: train one with points_loss above 0, and with this version"
        )


def traced_points(predictor: HeadsetPredictor, footage: Footage) -> dict[str, np.ndarray]:
    """Pixels (n, P, 2) by camera of ``HeadsetModel.points``, NaN where the camera has no picture that counts.

    They are pixels of the pictures as they were recorded, whatever size the network sees them at.
    """
    found = predictor.graph.trace(footage.pictures)
    for column, name in enumerate(footage.cameras):
        if name not in found:
            continue
        if name in footage.placement and name in footage.scaled_from:
            found[name] = _in_pictures(found[name], footage, name)
        elif name in footage.scaled_from:
            height, width = footage.pictures[name].shape[1:]
            # 0 is the middle of the first pixel, before scaling and after
            scale = footage.scaled_from[name][:, None] / (width, height)
            found[name] = (found[name] + 0.5) * scale - 0.5
        found[name][~footage.present[:, column]] = np.nan
    return found


def _in_pictures(found: np.ndarray, footage: Footage, name: str) -> np.ndarray:
    """Pixels (n, P, 2) of a placed camera's views in its recorded pictures, which may be of several sizes."""
    height, width = footage.pictures[name].shape[1:]
    placed = np.empty_like(found)
    sizes = footage.scaled_from[name]
    for size in np.unique(sizes, axis=0):
        rows = (sizes == size).all(axis=1)
        matrix = footage.placement[name].picture_from_view((int(size[0]), int(size[1])), (width, height))
        placed[rows] = found[rows] @ matrix[:, :2].T + matrix[:, 2]
    return placed


def points_csv(predictor: HeadsetPredictor, footage: Footage) -> str:
    """A row a frame, with columns ``CAMERA.POINT.x`` and ``.y``; cells of absent cameras are empty."""
    points = traced_points(predictor, footage)
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    names = [
        f"{camera}.{point}.{axis}"
        for camera in points
        for point in predictor.model.points[camera]
        for axis in "xy"
    ]
    table.writerow(["frame", *names])
    values = np.concatenate([found.reshape(len(found), -1) for found in points.values()], axis=1)
    for number, row in zip(footage.numbers, values, strict=True):
        table.writerow([number, *("" if np.isnan(value) else f"{value:.2f}" for value in row)])
    return text.getvalue()

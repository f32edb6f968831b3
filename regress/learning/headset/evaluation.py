"""How good a headset network is on people it never saw, against exact labels; needs no PyTorch."""

from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.errors import InputError
from regress.learning.headset.accuracy import SCORED, r2_of, summary
from regress.learning.headset.arrays import HeadsetArrays
from regress.runtime.headset.estimates import Estimates
from regress.runtime.headset.graph import HeadsetGraph
from regress.runtime.headset.model import HeadsetModel

CALIBRATIONS = ("none", "same_seat", "other_seat")
COMBINED = "combined"
"""Component of frames in which the jaw opens while the lids close: reported apart from ordinary frames."""


@dataclass(frozen=True, kw_only=True)
class Condition:
    """What a network is given of each frame.

    Parameters
    ----------
    calibration
        One of ``CALIBRATIONS``: whose neutral pictures it sees.
    cameras
        Cameras that are there; None means all.
    fallback
        Answer without calibration where the network says that the neutral pictures come from another seat.
    """

    calibration: str = "none"
    cameras: tuple[str, ...] | None = None
    fallback: bool = False


def estimate(
    graph: HeadsetGraph, model: HeadsetModel, arrays: HeadsetArrays, rows: np.ndarray, condition: Condition
) -> Estimates:
    """What a network says of rows of arrays under a condition.

    Raises
    ------
    InputError
        Where the arrays' cameras are not the model's, or a row has no neutral picture of the kind asked for.
    """
    _check_cameras(model, arrays)
    pictures = {name: arrays.pictures[name][rows] for name in condition.cameras or model.camera_names}
    if condition.calibration == "none":
        return graph.run(pictures)
    source = arrays.neutral_rows(other_seat=condition.calibration == "other_seat")[rows]
    if (source < 0).any():
        raise InputError(
            f"sample {arrays.sample[rows][source < 0][0]} has no neutral picture of "
            f"{condition.calibration.replace('_', ' ')}; evaluate without calibration"
        )
    neutral = {name: arrays.pictures[name][source] for name in pictures}
    answer = graph.run(pictures, neutral=neutral)
    if not condition.fallback:
        return answer
    calibrated = answer.same_seat >= 0.5
    settled = graph.run(pictures, neutral=neutral, calibrated=calibrated)
    return replace(settled, same_seat=answer.same_seat)


def evaluate(
    graph: HeadsetGraph, model: HeadsetModel, arrays: HeadsetArrays, *, split: str = "test"
) -> dict[str, Any]:
    """All figures of a network on a split, as JSON data, unrounded.

    Frames count that are not neutral themselves; those of the component ``COMBINED`` count apart.

    Returns
    -------
    dict
        ``people`` and how many of them the arrays' training split has too, ``people_in_training``; ``unseen``, whether
        it is known that the network was trained on none of them;
        ``conditions`` and ``combined``: summaries by condition; ``floors``: of the training mean and of the
        resting face; ``shapes``: R2, MAE and RMSE by shape and calibration; ``cameras``: R2 of each shape from
        one camera alone; ``components`` and ``people_mm``: geometry error in mm by condition; ``deviation``: how
        honest the predicted standard deviations are; ``seat``: how often the network names the seat rightly.

    Raises
    ------
    InputError
        Where the split has no such row, or the arrays are of other cameras.
    """
    _check_cameras(model, arrays)
    rows = np.flatnonzero((arrays.split == split) & ~arrays.neutral)
    if not len(rows):
        raise InputError(f"the arrays have no {split} row with an expression; choose another split")
    people = np.unique(arrays.person[rows])
    known = int(np.isin(people, arrays.person[arrays.split == "train"]).sum())
    combined = arrays.component[rows] == COMBINED
    true, true_gaze = arrays.weights[rows], arrays.gaze[rows].reshape(-1, 2, 2)
    found = {
        name: estimate(graph, model, arrays, rows, condition)
        for name, condition in conditions(model, arrays, rows).items()
    }

    def figures(chosen: np.ndarray) -> dict[str, Any]:
        if not chosen.any():
            return {}
        return {
            name: asdict(
                summary(arrays.face, said.weights[chosen], said.gaze[chosen], true[chosen], true_gaze[chosen])
            )
            for name, said in found.items()
        }

    ordinary = ~combined if (~combined).any() else combined
    errors = {name: arrays.face.error_mm(said.weights, true) for name, said in found.items()}
    return {
        "split": split,
        "rows": len(rows),
        "people": len(people),
        "people_in_training": known,
        "unseen": _unseen(model, arrays, known),
        "dataset_hash": arrays.description.get("dataset_hash", ""),
        "conditions": figures(ordinary),
        "combined": figures(combined),
        "floors": _floors(model, arrays, rows[ordinary]),
        "shapes": _shapes(found, true, ordinary),
        "cameras": {
            name: _named(r2_of(found[f"only_{name}"].weights[ordinary], true[ordinary]))
            for name in model.camera_names
            if f"only_{name}" in found
        },
        "components": _grouped(arrays.component[rows], errors),
        "people_mm": _grouped(arrays.person[rows][ordinary], {k: v[ordinary] for k, v in errors.items()}),
        "deviation": _honesty(found["uncalibrated"], true, ordinary),
        "seat": {
            name: float(np.mean(found[name].same_seat[ordinary] >= 0.5))
            for name in CALIBRATIONS[1:]
            if name in found
        },
    }


def conditions(model: HeadsetModel, arrays: HeadsetArrays, rows: np.ndarray) -> dict[str, Condition]:
    """The conditions that a network can be judged under on these rows, by name."""
    cameras = model.camera_names
    found = {"uncalibrated": Condition()}
    if model.calibration != "none":
        for name in CALIBRATIONS[1:]:
            if (arrays.neutral_rows(other_seat=name == "other_seat")[rows] >= 0).all():
                found[name] = Condition(calibration=name)
                found[f"{name}_fallback"] = Condition(calibration=name, fallback=True)
    if len(cameras) > 1:
        for lost in cameras:
            found[f"without_{lost}"] = Condition(cameras=tuple(name for name in cameras if name != lost))
        for only in cameras:
            found[f"only_{only}"] = Condition(cameras=(only,))
    return found


def _check_cameras(model: HeadsetModel, arrays: HeadsetArrays) -> None:
    needed = {camera.name: (camera.width, camera.height) for camera in model.cameras}
    there = {camera.name: (camera.width, camera.height) for camera in arrays.cameras}
    for name, (width, height) in needed.items():
        if there.get(name) != (width, height):
            has = ", ".join(f"{other} {w}x{h}" for other, (w, h) in there.items())
            raise InputError(
                f"the model needs camera {name} of {width}x{height} pixels; the arrays have {has}"
            )


def _unseen(model: HeadsetModel, arrays: HeadsetArrays, known: int) -> bool:
    """Whether a model cannot know people of whom the arrays' own training split has so many.

    Datasets of one seed share people, however many each has; without a record of the seed nothing is known.
    """
    if model.dataset_hash and model.dataset_hash == arrays.description.get("dataset_hash"):
        return not known
    seeds = model.training.get("data_seed"), arrays.description.get("seed")
    return None not in seeds and seeds[0] != seeds[1]


def _floors(model: HeadsetModel, arrays: HeadsetArrays, rows: np.ndarray) -> dict[str, Any]:
    true, gaze = arrays.weights[rows], arrays.gaze[rows].reshape(-1, 2, 2)
    mean = np.asarray(model.training.get("mean_weights", true.mean(axis=0)), np.float64)
    mean_gaze = np.asarray(model.training.get("mean_gaze", arrays.gaze[rows].mean(axis=0)), np.float64)
    said = {"mean": (mean, mean_gaze), "rest": (np.zeros(len(BLENDSHAPES)), np.zeros(4))}
    return {
        name: asdict(
            summary(
                arrays.face,
                np.broadcast_to(weights, true.shape),
                np.broadcast_to(angles.reshape(2, 2), gaze.shape),
                true,
                gaze,
            )
        )
        for name, (weights, angles) in said.items()
    }


def _shapes(found: dict[str, Estimates], true: np.ndarray, rows: np.ndarray) -> dict[str, Any]:
    table: dict[str, Any] = {name: {} for name in BLENDSHAPES}
    for condition in ("uncalibrated", *CALIBRATIONS[1:]):
        if condition not in found:
            continue
        predicted, wanted = found[condition].weights[rows], true[rows]
        error = predicted - wanted
        columns = zip(
            BLENDSHAPES,
            _named(r2_of(predicted, wanted)).values(),
            np.abs(error).mean(axis=0).tolist(),
            np.sqrt(np.square(error).mean(axis=0)).tolist(),
            strict=True,
        )
        for name, r2, mae, rmse in columns:
            table[name][condition] = {"r2": r2, "mae": mae, "rmse": rmse}
    return table


def _grouped(keys: np.ndarray, errors: dict[str, np.ndarray]) -> dict[str, Any]:
    return {
        str(key): {
            "rows": int((keys == key).sum()),
            **{name: float(error[keys == key].mean()) for name, error in errors.items()},
        }
        for key in np.unique(keys)
    }


def _honesty(said: Estimates, true: np.ndarray, chosen: np.ndarray) -> dict[str, float | None]:
    """Mean squared error over predicted variance (1 is honest), and how error and deviation correlate."""
    error, deviation = (said.weights - true)[chosen][:, SCORED], said.deviation[chosen][:, SCORED]
    alike = np.corrcoef(np.abs(error).ravel(), deviation.ravel())[0, 1] if np.ptp(deviation) > 0 else np.nan
    return {
        "squared_error_over_variance": float(np.mean(error**2) / np.mean(deviation**2)),
        "correlation": None if np.isnan(alike) else float(alike),
    }


def _named(values: np.ndarray) -> dict[str, float | None]:
    return {
        name: None if np.isnan(value) else float(value)
        for name, value in zip(BLENDSHAPES, values, strict=True)
    }

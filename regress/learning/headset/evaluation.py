"""Evaluates a headset network on arrays with exact labels; needs no PyTorch."""

from dataclasses import dataclass, fields, replace

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.errors import InputError
from regress.learning.headset.accuracy import SCORED, r2_of, summary
from regress.learning.headset.arrays import HeadsetArrays
from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.figures import (
    DeviationFigures,
    Evaluation,
    GroupErrors,
    ShapeFigures,
    Summary,
)
from regress.runtime.headset.network.graph import HeadsetGraph
from regress.runtime.headset.network.model import HeadsetModel

NEUTRAL_SOURCES = ("none", "same_seat", "other_seat")
"""Seats of the headset that neutral pictures may come from."""

COMBINED = "combined"
"""Component of frames in which the jaw opens while the lids close: reported apart from ordinary frames."""


@dataclass(frozen=True, kw_only=True)
class Condition:
    """What a network is given of each frame.

    Parameters
    ----------
    calibration
        One of ``NEUTRAL_SOURCES``: whose neutral pictures it sees.
    cameras
        Cameras that are there; None means all.
    fallback
        Answer without calibration where the network says that the neutral pictures come from another seat.
    told
        Whether it is told where the cameras are.
    """

    calibration: str = "none"
    cameras: tuple[str, ...] | None = None
    fallback: bool = False
    told: bool = False


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
    if condition.told:
        return _estimate_told(graph, model, arrays, rows, condition)
    pictures = {name: arrays.pictures[name][rows] for name in condition.cameras or model.camera_names}
    if condition.calibration == "none":
        return graph.run(pictures)
    source = arrays.neutral_rows(other_seat=condition.calibration == "other_seat")[rows]
    if (source < 0).any():
        raise InputError(
            f"{arrays.folder}: sample {arrays.sample[rows][source < 0][0]} has no neutral picture of "
            f"{condition.calibration.replace('_', ' ')}; evaluate without calibration"
        )
    neutral = {name: arrays.pictures[name][source] for name in pictures}
    answer = graph.run(pictures, neutral=neutral)
    if not condition.fallback:
        return answer
    calibrated = answer.same_seat >= 0.5
    settled = graph.run(pictures, neutral=neutral, calibrated=calibrated)
    return replace(settled, same_seat=answer.same_seat)


def _estimate_told(
    graph: HeadsetGraph, model: HeadsetModel, arrays: HeadsetArrays, rows: np.ndarray, condition: Condition
) -> Estimates:
    """`estimate` of each headset's rows apart, told of its cameras."""
    terms = np.stack([arrays.camera_terms[name][rows] for name in model.camera_names], axis=1)
    units, unit_of = np.unique(terms.reshape(len(rows), -1), axis=0, return_inverse=True)
    unit_of = unit_of.reshape(-1)
    parts = []
    for number in range(len(units)):
        chosen = np.flatnonzero(unit_of == number)
        told = graph.told(dict(zip(model.camera_names, terms[chosen[0]], strict=True)))
        parts.append(estimate(told, model, arrays, rows[chosen], replace(condition, told=False)))
    back = np.argsort(np.argsort(unit_of, kind="stable"))
    return Estimates(
        **{
            one.name: np.concatenate([getattr(part, one.name) for part in parts])[back]
            for one in fields(Estimates)
        }
    )


def evaluate(
    graph: HeadsetGraph, model: HeadsetModel, arrays: HeadsetArrays, *, split: str = "test"
) -> Evaluation:
    """All figures of a network on a split.

    Frames count that are not neutral themselves; those of the component ``COMBINED`` count apart.

    Raises
    ------
    InputError
        Where the split has no such row, or the arrays are of other cameras.
    """
    _check_cameras(model, arrays)
    rows = np.flatnonzero((arrays.split == split) & ~arrays.neutral)
    if not len(rows):
        raise InputError(f"{arrays.folder} has no {split} row with an expression; choose another split")
    people = np.unique(arrays.person[rows])
    in_training = int(np.isin(people, arrays.person[arrays.split == "train"]).sum())
    combined = arrays.component[rows] == COMBINED
    true, true_gaze = arrays.weights[rows], arrays.gaze[rows].reshape(-1, 2, 2)
    estimates = {
        name: estimate(graph, model, arrays, rows, condition)
        for name, condition in conditions(model, arrays, rows).items()
    }

    def summaries(chosen: np.ndarray) -> dict[str, Summary]:
        if not chosen.any():
            return {}
        return {
            name: summary(arrays.face, one.weights[chosen], one.gaze[chosen], true[chosen], true_gaze[chosen])
            for name, one in estimates.items()
        }

    ordinary = ~combined if (~combined).any() else combined
    errors = {name: arrays.face.error_mm(one.weights, true) for name, one in estimates.items()}
    return Evaluation(
        split=split,
        rows=len(rows),
        people=len(people),
        people_in_training=in_training,
        unseen=are_unseen(model, arrays, in_training),
        dataset_hash=arrays.description.get("dataset_hash", ""),
        conditions=summaries(ordinary),
        combined=summaries(combined),
        floors=_floors(model, arrays, rows[ordinary]),
        shapes=_shapes(estimates, true, ordinary),
        cameras={
            name: _named(r2_of(estimates[f"only_{name}"].weights[ordinary], true[ordinary]))
            for name in model.camera_names
            if f"only_{name}" in estimates
        },
        components=_grouped(arrays.component[rows], errors),
        people_mm=_grouped(arrays.person[rows][ordinary], {k: v[ordinary] for k, v in errors.items()}),
        deviation=_deviation(estimates["uncalibrated"], true, ordinary),
        seat={
            name: float(np.mean(estimates[name].same_seat[ordinary] >= 0.5))
            for name in NEUTRAL_SOURCES[1:]
            if name in estimates
        },
    )


def conditions(model: HeadsetModel, arrays: HeadsetArrays, rows: np.ndarray) -> dict[str, Condition]:
    """The conditions that a network can be judged under on these rows, by name."""
    cameras = model.camera_names
    named = {"uncalibrated": Condition()}
    if model.calibration != "none":
        for name in NEUTRAL_SOURCES[1:]:
            if (arrays.neutral_rows(other_seat=name == "other_seat")[rows] >= 0).all():
                named[name] = Condition(calibration=name)
                named[f"{name}_fallback"] = Condition(calibration=name, fallback=True)
    if model.camera_terms and arrays.camera_terms:
        named |= {f"{name}_told": replace(one, told=True) for name, one in named.items()}
    if len(cameras) > 1:
        for lost in cameras:
            named[f"without_{lost}"] = Condition(cameras=tuple(name for name in cameras if name != lost))
        for only in cameras:
            named[f"only_{only}"] = Condition(cameras=(only,))
    return named


def _check_cameras(model: HeadsetModel, arrays: HeadsetArrays) -> None:
    needed = {camera.name: (camera.width, camera.height) for camera in model.cameras}
    sizes = {camera.name: (camera.width, camera.height) for camera in arrays.cameras}
    for name, (width, height) in needed.items():
        if sizes.get(name) != (width, height):
            has = ", ".join(f"{other} {w}x{h}" for other, (w, h) in sizes.items())
            raise InputError(
                f"the model needs camera {name} of {width}x{height} pixels; {arrays.folder} has {has}"
            )


def are_unseen(model: HeadsetModel, arrays: HeadsetArrays, in_training: int) -> bool:
    """Whether a model cannot know people of whom the arrays' own training split has so many.

    Datasets of one seed share people, however many each has; without a record of the seed nothing is known.
    """
    if model.dataset_hash and model.dataset_hash == arrays.description.get("dataset_hash"):
        return not in_training
    seeds = model.training.data_seed, arrays.description.get("seed")
    return None not in seeds and seeds[0] != seeds[1]


def _floors(model: HeadsetModel, arrays: HeadsetArrays, rows: np.ndarray) -> dict[str, Summary]:
    true, gaze = arrays.weights[rows], arrays.gaze[rows]
    mean, mean_gaze = model.training.mean_weights, model.training.mean_gaze
    constants = {
        "mean": (
            true.mean(axis=0) if mean is None else mean,
            gaze.mean(axis=0) if mean_gaze is None else mean_gaze,
        ),
        "rest": (np.zeros(len(BLENDSHAPES)), np.zeros(4)),
    }
    return {
        name: summary(
            arrays.face,
            np.broadcast_to(np.asarray(weights, np.float64), true.shape),
            np.broadcast_to(np.asarray(angles, np.float64), gaze.shape).reshape(-1, 2, 2),
            true,
            gaze.reshape(-1, 2, 2),
        )
        for name, (weights, angles) in constants.items()
    }


def _shapes(
    estimates: dict[str, Estimates], true: np.ndarray, rows: np.ndarray
) -> dict[str, dict[str, ShapeFigures]]:
    table: dict[str, dict[str, ShapeFigures]] = {name: {} for name in BLENDSHAPES}
    for condition in ("uncalibrated", *NEUTRAL_SOURCES[1:]):
        if condition not in estimates:
            continue
        error = estimates[condition].weights[rows] - true[rows]
        columns = zip(
            BLENDSHAPES,
            _named(r2_of(estimates[condition].weights[rows], true[rows])).values(),
            np.abs(error).mean(axis=0).tolist(),
            np.sqrt(np.square(error).mean(axis=0)).tolist(),
            strict=True,
        )
        for name, r2, mae, rmse in columns:
            table[name][condition] = ShapeFigures(r2=r2, mae=mae, rmse=rmse)
    return table


def _grouped(keys: np.ndarray, errors: dict[str, np.ndarray]) -> dict[str, GroupErrors]:
    return {
        str(key): GroupErrors(
            rows=int((keys == key).sum()),
            mm={name: float(error[keys == key].mean()) for name, error in errors.items()},
        )
        for key in np.unique(keys)
    }


def _deviation(estimates: Estimates, true: np.ndarray, chosen: np.ndarray) -> DeviationFigures:
    error = (estimates.weights - true)[chosen][:, SCORED]
    deviation = estimates.deviation[chosen][:, SCORED]
    alike = np.corrcoef(np.abs(error).ravel(), deviation.ravel())[0, 1] if np.ptp(deviation) > 0 else np.nan
    return DeviationFigures(
        squared_error_over_variance=float(np.mean(error**2) / np.mean(deviation**2)),
        correlation=None if np.isnan(alike) else float(alike),
    )


def _named(values: np.ndarray) -> dict[str, float | None]:
    return {
        name: None if np.isnan(value) else float(value)
        for name, value in zip(BLENDSHAPES, values, strict=True)
    }

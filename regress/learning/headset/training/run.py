"""Trains a headset network on arrays and writes its model folder."""

import os
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import torch

from facegen.conventions import CAMERA_TERMS
from facegen.files import refuse_sources
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.evaluation import evaluate
from regress.learning.headset.looks import camera_looks
from regress.learning.headset.recipe import HeadsetRecipe, recipe_of
from regress.learning.headset.training.export import export_graph
from regress.learning.headset.training.loop import start_training
from regress.learning.progress import Progress
from regress.runtime.headset.network.estimates import GRAPH_OUTPUTS, points_output
from regress.runtime.headset.network.folder import read_headset_model, save_headset_model
from regress.runtime.headset.network.graph import HeadsetGraph
from regress.runtime.headset.network.model import HeadsetModel, HeadsetTraining
from regress.runtime.headset.network.outputs import WEIGHTS
from regress.runtime.headset.network.parts import encoder_owners, part_of
from regress.runtime.headset.pictures.typical import typical_picture
from regress.runtime.model import HEADSET, check_place


def train_headset(
    arrays: HeadsetArrays,
    recipe: HeadsetRecipe,
    folder: str | os.PathLike[str],
    *,
    start: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
) -> HeadsetModel:
    """Train a network and write its model folder; stopped, it goes on where the last whole epoch ended.

    Parameters
    ----------
    arrays
        With a training split; scores come from its test split where it has one.
    recipe
        All settings.
    folder
        Where the model goes. Until it is written its state is in a file beside it, ``.NAME.checkpoint``.
    start
        Model folder whose network this one begins as; None begins with random numbers.
    progress
        Called after each epoch.

    Raises
    ------
    InputError
        Where a setting is impossible, no training row is left, the checkpoint belongs to another training, or the
        network would replace the one that it begins as.
    Interrupted
        On Ctrl-C.
    OutputError
        Where the model cannot be written.
    """
    folder, recipe = Path(folder), recipe_of(recipe.settings())
    check_place(folder, HEADSET)
    checkpoint = folder.parent / f".{folder.name}.checkpoint"
    began_as = None if start is None else read_headset_model(start)
    if start is not None:
        refuse_sources(folder / "model.json", [Path(start) / "model.json"])
    training = start_training(arrays, recipe, checkpoint, None if start is None else Path(start))
    resumed = len(training.history)
    network = training.run(progress)
    owners = encoder_owners(tuple(camera.name for camera in arrays.cameras))
    cameras = tuple(replace(camera, mirrored_of=owners[camera.name]) for camera in arrays.cameras)
    scale = training.deviation_scale()
    graph, difference = export_graph(
        network,
        cameras,
        training.targets,
        square_size=recipe.square_size,
        deviation_scale=scale,
        calibration=recipe.calibration,
    )
    points = training.points()
    description = arrays.description
    model = HeadsetModel(
        headset=description["headset"],
        cameras=cameras,
        parts={name: part_of(name) for name in owners},
        modulation=1.0 if network.part is None else recipe.modulation,
        architecture=recipe.architecture,
        calibration="optional" if recipe.calibration else "none",
        points=points,
        # the mean of many headsets' pictures looks like none of them
        typical={}
        if arrays.drawn
        else {name: _typical(pictures, training.rows) for name, pictures in arrays.pictures.items()},
        looks={
            name: camera_looks(arrays, name, training.rows, points.get(name, ())) for name in arrays.pictures
        },
        camera_terms=CAMERA_TERMS if recipe.camera_terms else (),
        outputs=(*GRAPH_OUTPUTS, *map(points_output, points)),
        training=HeadsetTraining(
            recipe=recipe.settings(),
            data_seed=description.get("seed"),
            rows=len(training.rows),
            people=len(set(arrays.person[training.rows].tolist())),
            parameters=sum(parameter.numel() for parameter in network.parameters()),
            history=tuple(training.history),
            cpu_s=training.cpu_s,
            resumed_after_epochs=resumed,
            began_as="" if began_as is None else began_as.network_sha256,
            onnx_difference=difference,
            deviation_scale=tuple(scale.tolist()),
            mean_weights=tuple(training.targets.mean[:WEIGHTS].tolist()),
            mean_gaze=tuple(training.targets.mean[WEIGHTS:].tolist()),
            versions={"facegen": version("facegen"), "torch": torch.__version__},
        ),
        dataset_hash=description.get("dataset_hash", ""),
        rig=description.get("rig", ""),
        licences=_licences(description),
    )
    if (arrays.split == "test").any():
        model = replace(model, scores=evaluate(HeadsetGraph(graph, cameras), model, arrays))
    written = save_headset_model(model, graph, folder, data=arrays.folder)
    checkpoint.unlink(missing_ok=True)
    return written


def _typical(pictures: np.ndarray, rows: np.ndarray) -> tuple[tuple[int, ...], ...]:
    return tuple(map(tuple, typical_picture(pictures, rows).tolist()))


def _licences(description: dict[str, Any]) -> tuple[str, ...]:
    licence = description.get("licence", ())
    return (licence,) if isinstance(licence, str) else tuple(map(str, licence))

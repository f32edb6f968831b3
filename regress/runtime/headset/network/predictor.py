"""Loads a headset network ready to be used: its description, and its graph."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regress.errors import InputError, ModelError
from regress.runtime.documents import read_document
from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.folder import read_headset_model
from regress.runtime.headset.network.graph import HeadsetGraph
from regress.runtime.headset.network.model import HeadsetModel
from regress.runtime.model import HEADSET
from regress.runtime.ready_made import model_folder


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadsetPredictor:
    """A loaded model folder.

    Parameters
    ----------
    model
        What the folder says of the network.
    graph
        Runs it.
    """

    model: HeadsetModel
    graph: HeadsetGraph

    @property
    def sizes(self) -> dict[str, tuple[int, int]]:
        """Width and height of each camera's pictures, in the model's order."""
        return {camera.name: (camera.width, camera.height) for camera in self.model.cameras}

    def told(self, terms: Mapping[str, np.ndarray]) -> "HeadsetPredictor":
        """The same predictor, told where its cameras are: `facegen.conventions.CAMERA_TERMS` (14,) by camera.

        Raises
        ------
        InputError
            Where the model does not listen.
        """
        return replace(self, graph=self.graph.told(terms))

    @property
    def typical(self) -> dict[str, np.ndarray]:
        """(24, 24) uint8 of each camera: its mean picture in training; none of older models."""
        return {name: np.array(rows, dtype=np.uint8) for name, rows in self.model.typical.items()}

    def predict(
        self,
        pictures: Mapping[str, np.ndarray],
        *,
        present: np.ndarray | None = None,
        neutral: Mapping[str, np.ndarray] | None = None,
        calibrated: np.ndarray | None = None,
    ) -> Estimates:
        """Estimates of n frames.

        Parameters
        ----------
        pictures
            (n, h, w) uint8 by camera of the model; one that is left out is not present.
        present : (n, cameras) bool, optional
            Which pictures count.
        neutral
            (h, w) or (n, h, w) uint8 of every camera that is present; without them no frame is calibrated.
        calibrated : (n,) bool, optional
            Which frames are compared with the neutral pictures; all by default.

        Raises
        ------
        InputError
            Where a camera is not the model's, or is present in a calibrated frame and has no neutral picture.
        """
        repeated = _repeated(neutral, pictures)
        return self.graph.run(dict(pictures), present=present, neutral=repeated, calibrated=calibrated)

    def see(
        self,
        pictures: Mapping[str, np.ndarray],
        *,
        neutral: Mapping[str, np.ndarray] | None = None,
        calibrated: np.ndarray | None = None,
    ) -> tuple[Estimates, dict[str, np.ndarray]]:
        """Estimates as `predict` gives them, and the pixels (n, P, 2) that each camera traces, for the time of one."""
        repeated = _repeated(neutral, pictures)
        return self.graph.see(dict(pictures), neutral=repeated, calibrated=calibrated)


def _repeated(
    neutral: Mapping[str, np.ndarray] | None, pictures: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray] | None:
    """Neutral pictures for each frame; None where there are none."""
    count = len(next(iter(pictures.values())))
    return {
        name: np.broadcast_to(picture, (count, *picture.shape[-2:]))
        for name, picture in (neutral or {}).items()
    } or None


def is_headset_model(folder: str | os.PathLike[str]) -> bool:
    """Whether a folder says of itself that it is a headset network's; False as well where it says nothing."""
    try:
        document = read_document(model_folder(folder) / "model.json")
    except InputError:
        return False
    return document.get("kind") == HEADSET.name


def load_headset_predictor(folder: str | os.PathLike[str]) -> HeadsetPredictor:
    """Load a model folder of ``regress headset train``, or the ready-made model of that name.

    Raises
    ------
    ModelError
        Where it is none, or damaged.
    """
    folder = model_folder(folder)
    model = read_headset_model(folder)
    graph = HeadsetGraph(folder / "network.onnx", model.cameras, model.points)
    lost = sorted(set(model.outputs) - graph.outputs)
    if lost:
        raise ModelError(f"{folder / 'network.onnx'} has no output {lost[0]}; model.json names it")
    if graph.listens != bool(model.camera_terms):
        raise ModelError(
            f"{folder / 'network.onnx'} and its model.json do not agree on whether the network is told of its cameras"
        )
    return HeadsetPredictor(model=model, graph=graph)

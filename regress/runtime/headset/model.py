"""What a model folder of a headset network says of itself: model.json, beside network.onnx."""

import hashlib
import json
import os
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from facegen.conventions import BLENDSHAPES
from facegen.files import write_whole
from regress.errors import ModelError
from regress.runtime.headset.estimates import GRAPH_OUTPUTS
from regress.runtime.headset.typical import read_typical
from regress.runtime.model import HEADSET, KEYPOINTS, write_folder

VERSION = 1
CALIBRATIONS = ("optional", "none")


@dataclass(frozen=True, kw_only=True)
class CameraInput:
    """One camera's pictures as the graph takes them.

    Parameters
    ----------
    name
        For example ``"left_eye"``; the graph's inputs are ``pictures_left_eye`` and ``neutral_left_eye``.
    width, height
        Pixels of the pictures.
    mirrored_of
        Camera whose encoder sees this one's pictures mirrored; None where the camera has its own.
    """

    name: str
    width: int
    height: int
    mirrored_of: str | None = None


@dataclass(frozen=True, kw_only=True)
class Temporal:
    """A convolution over the frames before, which may stand behind the network (``regress.runtime.headset.temporal``).

    Parameters
    ----------
    fps
        Frames a second that the taps are for.
    taps
        For each of the 52 weights and the 4 angles of the gaze, how much the frame itself counts and those before it.
    people, dataset_hash
        Whose clips they were chosen on.
    scores
        Figures on other people's clips: of one frame alone, of the mean of as many frames, and of the taps.
    """

    fps: float
    taps: tuple[tuple[float, ...], ...]
    people: int
    dataset_hash: str
    scores: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class HeadsetModel:
    """Description of a trained network; the network itself is network.onnx in the same folder.

    The graph takes for n frames ``pictures_<camera>`` and ``neutral_<camera>`` (n, height, width) uint8,
    ``present`` (n, cameras) and ``calibrated`` (n,) float32, 0 or 1. It gives what ``Estimates`` holds, and for each
    camera that traces points ``points_<camera>`` (n, P, 2): pixels of its pictures, x to the right and y down, whole
    numbers in the pixels' middles; places of points that the picture does not show are guesses.

    Parameters
    ----------
    headset
        Name of the headset's layout.
    cameras
        In the order of ``present`` and ``shares``.
    parts
        For each camera the shapes that it is made to see (``regress.runtime.headset.parts``).
    modulation
        Factor on a camera's share of shapes outside its part (the paper's eq. 6).
    architecture
        One of ``regress.learning.headset.architectures.ARCHITECTURES``.
    calibration
        ``"optional"``: neutral pictures help; ``"none"``: they are not looked at.
    points
        For each camera that traces any, which of ``VIEW_POINTS`` ``points_<camera>`` has; none in older models.
    typical
        For each camera the mean picture of its training (24 x 24 grey levels), by which ``predict`` knows pictures
        that are turned or of another camera (``regress.runtime.headset.typical``); none in older models.
    weights
        Names of the columns of ``weights``, ``deviation`` and ``shares``.
    outputs
        Names of the graph's outputs.
    temporal
        What the frames before add; None until ``regress headset temporal`` has found it.
    training
        Every setting and figure of the training, unrounded.
    scores
        Figures on unseen people (``regress.learning.headset.evaluation``).
    dataset_hash, rig, licences
        Of the data that it learned from.
    network_sha256
        Of network.onnx; empty until the model is written.
    """

    headset: str
    cameras: tuple[CameraInput, ...]
    parts: dict[str, tuple[str, ...]]
    modulation: float
    architecture: str
    calibration: str
    points: dict[str, tuple[str, ...]] = field(default_factory=dict)
    typical: dict[str, tuple[tuple[int, ...], ...]] = field(default_factory=dict)
    weights: tuple[str, ...] = BLENDSHAPES
    outputs: tuple[str, ...] = tuple(GRAPH_OUTPUTS)
    temporal: Temporal | None = None
    training: dict[str, Any] = field(default_factory=dict)
    scores: dict[str, Any] = field(default_factory=dict)
    dataset_hash: str = ""
    rig: str = ""
    licences: tuple[str, ...] = ()
    network_sha256: str = ""

    @property
    def camera_names(self) -> tuple[str, ...]:
        """Names of the cameras, in the order of ``present``."""
        return tuple(camera.name for camera in self.cameras)


def save_headset_model(model: HeadsetModel, graph: bytes, folder: str | os.PathLike[str]) -> HeadsetModel:
    """Write a model folder whole, by one rename.

    Parameters
    ----------
    graph
        Bytes of network.onnx.

    Returns
    -------
    HeadsetModel
        The model as written, with the graph's SHA-256.

    Raises
    ------
    OutputError
        Where the place cannot be written, or holds anything but an older headset model (``check_place``).
    """
    folder = Path(folder)
    text = _text(replace(model, network_sha256=hashlib.sha256(graph).hexdigest()))
    write_folder(folder, HEADSET, {"network.onnx": graph, "model.json": text.encode()})
    return read_headset_model(folder)


def describe_headset_model(model: HeadsetModel, folder: str | os.PathLike[str]) -> HeadsetModel:
    """Write what a model folder says of its network anew; the network and whatever else lies there stay.

    Raises
    ------
    OutputError
        Where it cannot be written.
    """
    path = Path(folder) / "model.json"
    write_whole(path, _text(model))
    return read_headset_model(folder)


def _text(model: HeadsetModel) -> str:
    return (
        json.dumps({"kind": HEADSET.name, "version": VERSION, **asdict(model)}, indent=1, allow_nan=False)
        + "\n"
    )


def read_headset_model(folder: str | os.PathLike[str]) -> HeadsetModel:
    """Read and check model.json; the graph's bytes are checked against its SHA-256.

    Raises
    ------
    ModelError
        Where a file is missing or damaged, or the folder holds a model of another kind or version.
    """
    folder = Path(folder)
    path, graph = folder / "model.json", folder / "network.onnx"
    for needed in (path, graph):
        if needed.is_file():
            continue
        if (folder / "weights.npz").is_file():
            raise ModelError(
                f"{folder} is a model of 68 points; `regress` commands without `headset` take it"
            )
        raise ModelError(
            f"{needed} does not exist; a headset model is a folder with model.json and network.onnx"
        )
    try:
        document = json.loads(path.read_text())
        kind, version = document.pop("kind", KEYPOINTS.name), document.pop("version", None)
    except (ValueError, AttributeError, TypeError, OSError) as error:
        raise ModelError(f"{path} is not a model's description: {error}") from error
    if (kind, version) != (HEADSET.name, VERSION):
        raise ModelError(
            f"{path} describes a model of kind {kind!r}, version {version!r}; "
            f"kind {HEADSET.name!r}, version {VERSION} is needed"
        )
    model = _model(document, path)
    if hashlib.sha256(graph.read_bytes()).hexdigest() != model.network_sha256:
        raise ModelError(f"{graph} is damaged or belongs to another model: its SHA-256 is not model.json's")
    return model


def _model(document: dict[str, Any], path: Path) -> HeadsetModel:
    try:
        cameras = tuple(CameraInput(**camera) for camera in document["cameras"])
        names = [camera.name for camera in cameras]
        model = HeadsetModel(
            **{
                **document,
                "cameras": cameras,
                "parts": {name: tuple(shapes) for name, shapes in document["parts"].items()},
                "points": {name: tuple(points) for name, points in document.get("points", {}).items()},
                "typical": read_typical(document.get("typical", {}), names),
                "weights": tuple(document["weights"]),
                "outputs": tuple(document["outputs"]),
                "temporal": _temporal(document.get("temporal")),
                "licences": tuple(document["licences"]),
            }
        )
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise ModelError(f"{path} is not a headset model's description: {error}") from error
    if model.calibration not in CALIBRATIONS:
        raise ModelError(
            f"{path} has calibration {model.calibration!r}; {' or '.join(CALIBRATIONS)} is needed"
        )
    return model


def _temporal(document: dict[str, Any] | None) -> Temporal | None:
    if document is None:
        return None
    return Temporal(**{**document, "taps": tuple(map(tuple, document["taps"]))})

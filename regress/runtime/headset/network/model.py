"""Describes a trained headset network: its cameras, its outputs, and how it was trained and evaluated."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, ClassVar, Literal

from annotated_types import Ge, Gt, Interval, Le, Len

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, CAMERA_TERMS, VIEW_POINTS
from regress.runtime.headset.network.estimates import GRAPH_OUTPUTS, points_output
from regress.runtime.headset.network.figures import ClipSummary, Evaluation
from regress.runtime.headset.pictures.looks import CameraLooks
from regress.runtime.headset.pictures.typical import TYPICAL_SIDE

GreyRow = Annotated[tuple[Annotated[int, Ge(0), Le(255)], ...], Len(TYPICAL_SIDE, TYPICAL_SIDE)]
GreySquare = Annotated[tuple[GreyRow, ...], Len(TYPICAL_SIDE, TYPICAL_SIDE)]
"""24 x 24 grey levels, whole numbers from 0 to 255."""

Side = Annotated[int, Interval(ge=8, le=8192)]
"""Pixels, as a headset file allows them."""

MOST_CAMERAS = 64
"""Seven times as many as any headset here has; a graph is fed so many blank pictures."""

TAPS = 5
"""The frame itself, and the four before it (the second paper's)."""

MOST_FPS = 10_000
"""Frames a second; no camera of a headset has a tenth of it."""

_CAMERA = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
"""What a camera may be called: files of pictures and inputs of graphs have its name."""

Count = Annotated[int, Ge(0)]
Row = Annotated[tuple[float, ...], Len(TAPS, TAPS)]
Weighted = Annotated[tuple[float, ...], Len(len(BLENDSHAPES), len(BLENDSHAPES))]
Gaze = Annotated[tuple[float, ...], Len(4, 4)]
"""Numbers of yaw and pitch, left and right."""

_OUTPUTS = len(BLENDSHAPES) + 4


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
    width: Side
    height: Side
    mirrored_of: str | None = None

    def __post_init__(self) -> None:
        """Refuse names that are no file's and no graph input's."""
        if not _CAMERA.fullmatch(self.name):
            raise ValueError(
                f"camera {self.name[:60]!r} must be called by up to 64 letters, digits, '_', '-' and '.', a letter or "
                f"digit first"
            )


@dataclass(frozen=True, kw_only=True)
class Temporal:
    """A convolution over the frames before that may stand behind it (``regress.runtime.headset.network.temporal``).

    Parameters
    ----------
    fps
        Frames a second that the taps are for.
    taps
        For each of the 52 weights and the 4 angles of the gaze, how much the frame itself counts and those before it.
    people, dataset_hash
        Whose clips they were chosen on.
    scores
        Figures on other clips: of one frame alone, of the mean of as many frames, and of the taps.
    unseen
        Whether neither the network nor the taps can know the people of these clips; older models do not say.
    """

    fps: Annotated[float, Gt(0), Le(MOST_FPS)]
    taps: Annotated[tuple[Row, ...], Len(_OUTPUTS, _OUTPUTS)]
    people: Count
    dataset_hash: str
    scores: dict[str, ClipSummary] = field(default_factory=dict)
    unseen: bool = False


@dataclass(frozen=True, kw_only=True)
class HeadsetTraining:
    """How a network was trained; unrounded, and as far as it is known.

    Parameters
    ----------
    recipe
        Every setting of ``regress.learning.headset.recipe``, as JSON data.
    data_seed
        Seed of the dataset.
    rows, people
        Frames that it learned from, and of how many people.
    parameters
        Numbers of the network.
    history
        ``loss`` and ``validation`` of each epoch.
    cpu_s
        Processor time.
    resumed_after_epochs
        Epochs that an earlier, stopped training had done.
    began_as
        SHA-256 of the network that it began as; empty where it began with random numbers.
    adapted_from
        SHA-256 of those that it was adapted from, one from the other: their eyes are its own, the last layers are not.
    onnx_difference
        Largest difference between the exported graph and PyTorch.
    deviation_scale, mean_weights, mean_gaze
        Factors on the predicted deviations (56); means of the training frames' weights (52) and gaze angles (4).
    versions
        Of the programs, by name.
    """

    recipe: dict[str, Any] = field(default_factory=dict)
    data_seed: int | None = None
    rows: Count = 0
    people: Count = 0
    parameters: Count | None = None
    history: tuple[dict[str, float], ...] = ()
    cpu_s: float | None = None
    resumed_after_epochs: int = 0
    began_as: str = ""
    adapted_from: Annotated[tuple[str, ...], Len(0, 100)] = ()
    onnx_difference: float | None = None
    deviation_scale: Annotated[tuple[float, ...], Len(_OUTPUTS, _OUTPUTS)] | None = None
    mean_weights: Weighted | None = None
    mean_gaze: Gaze | None = None
    versions: dict[str, str] = field(default_factory=dict)


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
        For each camera the shapes that it is made to see (``regress.runtime.headset.network.parts``).
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
        that are turned or of another camera (``regress.runtime.headset.pictures.typical``); none in older models and in
        those of drawn headsets.
    looks
        For each camera how its training pictures looked, by which `predict` levels others and `check` judges them;
        none in older models.
    camera_terms
        What the network may be told of each camera: ``CAMERA_TERMS`` where it was trained on drawn headsets, else
        nothing. The graph then has an input ``cameras``, which may be left out.
    weights
        Names of the columns of ``weights``, ``deviation`` and ``shares``.
    outputs
        Names of the graph's outputs.
    temporal
        What the frames before add; None until ``regress headset temporal`` has found it.
    training
        How it was trained.
    scores
        Figures on the test split's people (``regress.learning.headset.evaluation``); None where there were none.
    dataset_hash, rig, licences
        Of the data that it learned from.
    network_sha256
        Of network.onnx; empty until the model is written.
    """

    __pydantic_config__: ClassVar[Mapping[str, str]] = {"extra": "forbid"}

    headset: str
    cameras: Annotated[tuple[CameraInput, ...], Len(1, MOST_CAMERAS)]
    parts: dict[str, tuple[str, ...]]
    modulation: float
    architecture: str
    calibration: Literal["optional", "none"]
    points: dict[str, tuple[str, ...]] = field(default_factory=dict)
    typical: dict[str, GreySquare] = field(default_factory=dict)
    looks: dict[str, CameraLooks] = field(default_factory=dict)
    camera_terms: tuple[str, ...] = ()
    weights: tuple[str, ...] = BLENDSHAPES
    outputs: tuple[str, ...] = tuple(GRAPH_OUTPUTS)
    temporal: Temporal | None = None
    training: HeadsetTraining = field(default_factory=HeadsetTraining)
    scores: Evaluation | None = None
    dataset_hash: str = ""
    rig: str = ""
    licences: tuple[str, ...] = ()
    network_sha256: str = ""

    def __post_init__(self) -> None:
        """Refuse what speaks of cameras, shapes, points or outputs that the model does not have."""
        names = self.camera_names
        if len(set(names)) < len(names):
            raise ValueError(f"two cameras have the same name, of {', '.join(names)}")
        if self.weights != BLENDSHAPES:
            raise ValueError("weights must be the 52 names of blendshapes in their order")
        if self.camera_terms not in ((), CAMERA_TERMS):
            raise ValueError("camera_terms must be empty, or the 14 terms of cameras in their order")
        for what, table, known in (
            ("parts", self.parts, BLENDSHAPE_INDEX),
            ("points", self.points, VIEW_POINTS),
            ("typical", dict.fromkeys(self.typical, ()), ()),
            ("looks", dict.fromkeys(self.looks, ()), ()),
        ):
            for name, entries in table.items():
                if name not in names:
                    raise ValueError(f"{what} has {name[:60]!r}, and the cameras are {', '.join(names)}")
                if not set(entries) <= set(known) or len(set(entries)) < len(entries):
                    raise ValueError(f"{what}.{name} names what there is not, or something twice")
        for name, looks in self.looks.items():
            if len(looks.points) not in (0, len(self.points.get(name, ()))):
                raise ValueError(f"looks.{name} has {len(looks.points)} points, and the camera traces others")
        strangers = [
            camera.mirrored_of for camera in self.cameras if camera.mirrored_of not in (None, *names)
        ]
        if strangers:
            raise ValueError(f"cameras mirror {strangers[0][:60]!r}, and the cameras are {', '.join(names)}")
        traced = {points_output(name) for name in self.points}
        if not GRAPH_OUTPUTS.keys() <= set(self.outputs) <= GRAPH_OUTPUTS.keys() | traced:
            needed = ", ".join((*GRAPH_OUTPUTS, *sorted(traced)))
            raise ValueError(f"outputs must be those of {needed}, points alone may be lacking")

    @property
    def of_many_headsets(self) -> bool:
        """Whether it learned of headsets that were drawn: no mean picture or usual place is any headset's of them."""
        return bool(self.camera_terms) and not self.typical

    @property
    def camera_names(self) -> tuple[str, ...]:
        """Names of the cameras, in the order of ``present``."""
        return tuple(camera.name for camera in self.cameras)

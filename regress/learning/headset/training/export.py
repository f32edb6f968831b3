"""Exports a trained network as one ONNX graph, preprocessing included, and checks it against PyTorch."""

import io
import warnings
from collections.abc import Sequence

import numpy as np
import onnx
import torch
from onnx import numpy_helper
from torch import nn

from facegen.conventions import CAMERA_TERMS_MIRRORED
from regress.errors import ModelError
from regress.learning.headset.training.networks import HeadsetNetwork
from regress.learning.headset.training.resampling import resampling_matrix
from regress.learning.headset.training.targets import Targets
from regress.runtime.headset.network.estimates import CAMERA_INPUT, GRAPH_OUTPUTS, TERMS_TOLD, points_output
from regress.runtime.headset.network.model import CameraInput
from regress.runtime.headset.network.outputs import WEIGHTS
from regress.runtime.onnx_session import open_session

TOLERANCE = 1e-4
"""Largest difference between the graph and PyTorch that is let through."""

_OPSET = 17


class Deployed(nn.Module):
    """Pictures as cameras give them to weights, deviations and gaze: what the graph computes."""

    def __init__(
        self,
        network: HeadsetNetwork,
        cameras: tuple[CameraInput, ...],
        targets: Targets,
        square_size: int,
        deviation_scale: np.ndarray,
        calibration: bool,
    ) -> None:
        super().__init__()
        self.network, self.calibration = network, calibration
        self.told = network.encoder(cameras[0].name).told > 0
        mirrored = np.array([*CAMERA_TERMS_MIRRORED, 1], np.float32)
        seen_as = [mirrored if camera.mirrored_of else np.ones_like(mirrored) for camera in cameras]
        self.register_buffer("seen_as", torch.from_numpy(np.stack(seen_as)) if self.told else None)
        self.register_buffer("deviation_std", torch.from_numpy(targets.std * deviation_scale))
        self.register_buffer("mean", torch.from_numpy(targets.mean))
        self.register_buffer("std", torch.from_numpy(targets.std))
        self.cameras, self.square_size = cameras, square_size
        for column, camera in enumerate(cameras):
            rows, columns = (resampling_matrix(side, square_size) for side in (camera.height, camera.width))
            self.register_buffer(f"rows_{column}", torch.from_numpy(rows))
            self.register_buffer(f"columns_{column}", torch.from_numpy(columns.T.copy()))

    def forward(self, *inputs: torch.Tensor) -> tuple[torch.Tensor, ...]:
        """Outputs by ``output_names``; takes what `_probe` lists, in its order."""
        terms = None
        if self.told:
            *inputs, told = inputs
            terms = (told * self.seen_as).expand(inputs[-1].shape[0], -1, -1)
        *seen, present, calibrated = inputs
        if not self.calibration:  # a product, so that the graph keeps the input
            calibrated = 0 * calibrated
        answer = self.network(
            self._squares(seen[0::2]), self._squares(seen[1::2]), present, calibrated, terms
        )
        outputs_mean = answer.blended.mean * self.std + self.mean
        deviation = torch.sqrt(answer.blended.variance) * self.deviation_std
        # yaw and pitch of the left eye, then of the right
        gaze = outputs_mean[:, WEIGHTS:].reshape(-1, 2, 2)
        # the graph's nodes stand in this order
        outputs = {
            "weights": outputs_mean[:, :WEIGHTS].clamp(0, 1),
            "shares": answer.blended.shares[..., :WEIGHTS],
        }
        for camera, positions in zip(self.cameras, answer.positions, strict=True):
            if self._traces(camera):
                outputs[points_output(camera.name)] = self._pixels(camera, positions)
        outputs |= {
            "deviation": deviation[:, :WEIGHTS],
            "gaze": gaze,
            "same_seat": torch.sigmoid(answer.seat),
        }
        return tuple(outputs[name] for name in self.output_names)

    @property
    def output_names(self) -> tuple[str, ...]:
        """Names of the graph's outputs, in order."""
        traced = [points_output(camera.name) for camera in self.cameras if self._traces(camera)]
        return (*GRAPH_OUTPUTS, *traced)

    def _traces(self, camera: CameraInput) -> bool:
        return self.network.encoder(camera.name).tracer is not None

    def _pixels(self, camera: CameraInput, positions: torch.Tensor) -> torch.Tensor:
        """Positions (n, P, 2) that the camera's encoder found, in pixels of the camera's own picture."""
        encoder = self.network.encoder(camera.name)
        across, down = encoder.shares(positions).unbind(2)
        across = across if camera.mirrored_of is None else 1 - across
        return torch.stack([across * camera.width - 0.5, down * camera.height - 0.5], dim=2)

    def _squares(self, pictures: Sequence[torch.Tensor]) -> list[torch.Tensor]:
        return [self._square(column, seen.float()) for column, seen in enumerate(pictures)]

    def _square(self, column: int, seen: torch.Tensor) -> torch.Tensor:
        camera = self.cameras[column]
        if (camera.width, camera.height) != (self.square_size, self.square_size):
            seen = getattr(self, f"rows_{column}") @ seen @ getattr(self, f"columns_{column}")
        return seen if camera.mirrored_of is None else seen.flip(-1)


def export_graph(
    network: HeadsetNetwork,
    cameras: tuple[CameraInput, ...],
    targets: Targets,
    *,
    square_size: int,
    deviation_scale: np.ndarray,
    calibration: bool = True,
) -> tuple[bytes, float]:
    """The graph's bytes, and its largest difference from PyTorch on random frames.

    Parameters
    ----------
    network
        Trained, in evaluation mode.
    cameras, targets, square_size
        What it was trained with.
    deviation_scale : (56,) float32
        Factor on each output's predicted deviation.
    calibration
        Whether it was trained with neutral pictures; otherwise the graph takes ``calibrated`` for 0 whatever is given.

    Raises
    ------
    ModelError
        Where the difference is above ``TOLERANCE``.
    """
    deployed = Deployed(network, cameras, targets, square_size, deviation_scale, calibration).eval()
    names = [f"{kind}_{camera.name}" for camera in cameras for kind in ("pictures", "neutral")]
    names += ["present", "calibrated"]
    by_frame = [*names, *deployed.output_names]
    names += [CAMERA_INPUT] * deployed.told
    buffer = io.BytesIO()
    with warnings.catch_warnings():
        # The exporter that needs no further package is called deprecated, and warns of what tracing fixes.
        warnings.simplefilter("ignore")
        torch.onnx.export(
            deployed,
            _probe(cameras, 2, told=deployed.told),
            buffer,
            input_names=names,
            output_names=list(deployed.output_names),
            dynamic_axes={name: {0: "frames"} for name in by_frame},
            opset_version=_OPSET,
            dynamo=False,
        )
    graph = buffer.getvalue()
    if deployed.told:
        graph = _with_nothing_told(graph, len(cameras))
    difference = _difference(deployed, graph, names, _probe(cameras, 7, told=deployed.told))
    if not difference <= TOLERANCE:
        raise ModelError(
            f"the exported graph differs from PyTorch by {difference:.2g}; {TOLERANCE} is allowed"
        )
    return graph, difference


def _with_nothing_told(graph: bytes, cameras: int) -> bytes:
    """The graph with zeros as the default of what is told of its cameras: programs may leave that input out."""
    model = onnx.load_from_string(graph)
    nothing = np.zeros((cameras, TERMS_TOLD), np.float32)
    model.graph.initializer.append(numpy_helper.from_array(nothing, CAMERA_INPUT))
    return model.SerializeToString()


def _probe(cameras: tuple[CameraInput, ...], count: int, *, told: bool) -> tuple[torch.Tensor, ...]:
    """Random frames, some without a camera, some without a neutral picture; and what is told of the cameras."""
    random = np.random.default_rng(count)
    seen = [
        torch.from_numpy(random.integers(0, 256, (count, camera.height, camera.width), dtype=np.uint8))
        for camera in cameras
        for _ in range(2)
    ]
    present = (random.random((count, len(cameras))) < 0.7).astype(np.float32)
    present[0] = 1
    terms = torch.from_numpy(random.standard_normal((len(cameras), TERMS_TOLD)).astype(np.float32))
    calibrated = torch.from_numpy((np.arange(count) % 2).astype(np.float32))
    return *seen, torch.from_numpy(present), calibrated, *[terms] * told


def _difference(deployed: Deployed, graph: bytes, names: list[str], probe: tuple[torch.Tensor, ...]) -> float:
    with torch.no_grad():
        expected = deployed(*probe)
    feed = {name: value.numpy() for name, value in zip(names, probe, strict=True)}
    given = open_session(graph).run(None, feed)
    # points as shares of the picture: pixels are up to hundreds, and float32 has seven digits
    largest = max(max(camera.width, camera.height) for camera in deployed.cameras)
    scales = [1.0 if name in GRAPH_OUTPUTS else 1 / largest for name in deployed.output_names]
    pairs = zip(given, expected, scales, strict=True)
    return float(max(scale * np.abs(one - other.numpy()).max() for one, other, scale in pairs))

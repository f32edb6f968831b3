"""Gives a network what another one has learned, from that one's model folder: training then goes on from there."""

import re
from collections.abc import Callable, Iterable
from itertools import pairwise
from pathlib import Path

import numpy as np
import onnx
import torch
from onnx import numpy_helper
from torch import nn

from facegen.conventions import VIEW_POINTS
from facegen.documents import read_bytes
from regress.errors import InputError
from regress.learning.headset.training.batches import Batch
from regress.learning.headset.training.networks import Answer, HeadsetNetwork
from regress.learning.headset.training.residuals import residual_names
from regress.learning.headset.training.targets import Targets
from regress.runtime.headset.network.estimates import TERMS_TOLD
from regress.runtime.headset.network.folder import MOST_GRAPH_BYTES, read_headset_model

Answering = Callable[[HeadsetNetwork, Batch], Answer]
"""Runs a network on a batch."""

_PREFIX = "network."
"""Of the network's own parameters in a graph, where what stands round it has names too."""


class LearnedGraph:
    """What a trained graph holds: parameters by name, and the folded kernels of convolutions by their layer.

    Parameters
    ----------
    folder
        A headset model's.

    Raises
    ------
    InputError
        Where its graph cannot be read.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        model = read_headset_model(folder)
        self._cameras = model.camera_names
        owned = [camera.name for camera in model.cameras if camera.mirrored_of is None]
        self.traced = {
            name: np.array([VIEW_POINTS.index(point) for point in model.points.get(name, ())], np.int64)
            for name in owned
        }
        """Which of ``VIEW_POINTS`` it traces, by the camera that owns the encoder."""
        graph = onnx.load_from_string(read_bytes(folder / "network.onnx", most_bytes=MOST_GRAPH_BYTES)).graph
        arrays = {one.name: numpy_helper.to_array(one) for one in graph.initializer}
        # equal tensors are kept once; the other names stand for it
        same = [node for node in graph.node if node.op_type == "Identity" and node.input[0] in arrays]
        arrays |= {node.output[0]: arrays[node.input[0]] for node in same}
        self.targets = Targets(mean=arrays["mean"].copy(), std=arrays["std"].copy())
        self._named = {
            name.removeprefix(_PREFIX): array for name, array in arrays.items() if name.startswith(_PREFIX)
        }
        self._folded = {
            _layer(node.name): tuple(arrays[name] for name in node.input[1:])
            for node in graph.node
            if node.op_type == "Conv" and not node.input[1].startswith(_PREFIX)
        }

    def check_cameras(self, cameras: tuple[str, ...]) -> None:
        """Refuse arrays of other cameras.

        Raises
        ------
        InputError
            Names both.
        """
        if cameras != self._cameras:
            raise InputError(
                f"{self.folder} is of the cameras {', '.join(self._cameras)}, and the arrays are of "
                f"{', '.join(cameras)}; start from a model of the same cameras"
            )

    def give(self, network: HeadsetNetwork, batches: Iterable[Batch], answer: Answering) -> None:
        """Set a network of the same recipe or one of more blocks, which then answers as the graph does.

        Kernels of a graph have the normalisation behind them folded in. It is taken out again with the means and
        spreads that the batches show, so that further training normalises what it finds, and answers stay.

        Parameters
        ----------
        batches
            Plain frames of the training.
        answer
            ``answer(network, batch)`` runs the network.

        Raises
        ------
        InputError
            Where the network and the graph have not the same parameters, but for blocks, or of other shapes.
        """
        state = network.state_dict()
        with torch.no_grad():
            for name, array in self._named.items():
                array = _with_room_for_terms(array, state.get(name))
                self._check(name, state, array.shape)
                state[name].copy_(_tensor(array))
            # blocks that the graph lacks do nothing as yet
            new = residual_names(network) - self._folded.keys()
            pairs = [pair for pair in _normalised(network) if pair[0] not in new]
            if unknown := self._folded.keys() ^ {name for name, _, _ in pairs}:
                raise InputError(
                    f"{self.folder} and the network to train do not both have the layer {min(unknown)}; start from a "
                    "model of the same cameras and recipe"
                )
            for name, convolution, normalisation in pairs:
                kernel, bias = self._folded[name]
                self._check(f"{name}.weight", state, kernel.shape)
                convolution.weight.copy_(_tensor(kernel))
                _as_folded(normalisation, _tensor(bias))
            _unfold(network, [normalisation for _, _, normalisation in pairs], batches, answer)

    def _check(self, name: str, state: dict[str, torch.Tensor], shape: tuple[int, ...]) -> None:
        if name not in state or tuple(state[name].shape) != tuple(shape):
            has = "none" if name not in state else list(state[name].shape)
            raise InputError(
                f"{self.folder} has {name} of {list(shape)}, and the network to train {has}; start from a model of the "
                f"same cameras and recipe"
            )


def _with_room_for_terms(array: np.ndarray, place: torch.Tensor | None) -> np.ndarray:
    """A layer's weights with zeros for what is told of cameras, where the graph is told nothing and the network is."""
    if place is None or array.ndim != 2 or tuple(place.shape) != (len(array), array.shape[1] + TERMS_TOLD):
        return array
    return np.pad(array, ((0, 0), (0, TERMS_TOLD)))


def _normalised(network: nn.Module) -> Iterable[tuple[str, nn.Conv2d, nn.BatchNorm2d]]:
    """Convolutions with a normalisation behind them, and what the graph calls them."""
    for name, layer in network.named_modules():
        children = list(layer.named_children())
        for (own, first), (_, second) in pairwise(children):
            if isinstance(first, nn.Conv2d) and isinstance(second, nn.BatchNorm2d):
                yield f"{name}.{own}", first, second


def _layer(node: str) -> str:
    """``encoders.left_eye.convolutions.0.0`` of ``/network/left_eye/convolutions.0/convolutions.0.0_1/Conv``."""
    path: list[str] = []
    # a layer that is used again, for the neutral picture, has a number behind its name
    for part in re.sub(r"_\d+/Conv$", "/Conv", node).split("/")[2:-1]:
        if path and part.startswith(f"{path[-1]}."):
            path[-1] = part
        else:
            path.append(part)
    return ".".join(["encoders", *path])


def _as_folded(normalisation: nn.BatchNorm2d, bias: torch.Tensor) -> None:
    """Let a normalisation add a bias and do nothing else."""
    normalisation.running_mean.zero_()
    normalisation.running_var.fill_(1)
    normalisation.weight.fill_((1 + normalisation.eps) ** 0.5)
    normalisation.bias.copy_(bias)


def _unfold(
    network: nn.Module, layers: list[nn.BatchNorm2d], batches: Iterable[Batch], answer: Answering
) -> None:
    """Give normalisations the means and spreads of what reaches them, and answers that stay the same."""
    sums = {layer: [torch.zeros(layer.num_features) for _ in range(2)] + [0] for layer in layers}

    def watch(layer: nn.BatchNorm2d, inputs: tuple[torch.Tensor, ...]) -> None:
        seen = inputs[0]
        total = sums[layer]
        total[0] += seen.sum(dim=(0, 2, 3))
        total[1] += seen.square().sum(dim=(0, 2, 3))
        total[2] += seen.numel() // layer.num_features

    hooks = [layer.register_forward_pre_hook(watch) for layer in layers]
    network.eval()
    for batch in batches:
        answer(network, batch)
    for hook in hooks:
        hook.remove()
    for layer, (total, squares, count) in sums.items():
        mean = total / count
        variance = (squares / count - mean.square()).clamp(min=1e-6)
        layer.running_mean.copy_(mean)
        layer.running_var.copy_(variance)
        layer.weight.copy_((variance + layer.eps).sqrt())
        layer.bias.add_(mean)


def _tensor(array: np.ndarray) -> torch.Tensor:
    return torch.from_numpy(array.copy())

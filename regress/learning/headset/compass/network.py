"""The compass's networks, and their graph."""

import io
import warnings
from collections.abc import Iterable, Mapping

import numpy as np
import onnx
import torch
from torch import nn

from regress.errors import ModelError
from regress.runtime.headset.placing.compass import COMPASS_SIDE, ORIENTATIONS
from regress.runtime.onnx_session import open_session

_CHANNELS = (24, 48, 64, 96)
_HIDDEN = 96
_DROPOUT = 0.3
_TOLERANCE = 1e-4
_OPSET = 17


class Compass(nn.Module):
    """A member: grey views (n, 64, 64) to logarithms of orientations' shares (n, 8), whatever levels and contrast."""

    def __init__(self) -> None:
        super().__init__()
        layers: list[nn.Module] = []
        channels, side = 1, COMPASS_SIDE
        for step, wider in enumerate(_CHANNELS):
            kernel = 5 if step == 0 else 3
            layers += _layer(channels, wider, kernel, stride=2)
            if step:
                layers += _layer(wider, wider, 3, stride=1)
            channels, side = wider, side // 2
        self.features = nn.Sequential(*layers)
        self.head = nn.Sequential(
            nn.Dropout(_DROPOUT),
            nn.Linear(channels * side**2, _HIDDEN),
            nn.ReLU(),
            nn.Linear(_HIDDEN, ORIENTATIONS),
            nn.LogSoftmax(dim=1),
        )

    def forward(self, views: torch.Tensor) -> torch.Tensor:
        """(n, 8) float32."""
        views = views.float()
        mean = views.mean(dim=(1, 2), keepdim=True)
        spread = (views - mean).square().mean(dim=(1, 2), keepdim=True).sqrt()
        return self.head(self.features(((views - mean) / (spread + 0.5))[:, None]).flatten(1))


class MeanCompass(nn.Module):
    """Members whose logarithms are averaged."""

    def __init__(self, members: Iterable[Compass]) -> None:
        super().__init__()
        self.members = nn.ModuleList(members)

    def forward(self, views: torch.Tensor) -> torch.Tensor:
        """(n, 8) float32: their exponentials sum up to 1 at most."""
        return torch.stack([member(views) for member in self.members]).mean(dim=0)


def _layer(channels: int, wider: int, kernel: int, *, stride: int) -> list[nn.Module]:
    return [
        nn.Conv2d(channels, wider, kernel, stride=stride, padding=kernel // 2, bias=False),
        nn.BatchNorm2d(wider),
        nn.ReLU(),
    ]


def compass_graph(compass: MeanCompass, about: Mapping[str, str]) -> bytes:
    """An .onnx file: ``views`` (n, 64, 64) uint8 in, ``log_shares`` (n, 8) float32 out.

    Parameters
    ----------
    compass
        Trained, in evaluation mode.
    about
        What the file says of itself (``metadata_props``): data and their licence, seed, versions.

    Raises
    ------
    ModelError
        Where it does not say what the networks say.
    """
    probe = torch.from_numpy(
        np.random.default_rng(0).integers(0, 256, (5, COMPASS_SIDE, COMPASS_SIDE), dtype=np.uint8)
    )
    buffer = io.BytesIO()
    with warnings.catch_warnings():
        # the exporter that needs no further package is called deprecated
        warnings.simplefilter("ignore")
        torch.onnx.export(
            compass,
            (probe[:2],),
            buffer,
            input_names=["views"],
            output_names=["log_shares"],
            dynamic_axes={"views": {0: "views"}, "log_shares": {0: "views"}},
            opset_version=_OPSET,
            dynamo=False,
        )
    model = onnx.load_from_string(buffer.getvalue())
    onnx.helper.set_model_props(model, dict(about))
    graph = model.SerializeToString()
    (given,) = open_session(graph).run(None, {"views": probe.numpy()})
    with torch.no_grad():
        difference = float(np.abs(given - compass(probe).numpy()).max())
    if not difference <= _TOLERANCE:
        raise ModelError(
            f"the compass's graph differs from PyTorch by {difference:.2g}; {_TOLERANCE} is allowed"
        )
    return graph

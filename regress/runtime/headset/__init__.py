"""Networks that see the pictures of a headset's cameras; training alone needs PyTorch (the extra ``headset``)."""

from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.folder import read_headset_model, save_headset_model
from regress.runtime.headset.network.graph import HeadsetGraph
from regress.runtime.headset.network.model import CameraInput, HeadsetModel
from regress.runtime.headset.network.outputs import GAZE_OUTPUTS

__all__ = [
    "GAZE_OUTPUTS",
    "CameraInput",
    "Estimates",
    "HeadsetGraph",
    "HeadsetModel",
    "read_headset_model",
    "save_headset_model",
]

"""Networks that see the pictures of a headset's cameras; training alone needs PyTorch (the extra ``headset``)."""

from regress.runtime.headset.estimates import Estimates
from regress.runtime.headset.folder import read_headset_model, save_headset_model
from regress.runtime.headset.graph import HeadsetGraph
from regress.runtime.headset.model import CameraInput, HeadsetModel
from regress.runtime.headset.outputs import GAZE_OUTPUTS

__all__ = [
    "GAZE_OUTPUTS",
    "CameraInput",
    "Estimates",
    "HeadsetGraph",
    "HeadsetModel",
    "read_headset_model",
    "save_headset_model",
]

"""What a frame passes through: each stage takes one sample and gives one, live or in a file's loop."""

from regress.runtime.stages.networks import AutomaticCalibration, LandmarkConfidence, LandmarkNetworks
from regress.runtime.stages.output import Output
from regress.runtime.stages.smoothing import OneEuro
from regress.runtime.stages.soundness import Soundness
from regress.runtime.stages.stage import Chain, Stage

__all__ = [
    "AutomaticCalibration",
    "Chain",
    "LandmarkConfidence",
    "LandmarkNetworks",
    "OneEuro",
    "Output",
    "Soundness",
    "Stage",
]

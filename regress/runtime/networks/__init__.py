"""Many small networks side by side: how they run."""

from regress.runtime.networks.denoising import Denoising
from regress.runtime.networks.folded import FoldedNetworks, evaluate, shifted

__all__ = ["Denoising", "FoldedNetworks", "evaluate", "shifted"]

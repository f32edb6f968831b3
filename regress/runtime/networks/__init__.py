"""Runs many small networks side by side."""

from regress.runtime.networks.denoising import Denoising
from regress.runtime.networks.folded import FoldedNetworks, evaluate, shifted

__all__ = ["Denoising", "FoldedNetworks", "evaluate", "shifted"]

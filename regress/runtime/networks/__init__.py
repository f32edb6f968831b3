"""Runs many small networks side by side."""

from regress.runtime.networks.denoising import LEVELS, Denoising
from regress.runtime.networks.folded import FoldedNetworks, evaluate, shifted

__all__ = ["LEVELS", "Denoising", "FoldedNetworks", "evaluate", "shifted"]

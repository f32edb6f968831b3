"""Trains headset networks: the one package that imports PyTorch (the extra ``headset``)."""

from regress.learning.headset.training.run import train_headset

__all__ = ["train_headset"]

"""Trains the compass that tells how an eye lies in pictures of any camera; imports PyTorch (the extra ``headset``)."""

from regress.learning.headset.compass.run import train_compass

__all__ = ["train_compass"]

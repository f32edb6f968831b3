"""Trained models: what they hold, what they predict, and their folders on disk."""

from regress.model.fast import FastPredictor
from regress.model.folder import load_model, save_model
from regress.model.model import Calibrated, Model, Normalisation
from regress.model.place import HEADSET, KEYPOINTS, check_place, write_folder
from regress.model.symmetry import symmetrised

__all__ = [
    "HEADSET",
    "KEYPOINTS",
    "Calibrated",
    "FastPredictor",
    "Model",
    "Normalisation",
    "check_place",
    "load_model",
    "save_model",
    "symmetrised",
    "write_folder",
]

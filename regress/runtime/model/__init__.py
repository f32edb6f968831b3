"""Trained models: what they hold, what they predict, and their folders on disk."""

from regress.runtime.model.fast import FastPredictor
from regress.runtime.model.folder import load_model, save_model
from regress.runtime.model.model import Calibrated, Model, Normalisation
from regress.runtime.model.place import HEADSET, KEYPOINTS, check_place, licences_beside, write_folder
from regress.runtime.model.record import Regression, Scores, TrainingRecord
from regress.runtime.model.symmetry import symmetrised

__all__ = [
    "HEADSET",
    "KEYPOINTS",
    "Calibrated",
    "FastPredictor",
    "Model",
    "Normalisation",
    "Regression",
    "Scores",
    "TrainingRecord",
    "check_place",
    "licences_beside",
    "load_model",
    "save_model",
    "symmetrised",
    "write_folder",
]

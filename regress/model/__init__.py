"""Trained models: what they hold, what they predict, and their folders on disk."""

from regress.model.fast import FastPredictor
from regress.model.folder import check_place, load_model, save_model
from regress.model.model import Calibrated, Model, Normalisation
from regress.model.symmetry import symmetrised

__all__ = [
    "Calibrated",
    "FastPredictor",
    "Model",
    "Normalisation",
    "check_place",
    "load_model",
    "save_model",
    "symmetrised",
]

"""Trains models on facegen datasets: splits, z-scores, 31 networks, baselines, scores."""

from regress.learning.training.dataset import KeypointDataset, read_dataset
from regress.learning.training.detectors import for_detector
from regress.learning.training.recipes import RECIPES, Recipe
from regress.learning.training.run import train
from regress.learning.training.scores import evaluate_model, score
from regress.runtime.model import Scores

__all__ = [
    "RECIPES",
    "KeypointDataset",
    "Recipe",
    "Scores",
    "evaluate_model",
    "for_detector",
    "read_dataset",
    "score",
    "train",
]

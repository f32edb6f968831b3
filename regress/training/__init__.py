"""From a facegen dataset to a model: splits, z-scores, 31 networks, baselines, scores."""

from regress.training.dataset import KeypointDataset, read_dataset
from regress.training.recipes import RECIPES, Recipe
from regress.training.run import train
from regress.training.scores import Scores, evaluate_model, score

__all__ = [
    "RECIPES",
    "KeypointDataset",
    "Recipe",
    "Scores",
    "evaluate_model",
    "read_dataset",
    "score",
    "train",
]

"""Finds the trained models that come with the package, by name."""

import os
from importlib import resources
from pathlib import Path

FOLDER = Path(str(resources.files("regress") / "models"))
"""A folder for each: model.json, weights.npz or network.onnx, and CARD.md for people."""

LANDMARKS = "landmarks-default"
"""What `regress predict` takes where no model is given: the networks of `make train`."""

HEADSET = "headset-tracking3"
"""What `regress headset predict` takes where no model is given: the networks of `make headset`."""


def ready_made_models() -> dict[str, Path]:
    """Folders of the models that this installation has, by name."""
    return {path.parent.name: path.parent for path in sorted(FOLDER.glob("*/model.json"))}


def ready_made_names() -> str:
    """Names of the ready-made models, for a sentence: those of landmarks, and those of headsets."""
    of_headsets = {name: (folder / "network.onnx").is_file() for name, folder in ready_made_models().items()}
    landmarks = ", ".join(name for name, headset in of_headsets.items() if not headset)
    return (
        f"{landmarks}, or of headsets {', '.join(name for name, headset in of_headsets.items() if headset)}"
    )


def model_folder(model: str | os.PathLike[str]) -> Path:
    """The folder itself where it exists, or that of a model.json, else that of the ready-made model of this name."""
    folder = Path(model)
    if folder.name == "model.json" and folder.is_file():
        return folder.parent
    return folder if folder.exists() else ready_made_models().get(os.fspath(model), folder)

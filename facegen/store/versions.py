"""Compares the versions of what made a dataset with those of what goes on with it: two Blenders render two pictures."""

import importlib.metadata
from collections.abc import Sequence
from pathlib import Path

from facegen import __version__
from facegen.errors import InputError
from facegen.store.dataset import Dataset
from facegen.store.description import read_description

PACKAGES = ("numpy", "scipy", "pyarrow", "bpy", "OpenEXR")
BLENDER = "bpy"


def installed_versions() -> dict[str, str]:
    """Versions of what makes data here; OpenCV's is its own word, as any of its four distributions will do."""
    import cv2  # where a dataset begins, not where one is read

    installed = {name: importlib.metadata.version(name) for name in PACKAGES}
    return {"facegen": __version__, **installed, "opencv": cv2.__version__}


def check_renderer(dataset: Dataset) -> None:
    """Refuse to render into a dataset that another version of Blender was begun with.

    Raises
    ------
    InputError
        If ``dataset.json`` names another version than the installed one.
    """
    began, here = (
        read_description(dataset.folder)["versions"].get(BLENDER),
        importlib.metadata.version(BLENDER),
    )
    if began not in (None, here):
        raise InputError(
            f"{dataset.folder.path}: was begun with Blender {began}, and here is {here}, whose pictures may differ; "
            f"install bpy=={began} to go on, or choose another folder"
        )


def check_renderers(datasets: Sequence[Dataset]) -> None:
    """Refuse to join pictures of two versions of Blender.

    Raises
    ------
    InputError
        If two of the datasets name two versions.
    """
    found: dict[str, Path] = {}
    for dataset in datasets:
        version = read_description(dataset.folder)["versions"].get(BLENDER)
        if version is not None:
            found.setdefault(version, dataset.folder.path)
    if len(found) > 1:
        (one, first), (other, second), *_ = found.items()
        raise InputError(
            f"{second}: was made with Blender {other}, and {first} with {one}, and pictures of two versions may "
            "differ; join runs of one version, and render the others again with it"
        )


def version_note(dataset: Dataset) -> str:
    """A sentence on versions that are others than a dataset was begun with; nothing where all are the same."""
    began, here = read_description(dataset.folder)["versions"], installed_versions()
    others = [name for name in here if began.get(name, here[name]) != here[name]]
    words = ", ".join(f"{name} {began[name]} (here {here[name]})" for name in others)
    what = "what is made now may differ from what is there in last bits"
    return f"{dataset.folder.path}: was begun with {words}; {what}" if others else ""

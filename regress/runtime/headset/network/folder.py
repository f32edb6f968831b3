"""Writes and reads the folder of a headset network: model.json beside network.onnx."""

import hashlib
import json
import os
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from facegen.documents import read_bytes
from facegen.files import write_whole
from regress.errors import InputError, ModelError
from regress.runtime.documents import checked, read_document
from regress.runtime.headset.network.figures import evaluation_from_json, evaluation_to_json
from regress.runtime.headset.network.model import HeadsetModel
from regress.runtime.model import HEADSET, KEYPOINTS, licences_beside, write_folder
from regress.runtime.ready_made import ready_made_names

VERSION = 1

MOST_GRAPH_BYTES = 2**28
"""Of network.onnx: eighty times the largest network that the recipes make."""


def save_headset_model(
    model: HeadsetModel,
    graph: bytes,
    folder: str | os.PathLike[str],
    *,
    data: str | os.PathLike[str] | None = None,
) -> HeadsetModel:
    """Write a model folder whole, by one rename.

    Parameters
    ----------
    graph
        Bytes of network.onnx.
    data
        Folder that it learned from; its ``LICENSE.txt`` comes along.

    Returns
    -------
    HeadsetModel
        The model as written, with the graph's SHA-256.

    Raises
    ------
    OutputError
        Where the place cannot be written, or holds anything but an older headset model (``check_place``).
    """
    folder = Path(folder)
    text = _text(replace(model, network_sha256=hashlib.sha256(graph).hexdigest()))
    licences = {} if data is None else licences_beside(data)
    write_folder(folder, HEADSET, {"network.onnx": graph, "model.json": text.encode(), **licences})
    return read_headset_model(folder)


def describe_headset_model(model: HeadsetModel, folder: str | os.PathLike[str]) -> HeadsetModel:
    """Write what a model folder says of its network anew; the network and whatever else lies there stay.

    Raises
    ------
    OutputError
        Where it cannot be written.
    """
    path = Path(folder) / "model.json"
    write_whole(path, _text(model))
    return read_headset_model(folder)


def read_headset_model(folder: str | os.PathLike[str]) -> HeadsetModel:
    """Read and check model.json; the graph's bytes are checked against its SHA-256.

    Raises
    ------
    ModelError
        Where a file is missing or damaged, or the folder holds a model of another kind or version.
    """
    folder = Path(folder)
    path, graph = folder / "model.json", folder / "network.onnx"
    for needed in (path, graph):
        if needed.is_file():
            continue
        if (folder / "weights.npz").is_file():
            raise ModelError(
                f"{folder} is a model of 68 points; `regress` commands without `headset` take it"
            )
        raise ModelError(
            f"{needed} does not exist; a headset model is a folder with model.json and network.onnx, or the name of a "
            f"ready-made one: {ready_made_names()}"
        )
    try:
        document = read_document(path)
    except InputError as error:
        raise ModelError(f"{path} is not a model's description: {error}") from error
    try:
        content = read_bytes(graph, most_bytes=MOST_GRAPH_BYTES)
    except InputError as error:
        raise ModelError(str(error)) from error
    kind, version = document.pop("kind", KEYPOINTS.name), document.pop("version", None)
    if (kind, version) != (HEADSET.name, VERSION):
        raise ModelError(
            f"{path} describes a model of kind {kind!r}, version {version!r}; "
            f"kind {HEADSET.name!r}, version {VERSION} is needed"
        )
    model = _model(document, path)
    if hashlib.sha256(content).hexdigest() != model.network_sha256:
        raise ModelError(f"{graph} is damaged or belongs to another model: its SHA-256 is not model.json's")
    return model


def _text(model: HeadsetModel) -> str:
    document = asdict(model)
    document["scores"] = {} if model.scores is None else evaluation_to_json(model.scores)
    return (
        json.dumps({"kind": HEADSET.name, "version": VERSION, **document}, indent=1, allow_nan=False) + "\n"
    )


def _model(document: dict[str, Any], path: Path) -> HeadsetModel:
    scores = document.get("scores")
    try:
        return checked(HeadsetModel, {**document, "scores": evaluation_from_json(scores) if scores else None})
    except InputError as error:
        raise ModelError(f"{path} is not a headset model's description: {error}") from error

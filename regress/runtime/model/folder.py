"""Writes and reads a model folder: model.json and weights.npz, no pickle, equal bytes for equal models."""

import dataclasses
import hashlib
import io
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.errors import InputError, ModelError
from regress.runtime.documents import checked
from regress.runtime.features import Features
from regress.runtime.model.model import Calibrated, Model, Normalisation
from regress.runtime.model.place import KEYPOINTS, write_folder
from regress.runtime.model.record import TrainingRecord, record_to_json
from regress.runtime.networks import Denoising, FoldedNetworks
from regress.runtime.ready_made import model_folder
from regress.targets import Network, observability

SCHEMAS = (1, 2, 3, 4)
"""Those read; the last one is written. 1 knows no array ``depth``: its readers would take turned heads as they are. 2
knows no arrays ``denoising_*``: its readers would show networks what they cannot read. 3 knows no surplus: its readers
would take a face unlike those trained on for one without noise."""

_CALIBRATED = "calibrated_"
"""Begins the names of the arrays that compare with a neutral frame."""


_DENOISING = "denoising_"
"""Begins the names of the arrays that shrink features."""

_INFERENCE = (
    "clip(w2 tanh(w1 features + b1) + b2, 0, 1); features are raw, z-scores are folded in",
    "clip(w2 tanh(w1 p + b1) + b2, 0, 1) with p = (axes x + offset) signal / (signal + noise), x = features less "
    "origin, noise = the mean square of noise_axes x, or surplus (axes x)^2 - usual where that is larger, plus "
    "least (arrays denoising_*); features are raw",
)
"""Of networks that see features, and of those that see what denoising leaves of them."""


def save_model(model: Model, folder: str | os.PathLike[str]) -> None:
    """Write a model folder whole, by one rename; equal models give equal bytes.

    Raises
    ------
    OutputError
        Where the place cannot be written, or holds anything but an older model of 68 points (``check_place``).
    """
    weights = _weights_bytes(model)
    text = json.dumps(_document(model, hashlib.sha256(weights).hexdigest()), indent=1, allow_nan=False) + "\n"
    write_folder(Path(folder), KEYPOINTS, {"weights.npz": weights, "model.json": text.encode()})


def load_model(folder: str | os.PathLike[str]) -> Model:
    """Read a model folder, or the ready-made model of that name.

    Raises
    ------
    ModelError
        Where model.json or weights.npz is missing, damaged or does not belong to the other.
    """
    folder = model_folder(folder)
    document_path, weights_path = folder / "model.json", folder / "weights.npz"
    for path in (document_path, weights_path):
        if path.is_file():
            continue
        if (folder / "network.onnx").is_file():
            raise ModelError(f"{folder} is a model of headset pictures; `regress headset` commands take it")
        raise ModelError(f"{path} does not exist; a model is a folder with model.json and weights.npz")
    document = _read_document(document_path)
    weights = weights_path.read_bytes()
    if hashlib.sha256(weights).hexdigest() != document.weights_sha256:
        raise ModelError(
            f"{weights_path} is damaged or belongs to another model: its SHA-256 is not model.json's"
        )
    with np.load(io.BytesIO(weights), allow_pickle=False) as arrays:
        return _model(document, {name: arrays[name] for name in arrays.files}, weights_path)


@dataclass(frozen=True, kw_only=True)
class _FeaturesDocument:
    alignment: Literal["affine", "none"]
    edges: list[tuple[int, int]]
    reference_name: str
    reference_sha256: str


@dataclass(frozen=True, kw_only=True)
class _Document:
    """What is read of model.json; the rest of it is for people."""

    recipe: str
    networks: tuple[Network, ...]
    features: _FeaturesDocument
    weights_sha256: str
    record: TrainingRecord | None


def _read_document(path: Path) -> _Document:
    try:
        document = json.loads(path.read_text())
        schema = document["schema"]
    except (ValueError, KeyError, TypeError, OSError) as error:
        raise ModelError(f"{path} is not a model's description: {error}") from error
    if schema not in SCHEMAS:
        raise ModelError(
            f"{path} has schema {schema!r}; this version reads {' and '.join(map(str, SCHEMAS))}"
        )
    try:
        return checked(_Document, {**document, "record": document.get("record") or None})
    except InputError as error:
        raise ModelError(f"{path} is not a model's description: {error}") from error


def _document(model: Model, weights_sha256: str) -> dict[str, Any]:
    return {
        "schema": SCHEMAS[-1],
        "recipe": model.recipe,
        "blendshapes": list(BLENDSHAPES),
        "networks": [dataclasses.asdict(network) for network in model.table],
        "observability": {name: observability(name) for name in BLENDSHAPES},
        "hidden": model.networks.hidden,
        "features": {
            "kind": "edge lengths over face width",
            "alignment": model.features.alignment,
            "turn": "undone by the array depth" if model.features.depth is not None else "left as it is",
            "edges": model.features.edges.tolist(),
            "reference_name": model.features.reference_name,
            "reference_sha256": model.features.reference_sha256,
        },
        "inference": _INFERENCE[model.networks.denoising is not None],
        "calibrated": model.calibrated is not None
        and "the same with the arrays calibrated_*, on features less the neutral frame's",
        "weights_sha256": weights_sha256,
        "record": record_to_json(model.record),
    }


def _arrays(model: Model) -> dict[str, np.ndarray]:
    arrays = {**_fields(model.networks), **_fields(model.normalisation)}
    if model.calibrated is not None:
        calibrated = {**_fields(model.calibrated.networks), **_fields(model.calibrated.normalisation)}
        arrays |= {_CALIBRATED + name: array for name, array in calibrated.items()}
    depth = {} if model.features.depth is None else {"depth": model.features.depth}
    return {**arrays, "mean_shape": model.features.mean_shape, **depth}


def _fields(record: FoldedNetworks | Normalisation | Denoising) -> dict[str, np.ndarray]:
    values = {field.name: getattr(record, field.name) for field in dataclasses.fields(record)}
    denoising = values.pop("denoising", None)
    if denoising is not None:
        values |= {_DENOISING + name: array for name, array in _fields(denoising).items()}
    return values


def _weights_bytes(model: Model) -> bytes:
    buffer = io.BytesIO()
    np.savez(buffer, **_arrays(model))  # stored, not compressed, with 1980 as every entry's date: equal bytes
    return buffer.getvalue()


def _model(document: _Document, arrays: dict[str, np.ndarray], path: Path) -> Model:
    try:
        return Model(
            recipe=document.recipe,
            table=document.networks,
            features=Features(
                alignment=document.features.alignment,
                mean_shape=arrays["mean_shape"],
                edges=np.array(document.features.edges, dtype=np.int64),
                reference_name=document.features.reference_name,
                reference_sha256=document.features.reference_sha256,
                depth=arrays.get("depth"),
            ),
            normalisation=_taken(Normalisation, arrays),
            networks=_networks(arrays),
            record=document.record,
            calibrated=_calibrated(arrays),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ModelError(f"{path} lacks a part of the model: {error}") from error


def _calibrated(arrays: dict[str, np.ndarray]) -> Calibrated | None:
    named = {
        name.removeprefix(_CALIBRATED): array
        for name, array in arrays.items()
        if name.startswith(_CALIBRATED)
    }
    if not named:
        return None
    return Calibrated(normalisation=_taken(Normalisation, named), networks=_networks(named))


def _networks(arrays: dict[str, np.ndarray]) -> FoldedNetworks:
    named = {
        name.removeprefix(_DENOISING): array for name, array in arrays.items() if name.startswith(_DENOISING)
    }
    if named and "surplus" not in named:  # schema 3
        named |= {"surplus": np.zeros(len(named["axes"])), "usual": np.zeros(())}
    return _taken(FoldedNetworks, {**arrays, "denoising": _taken(Denoising, named) if named else None})


def _taken(kind: type, arrays: dict[str, np.ndarray]) -> Any:
    return kind(**{field.name: arrays[field.name] for field in dataclasses.fields(kind)})

"""Writes and reads a model folder: model.json and weights.npz, no pickle, equal bytes for equal models."""

import dataclasses
import hashlib
import io
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Len, Lt

from facegen.archives import MOST_BYTES, parse_npz
from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from facegen.documents import read_bytes
from regress.errors import InputError, ModelError
from regress.runtime.documents import checked, read_document
from regress.runtime.features import ALIGNMENTS, Features
from regress.runtime.model.arrays import CALIBRATED, DENOISING, YOUNGER, Sizes, array_fault
from regress.runtime.model.model import Calibrated, Model, Normalisation
from regress.runtime.model.place import KEYPOINTS, licences_beside, write_folder
from regress.runtime.model.record import TrainingRecord, record_to_json
from regress.runtime.networks import Denoising, FoldedNetworks
from regress.runtime.ready_made import model_folder, ready_made_names
from regress.targets import Network, observability

SCHEMAS = (1, 2, 3, 4, 5)
"""Those read; the last one is written, or for models of lengths alone the one before. 1 knows no array ``depth``: its
readers would take turned heads as they are. 2 knows no arrays ``denoising_*``: its readers would show networks what
they cannot read. 3 knows no surplus: its readers would take a face unlike those trained on for one without noise. 4
knows no features that are points, and none that the calibrated networks have to themselves."""

_INFERENCE = (
    "clip(w2 tanh(w1 features + b1) + b2, 0, 1); features are raw, z-scores are folded in",
    "clip(w2 tanh(w1 p + b1) + b2, 0, 1) with p = (axes x + offset) signal / (signal + noise), x = features less "
    "origin, noise = the mean square of noise_axes x, or surplus (axes x)^2 - usual where that is larger, plus "
    "least (arrays denoising_*); features are raw",
)
"""Of networks that see features, and of those that see what denoising leaves of them."""


def save_model(
    model: Model, folder: str | os.PathLike[str], *, data: str | os.PathLike[str] | None = None
) -> None:
    """Write a model folder whole, by one rename; equal models give equal bytes.

    Where ``data``, the folder that it learned from, has a ``LICENSE.txt``, the model's folder gets that too.

    Raises
    ------
    OutputError
        Where the place cannot be written, or holds anything but an older model of 68 points (``check_place``).
    """
    licences = {} if data is None else licences_beside(data)
    weights = _weights_bytes(model)
    text = json.dumps(_document(model, hashlib.sha256(weights).hexdigest()), indent=1, allow_nan=False) + "\n"
    write_folder(Path(folder), KEYPOINTS, {"weights.npz": weights, "model.json": text.encode(), **licences})


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
        raise ModelError(
            f"{path} does not exist; a model is a folder with model.json and weights.npz, or the name of a ready-made "
            f"one: {ready_made_names()}"
        )
    document = _read_document(document_path)
    arrays = _read_arrays(weights_path, document.weights_sha256)
    sizes = Sizes(
        features=document.features.count,
        outputs=[len(network.outputs) for network in document.networks],
        calibrated_features=(document.calibrated_features or document.features).count,
    )
    fault = array_fault(arrays, sizes)
    if fault is not None:
        raise ModelError(f"{weights_path} {fault}; train or export the model again")
    return _model(document, arrays)


def _read_arrays(path: Path, sha256: str) -> dict[str, np.ndarray]:
    try:
        weights = read_bytes(path, most_bytes=MOST_BYTES)
        if hashlib.sha256(weights).hexdigest() == sha256:
            return parse_npz(weights, where=str(path))
    except InputError as error:
        raise ModelError(str(error)) from error
    raise ModelError(f"{path} is damaged or belongs to another model: its SHA-256 is not model.json's")


_Landmark = Annotated[int, Ge(0), Lt(LANDMARK_COUNT)]


@dataclass(frozen=True, kw_only=True)
class _FeaturesDocument:
    alignment: Literal[ALIGNMENTS]
    edges: Annotated[list[tuple[_Landmark, _Landmark]], Len(0, LANDMARK_COUNT * (LANDMARK_COUNT - 1) // 2)]
    reference_name: str
    reference_sha256: str
    turn: Literal["undone by the array depth", "left as it is"] | None = None

    @property
    def count(self) -> int:
        """How many numbers a face becomes."""
        return 2 * LANDMARK_COUNT if self.alignment == "stable" else len(self.edges)

    def __post_init__(self) -> None:
        """Refuse edges from a landmark to itself, turned ones, those that come twice, and too few or too many."""
        if (self.alignment == "stable") == bool(self.edges):
            raise ValueError('edges must be there, but behind the alignment "stable", which has none')
        if not all(first < second for first, second in self.edges) or len(set(self.edges)) < len(self.edges):
            raise ValueError("edges must be pairs of landmarks, the lower first, none twice")


@dataclass(frozen=True, kw_only=True)
class _Document:
    """What is read of model.json; the rest of it is for people."""

    recipe: str
    networks: Annotated[tuple[Network, ...], Len(1, len(BLENDSHAPES))]
    features: _FeaturesDocument
    weights_sha256: str
    record: TrainingRecord | None
    calibrated_features: _FeaturesDocument | None = None

    def __post_init__(self) -> None:
        """Refuse shapes and names that two networks have."""
        for what, names in (
            ("shape", [name for network in self.networks for name in network.outputs]),
            ("name", [network.key for network in self.networks]),
        ):
            if len(set(names)) < len(names):
                raise ValueError(f"two networks have the same {what}")


def _read_document(path: Path) -> _Document:
    try:
        document = read_document(path)
    except InputError as error:
        raise ModelError(f"{path} is not a model's description: {error}") from error
    schema = document.get("schema")
    if schema not in SCHEMAS:
        raise ModelError(
            f"{path} has schema {schema!r}; this version reads {' and '.join(map(str, SCHEMAS))}"
        )
    try:
        return checked(_Document, {**document, "record": document.get("record") or None})
    except InputError as error:
        raise ModelError(f"{path} is not a model's description: {error}") from error


def _document(model: Model, weights_sha256: str) -> dict[str, Any]:
    calibrated = model.calibrated
    return {
        "schema": SCHEMAS[-1] if any(features.of_points for features in model.all_features) else SCHEMAS[-2],
        "recipe": model.recipe,
        "blendshapes": list(BLENDSHAPES),
        "networks": [dataclasses.asdict(network) for network in model.table],
        "observability": {name: observability(name) for name in BLENDSHAPES},
        "hidden": model.networks.hidden,
        "features": _features_document(model.features),
        **({} if calibrated is None else {"calibrated_features": _features_document(calibrated.features)}),
        "inference": _INFERENCE[model.networks.denoising is not None],
        "calibrated": calibrated is not None
        and "the same with the arrays calibrated_*, on features less the neutral frame's",
        "weights_sha256": weights_sha256,
        "record": record_to_json(model.record),
    }


def _features_document(features: Features) -> dict[str, Any]:
    return {
        "kind": "x and y of the aligned points" if features.of_points else "edge lengths over face width",
        "alignment": features.alignment,
        "turn": "undone by the array depth" if features.depth is not None else "left as it is",
        "edges": features.edges.tolist(),
        "reference_name": features.reference_name,
        "reference_sha256": features.reference_sha256,
    }


def _arrays(model: Model) -> dict[str, np.ndarray]:
    arrays = {**_fields(model.networks), **_fields(model.normalisation)}
    if model.calibrated is not None:
        calibrated = {**_fields(model.calibrated.networks), **_fields(model.calibrated.normalisation)}
        arrays |= {CALIBRATED + name: array for name, array in calibrated.items()}
    depth = [features.depth for features in model.all_features if features.depth is not None]
    return {**arrays, "mean_shape": model.features.mean_shape, **({"depth": depth[0]} if depth else {})}


def _fields(record: FoldedNetworks | Normalisation | Denoising) -> dict[str, np.ndarray]:
    values = {field.name: getattr(record, field.name) for field in dataclasses.fields(record)}
    denoising = values.pop("denoising", None)
    if denoising is not None:
        values |= {DENOISING + name: array for name, array in _fields(denoising).items()}
    return values


def _weights_bytes(model: Model) -> bytes:
    buffer = io.BytesIO()
    np.savez(buffer, **_arrays(model))  # stored, not compressed, with 1980 as every entry's date: equal bytes
    return buffer.getvalue()


def _model(document: _Document, arrays: dict[str, np.ndarray]) -> Model:
    return Model(
        recipe=document.recipe,
        table=document.networks,
        features=_features(document.features, arrays),
        normalisation=_taken(Normalisation, arrays),
        networks=_networks(arrays),
        record=document.record,
        calibrated=_calibrated(document, arrays),
    )


def _features(document: _FeaturesDocument, arrays: dict[str, np.ndarray]) -> Features:
    return Features(
        alignment=document.alignment,
        mean_shape=arrays["mean_shape"],
        edges=np.array(document.edges, dtype=np.int64).reshape(-1, 2),
        reference_name=document.reference_name,
        reference_sha256=document.reference_sha256,
        depth=None if document.turn == "left as it is" else arrays.get("depth"),
    )


def _calibrated(document: _Document, arrays: dict[str, np.ndarray]) -> Calibrated | None:
    named = _beginning(arrays, CALIBRATED)
    if not named:
        return None
    return Calibrated(
        features=_features(document.calibrated_features or document.features, arrays),
        normalisation=_taken(Normalisation, named),
        networks=_networks(named),
    )


def _networks(arrays: dict[str, np.ndarray]) -> FoldedNetworks:
    named = _beginning(arrays, DENOISING)
    if named and not YOUNGER & named.keys():  # schema 3
        named |= {"surplus": np.zeros(len(named["axes"])), "usual": np.zeros(())}
    return _taken(FoldedNetworks, {**arrays, "denoising": _taken(Denoising, named) if named else None})


def _beginning(arrays: dict[str, np.ndarray], prefix: str) -> dict[str, np.ndarray]:
    """Those whose names begin so, by the rest of their names."""
    return {name.removeprefix(prefix): array for name, array in arrays.items() if name.startswith(prefix)}


def _taken(kind: type, arrays: dict[str, np.ndarray]) -> Any:
    return kind(**{field.name: arrays[field.name] for field in dataclasses.fields(kind)})

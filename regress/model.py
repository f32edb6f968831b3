"""A trained model: a folder with model.json and weights.npz, and what it predicts."""

import dataclasses
import hashlib
import io
import json
import os
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError, ModelError, OutputError
from regress.features import Features, extract
from regress.networks import FoldedNetworks, evaluate
from regress.targets import Network, observability

SCHEMA = 1
_BLOCK_ROWS = 4096
"""Rows predicted at a time: 4096 x 620 hidden units are 20 MB."""


@dataclass(frozen=True, kw_only=True)
class Normalisation:
    """The z-scores of the training split; already folded into the weights, kept for reading.

    Parameters
    ----------
    feature_mean, feature_std : (E,) float64
        Face widths.
    target_mean, target_std : (O,) float64
        In the networks' output order.
    """

    feature_mean: np.ndarray
    feature_std: np.ndarray
    target_mean: np.ndarray
    target_std: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Model:
    """Everything needed to predict, and the record of how it came about.

    Parameters
    ----------
    recipe
        Name of the recipe: ``"default"`` or ``"paper"``.
    table
        The networks, in the order of the folded weights.
    features
        Alignment and edges.
    normalisation
        Z-scores, for reading only.
    networks
        The folded weights.
    record
        Training record: JSON data, every figure unrounded (see ``regress.training``).
    """

    recipe: str
    table: tuple[Network, ...]
    features: Features
    normalisation: Normalisation
    networks: FoldedNetworks
    record: dict[str, Any]

    @property
    def outputs(self) -> tuple[str, ...]:
        """Predicted shapes in the networks' order (51; tongueOut is not among them)."""
        return tuple(output for network in self.table for output in network.outputs)

    def predict_raw(self, points: np.ndarray) -> np.ndarray:
        """What the networks say, unclipped, in their own order (see ``outputs``).

        Parameters
        ----------
        points : (n, 68, 2) float
            Faces in pixels or any other unit, y down.

        Returns
        -------
        (n, O) float64
            Rows of NaN where a face has missing points.
        """
        points = np.asarray(points, dtype=np.float64)
        if points.ndim != 3 or points.shape[1:] != (LANDMARK_COUNT, 2):
            raise InputError(f"points have shape {points.shape}; (n, 68, 2) is needed")
        usable = np.isfinite(points).all(axis=(1, 2))
        raw = np.full((len(points), len(self.networks.b2)), np.nan)
        rows = np.flatnonzero(usable)
        for start in range(0, len(rows), _BLOCK_ROWS):
            block = rows[start : start + _BLOCK_ROWS]
            raw[block] = evaluate(self.networks, extract(self.features, points[block]))
        return raw

    def predict(self, points: np.ndarray) -> np.ndarray:
        """Blendshape weights of faces.

        Parameters
        ----------
        points : (n, 68, 2) float
            Faces in pixels or any other unit, y down, iBUG order.

        Returns
        -------
        (n, 52) float64
            In the order of ``facegen.conventions.BLENDSHAPES``, clipped to [0, 1]; tongueOut is 0. A
            face with a missing point gives a row of NaN, so nothing downstream takes it for a neutral face.
        """
        raw = self.predict_raw(points)
        weights = np.zeros((len(raw), len(BLENDSHAPES)))
        weights[:, [BLENDSHAPE_INDEX[name] for name in self.outputs]] = np.clip(raw, 0, 1)
        weights[np.isnan(raw).any(axis=1)] = np.nan
        return weights


def save_model(model: Model, folder: str | os.PathLike[str]) -> None:
    """Write a model folder: into a temporary folder beside it, then one rename.

    Equal models give equal bytes. A folder that is already a model is replaced; any other is left alone.

    Raises
    ------
    OutputError
        Where the place cannot be written, or holds something that is not a model.
    """
    folder = Path(folder)
    weights = _weights_bytes(model)
    text = json.dumps(_document(model, hashlib.sha256(weights).hexdigest()), indent=1, allow_nan=False) + "\n"
    if folder.exists() and not (
        folder.is_dir() and (not any(folder.iterdir()) or (folder / "model.json").exists())
    ):
        raise OutputError(f"{folder} exists and is not a model folder; choose another place for the model")
    temporary = None
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        temporary = Path(tempfile.mkdtemp(prefix=f".{folder.name}-", dir=folder.parent))
        temporary.chmod(0o755)
        _write_synced(temporary / "weights.npz", weights)
        _write_synced(temporary / "model.json", text.encode())
        if folder.exists():
            # A folder cannot be renamed over a full one: the old model steps aside first.
            old = folder.rename(temporary.with_name(temporary.name + "-old"))
            temporary.rename(folder)
            shutil.rmtree(old)
        else:
            temporary.rename(folder)
    except OSError as error:
        if temporary is not None:
            shutil.rmtree(temporary, ignore_errors=True)
        raise OutputError(f"the model cannot be written to {folder}: {error.strerror or error}") from error


def load_model(folder: str | os.PathLike[str]) -> Model:
    """Read a model folder.

    Raises
    ------
    ModelError
        Where model.json or weights.npz is missing, damaged or does not belong to the other.
    """
    folder = Path(folder)
    document_path, weights_path = folder / "model.json", folder / "weights.npz"
    for path in (document_path, weights_path):
        if not path.is_file():
            raise ModelError(f"{path} does not exist; a model is a folder with model.json and weights.npz")
    try:
        document = json.loads(document_path.read_text())
        schema, expected = document["schema"], document["weights_sha256"]
    except (ValueError, KeyError, TypeError, OSError) as error:
        raise ModelError(f"{document_path} is not a model's description: {error}") from error
    if schema != SCHEMA:
        raise ModelError(f"{document_path} has schema {schema!r}; this version reads {SCHEMA}")
    weights = weights_path.read_bytes()
    if hashlib.sha256(weights).hexdigest() != expected:
        raise ModelError(
            f"{weights_path} is damaged or belongs to another model: its SHA-256 is not model.json's"
        )
    with np.load(io.BytesIO(weights), allow_pickle=False) as arrays:
        return _model(document, {name: arrays[name] for name in arrays.files}, document_path)


def _document(model: Model, weights_sha256: str) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "recipe": model.recipe,
        "blendshapes": list(BLENDSHAPES),
        "networks": [dataclasses.asdict(network) for network in model.table],
        "observability": {name: observability(name) for name in BLENDSHAPES},
        "hidden": model.networks.hidden,
        "features": {
            "kind": "edge lengths over face width",
            "alignment": model.features.alignment,
            "edges": model.features.edges.tolist(),
            "reference_name": model.features.reference_name,
            "reference_sha256": model.features.reference_sha256,
        },
        "inference": "clip(w2 tanh(w1 features + b1) + b2, 0, 1); features are raw, z-scores are folded in",
        "weights_sha256": weights_sha256,
        "record": model.record,
    }


def _arrays(model: Model) -> dict[str, np.ndarray]:
    networks, normalisation = model.networks, model.normalisation
    return {
        **{field.name: getattr(networks, field.name) for field in dataclasses.fields(networks)},
        **{field.name: getattr(normalisation, field.name) for field in dataclasses.fields(normalisation)},
        "mean_shape": model.features.mean_shape,
    }


def _weights_bytes(model: Model) -> bytes:
    buffer = io.BytesIO()
    np.savez(buffer, **_arrays(model))  # stored, not compressed, with 1980 as every entry's date: equal bytes
    return buffer.getvalue()


def _model(document: dict[str, Any], arrays: dict[str, np.ndarray], path: Path) -> Model:
    try:
        described = document["features"]
        return Model(
            recipe=document["recipe"],
            table=tuple(
                Network(region=entry["region"], name=entry["name"], outputs=tuple(entry["outputs"]))
                for entry in document["networks"]
            ),
            features=Features(
                alignment=described["alignment"],
                mean_shape=arrays["mean_shape"],
                edges=np.array(described["edges"], dtype=np.int64),
                reference_name=described["reference_name"],
                reference_sha256=described["reference_sha256"],
            ),
            normalisation=Normalisation(
                **{f.name: arrays[f.name] for f in dataclasses.fields(Normalisation)}
            ),
            networks=FoldedNetworks(**{f.name: arrays[f.name] for f in dataclasses.fields(FoldedNetworks)}),
            record=document["record"],
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ModelError(f"{path} lacks a part of the model: {error}") from error


def _write_synced(path: Path, content: bytes) -> None:
    with open(path, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())

"""Describes a trained model to people: its figures, its files and their hashes, read from its folder."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from regress.errors import ModelError
from regress.runtime.model import HEADSET, KEYPOINTS

_CONDITIONS = {
    "uncalibrated": "no neutral picture",
    "same_seat": "a neutral picture of the person",
    "other_seat": "a neutral picture from before the headset was put on again",
}
"""Titles of the conditions of ``regress headset evaluate`` that a card shows, by name."""


@dataclass(frozen=True, kw_only=True)
class ModelCard:
    """What a model is and how good it is.

    Parameters
    ----------
    name, kind
        Its name, and ``"keypoints"`` or ``"headset"``.
    sees
        What it takes, for people.
    figures
        A sentence or two of its test figures, the least flattering first.
    licence
        Of its weights.
    sha256
        Of weights.npz or network.onnx.
    size_bytes
        Of all of its files.
    folder
        Where it lies.
    """

    name: str
    kind: str
    sees: str
    figures: str
    licence: str
    sha256: str
    size_bytes: int
    folder: Path


def describe_model(name: str, folder: Path) -> ModelCard:
    """Read a model's card from its folder.

    Raises
    ------
    ModelError
        Where there is no model of this version, or none that was judged.
    """
    document = _document(folder)
    kind = _kind(document)
    files = [folder / "model.json", folder / kind.numbers]
    texts = _keypoint_texts(document) if kind is KEYPOINTS else _headset_texts(document)
    return ModelCard(
        name=name,
        kind=kind.name,
        sees=texts["sees"],
        figures=texts["figures"],
        licence=texts["licence"],
        sha256=document["weights_sha256" if kind is KEYPOINTS else "network_sha256"],
        size_bytes=sum(path.stat().st_size for path in files),
        folder=folder,
    )


def card_markdown(name: str, folder: Path) -> str:
    """The text of CARD.md: regress/data/cards, filled in with what model.json says."""
    document = _document(folder)
    kind = _kind(document)
    texts = _keypoint_texts(document) if kind is KEYPOINTS else _headset_texts(document)
    rows = []
    for file in ("model.json", kind.numbers):
        content = (folder / file).read_bytes()
        rows.append(f"| {file} | `{hashlib.sha256(content).hexdigest()}` | {len(content):,} |")
    template = resources.files("regress") / "data" / "cards" / f"{kind.name}.md"
    return template.read_text(encoding="utf-8").format_map({**texts, "name": name, "files": "\n".join(rows)})


def _document(folder: Path) -> dict[str, Any]:
    path = folder / "model.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ModelError(f"{path} is no model's description: {error}") from error


def _kind(document: Mapping[str, Any]) -> Any:
    return HEADSET if document.get("kind") == HEADSET.name else KEYPOINTS


def _keypoint_texts(document: Mapping[str, Any]) -> dict[str, str]:
    record = document["record"]
    dataset, samples = record["dataset"], record["dataset"]["samples"]
    figures = {
        "detected": record["as_detected"]["network"],
        "detected_calibrated": record["as_detected"]["calibrated"],
        "exact": record["summary"]["network"],
        "exact_calibrated": record["summary"]["calibrated"],
    }
    texts = {}
    for name, means in figures.items():
        texts[f"{name}_visible"] = f"{means['mean_r2_visible']:.3f}"
        texts[f"{name}_networks"] = f"{means['mean_r2_networks']:.3f}"
    return texts | {
        "sees": "68 landmarks",
        "figures": f"R2 {texts['detected_visible']} as a detector puts landmarks, "
        f"{texts['detected_calibrated_visible']} with a neutral frame; exact landmarks {texts['exact_visible']}",
        "licence": record["licence"],
        "test_samples": f"{samples['test']:,}",
        "train_samples": f"{samples['train']:,}",
        "people": f"{dataset['people']:,}",
        "dataset": dataset["name"],
        "data_sha256": dataset["keypoints_sha256"],
        "data_licence": dataset["licence"],
    }


def _headset_texts(document: Mapping[str, Any]) -> dict[str, str]:
    training, scores = document["training"], document["scores"]
    shown = {
        title: scores["conditions"][name]
        for name, title in _CONDITIONS.items()
        if name in scores["conditions"]
    }
    rows = [
        f"| {title} | {figures['geometry_mm']:.2f} | {figures['r2']:.3f} | {figures['gaze_deg']:.1f} |"
        for title, figures in shown.items()
    ]
    cameras = ", ".join(camera["name"] for camera in document["cameras"])
    uncalibrated = scores["conditions"]["uncalibrated"]
    return {
        "sees": f"{document['headset']}: {cameras}",
        "figures": "; ".join(
            f"{figures['geometry_mm']:.2f} mm with {title}" for title, figures in shown.items()
        )
        + f"; a resting face errs by {scores['floors']['rest']['geometry_mm']:.2f} mm; synthetic people",
        "licence": "Apache-2.0",
        "cameras": cameras,
        "headset": document["headset"],
        "rows": f"{uncalibrated['rows']:,}",
        "people_judged": f"{len(scores['people_mm']):,}",
        "conditions": "\n".join(rows),
        "rest_mm": f"{scores['floors']['rest']['geometry_mm']:.2f}",
        "train_rows": f"{training['rows']:,}",
        "people": f"{training['people']:,}",
        "data_sha256": document["dataset_hash"],
        "rig": document["rig"],
        "data_licence": ", ".join(document["licences"]),
    }

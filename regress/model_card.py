"""Describes a trained model to people: its figures, its files and their hashes, read from its folder."""

import hashlib
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from regress.errors import ModelError
from regress.runtime.headset.network.figures import Evaluation
from regress.runtime.headset.network.folder import read_headset_model
from regress.runtime.headset.network.model import HeadsetModel
from regress.runtime.headset.network.predictor import is_headset_model
from regress.runtime.model import HEADSET, KEYPOINTS, load_model
from regress.runtime.model.record import MeanScores, TrainingRecord

_CONDITIONS = {
    "uncalibrated": "no neutral picture",
    "same_seat": "a neutral picture of the person",
    "other_seat": "a neutral picture from before the headset was put on again",
    "uncalibrated_told": "no neutral picture, told where the cameras are",
    "same_seat_told": "a neutral picture, told where the cameras are",
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
        Where there is no model, or none that was judged.
    """
    kind = HEADSET if is_headset_model(folder) else KEYPOINTS
    texts = _texts(folder)
    return ModelCard(
        name=name,
        kind=kind.name,
        sees=texts["sees"],
        figures=texts["figures"],
        licence=texts["licence"],
        sha256=_sha256(folder / kind.numbers),
        size_bytes=sum((folder / file).stat().st_size for file in ("model.json", kind.numbers)),
        folder=folder,
    )


def card_markdown(name: str, folder: Path) -> str:
    """The text of CARD.md: the template in regress/data/cards, filled in with what the folder says."""
    kind = HEADSET if is_headset_model(folder) else KEYPOINTS
    texts = _texts(folder)
    files = "\n".join(
        f"| {file} | `{_sha256(folder / file)}` | {(folder / file).stat().st_size:,} |"
        for file in ("model.json", kind.numbers)
    )
    drawn = kind is HEADSET and read_headset_model(folder).of_many_headsets
    template = (
        resources.files("regress") / "data" / "cards" / ("headset-any.md" if drawn else f"{kind.name}.md")
    )
    return template.read_text(encoding="utf-8").format_map({**texts, "name": name, "files": files})


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _texts(folder: Path) -> dict[str, str]:
    """What fills the template's fields, and the fields of a card."""
    if is_headset_model(folder):
        model = read_headset_model(folder)
        if model.scores is None or "uncalibrated" not in model.scores.conditions:
            raise ModelError(f"{folder} was not judged: its model.json has no scores on a test split")
        return _headset_texts(model, model.scores)
    record = load_model(folder).record
    sets = {"network", "calibrated"}
    if record is None or not (sets <= record.as_detected.keys() and sets <= record.summary.keys()):
        raise ModelError(
            f"{folder} was not judged as a detector is guessed to put landmarks: its model.json has no such scores"
        )
    lacking = {"train", "test"} - record.dataset.samples.keys()
    if lacking:
        raise ModelError(f"{folder} does not say how many {min(lacking)} samples it saw")
    return _keypoint_texts(record)


def _keypoint_texts(record: TrainingRecord) -> dict[str, str]:
    means = {
        "detected": record.as_detected["network"],
        "detected_calibrated": record.as_detected["calibrated"],
        "exact": record.summary["network"],
        "exact_calibrated": record.summary["calibrated"],
    }
    texts = {f"{name}_visible": _figure(one.mean_r2_visible) for name, one in means.items()}
    texts |= {f"{name}_networks": _figure(one.mean_r2_networks) for name, one in means.items()}
    texts |= {
        f"{kind}_{prefix}ridge": _visible(scores, *(f"{prefix}{name}" for name in names))
        for kind, scores, names in (
            ("detected", record.as_detected, ("ridge_same_rows", "ridge")),
            ("exact", record.summary, ("ridge",)),
        )
        for prefix in ("", "calibrated_")
    }
    dataset = record.dataset
    return texts | {
        "sees": "68 landmarks",
        "figures": f"R2 {texts['detected_visible']} as a detector is guessed to put landmarks, "
        f"{texts['detected_calibrated_visible']} with a neutral frame; exact landmarks {texts['exact_visible']}",
        "licence": record.licence,
        "test_samples": f"{dataset.samples['test']:,}",
        "train_samples": f"{dataset.samples['train']:,}",
        "people": f"{dataset.people:,}",
        "dataset": dataset.name,
        "data_sha256": dataset.keypoints_sha256,
        "data_licence": str(dataset.licence),
        "heads": heads_in_words(dataset.rig),
    }


def _visible(scores: dict[str, MeanScores], *methods: str) -> str:
    """Mean R2 of the visible shapes by the first method that was measured; a dash where none was."""
    found = next((scores[method] for method in methods if method in scores), None)
    return "\N{EN DASH}" if found is None else _figure(found.mean_r2_visible)


def heads_in_words(rigs: Any) -> str:
    """What a dataset says of the rigs of its people, in words; older ones, and foreign ones, say what they like."""
    if isinstance(rigs, dict) and isinstance(rigs.get("name"), str):
        return f"one rig (`{rigs['name']}`)"
    try:
        return "several rigs (" + ", ".join(f"`{rig['name']}`: {rig['share']:.0%}" for rig in rigs) + ")"
    except (TypeError, KeyError, ValueError):
        return "rigs that its dataset does not name"


def _headset_texts(model: HeadsetModel, scores: Evaluation) -> dict[str, str]:
    shown = {
        title: scores.conditions[name] for name, title in _CONDITIONS.items() if name in scores.conditions
    }
    errors = (f"{summary.geometry_mm:.2f} mm with {title}" for title, summary in shown.items())
    rest_mm = f"{scores.floors['rest'].geometry_mm:.2f}" if "rest" in scores.floors else "-"
    cameras = ", ".join(model.camera_names)
    return {
        "sees": f"{model.headset}: {cameras}",
        "figures": f"{'; '.join(errors)}; a resting face errs by {rest_mm} mm; synthetic people",
        "licence": "Apache-2.0",
        "cameras": cameras,
        "headset": model.headset,
        "rows": f"{scores.conditions['uncalibrated'].rows:,}",
        "people_judged": f"{scores.people:,}",
        "conditions": "\n".join(
            f"| {title} | {summary.geometry_mm:.2f} | {_figure(summary.r2)} | {summary.gaze_deg:.1f} |"
            for title, summary in shown.items()
        ),
        "rest_mm": rest_mm,
        "train_rows": f"{model.training.rows:,}",
        "people": f"{model.training.people:,}",
        "data_sha256": model.dataset_hash,
        "rig": model.rig,
        "data_licence": ", ".join(model.licences),
    }


def _figure(value: float | None) -> str:
    return "undefined" if value is None else f"{value:.3f}"

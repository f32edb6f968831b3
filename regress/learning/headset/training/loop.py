"""Runs the training loop: epochs of batches, a checkpoint after each."""

import hashlib
import json
import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import torch

from facegen.conventions import VIEW_POINTS
from regress.errors import InputError, Interrupted
from regress.learning.headset.arrays import HeadsetArrays, pack_again
from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.batches import Batch, TrainingFrames
from regress.learning.headset.training.checkpoint import read_checkpoint, save_checkpoint
from regress.learning.headset.training.losses import total_loss
from regress.learning.headset.training.networks import Answer, HeadsetNetwork, network_of
from regress.learning.headset.training.optimizer import optimizers_of
from regress.learning.headset.training.photometry import draw_photometry
from regress.learning.headset.training.start import LearnedGraph
from regress.learning.headset.training.targets import Targets, target_scale
from regress.learning.headset.training.traced import mirrored_points
from regress.learning.progress import Progress
from regress.runtime.headset.network.folder import read_headset_model
from regress.runtime.headset.network.outputs import WEIGHTS

_STATE_VERSION = 3
"""Raised when a checkpoint of before no longer fits the networks."""

_SCALE_ROWS = 512
"""Training rows from which the pictures' mean and spread are taken."""

_START_BATCHES = 8
"""In which those rows pass a network that begins as another: 64 frames at a time."""


class Training:
    """A network on its way, as `start_training` begins it.

    Parameters
    ----------
    recipe, frames, validation
        How it learns, from what, and the rows that judge it after each epoch.
    targets, gram
        Scale of the outputs, and of errors in millimetres.
    network
        What learns.
    key
        Of all that a checkpoint must share with it.
    checkpoint
        File that holds the state after each epoch. None keeps none.
    began_s
        Processor time of this process when it began.
    """

    def __init__(
        self,
        recipe: HeadsetRecipe,
        frames: TrainingFrames,
        validation: np.ndarray,
        *,
        targets: Targets,
        gram: torch.Tensor,
        network: HeadsetNetwork,
        key: str,
        checkpoint: Path | None,
        began_s: float,
    ) -> None:
        self.recipe, self.targets, self.network = recipe, targets, network
        self.history: list[dict[str, float]] = []
        self._frames, self._validation, self._gram = frames, validation, gram
        self._mean, self._std = torch.from_numpy(targets.mean), torch.from_numpy(targets.std)
        self._optimizers = optimizers_of(network, recipe)
        self._key, self._checkpoint = key, checkpoint
        self._began_s, self._earlier_s = began_s, 0.0

    @property
    def cpu_s(self) -> float:
        """Processor seconds so far, those before it was stopped among them."""
        return self._earlier_s + time.process_time() - self._began_s

    @property
    def rows(self) -> np.ndarray:
        """Training rows of the arrays."""
        return self._frames.rows

    def points(self) -> dict[str, tuple[str, ...]]:
        """Names of what each camera traces, in order; a mirrored camera's are those of the other side."""
        points = {}
        for camera in self.network.cameras:
            owner = self.network.owners[camera]
            traced = self._frames.traced[owner or camera]
            chosen = traced if owner is None else mirrored_points(traced)
            points[camera] = tuple(VIEW_POINTS[index] for index in chosen)
        return {camera: names for camera, names in points.items() if names}

    def run(self, progress: Progress | None = None) -> HeadsetNetwork:
        """Train what is left to train.

        Raises
        ------
        Interrupted
            On Ctrl-C; the checkpoint holds all whole epochs.
        """
        try:
            while len(self.history) < self.recipe.epochs:
                self._run_epoch(len(self.history))
                if self._checkpoint is not None:
                    self._save(self._checkpoint)
                if progress is not None:
                    progress("epochs", len(self.history), self.recipe.epochs)
        except KeyboardInterrupt:
            kept = "nothing was kept" if self._checkpoint is None else "run the same command again to go on"
            raise Interrupted(
                f"training was stopped after {len(self.history)} of {self.recipe.epochs} epochs; {kept}"
            ) from None
        return self.network.eval()

    def deviation_scale(self) -> np.ndarray:
        """(56,) float32: true over predicted deviation of each output on validation people, without calibration.

        Variances are learned on training people, whom the network knows better than others. Ones without such rows.
        """
        squares, variances = [], []
        for answer, true in self._validation_answers():
            squares.append((answer.blended.mean - true).square().numpy())
            variances.append(answer.blended.variance.numpy())
        if not squares:
            return np.ones(len(self.targets.std), np.float32)
        ratio = np.concatenate(squares).mean(axis=0) / np.concatenate(variances).mean(axis=0)
        return np.sqrt(np.clip(ratio, 0.1, 10)).astype(np.float32)

    def _run_epoch(self, epoch: int) -> None:
        random = np.random.default_rng([self.recipe.seed, epoch])
        self.network.train()
        losses = []
        for number, batch in enumerate(self._frames.draw_epoch(random)):
            done = (epoch + number / self._frames.batches) / self.recipe.epochs
            self.network.zero_grad(set_to_none=True)
            loss = self._draw_loss(batch, random)
            loss.backward()
            for optimizer in self._optimizers:
                for group in optimizer.param_groups:
                    group["lr"] = group["peak"] * 0.5 * (1 + math.cos(math.pi * done))
                optimizer.step()
            losses.append(float(loss.detach()))
        if not np.isfinite(losses).all():
            raise InputError(
                f"the loss is no longer a number in epoch {epoch + 1}; begin anew with a lower learning_rate or "
                "matrix_learning_rate (--set)"
            )
        self.history.append({"loss": float(np.mean(losses)), "validation": self._validation_error()})

    def _draw_loss(self, batch: Batch, random: np.random.Generator) -> torch.Tensor:
        pictures, neutral, present, calibrated, terms = _tensors_of(batch)
        if self.recipe.randomise:
            pictures, neutral = draw_photometry(
                random, pictures, neutral, self.recipe.randomise, batch.plain, self.recipe.patches
            )
        answer = self.network(pictures.unbind(1), neutral.unbind(1), present, calibrated, terms)
        return total_loss(
            self.network,
            answer,
            self._wanted(batch),
            calibrated=calibrated,
            same_seat=torch.from_numpy(batch.same_seat),
            positions=self._positions(batch),
            gram=self._gram,
            recipe=self.recipe,
        )

    def _wanted(self, batch: Batch) -> torch.Tensor:
        return (torch.from_numpy(batch.outputs) - self._mean) / self._std

    def _positions(self, batch: Batch) -> list[torch.Tensor]:
        """Standardised positions of each camera's points; none where they are not traced."""
        standardised = []
        for camera, positions in zip(self.network.cameras, batch.positions, strict=True):
            standardised.append(self.network.encoder(camera).standardised(torch.from_numpy(positions)))
        return standardised

    def _validation_error(self) -> float:
        """Mean squared z-score without calibration; 1 is as good as the training mean. Without rows it is 0."""
        squares = [
            (answer.blended.mean - true).square().mean(dim=1) for answer, true in self._validation_answers()
        ]
        return float(torch.cat(squares).mean()) if squares else 0.0

    def _validation_answers(self) -> Iterator[tuple[Answer, torch.Tensor]]:
        """Answers to the validation rows, and what they should be."""
        self.network.eval()
        with torch.no_grad():
            for start in range(0, len(self._validation), 256):
                batch = self._frames.plain_batch(self._validation[start : start + 256])
                yield answer_to(self.network, batch), self._wanted(batch)

    def _save(self, path: Path) -> None:
        state = {
            "history": self.history,
            "cpu_s": self.cpu_s,
            "network": self.network.state_dict(),
            "optimizers": [optimizer.state_dict() for optimizer in self._optimizers],
        }
        save_checkpoint(path, self._key, state)

    def resume(self, path: Path) -> None:
        """Go on from a checkpoint.

        Raises
        ------
        InputError
            Where it is none, or of another training.
        """
        state = read_checkpoint(path, self._key, of="a training", fixed="settings, data or networks")
        self.history, self._earlier_s = state["history"], state["cpu_s"]
        self.network.load_state_dict(state["network"])
        for optimizer, kept in zip(self._optimizers, state["optimizers"], strict=True):
            optimizer.load_state_dict(kept)


def start_training(
    arrays: HeadsetArrays, recipe: HeadsetRecipe, checkpoint: Path | None = None, start: Path | None = None
) -> Training:
    """Begin a training, or go on with one.

    Equal arrays and recipes give the same network on one machine, stopped or not. From here on this process
    has one thread of PyTorch, and its random numbers follow the recipe's seed.

    Parameters
    ----------
    arrays, recipe
        What it learns from, and how.
    checkpoint
        File that holds the state after each epoch; where it exists, training goes on from it. None keeps none.
    start
        Model folder whose network this one begins as; None begins with random numbers.

    Raises
    ------
    InputError
        Where a setting is impossible, no row is left, or the checkpoint or the model belongs to another training.
    """
    began_s = time.process_time()
    torch.set_num_threads(1)  # other splits of a sum end in other last bits
    torch.manual_seed(recipe.seed)
    if recipe.camera_terms and not arrays.camera_terms:
        raise InputError(
            f"{arrays.folder} does not say where cameras are, and camera_terms asks for it; "
            f"{pack_again(arrays.folder)}"
        )
    rows = arrays.kept_rows("train", withhold=recipe.withhold, people=recipe.people)
    names = tuple(camera.name for camera in arrays.cameras)
    learned = None if start is None else LearnedGraph(start)
    if learned is not None:
        learned.check_cameras(names)
    frames = TrainingFrames(arrays, recipe, rows, None if learned is None else learned.traced)
    targets = target_scale(frames.outputs[rows]) if learned is None else learned.targets
    network = network_of(recipe.architecture)(names, recipe, frames.traced)
    some = _some_of(frames.rows)
    _set_scales(network, frames.plain_batch(some))
    if learned is not None:
        plain = [frames.plain_batch(block) for block in np.array_split(some, _START_BATCHES)]
        learned.give(network, plain, answer_to)
    training = Training(
        recipe,
        frames,
        arrays.rows("validation"),
        targets=targets,
        gram=_scaled_gram(arrays, targets, rows),
        network=network,
        key=_key(arrays, recipe, rows, start),
        checkpoint=checkpoint,
        began_s=began_s,
    )
    if checkpoint is not None and checkpoint.exists():
        training.resume(checkpoint)
    return training


def _set_scales(network: HeadsetNetwork, batch: Batch) -> None:
    """Give encoders the spread of training pictures, and their points' usual positions."""
    pictures = batch.pictures.astype(np.float32)
    for column, camera in enumerate(network.cameras):
        if network.owners[camera] is not None:
            continue
        encoder = network.encoder(camera)
        encoder.set_usual(torch.from_numpy(batch.positions[column]))
        seen = pictures[:, column]
        encoder.set_scale(float(seen.mean()), max(float(seen.std()), 1.0))


def _some_of(rows: np.ndarray) -> np.ndarray:
    """Training rows that stand for all where means and spreads are taken."""
    return rows[:: max(1, len(rows) // _SCALE_ROWS)]


def answer_to(network: HeadsetNetwork, batch: Batch) -> Answer:
    """A network's answer to a batch as it is."""
    pictures, neutral, present, calibrated, terms = _tensors_of(batch)
    return network(pictures.unbind(1), neutral.unbind(1), present, calibrated, terms)


def _tensors_of(batch: Batch) -> tuple[torch.Tensor, ...]:
    """What a network sees of a batch: pictures, neutral ones, which are there, which are calibrated, cameras' terms."""
    pictures, neutral = (torch.from_numpy(seen).float() for seen in (batch.pictures, batch.neutral))
    present, calibrated = torch.from_numpy(batch.present), torch.from_numpy(batch.calibrated)
    return pictures, neutral, present, calibrated, torch.from_numpy(batch.terms)


def _scaled_gram(arrays: HeadsetArrays, targets: Targets, rows: np.ndarray) -> torch.Tensor:
    std = targets.std[:WEIGHTS].astype(np.float64)
    gram = arrays.face.gram_mm2() * std * std[:, None]
    scores = (arrays.weights[rows] - targets.mean[:WEIGHTS]) / std
    spread = float(((scores @ gram) * scores).sum(axis=1).mean())
    return torch.from_numpy((gram / max(spread, 1e-12)).astype(np.float32))


def _key(arrays: HeadsetArrays, recipe: HeadsetRecipe, rows: np.ndarray, start: Path | None) -> str:
    """Of everything that a state must share with a training to go on with it."""
    settings: dict[str, Any] = {
        "version": _STATE_VERSION,
        "recipe": recipe.settings(),
        "arrays": arrays.description,
        "start": "" if start is None else read_headset_model(start).network_sha256,
    }
    labels = [arrays.weights, arrays.gaze, np.asarray(rows)]
    text = json.dumps(settings, sort_keys=True).encode() + b"".join(array.tobytes() for array in labels)
    return hashlib.sha256(text).hexdigest()

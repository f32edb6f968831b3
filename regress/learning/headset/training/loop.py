"""Runs the training loop: epochs of batches, a checkpoint after each."""

import hashlib
import io
import json
import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import torch

from facegen.conventions import VIEW_POINTS
from facegen.files import output_errors, write_whole
from regress.errors import InputError, Interrupted
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.batches import Batch, TrainingFrames
from regress.learning.headset.training.losses import total_loss
from regress.learning.headset.training.networks import Answer, HeadsetNetwork, network_of
from regress.learning.headset.training.optimizer import optimizers_of
from regress.learning.headset.training.photometry import draw_photometry
from regress.learning.headset.training.start import LearnedGraph
from regress.learning.headset.training.targets import Targets, target_scale
from regress.learning.headset.training.traced import mirrored_points
from regress.learning.progress import Progress
from regress.runtime.headset.folder import read_headset_model
from regress.runtime.headset.outputs import WEIGHTS

_STATE_VERSION = 3
"""Raised when a checkpoint of before no longer fits the networks."""

_SCALE_ROWS = 512
"""Training rows from which the pictures' mean and spread are taken."""

_START_BATCHES = 8
"""In which those rows pass a network that begins as another: 64 frames at a time."""


class Training:
    """A network on its way: the same arrays and recipe give the same one on one machine, stopped or not.

    Parameters
    ----------
    arrays, recipe
        What it learns from, and how.
    checkpoint
        File that holds the state after each epoch; where it exists, training goes on from it. None keeps none.
    start
        Model folder whose network this one begins as; None begins with random numbers.
    """

    def __init__(
        self,
        arrays: HeadsetArrays,
        recipe: HeadsetRecipe,
        checkpoint: Path | None = None,
        start: Path | None = None,
    ) -> None:
        self._began_s, self._earlier_s = time.process_time(), 0.0
        torch.set_num_threads(1)  # other splits of a sum end in other last bits
        torch.manual_seed(recipe.seed)
        if recipe.camera_terms and not arrays.camera_terms:
            raise InputError(
                f"{arrays.folder} does not say where cameras are, and camera_terms asks for it; pack the dataset again "
                "with facegen pack"
            )
        rows = arrays.kept_rows("train", withhold=recipe.withhold, people=recipe.people)
        self.recipe = recipe
        self.history: list[dict[str, float]] = []
        self._checkpoint = checkpoint
        names = tuple(camera.name for camera in arrays.cameras)
        learned = None if start is None else LearnedGraph(start)
        if learned is not None:
            learned.check_cameras(names)
        self._frames = TrainingFrames(arrays, recipe, rows, None if learned is None else learned.traced)
        self._validation = arrays.rows("validation")
        self.targets = target_scale(self._frames.outputs[rows]) if learned is None else learned.targets
        self._mean, self._std = torch.from_numpy(self.targets.mean), torch.from_numpy(self.targets.std)
        self._gram = _scaled_gram(arrays, self.targets, rows)
        self.network = network_of(recipe.architecture)(names, recipe, self._frames.traced)
        self._set_scales()
        if learned is not None:
            plain = [
                self._frames.plain_batch(block) for block in np.array_split(self._some_rows(), _START_BATCHES)
            ]
            learned.give(self.network, plain, answer_to)
        self._optimizers = optimizers_of(self.network, recipe)
        self._key = _key(arrays, recipe, rows, start)
        if checkpoint is not None and checkpoint.exists():
            self._resume(checkpoint)

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
            loss = self._loss(batch, random)
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

    def _loss(self, batch: Batch, random: np.random.Generator) -> torch.Tensor:
        pictures, neutral = (torch.from_numpy(seen).float() for seen in (batch.pictures, batch.neutral))
        if self.recipe.randomise:
            pictures, neutral = draw_photometry(
                random, pictures, neutral, self.recipe.randomise, batch.plain, self.recipe.patches
            )
        calibrated = torch.from_numpy(batch.calibrated)
        present = torch.from_numpy(batch.present)
        terms = torch.from_numpy(batch.terms)
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

    def _set_scales(self) -> None:
        """Give encoders the spread of training pictures, and their points' usual positions."""
        batch = self._frames.plain_batch(self._some_rows())
        pictures = batch.pictures.astype(np.float32)
        for column, camera in enumerate(self.network.cameras):
            if self.network.owners[camera] is not None:
                continue
            encoder = self.network.encoder(camera)
            encoder.set_usual(torch.from_numpy(batch.positions[column]))
            seen = pictures[:, column]
            encoder.set_scale(float(seen.mean()), max(float(seen.std()), 1.0))

    def _some_rows(self) -> np.ndarray:
        """Training rows that stand for all where means and spreads are taken."""
        return self.rows[:: max(1, len(self.rows) // _SCALE_ROWS)]

    def _save(self, path: Path) -> None:
        state = {
            "key": self._key,
            "history": self.history,
            "cpu_s": self.cpu_s,
            "network": self.network.state_dict(),
            "optimizers": [optimizer.state_dict() for optimizer in self._optimizers],
        }
        content = io.BytesIO()  # which torch.save fills without errors of its own kind where a disk is full
        torch.save(state, content)
        with output_errors(path):
            path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, content.getvalue())

    def _resume(self, path: Path) -> None:
        try:
            state = torch.load(path, weights_only=True)
            key = state["key"]
        except Exception as error:  # whatever a damaged file makes the unpickler raise
            raise InputError(f"{path} is not a checkpoint of a training: {error}; remove it") from error
        if key != self._key:
            raise InputError(
                f"{path} is the checkpoint of a training with other settings, data or networks; "
                "remove it, or repeat that training's command"
            )
        self.history, self._earlier_s = state["history"], state["cpu_s"]
        self.network.load_state_dict(state["network"])
        for optimizer, kept in zip(self._optimizers, state["optimizers"], strict=True):
            optimizer.load_state_dict(kept)


def answer_to(network: HeadsetNetwork, batch: Batch) -> Answer:
    """A network's answer to a batch as it is."""
    pictures, neutral = (torch.from_numpy(seen).float() for seen in (batch.pictures, batch.neutral))
    present, calibrated = torch.from_numpy(batch.present), torch.from_numpy(batch.calibrated)
    return network(pictures.unbind(1), neutral.unbind(1), present, calibrated, torch.from_numpy(batch.terms))


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

"""Trains the compass on arrays of drawn headsets, epoch by epoch, and writes its graph."""

import hashlib
import json
import math
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np
import torch
from torch.nn import functional

from facegen.files import output_errors, write_whole
from regress.errors import InputError, Interrupted
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.compass.network import Compass, MeanCompass, compass_graph
from regress.learning.headset.compass.views import draw_views, eyes_of
from regress.learning.headset.training.checkpoint import read_checkpoint, save_checkpoint
from regress.learning.headset.training.photometry import draw_photometry
from regress.learning.progress import Progress

_BATCH, _PEAK_RATE, _WARM_UP, _WEIGHT_DECAY = 64, 3e-3, 0.1, 0.05
_SMOOTHING = 0.02
"""Of labels: drawn cameras lean by up to 30 degrees, and some views show skin alone."""

_PLAIN = 0.3
"""Share of views whose light is left as it was rendered."""


@dataclass(frozen=True, kw_only=True)
class CompassScores:
    """Shares of unseen people's single views that are told right: the orientation, its side, its quarter."""

    views: int
    orientation: float
    side: float
    quarter: float


def train_compass(
    arrays: HeadsetArrays,
    out: Path,
    *,
    seed: int = 0,
    epochs: int = 45,
    members: int = 2,
    progress: Progress | None = None,
) -> CompassScores:
    """Train and write ``out``; stopped, it goes on where the last whole epoch ended.

    Parameters
    ----------
    arrays
        With training and test people; drawn headsets, or it knows one camera alone.
    out
        The .onnx file. Until it is written the members' states are in files beside it, ``.NAME.0.checkpoint``.
    seed, epochs
        Of the first member; the others have the next seeds.
    members
        Networks whose logarithms are averaged: on films of real eyes one seed differs from another.
    progress
        Called after each epoch.

    Raises
    ------
    InputError
        Where there is no eye to learn from, or the checkpoint belongs to another training.
    Interrupted
        On Ctrl-C.
    OutputError
        Where the file cannot be written.
    """
    torch.set_num_threads(1)  # other splits of a sum end in other last bits
    pictures = eyes_of(arrays, arrays.rows("train"))
    if len(pictures) < 2:
        raise InputError(f"{arrays.folder} has no training people; the compass learns from those")
    runs: list[_Run] = []
    try:
        for member in range(members):
            checkpoint = out.parent / f".{out.name}.{member}.checkpoint"
            run = _start_run(arrays, pictures, checkpoint, seed=seed + member, epochs=epochs)
            runs.append(run)
            while run.done < epochs:
                run.run_epoch()
                if progress is not None:
                    progress("epochs", member * epochs + run.done, members * epochs)
    except KeyboardInterrupt:
        done = sum(run.done for run in runs)
        raise Interrupted(
            f"training was stopped after {done} of {members * epochs} epochs; run the same command again to go on"
        ) from None
    with output_errors(out):
        out.parent.mkdir(parents=True, exist_ok=True)
    about = {
        "licence": str(arrays.description.get("licence", "")),
        "rig": str(arrays.description.get("rig", "")),
        "dataset_hash": str(arrays.description.get("dataset_hash", "")),
        "people": str(len(np.unique(arrays.person[arrays.rows("train")]))),
        "pictures": str(len(pictures)),
        "seed": str(seed),
        "epochs": str(epochs),
        "members": str(members),
        "facegen": version("facegen"),
        "torch": torch.__version__,
    }
    compass = MeanCompass(run.network for run in runs).eval()
    write_whole(out, compass_graph(compass, about))
    for run in runs:
        run.checkpoint.unlink(missing_ok=True)
    return _scores(compass, eyes_of(arrays, arrays.rows("test")))


class _Run:
    """A member on its way: the same on one machine, stopped or not."""

    def __init__(
        self, network: Compass, pictures: np.ndarray, checkpoint: Path, *, key: str, seed: int, epochs: int
    ) -> None:
        self.network, self.done, self.checkpoint = network, 0, checkpoint
        self._pictures, self._seed, self._key = pictures, seed, key
        self._batch = min(_BATCH, len(pictures))
        self._optimizer = torch.optim.AdamW(network.parameters(), weight_decay=_WEIGHT_DECAY)
        self._epochs = epochs

    def run_epoch(self) -> None:
        """All pictures once, each in some orientation."""
        random = np.random.default_rng([self._seed, self.done])
        torch.manual_seed(int(random.integers(2**31)))
        self.network.train()
        order = random.permutation(len(self._pictures))
        for start in range(0, len(order) - self._batch + 1, self._batch):
            views, orientations = draw_views(random, self._pictures[order[start : start + self._batch]])
            answer = self.network(_draw_light(random, views, random.random(len(views)) < _PLAIN))
            loss = functional.cross_entropy(
                answer, torch.from_numpy(orientations), label_smoothing=_SMOOTHING
            )
            self.network.zero_grad(set_to_none=True)
            loss.backward()
            for group in self._optimizer.param_groups:
                group["lr"] = _rate((self.done + start / len(order)) / self._epochs)
            self._optimizer.step()
        self.done += 1
        self._save()

    def _save(self) -> None:
        state = {
            "done": self.done,
            "network": self.network.state_dict(),
            "optimizer": self._optimizer.state_dict(),
        }
        save_checkpoint(self.checkpoint, self._key, state)

    def resume(self) -> None:
        """Go on from the checkpoint."""
        state = read_checkpoint(self.checkpoint, self._key, of="a compass", fixed="settings or data")
        self.done = state["done"]
        self.network.load_state_dict(state["network"])
        self._optimizer.load_state_dict(state["optimizer"])


def _start_run(
    arrays: HeadsetArrays, pictures: np.ndarray, checkpoint: Path, *, seed: int, epochs: int
) -> _Run:
    """Begin a member, or go on with one; PyTorch's random numbers follow its seed from here on."""
    torch.manual_seed(seed)
    settings = [seed, epochs, arrays.description.get("dataset_hash"), pictures.shape]
    key = hashlib.sha256(json.dumps(settings).encode()).hexdigest()
    run = _Run(Compass(), pictures, checkpoint, key=key, seed=seed, epochs=epochs)
    if checkpoint.exists():
        run.resume()
    return run


def _rate(done: float) -> float:
    """Learning rate after a share of the training: up to its peak, then down along a cosine."""
    return _PEAK_RATE * min(1.0, done / _WARM_UP + 0.01) * 0.5 * (1 + math.cos(math.pi * done))


def _draw_light(random: np.random.Generator, views: np.ndarray, plain: np.ndarray) -> torch.Tensor:
    """Views (n, 64, 64) float32 as other cameras and lamps would have made them."""
    seen = torch.from_numpy(views).float()[:, None]
    lit, _ = draw_photometry(random, seen, seen.clone(), 1.0, plain)
    return lit[:, 0]


def _scores(compass: MeanCompass, pictures: np.ndarray) -> CompassScores:
    """How well single views of people are told, lit anew."""
    if not len(pictures):
        return CompassScores(views=0, orientation=float("nan"), side=float("nan"), quarter=float("nan"))
    random = np.random.default_rng(0)
    views, orientations = draw_views(random, pictures)
    with torch.no_grad():
        told = compass(_draw_light(random, views, np.zeros(len(views), bool))).argmax(dim=1).numpy()
    return CompassScores(
        views=len(views),
        orientation=float(np.mean(told == orientations)),
        side=float(np.mean(told % 2 == orientations % 2)),
        quarter=float(np.mean(told // 2 == orientations // 2)),
    )

"""Adapts the last layers of a trained headset network to one person: ridge regression with a pull to what they are.

Only the linear heads that read codes change, and only as far as frames with known weights ask; encoders, variances and
points stay. The shares with which cameras count do not depend on these heads, so each weight is linear in them, and
both sides of the face share a head through the mirror. Needs no PyTorch.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import onnx
from onnx import helper, numpy_helper

from facegen.conventions import BLENDSHAPES
from regress.errors import ModelError
from regress.runtime.headset.network.graph import HeadsetGraph
from regress.runtime.headset.network.model import HeadsetModel
from regress.runtime.headset.network.outputs import MIRROR

PULLS = (3.0, 10.0, 30.0, 100.0, 300.0)
"""Penalties on changes of the heads that are tried: below 3 eight rendered faces are learnt by heart."""

LEAST_GAIN = 0.01
"""Share of its error on held-out frames that a network must lose to be written: half of what ten faces vary by."""

_MEANS = ".means.weight"
_SHAPES = len(BLENDSHAPES)


@dataclass(frozen=True, kw_only=True, eq=False)
class KnownFrames:
    """Frames of a person whose weights are known in part, as a network sees them.

    Parameters
    ----------
    weights : (n, 52)
        What they are.
    known : (n, 52) bool
        Which of them count.
    fold : (n,)
        Number of the face or stretch of time that a frame belongs to: it is held out as a whole, as frames that follow
        one another are nearly the same.
    """

    weights: np.ndarray
    known: np.ndarray
    fold: np.ndarray


@dataclass(frozen=True, kw_only=True, eq=False)
class Heads:
    """What the heads of a network get and give, of n frames.

    Parameters
    ----------
    names
        Of each camera's weights in the graph; the one head of a holistic network stands alone.
    biases
        Of each camera's bias.
    features
        (n, k + 1) that each camera's head reads, the last of them 1.
    shares : (n, cameras, 52)
        How much each camera counts, in units of the weights.
    mirrored
        Whether a camera's head sees the mirrored face.
    weights : (n, 52)
        The network's answer.
    """

    names: tuple[str, ...]
    biases: tuple[str, ...]
    features: tuple[np.ndarray, ...]
    shares: np.ndarray
    mirrored: tuple[bool, ...]
    weights: np.ndarray

    def design(self, shapes: Sequence[int], rows: np.ndarray) -> tuple[np.ndarray, list[tuple[str, int]]]:
        """How weights of some shapes (len(shapes) * rows, p) change with rows of heads, and which rows these are."""
        parts: dict[tuple[str, int], dict[int, np.ndarray]] = {}
        for place, shape in enumerate(shapes):
            for camera, (name, read) in enumerate(zip(self.names, self.features, strict=True)):
                row = int(MIRROR[shape]) if self.mirrored[camera] else shape
                here = parts.setdefault((name, row), {})
                here[place] = here.get(place, 0) + self.shares[rows, camera, shape, None] * read[rows]
        keys = sorted(parts)
        blocks = [
            np.concatenate(
                [
                    parts[key].get(place, np.zeros((len(rows), self._width(key[0]))))
                    for place in range(len(shapes))
                ]
            )
            for key in keys
        ]
        return np.concatenate(blocks, axis=1), keys

    def _width(self, name: str) -> int:
        return self.features[self.names.index(name)].shape[1]


def read_heads(
    graph: bytes,
    model: HeadsetModel,
    pictures: dict[str, np.ndarray],
    neutral: dict[str, np.ndarray] | None,
    *,
    terms: Mapping[str, np.ndarray] | None = None,
) -> Heads:
    """Run a network on frames, and keep what its heads read.

    Parameters
    ----------
    terms
        Where cameras are, as `HeadsetGraph.told` takes them; nothing is told without.

    Raises
    ------
    ModelError
        Where the graph has no heads as `regress headset train` makes them.
    """
    whole = onnx.load_from_string(graph)
    known = {one.name: numpy_helper.to_array(one) for one in whole.graph.initializer}
    nodes = [node for node in whole.graph.node if node.op_type == "Gemm" and node.input[1].endswith(_MEANS)]
    if len(nodes) not in (1, len(model.cameras)) or known.get("std", np.zeros(0)).shape != (_SHAPES + 4,):
        raise ModelError("network.onnx has no heads as `regress headset train` makes them; train it anew")
    for node in nodes:
        whole.graph.output.append(helper.make_tensor_value_info(node.input[0], onnx.TensorProto.FLOAT, None))
    run = HeadsetGraph(whole.SerializeToString(), model.cameras, model.points)
    run = run if terms is None else run.told(terms)
    estimates, read = run.read([node.input[0] for node in nodes], pictures, neutral=neutral)
    shares = estimates.shares if len(nodes) > 1 else np.ones((len(estimates.weights), 1, _SHAPES))
    return Heads(
        names=tuple(node.input[1] for node in nodes),
        biases=tuple(node.input[2] for node in nodes),
        features=tuple(np.column_stack([one, np.ones(len(one))]).astype(np.float64) for one in read),
        shares=shares * known["std"][:_SHAPES].astype(np.float64),
        mirrored=tuple(len(nodes) > 1 and one.mirrored_of is not None for one in model.cameras[: len(nodes)]),
        weights=estimates.weights.astype(np.float64),
    )


def changes(
    heads: Heads, frames: KnownFrames, rows: np.ndarray, *, pull: float
) -> dict[tuple[str, int], np.ndarray]:
    """What to add to rows of heads, by the head's name and the row: ridge regression on some frames."""
    found = {}
    for pair in _pairs():
        design, keys = heads.design(pair, rows)
        wanted, known = (
            np.concatenate([table[rows, one] for one in pair])
            for table in (frames.weights - heads.weights, frames.known)
        )
        if not known.any():
            continue
        design, wanted = design[known], wanted[known]
        gram = design @ design.T + pull * np.eye(len(design))
        change = design.T @ np.linalg.solve(gram, wanted)
        widths = np.cumsum([heads.features[heads.names.index(name)].shape[1] for name, _ in keys])[:-1]
        found |= dict(zip(keys, np.split(change, widths), strict=True))
    return found


@dataclass(frozen=True, kw_only=True)
class HeldOut:
    """How a network does on frames that its adaptation has not seen: root mean square error of known weights.

    Parameters
    ----------
    before, after
        Of the network as it was, and adapted with `pull`.
    pull
        The best of `PULLS`.
    """

    before: float
    after: float
    pull: float

    @property
    def better(self) -> bool:
        """Whether it is worth to be written."""
        return self.after <= (1 - LEAST_GAIN) * self.before


def judge(heads: Heads, frames: KnownFrames) -> HeldOut:
    """Hold each fold out in turn, and say which pull does best there."""
    every = np.arange(len(frames.fold))
    before, after = 0.0, np.zeros(len(PULLS))
    for pair in _pairs():
        design, _ = heads.design(pair, every)
        gram = design @ design.T
        predicted, true, known = (
            np.concatenate([table[:, one] for one in pair])
            for table in (heads.weights, frames.weights, frames.known)
        )
        fold = np.tile(frames.fold, len(pair))
        before += float(((predicted - true)[known] ** 2).sum())
        for number in np.unique(fold[known]):
            held, fit = (np.flatnonzero(known & chosen) for chosen in (fold == number, fold != number))
            across, inner = gram[np.ix_(held, fit)], gram[np.ix_(fit, fit)]
            for column, pull in enumerate(PULLS):
                moved = across @ np.linalg.solve(inner + pull * np.eye(len(fit)), (true - predicted)[fit])
                after[column] += ((np.clip(predicted[held] + moved, 0, 1) - true[held]) ** 2).sum()
    best, count = int(np.argmin(after)), max(int(frames.known.sum()), 1)
    return HeldOut(
        before=float(np.sqrt(before / count)), after=float(np.sqrt(after[best] / count)), pull=PULLS[best]
    )


def _pairs() -> Iterator[list[int]]:
    """Shapes with their partners on the other side, with which they share rows of heads."""
    for shape in range(_SHAPES):
        pair = sorted({shape, int(MIRROR[shape])})
        if pair[0] == shape:
            yield pair


def adapted_graph(graph: bytes, heads: Heads, change: dict[tuple[str, int], np.ndarray]) -> bytes:
    """The graph with other heads."""
    whole = onnx.load_from_string(graph)
    by_name = {one.name: one for one in whole.graph.initializer}
    arrays = {name: numpy_helper.to_array(by_name[name]).copy() for name in {*heads.names, *heads.biases}}
    for (name, row), added in change.items():
        arrays[name][row] += added[:-1].astype(np.float32)
        arrays[heads.biases[heads.names.index(name)]][row] += np.float32(added[-1])
    for name, array in arrays.items():
        by_name[name].CopyFrom(numpy_helper.from_array(array, name))
    return whole.SerializeToString()

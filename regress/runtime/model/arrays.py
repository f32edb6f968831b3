"""Checks the arrays of a model of 68 points against its description: which there are, their shapes and numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.runtime.networks import LEVELS

CALIBRATED = "calibrated_"
"""Begins the names of the arrays that compare with a neutral frame."""

DENOISING = "denoising_"
"""Begins the names of the arrays that shrink features."""

LARGEST = 1e9
"""Of any number of a model, either way: those trained stay below 1e4, and with three such factors a sum of products
still fits float32, in which frames and exports compute."""

MOST_HIDDEN = 1000
"""Units of one network: recipes have 20, symmetric ones 40."""

Shape = tuple[str, ...]
"""Words stand for the model's own counts."""

_SET: dict[str, Shape] = {
    "w1": ("units", "inputs"),
    "b1": ("units",),
    "w2": ("outputs", "hidden"),
    "b2": ("outputs",),
    "network_of_output": ("outputs",),
    "feature_mean": ("features",),
    "feature_std": ("features",),
    "target_mean": ("outputs",),
    "target_std": ("outputs",),
}
"""Arrays of the networks for a frame alone, and again of those that compare."""

_FILTER: dict[str, Shape] = {
    "origin": ("features",),
    "axes": ("axes", "features"),
    "offset": ("axes",),
    "signal": ("axes",),
    "noise_axes": ("noise axes", "features"),
    "surplus": ("axes",),
    "usual": (),
    "least": (),
}
"""Arrays of what shrinks features for a set of networks, where something does."""

YOUNGER = frozenset({"surplus", "usual"})
"""Of the filter's; schema 3 knows them not."""

_FACE = {"mean_shape": (LANDMARK_COUNT, 2), "depth": (LANDMARK_COUNT,)}

_OWNERS = "network_of_output"

_POSITIVE = ("feature_std", "target_std", "signal")
"""They divide."""


@dataclass(frozen=True, kw_only=True)
class Sizes:
    """What a description says of its arrays.

    Parameters
    ----------
    features
        How many numbers the networks for a frame alone see.
    outputs
        Shapes that each network gives, in order.
    calibrated_features
        How many those see that compare with a neutral frame.
    """

    features: int
    outputs: Sequence[int]
    calibrated_features: int


def array_fault(arrays: Mapping[str, np.ndarray], sizes: Sizes) -> str | None:
    """What keeps arrays from being those of the model that a description has, in words; None where nothing does."""
    shapes = {name: shape for name, shape in _FACE.items() if name != "depth" or name in arrays}
    for prefix in ("", CALIBRATED) if any(name.startswith(CALIBRATED) for name in arrays) else ("",):
        shapes |= _shapes_of_set(arrays, prefix, sizes)
    missing, unknown = sorted(shapes.keys() - arrays.keys()), sorted(arrays.keys() - shapes.keys())
    if missing:
        return f"lacks the array {missing[0]}"
    if unknown:
        return f"holds the array {unknown[0][:60]!r}, which no model has"
    owners = np.repeat(np.arange(len(sizes.outputs)), sizes.outputs)
    for name, shape in shapes.items():
        fault = _fault(arrays[name], name, shape)
        if fault is None and name.endswith(_OWNERS) and not np.array_equal(arrays[name], owners):
            fault = "does not give each network of model.json its outputs, one after the other"
        if fault is not None:
            return f"is not of this model: its array {name} {fault}"
    return None


def _shapes_of_set(arrays: Mapping[str, np.ndarray], prefix: str, sizes: Sizes) -> dict[str, tuple[int, ...]]:
    """Shapes of all arrays that a set of networks needs; free sides are as long as they are, up to their bound."""

    def side(name: str, axis: int, most: int) -> int:
        shape = arrays[prefix + name].shape if prefix + name in arrays else ()
        return min(max(shape[axis], 1), most) if axis < len(shape) else 1

    features = sizes.calibrated_features if prefix else sizes.features
    counts = {"features": features, "outputs": sum(sizes.outputs), "hidden": side("w2", 1, MOST_HIDDEN)}
    counts |= {"units": counts["hidden"] * len(sizes.outputs), "inputs": features}
    words = dict(_SET)
    if any(name.startswith(prefix + DENOISING) for name in arrays):
        lacking = YOUNGER if not any(prefix + DENOISING + name in arrays for name in YOUNGER) else ()
        words |= {DENOISING + name: shape for name, shape in _FILTER.items() if name not in lacking}
        counts["axes"] = counts["inputs"] = side(f"{DENOISING}axes", 0, features + len(LEVELS))
        counts["noise axes"] = side(f"{DENOISING}noise_axes", 0, features)
    return {prefix + name: tuple(counts[word] for word in shape) for name, shape in words.items()}


def _fault(array: np.ndarray, name: str, shape: tuple[int, ...]) -> str | None:
    """What is wrong with one array by itself, in words; None where nothing is."""
    if array.shape != shape:
        return f"has the shape {array.shape}, where {shape} is needed"
    whole = name.endswith(_OWNERS)
    if array.dtype.kind not in ("iu" if whole else "f") or array.dtype.itemsize not in (4, 8):
        return f"holds {array.dtype}, where {'whole numbers' if whole else 'float64'} are needed"
    if not (np.abs(array) <= LARGEST).all():  # NaN is not, either
        return f"holds numbers that are not finite, or beyond {LARGEST:g}"
    if name.endswith(_POSITIVE) and not (array > 0).all():
        return "holds numbers that are not above 0"
    if name.endswith("least") and array < 0:
        return "is below 0"
    return None

"""Prepares training data: z-scored, in principal axes, padded to one shape."""

from dataclasses import dataclass, replace

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, MIRRORED_BLENDSHAPES, MIRRORED_LANDMARKS
from regress.learning.networks import Rows, fit_denoising
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.noise import DetectorNoise, displace, draw_displacements
from regress.learning.training.shrinking import draw_gains, shrink
from regress.runtime.features import Features, extract, mirrored_edges
from regress.runtime.model import Normalisation
from regress.runtime.networks import Denoising
from regress.targets import NETWORKS, OUTPUTS

OUTPUT_COLUMNS = [BLENDSHAPE_INDEX[name] for name in OUTPUTS]
"""Where the predicted shapes stand among the 52."""

WIDEST = max(len(network.outputs) for network in NETWORKS)

_PROBE = 0.002
"""Noise, in outer-eye distances, that shows how noise moves features: as much as a good detector's."""

_NO_AXIS = 1e-9
"""Share of the largest axis' square below which an axis is rounding: alignment takes four of the points' 136 away."""

_FLOAT = np.float32
"""Training's precision: errors agree with float64 to four digits at alphas from 0.1, in half the time."""


@dataclass(frozen=True, kw_only=True)
class Split:
    """One split, standardised.

    Parameters
    ----------
    inputs : (n, E) float64
        Z-scored features in principal axes.
    targets : (n, O) float64
        Z-scored weights in ``OUTPUTS`` order.
    exact : (n,) bool
        Rows as the dataset has them, not displaced.
    """

    inputs: np.ndarray
    targets: np.ndarray
    exact: np.ndarray

    def take(self, rows: np.ndarray | slice) -> "Split":
        """Some of the rows."""
        return Split(inputs=self.inputs[rows], targets=self.targets[rows], exact=self.exact[rows])

    def network_rows(self) -> Rows:
        """The same in the layout and precision of :class:`NetworkProblem`."""
        ones = np.ones((1, len(self.inputs)), dtype=_FLOAT)
        targets = np.zeros((len(NETWORKS), WIDEST, len(self.targets)), dtype=_FLOAT)
        for row, columns in enumerate(network_columns()):
            targets[row, : len(columns)] = self.targets[:, columns].T
        return Rows(inputs=np.concatenate([self.inputs.T.astype(_FLOAT), ones]), targets=targets)


@dataclass(frozen=True, kw_only=True)
class Prepared:
    """All splits, and the way back to features and weights.

    Parameters
    ----------
    splits
        By name.
    normalisation
        Z-scores of the training split.
    denoising
        What shrinks features; None where nothing does.
    input_mean, input_std : (E,) or (E + 2,) float64
        Z-scores of what comes of the features.
    rotation : (E, E) or (E + 2, A) float64
        Columns are the principal axes of the z-scored inputs: as many as denoising leaves, or all.
    """

    splits: dict[str, Split]
    normalisation: Normalisation
    denoising: Denoising | None
    input_mean: np.ndarray
    input_std: np.ndarray
    rotation: np.ndarray


def network_columns() -> list[range]:
    """Columns of ``OUTPUTS`` that each network gives."""
    ends = np.cumsum([len(network.outputs) for network in NETWORKS])
    return [range(end - len(network.outputs), end) for end, network in zip(ends, NETWORKS, strict=True)]


def used_outputs() -> np.ndarray:
    """(31, K): 1 where a network has that output, 0 for padding."""
    used = np.zeros((len(NETWORKS), WIDEST), dtype=_FLOAT)
    for row, network in enumerate(NETWORKS):
        used[row, : len(network.outputs)] = 1
    return used


@dataclass(frozen=True, kw_only=True)
class Faces:
    """Faces of one split before features are taken.

    Parameters
    ----------
    points : (n, 68, 2) float64
    neutral : (n, 68, 2) float64 or None
        A neutral frame of each face's person, where networks are to see one.
    weights : (n, 52) float64
    """

    points: np.ndarray
    neutral: np.ndarray | None
    weights: np.ndarray

    def repeated(self, times: int) -> "Faces":
        """The faces several times over."""
        return Faces(
            points=np.tile(self.points, (times, 1, 1)),
            neutral=None if self.neutral is None else np.tile(self.neutral, (times, 1, 1)),
            weights=np.tile(self.weights, (times, 1)),
        )

    def features(self, features: Features) -> np.ndarray:
        """Raw features (n, E), less the neutral frame's where there is one."""
        values = extract(features, self.points)
        return values if self.neutral is None else values - extract(features, self.neutral)


def mirrored(points: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The mirror images of faces (n, 68, 2) and their weights (n, 52)."""
    return points[:, list(MIRRORED_LANDMARKS)] * [-1, 1], weights[:, list(MIRRORED_BLENDSHAPES)]


def faces_of(dataset: KeypointDataset, split: str, *, calibrated: bool) -> Faces:
    """Faces of a split; calibrated ones leave out who has no neutral frame, and neutral frames held out.

    A held-out neutral frame would be compared with itself, which is no test.
    """
    rows = dataset.rows(split)
    if not calibrated:
        return Faces(points=dataset.points[rows], neutral=None, weights=dataset.weights[rows])
    neutral = dataset.neutral_rows()
    keep = neutral[rows] >= 0
    if split != "train":
        keep &= ~dataset.neutral[rows]
    rows = rows[keep]
    return Faces(
        points=dataset.points[rows], neutral=dataset.points[neutral[rows]], weights=dataset.weights[rows]
    )


def draw_detected(faces: Faces, noise: DetectorNoise, rng: np.random.Generator) -> Faces:
    """Faces as a detector would give them, with a bias of its own for each."""
    frame, neutral = draw_displacements(noise, rng, len(faces.points))
    points = faces.points
    if noise.movement < 1 and faces.neutral is not None:
        points = shrink(points, faces.neutral, draw_gains(rng, len(points), least=noise.movement))
    return replace(
        faces,
        points=displace(points, frame),
        neutral=None if faces.neutral is None else displace(faces.neutral, neutral),
    )


def prepare(
    dataset: KeypointDataset,
    features: Features,
    *,
    mirror: bool,
    noise: DetectorNoise | None = None,
    calibrated: bool = False,
    denoise: bool = False,
    whitening: float = 0.0,
    seed: int = 0,
) -> Prepared:
    """Standardise all splits by the training split.

    Held-out splits are never mirrored. Noise goes to training and validation, which must choose strengths
    for what networks will meet; the test split stays as the dataset has it.

    The rotation into principal axes changes no cost (``|W1 V| = |W1|``) and makes X'X diagonal for the
    preconditioner. Nothing is cut off: low-variance axes carry signal. Where features are denoised, what is rotated
    is features again, made of the places along the axes. Whitening, in part, strengthens faint axes against L2.
    """
    raw: dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}
    denoising = None
    for number, split in enumerate(("train", "validation", "test")):
        faces = faces_of(dataset, split, calibrated=calibrated)
        if mirror and split == "train":
            faces = _with_mirror_images(faces)
        if denoise and split == "train":
            denoising = _draw_denoising(features, faces, np.random.default_rng([seed, 3]))
        given = faces
        if noise is not None and split != "test":
            given = faces.repeated(noise.copies)
            faces = draw_detected(given, noise, np.random.default_rng([seed, number]))
        exact = (faces.points == given.points).all(axis=(1, 2))
        raw[split] = faces.features(features), faces.weights[:, OUTPUT_COLUMNS], exact
    inputs, targets, _ = raw["train"]
    normalisation = Normalisation(
        feature_mean=inputs.mean(axis=0),
        feature_std=_spread(inputs),
        target_mean=targets.mean(axis=0),
        target_std=_spread(targets),
    )
    count, input_mean, input_std = inputs.shape[1], normalisation.feature_mean, normalisation.feature_std
    if denoising is not None:
        # shrunk, but features again: along the axes themselves z-scores would make the faintest as large as the rest
        back, count = denoising.back, len(denoising.axes)
        # a lively face among these is no stranger; shrunk as one, it would teach networks that strangers are lively
        believing = denoising.believing
        raw = {split: (believing.shrunk(each[0]) @ back, *each[1:]) for split, each in raw.items()}
        input_mean, input_std = raw["train"][0].mean(axis=0), _spread(raw["train"][0])
    standard = (raw["train"][0] - input_mean) / input_std
    squares, axes = np.linalg.eigh(standard.T @ standard)
    rotation = axes[:, ::-1][:, :count]
    if whitening:
        rotation = rotation * _strengthened(squares[::-1][:count], whitening)
    splits = {
        split: Split(
            inputs=((inputs - input_mean) / input_std) @ rotation,
            targets=(targets - normalisation.target_mean) / normalisation.target_std,
            exact=exact,
        )
        for split, (inputs, targets, exact) in raw.items()
    }
    return Prepared(
        splits=splits,
        normalisation=normalisation,
        denoising=denoising,
        input_mean=input_mean,
        input_std=input_std,
        rotation=rotation,
    )


def _strengthened(squares: np.ndarray, whitening: float) -> np.ndarray:
    """Factors (A,) on axes with sums of squares (A,), most first: the mean square stays; 0 for axes that are none."""
    there = squares > _NO_AXIS * squares[0]
    factors = np.where(there, np.where(there, squares, 1.0) ** (-whitening / 2), 0.0)
    return factors * np.sqrt(squares[there].sum() / (squares * factors**2).sum())


def _draw_denoising(features: Features, faces: Faces, rng: np.random.Generator) -> Denoising:
    def moved(points: np.ndarray) -> np.ndarray:
        return displace(points, _PROBE * rng.standard_normal(points.shape))

    clean = faces.features(features)
    neutral = None if faces.neutral is None else moved(faces.neutral)
    disturbed = replace(faces, points=moved(faces.points), neutral=neutral).features(features)
    return fit_denoising(clean, (disturbed - clean) / _PROBE, mirrored_edges(features.edges))


def _with_mirror_images(faces: Faces) -> Faces:
    points, weights = mirrored(faces.points, faces.weights)
    neutral = faces.neutral
    if neutral is not None:
        neutral = np.concatenate([neutral, mirrored(neutral, faces.weights)[0]])
    return Faces(
        points=np.concatenate([faces.points, points]),
        neutral=neutral,
        weights=np.concatenate([faces.weights, weights]),
    )


def _spread(values: np.ndarray) -> np.ndarray:
    spread = values.std(axis=0)
    return np.where(spread > 0, spread, 1.0)  # a shape that never moves stays at 0 instead of NaN

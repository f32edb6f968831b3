"""Models without training: drawn faces and random networks of realistic size."""

import numpy as np
import pytest

from facegen.rigs import Rig
from facegen.spec import parse_spec
from facegen.store import resolve
from facegen.work import generate
from regress import Model, load_model
from regress.learning.networks import fit_denoising
from regress.learning.reference_shape import delaunay_edges
from regress.learning.training import KeypointDataset, read_dataset
from regress.runtime.features import (
    Features,
    closed_under_mirror,
    depths_of,
    extract,
    load_reference_shape,
    mirrored_edges,
)
from regress.runtime.model import Calibrated, Normalisation, symmetrised
from regress.runtime.networks import FoldedNetworks
from regress.targets import NETWORKS
from tests.regress.drawn import drawn_face, drawn_faces

HIDDEN = 20


def random_model(
    rng: np.random.Generator,
    *,
    alignment: str = "affine",
    turned: bool = True,
    denoised: bool = False,
    calibrated: str | None = None,
    symmetric: bool = False,
) -> Model:
    """A model whose hidden units and outputs swing as trained ones do: half of the outputs hit a bound.

    ``calibrated`` is the alignment of its networks that compare with a neutral face; None: it has none. A symmetric one
    is averaged with its mirror image.
    """
    features = random_features(rng, alignment, turned)
    drawn = drawn_faces(rng, 500)
    swing = 0.5 if symmetric else 0.3  # a mean of two swings less
    networks, normalisation = random_networks(rng, features, drawn, denoised=denoised, swing=swing)
    beside = None
    if calibrated is not None:
        compared = random_features(rng, calibrated, turned) if calibrated != alignment else features
        rest = drawn_faces(rng, 1) if calibrated != alignment else drawn[:1]
        others, scores = random_networks(
            rng, compared, drawn, denoised=calibrated == alignment, swing=swing, neutral=rest
        )
        beside = Calibrated(features=compared, normalisation=scores, networks=others)
    model = Model(
        recipe="paper",
        table=NETWORKS,
        features=features,
        normalisation=normalisation,
        networks=networks,
        calibrated=beside,
    )
    return symmetrised(model) if symmetric else model


def random_features(rng: np.random.Generator, alignment: str, turned: bool) -> Features:
    edges = closed_under_mirror(delaunay_edges(drawn_face() + rng.normal(size=(68, 2)) * 1e-3))
    return Features(
        alignment=alignment,
        mean_shape=drawn_face() / 2 + [0.3, -0.2],  # off the origin: readers must centre it
        edges=np.zeros((0, 2), dtype=np.int64) if alignment == "stable" else edges,
        reference_name="drawn",
        reference_sha256="0" * 64,
        depth=depths_of(load_reference_shape()) if turned else None,
    )


def random_networks(
    rng: np.random.Generator,
    features: Features,
    drawn: np.ndarray,
    *,
    denoised: bool,
    swing: float,
    neutral: np.ndarray | None = None,
) -> tuple[FoldedNetworks, Normalisation]:
    """Networks of realistic size that act on the features of faces (n, 68, 2), or on these less the neutral face's."""
    raw = extract(features, drawn)
    if neutral is not None:
        raw = raw - extract(features, neutral)
    mean, std = raw.mean(axis=0), raw.std(axis=0)
    feature_mean, feature_std, denoising = mean, std, None
    if denoised:
        size = np.linalg.norm(drawn[:, 45] - drawn[:, 36], axis=1)[:, None, None]
        noisy = extract(features, drawn + 0.002 * size * rng.normal(size=drawn.shape))
        moved = (noisy - extract(features, drawn)) / 0.002
        denoising = fit_denoising(raw, moved, mirrored_edges(features.edges))
        seen = denoising.shrunk(raw)
        mean, spread = seen.mean(axis=0), seen.std(axis=0)
        std = np.maximum(spread, 1e-3)  # what hardly varies is left small
        std *= 0.8 * np.sqrt(np.mean((spread / std) ** 2))  # drawn faces swing less than that
    hidden_count = HIDDEN * len(NETWORKS)
    w1 = rng.normal(size=(hidden_count, len(mean))) / np.sqrt(len(mean)) / np.maximum(std, 1e-9)
    network_of_output = np.repeat(np.arange(len(NETWORKS)), [len(network.outputs) for network in NETWORKS])
    output_count = len(network_of_output)
    networks = FoldedNetworks(
        w1=w1,
        b1=rng.normal(size=hidden_count) - w1 @ mean,
        w2=rng.normal(size=(output_count, HIDDEN)) * swing,
        b2=rng.uniform(0, 0.5, size=output_count),
        network_of_output=network_of_output,
        denoising=denoising,
    )
    normalisation = Normalisation(
        feature_mean=feature_mean,
        feature_std=feature_std,
        target_mean=np.full(output_count, 0.2),
        target_std=np.full(output_count, 0.3),
    )
    return networks, normalisation


MODELS = {
    "denoised": {"denoised": True},
    "turn": {},
    "affine": {"turned": False},
    "none": {"alignment": "none", "turned": False},
    "points": {"alignment": "stable"},
    "symmetric": {"symmetric": True},
    "lengths and points": {"turned": False, "calibrated": "stable"},
    "lengths twice": {"turned": False, "calibrated": "affine", "symmetric": True},
    "symmetric lengths and points": {"denoised": True, "calibrated": "stable", "symmetric": True},
}
"""Every kind of networks that a recipe, or a neutral face given at export, can make."""


@pytest.fixture(scope="session", params=MODELS.values(), ids=MODELS)
def model(request) -> Model:
    return random_model(np.random.default_rng(5), **request.param)


@pytest.fixture(scope="session", params=[key for key in MODELS if "calibrated" in MODELS[key]])
def calibratable(request) -> Model:
    return random_model(np.random.default_rng(5), **MODELS[request.param])


@pytest.fixture(scope="session")
def faces() -> np.ndarray:
    """What exports read is float32, so what they are compared on is float32 too."""
    return drawn_faces(np.random.default_rng(6), 400).astype(np.float32)


@pytest.fixture(scope="session")
def shipped_model() -> Model:
    return load_model("landmarks-default")


@pytest.fixture(scope="session")
def shipped_people(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> KeypointDataset:
    """Ten people as facegen makes them, each with a neutral face: a test split for the model that ships."""
    table = {"version": 1, "kind": "still", "seed": 8, "people": 10, "split_shares": [0.0, 0.0, 1.0]}
    made = resolve(
        parse_spec(table | {"still": {"neutral": 1, "faces": 20}}, where="test"),
        tmp_path_factory.mktemp("people") / "made",
    )
    assert generate(made, workers=1).left == 0
    return read_dataset(made.folder.path, splits=("test",))

"""Models without training: a drawn face, random deformations of it, random networks of realistic size."""

from pathlib import Path

import numpy as np
import pytest

from regress import Model, load_model
from regress.features import Features, delaunay_edges, extract
from regress.model import Normalisation
from regress.networks import FoldedNetworks
from regress.targets import NETWORKS

HIDDEN = 20


def drawn_face() -> np.ndarray:
    """68 points of a face of width 2 about the origin, y down."""

    def arc(count, start_deg, stop_deg, centre, radii):
        angles = np.deg2rad(np.linspace(start_deg, stop_deg, count))
        return np.asarray(centre) + np.stack([np.cos(angles), np.sin(angles)], axis=1) * radii

    def ring(count, centre, radii):
        return arc(count + 1, 180, 540, centre, radii)[:-1]

    nose = np.stack([np.zeros(4), np.linspace(-0.25, 0.2, 4)], axis=1)
    return np.concatenate(
        [
            arc(17, 180, 0, (0, -0.1), (1, 1.25)),
            arc(5, 200, 320, (-0.48, -0.42), (0.34, 0.15)),
            arc(5, 220, 340, (0.48, -0.42), (0.34, 0.15)),
            nose,
            arc(5, 170, 10, (0, 0.26), (0.2, 0.09)),
            ring(6, (-0.45, -0.28), (0.17, 0.07)),
            ring(6, (0.45, -0.28), (0.17, 0.07)),
            ring(12, (0, 0.6), (0.36, 0.16)),
            ring(8, (0, 0.6), (0.28, 0.07)),
        ]
    )


def draw_faces(rng: np.random.Generator, count: int) -> np.ndarray:
    """Faces that differ as people do (smoothly) and as detectors do (by noise), in pixels at video places."""
    modes = rng.normal(size=(12, 68, 2)) * 0.03
    faces = drawn_face() + np.einsum("nk,kpd->npd", rng.normal(size=(count, 12)), modes)
    roll = rng.normal(size=count) * 0.2
    turn = np.stack([np.cos(roll), -np.sin(roll), np.sin(roll), np.cos(roll)], axis=1).reshape(-1, 2, 2)
    scale = rng.uniform(40, 300, size=(count, 1, 1))
    return (faces @ turn) * scale + rng.uniform(200, 1700, size=(count, 1, 2))


def random_model(rng: np.random.Generator, *, alignment: str = "affine") -> Model:
    """A model whose hidden units and outputs swing as trained ones do: half of the outputs hit a bound."""
    features = Features(
        alignment=alignment,
        mean_shape=drawn_face() / 2 + [0.3, -0.2],  # off the origin: readers must centre it
        edges=delaunay_edges(drawn_face() + rng.normal(size=(68, 2)) * 1e-3),
        reference_name="drawn",
        reference_sha256="0" * 64,
    )
    raw = extract(features, draw_faces(rng, 500))
    mean, std = raw.mean(axis=0), raw.std(axis=0)
    hidden_count = HIDDEN * len(NETWORKS)
    w1 = rng.normal(size=(hidden_count, len(mean))) / np.sqrt(len(mean)) / std
    network_of_output = np.repeat(np.arange(len(NETWORKS)), [len(network.outputs) for network in NETWORKS])
    output_count = len(network_of_output)
    return Model(
        recipe="paper",
        table=NETWORKS,
        features=features,
        normalisation=Normalisation(
            feature_mean=mean,
            feature_std=std,
            target_mean=np.full(output_count, 0.2),
            target_std=np.full(output_count, 0.3),
        ),
        networks=FoldedNetworks(
            w1=w1,
            b1=rng.normal(size=hidden_count) - w1 @ mean,
            w2=rng.normal(size=(output_count, HIDDEN)) * 0.3,
            b2=rng.uniform(0, 0.5, size=output_count),
            network_of_output=network_of_output,
        ),
        record={},
    )


@pytest.fixture(scope="session", params=["affine", "none"])
def model(request) -> Model:
    return random_model(np.random.default_rng(5), alignment=request.param)


@pytest.fixture(scope="session")
def faces() -> np.ndarray:
    """What exports read is float32, so what they are compared on is float32 too."""
    return draw_faces(np.random.default_rng(6), 400).astype(np.float32)


@pytest.fixture(scope="session")
def shipped_model() -> Model:
    folder = Path(__file__).parents[3] / "models" / "default"
    if not (folder / "model.json").is_file():
        pytest.skip("models/default is not built: `make` trains it")
    return load_model(folder)

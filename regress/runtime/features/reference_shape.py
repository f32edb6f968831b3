"""Reads the one reference shape and its Delaunay edges, fixed once and copied into every model."""

import hashlib
import json
from dataclasses import dataclass
from importlib import resources

import numpy as np

from facegen.conventions import MIRRORED_LANDMARKS


@dataclass(frozen=True, kw_only=True)
class ReferenceShape:
    """68 points and the edges that came from them.

    Parameters
    ----------
    name
        Which face it is.
    source
        How the points were made: commands and versions.
    tilt_deg
        Tilt about x before the orthographic projection.
    points : (68, 3) float64
        Head frame, metres, mirror-symmetric, not tilted.
    edges : (178, 2) int64
        Pairs ``i < j``, sorted.
    sha256
        Of the edges, as text ``i-j`` joined by commas.
    """

    name: str
    source: str
    tilt_deg: float
    points: np.ndarray
    edges: np.ndarray
    sha256: str


def mirrored_edges(edges: np.ndarray) -> np.ndarray:
    """Row of each edge's mirror partner, -1 where the list has none.

    Parameters
    ----------
    edges : (E, 2) int

    Returns
    -------
    (E,) int64
    """
    rows = {(int(i), int(j)): row for row, (i, j) in enumerate(edges)}
    mirrored = np.sort(np.asarray(MIRRORED_LANDMARKS)[edges], axis=1)
    return np.array([rows.get((int(i), int(j)), -1) for i, j in mirrored], dtype=np.int64)


def closed_under_mirror(edges: np.ndarray) -> np.ndarray:
    """The edges and their mirror partners, sorted: every edge of the result has its partner there."""
    lonely = edges[mirrored_edges(edges) < 0]
    partners = np.sort(np.asarray(MIRRORED_LANDMARKS)[lonely], axis=1)
    return np.unique(np.concatenate([edges, partners]), axis=0)


def edges_sha256(edges: np.ndarray) -> str:
    """SHA-256 of an edge list, as text ``i-j`` joined by commas."""
    return hashlib.sha256(",".join(f"{i}-{j}" for i, j in edges).encode()).hexdigest()


def load_reference_shape() -> ReferenceShape:
    """The reference shape shipped with the package."""
    document = json.loads(resources.files("regress").joinpath("data/reference_shape.json").read_text())
    return ReferenceShape(
        name=document["name"],
        source=document["source"],
        tilt_deg=document["tilt_deg"],
        points=np.array(document["points"]),
        edges=np.array(document["edges"], dtype=np.int64),
        sha256=document["edges_sha256"],
    )

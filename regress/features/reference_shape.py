"""The one reference shape and its Delaunay edges, fixed once and copied into every model."""

import hashlib
import json
from dataclasses import dataclass
from importlib import resources

import numpy as np

from facegen.conventions import LANDMARK_COUNT, MIRRORED_LANDMARKS
from regress.errors import InputError

EDGE_COUNT = 178
TILT_DEG = 1.5
"""Tilt about x before projection: from 0.5 to 3 degrees the hull has 23 points (178 edges), at 0 only 176."""


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


def delaunay_edges(points: np.ndarray) -> np.ndarray:
    """Edges of the Delaunay triangulation, sorted.

    Parameters
    ----------
    points : (n, 2) float64

    Returns
    -------
    (E, 2) int64
        Pairs ``i < j`` in lexicographic order.
    """
    from scipy.spatial import Delaunay  # half a second of import that predicting does not need

    triangles = Delaunay(points).simplices
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(pairs, axis=1), axis=0).astype(np.int64)


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


def make_reference_shape(
    points: np.ndarray, *, name: str, source: str, tilt_deg: float = TILT_DEG
) -> ReferenceShape:
    """Make a face symmetric, tilt it, project it orthographically and triangulate it.

    The mean of random people is symmetric to a tenth of a millimetre only, which is enough to flip edges.

    Parameters
    ----------
    points : (68, 3) float
        Head frame, metres (any length unit gives the same edges).

    Raises
    ------
    InputError
        Where the points are not 68 in 3D, or do not give 178 edges of which one has no mirror partner.
    """
    points = np.asarray(points, dtype=np.float64)
    if points.shape != (LANDMARK_COUNT, 3) or not np.isfinite(points).all():
        raise InputError(f"the reference shape needs finite points of shape (68, 3), found {points.shape}")
    points = (points + points[list(MIRRORED_LANDMARKS)] * [-1, 1, 1]) / 2
    tilt = np.deg2rad(tilt_deg)
    projected = np.stack([points[:, 0], points[:, 1] * np.cos(tilt) - points[:, 2] * np.sin(tilt)], axis=1)
    edges = delaunay_edges(projected)
    lonely = int(np.sum(mirrored_edges(edges) < 0))
    if len(edges) != EDGE_COUNT or lonely != 1:
        raise InputError(
            f"the reference shape {name!r} tilted by {tilt_deg} degrees gives {len(edges)} edges, {lonely} "
            f"without a mirror partner; {EDGE_COUNT} and 1 are needed (other tilts: 0.5 to 3 degrees)"
        )
    return ReferenceShape(
        name=name, source=source, tilt_deg=tilt_deg, points=points, edges=edges, sha256=edges_sha256(edges)
    )


def reference_shape_json(shape: ReferenceShape) -> str:
    """Text of a reference shape's file; the same shape always gives the same bytes."""
    points = ",\n".join(f"    {json.dumps(row)}" for row in shape.points.tolist())
    edges = ",\n".join(f"    {json.dumps(row)}" for row in shape.edges.tolist())
    head = {
        "name": shape.name,
        "source": shape.source,
        "frame": "head frame, metres; x to the subject's left, y up, z out of the face; iBUG order",
        "projection": "orthographic after y' = y cos(tilt) - z sin(tilt)",
        "tilt_deg": shape.tilt_deg,
        "edges_sha256": shape.sha256,
    }
    lines = "".join(f"  {json.dumps(key)}: {json.dumps(value)},\n" for key, value in head.items())
    return f'{{\n{lines}  "points": [\n{points}\n  ],\n  "edges": [\n{edges}\n  ]\n}}\n'


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

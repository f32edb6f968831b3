"""Makes the reference shape: symmetric, tilted, projected and triangulated (``regress edges``)."""

import json

import numpy as np
from scipy.spatial import Delaunay, QhullError

from facegen.conventions import LANDMARK_COUNT, MIRRORED_LANDMARKS
from regress.errors import InputError
from regress.runtime.features.reference_shape import ReferenceShape, edges_sha256, mirrored_edges

EDGE_COUNT = 178
TILT_DEG = 1.5
"""Tilt about x before projection: from 0.5 to 3 degrees the hull has 23 points (178 edges), at 0 only 176."""

LARGEST = 1e6
"""Of a coordinate, in whatever unit of length: a face in nanometres does not pass, one in micrometres does."""


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
    triangles = Delaunay(points).simplices
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(pairs, axis=1), axis=0).astype(np.int64)


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
        Where the points are not 68 in 3D, are on one line or too far out, or do not give 178 edges of which one has
        no mirror partner.
    """
    points = np.asarray(points, dtype=np.float64)
    if points.shape != (LANDMARK_COUNT, 3) or not (np.abs(points) <= LARGEST).all():
        raise InputError(
            f"the reference shape needs points of shape (68, 3), none beyond {LARGEST:g}, found {points.shape}"
        )
    points = (points + points[list(MIRRORED_LANDMARKS)] * [-1, 1, 1]) / 2
    tilt = np.deg2rad(tilt_deg)
    projected = np.stack([points[:, 0], points[:, 1] * np.cos(tilt) - points[:, 2] * np.sin(tilt)], axis=1)
    try:
        edges = delaunay_edges(projected)
    except QhullError as error:
        raise InputError(
            f"the points of {name!r} are on one line or in one place: no edges join them"
        ) from error
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

"""From 68 points to the 178 numbers the networks see: turn, alignment, edge lengths, face width."""

from regress.features.alignment import ANCHORS, align_affine, align_similarity, mean_shape
from regress.features.distances import edge_distances
from regress.features.extraction import ALIGNMENTS, Features, extract
from regress.features.reference_shape import (
    ReferenceShape,
    closed_under_mirror,
    delaunay_edges,
    load_reference_shape,
    make_reference_shape,
    mirrored_edges,
)
from regress.features.turn import depths_of, turn_weights, undo_turn

__all__ = [
    "ALIGNMENTS",
    "ANCHORS",
    "Features",
    "ReferenceShape",
    "align_affine",
    "align_similarity",
    "closed_under_mirror",
    "delaunay_edges",
    "depths_of",
    "edge_distances",
    "extract",
    "load_reference_shape",
    "make_reference_shape",
    "mean_shape",
    "mirrored_edges",
    "turn_weights",
    "undo_turn",
]

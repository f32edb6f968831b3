"""From 68 points to the numbers the networks see: turn, alignment, edge lengths or points, in face widths."""

from regress.runtime.features.alignment import ANCHORS, STABLE, align_affine, align_similarity, mean_shape
from regress.runtime.features.distances import edge_distances
from regress.runtime.features.extraction import ALIGNMENTS, Features, extract
from regress.runtime.features.reference_shape import (
    ReferenceShape,
    closed_under_mirror,
    load_reference_shape,
    mirrored_edges,
)
from regress.runtime.features.turn import depths_of, turn_weights, undo_turn

__all__ = [
    "ALIGNMENTS",
    "ANCHORS",
    "STABLE",
    "Features",
    "ReferenceShape",
    "align_affine",
    "align_similarity",
    "closed_under_mirror",
    "depths_of",
    "edge_distances",
    "extract",
    "load_reference_shape",
    "mean_shape",
    "mirrored_edges",
    "turn_weights",
    "undo_turn",
]

"""Which neutral faces exports refuse, in numbers: those that `face_faults` calls collapsed or mirrored."""

from regress.runtime.inputs.faults import FLAT, OUTLINE, TURNED

__all__ = ["FLAT", "LARGEST_AREA", "OUTLINE"]

LARGEST_AREA = 8 * TURNED
"""Twice the outline's area over the square of the face's extent, beyond which it runs the wrong way round."""

"""The bones of an avatar that is a head: chest, neck, head and eyes, all with the avatar's own axes."""

from facegen.avatars.surface import Bone
from facegen.rigs import Rig

CHEST_M, NECK_M, HEAD_M = (0.0, -0.26, -0.10), (0.0, -0.155, -0.100), (0.0, -0.055, -0.080)
"""Where these bones begin, in the frame of an adult's head; the head turns about the top of the spine, between the ears
and a little below them."""


def head_bones(rig: Rig) -> tuple[Bone, ...]:
    """Chest, Neck, Head, LeftEye and RightEye."""
    left, right = (tuple(float(x) for x in centre) for centre in rig.eye_center)
    return (
        Bone(name="Chest", parent=None, place=CHEST_M),
        Bone(name="Neck", parent="Chest", place=NECK_M),
        Bone(name="Head", parent="Neck", place=HEAD_M),
        Bone(name="LeftEye", parent="Head", place=left),
        Bone(name="RightEye", parent="Head", place=right),
    )

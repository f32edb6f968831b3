"""Names, orders, frames and numbers that every part agrees on (drawn in docs/conventions.md).

Frames, all right-handed, all in metres:

head
    Origin midway between the mean head's eyeballs as the rig's source draws them, which is some 5 mm behind and 1 mm
    above its human eyes; x to the subject's left, y up, z out of the face.
camera
    OpenCV: x right, y down, z forward. ``camera_from_head`` maps head points to camera points.
pixels
    (0, 0) is the centre of the top-left pixel.

Left and right are the subject's. Landmark index 0 (iBUG point 1) is the subject's right jaw, at the image's left.
Angles are radians inside, degrees in specs and on the command line, where the key says so (``yaw_deg``).
"""

from enum import IntEnum

BLENDSHAPES: tuple[str, ...] = (
    *("eyeBlinkLeft", "eyeLookDownLeft", "eyeLookInLeft", "eyeLookOutLeft", "eyeLookUpLeft", "eyeSquintLeft"),
    *("eyeWideLeft", "eyeBlinkRight", "eyeLookDownRight", "eyeLookInRight", "eyeLookOutRight"),
    *("eyeLookUpRight", "eyeSquintRight", "eyeWideRight"),
    *("jawForward", "jawLeft", "jawRight", "jawOpen"),
    *(
        "mouthClose",
        "mouthFunnel",
        "mouthPucker",
        "mouthLeft",
        "mouthRight",
        "mouthSmileLeft",
        "mouthSmileRight",
    ),
    *("mouthFrownLeft", "mouthFrownRight", "mouthDimpleLeft", "mouthDimpleRight", "mouthStretchLeft"),
    *("mouthStretchRight", "mouthRollLower", "mouthRollUpper", "mouthShrugLower", "mouthShrugUpper"),
    *("mouthPressLeft", "mouthPressRight", "mouthLowerDownLeft", "mouthLowerDownRight", "mouthUpperUpLeft"),
    "mouthUpperUpRight",
    *("browDownLeft", "browDownRight", "browInnerUp", "browOuterUpLeft", "browOuterUpRight"),
    *("cheekPuff", "cheekSquintLeft", "cheekSquintRight"),
    *("noseSneerLeft", "noseSneerRight"),
    "tongueOut",
)
"""The 52 ARKit blendshapes in Live Link Face's order, but with Left before Right throughout."""

BLENDSHAPE_INDEX: dict[str, int] = {name: index for index, name in enumerate(BLENDSHAPES)}

BLINK_INDICES = [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]
"""``weights[..., BLINK_INDICES]`` are the blinks of both eyes, left first."""

EYE_LOOK_INDICES = [index for index, name in enumerate(BLENDSHAPES) if name.startswith("eyeLook")]
"""``weights[..., EYE_LOOK_INDICES]`` are where both eyes look: the left one down, in, out, up, then the right one."""


def mirrored_name(blendshape: str) -> str:
    """Name of the same blendshape on the other side of the face; shapes without a side give themselves."""
    if blendshape.endswith("Left"):
        return blendshape.removesuffix("Left") + "Right"
    if blendshape.endswith("Right"):
        return blendshape.removesuffix("Right") + "Left"
    return blendshape


MIRRORED_BLENDSHAPES: tuple[int, ...] = tuple(BLENDSHAPE_INDEX[mirrored_name(name)] for name in BLENDSHAPES)
"""``weights[..., MIRRORED_BLENDSHAPES]`` are the weights of the mirrored face."""

RECORDED_WEIGHTS = (-0.1, 1.6)
"""Least and greatest weight of a recording that is played: it is kept as it is, and devices were seen to give -0.02 to
1.4."""

LANDMARK_COUNT = 68

LANDMARK_GROUPS: dict[str, range] = {
    "jaw": range(0, 17),
    "right_brow": range(17, 22),
    "left_brow": range(22, 27),
    "nose_bridge": range(27, 31),
    "nose_base": range(31, 36),
    "right_eye": range(36, 42),
    "left_eye": range(42, 48),
    "outer_lip": range(48, 60),
    "inner_lip": range(60, 68),
}
"""Landmark indices (0-67, iBUG order) of each part of the face."""

RIGHT_JAW_END, CHIN, LEFT_JAW_END = 0, 8, 16
NOSE_ROOT, NOSE_TIP = 27, 30
RIGHT_NOSE_WING, NOSE_BASE, LEFT_NOSE_WING = 31, 33, 35
RIGHT_MOUTH_CORNER, LEFT_MOUTH_CORNER = 48, 54
UPPER_LIP_TOP, UPPER_LIP_SEAM, LOWER_LIP_SEAM, LOWER_LIP_BOTTOM = 51, 62, 66, 57
"""Landmarks with names of their own; those of lips lie in the middle of the outer line and of the inner one."""

MIRRORED_LANDMARKS: tuple[int, ...] = (
    *(16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0),
    *(26, 25, 24, 23, 22, 21, 20, 19, 18, 17),
    *(27, 28, 29, 30, 35, 34, 33, 32, 31),
    *(45, 44, 43, 42, 47, 46, 39, 38, 37, 36, 41, 40),
    *(54, 53, 52, 51, 50, 49, 48, 59, 58, 57, 56, 55),
    *(64, 63, 62, 61, 60, 67, 66, 65),
)
"""``points[..., MIRRORED_LANDMARKS, :]`` are the landmarks of the mirrored face, once x is mirrored too."""

DETECTOR_DISAGREEMENT: dict[str, float] = {
    **{"jaw": 0.083, "right_brow": 0.060, "left_brow": 0.060, "nose_bridge": 0.031, "nose_base": 0.031},
    **{"right_eye": 0.024, "left_eye": 0.024, "outer_lip": 0.032, "inner_lip": 0.032},
}
"""How far apart two detectors put the points of each group, in outer-eye distances (measured on a tracked face)."""
BIAS_TOGETHER, BIAS_SMOOTH, BIAS_ALONE, BIAS_BENDS = 0.5, 0.35, 0.15, 3
"""Shares of a detector bias's variance: the group as a whole, bends along its contour (half waves at most), each point
alone."""

FACE_WIDTH_LANDMARKS = (0, 16)
"""The face's width in a picture is the distance between these two landmarks (ear to ear along the jaw)."""

SIDES = ("left", "right")
"""Order of every array with one row an eye: the subject's left first, as in ``BLENDSHAPES``."""


LID_POINTS = 12
"""Points along the margin of a lid in ``VIEW_POINTS``, equally far apart in the picture, inner canthus first."""

IRIS_POINTS = 8
"""Points of an iris' outline in ``VIEW_POINTS``: the one farthest along x, and on towards y (down) by eighths."""

VIEW_POINTS: tuple[str, ...] = (
    *(f"landmark_{index}" for index in range(len(MIRRORED_LANDMARKS))),
    *(
        f"{side}_{name}"
        for side in SIDES
        for name in (
            *(f"{lid}_lid_{place}" for lid in ("upper", "lower") for place in range(LID_POINTS)),
            "pupil",
            *(f"iris_{place}" for place in range(IRIS_POINTS)),
        )
    ),
)
"""Points of the face that headset views may show: landmarks, lids, centre of the pupil (through the cornea), iris."""


def _mirrored_view_point(name: str) -> str:
    side, part = name.split("_", 1)
    other = SIDES[1 - SIDES.index(side)]
    if part.startswith("iris_"):  # what lay farthest along x now lies farthest against it
        return f"{other}_iris_{(IRIS_POINTS // 2 - int(part.removeprefix('iris_'))) % IRIS_POINTS}"
    return f"{other}_{part}"


MIRRORED_VIEW_POINTS: tuple[int, ...] = (
    *MIRRORED_LANDMARKS,
    *(VIEW_POINTS.index(_mirrored_view_point(name)) for name in VIEW_POINTS[len(MIRRORED_LANDMARKS) :]),
)
"""``points[..., MIRRORED_VIEW_POINTS, :]`` are the view points of the mirrored face, once x is mirrored too."""


class Visibility(IntEnum):
    """COCO's numbers: outside the picture, inside but hidden, visible."""

    OUTSIDE = 0
    HIDDEN = 1
    VISIBLE = 2


class Part(IntEnum):
    """What a face of a mesh, or a pixel of a picture, belongs to; 0 is nothing at all."""

    BACKGROUND = 0
    SKIN = 1
    LIPS = 2
    BROWS = 3
    LASHES = 4
    SCLERA = 5
    IRIS = 6
    PUPIL = 7
    CORNEA = 8
    TEETH = 9
    GUMS = 10
    TONGUE = 11
    MOUTH_CAVITY = 12
    EYE_CAVITY = 13
    HEADSET = 14
    GLASSES = 15
    HAIR = 16
    LENS = 17


SPLITS = ("train", "validation", "test")
BLOCK = 1000
"""Samples that are drawn and computed together; a block is always computed whole, then cut."""
SHARD_ROWS = 10_000
"""Rows of a keypoint shard: ten blocks, committed whole."""

CAMERA_TERMS: tuple[str, ...] = (
    *("x", "y", "z"),
    *("forward_x", "forward_y", "forward_z"),
    *("right_x", "right_y", "right_z"),
    *("half_width", "half_height"),
    *("off_right", "off_down"),
    "fisheye",
)
"""What a network may be told of a camera (`facegen.geometry.camera_terms`): its place in the headset's frame in units
of 5 cm, its axis and the right of its picture as unit vectors there, half the picture's sides over the focal lengths,
the principal point from the picture's middle in picture widths and heights, and whether the lens is a fisheye's."""

CAMERA_TERMS_MIRRORED: tuple[float, ...] = (-1, 1, 1, -1, 1, 1, 1, -1, -1, 1, 1, -1, 1, 1)
"""``terms * CAMERA_TERMS_MIRRORED`` are those of a camera that sees the mirrored face, in a mirrored picture."""

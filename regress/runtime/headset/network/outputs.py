"""Lists a headset network's outputs for a frame: 52 weights, then four gaze angles; and mirrors them."""

import numpy as np

from facegen.conventions import BLENDSHAPES, MIRRORED_BLENDSHAPES

WEIGHTS = len(BLENDSHAPES)
GAZE_OUTPUTS = ("gazeYawLeft", "gazePitchLeft", "gazeYawRight", "gazePitchRight")
"""Radians in the head frame: yaw to the subject's left, pitch upwards, of each eye's optical axis."""
OUTPUTS = (*BLENDSHAPES, *GAZE_OUTPUTS)

MIRROR = np.array([*MIRRORED_BLENDSHAPES, *(WEIGHTS + column for column in (2, 3, 0, 1))])
"""``outputs[:, MIRROR] * MIRROR_SIGN`` are the outputs of the mirrored face."""
MIRROR_SIGN = np.array([*[1.0] * WEIGHTS, -1.0, 1.0, -1.0, 1.0], dtype=np.float32)
